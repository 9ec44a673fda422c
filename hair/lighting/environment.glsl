// SPDX-License-Identifier: MIT
// The environment as an irradiance map (W/m2 by direction of the normal).
#ifndef PELAGE_ENVIRONMENT_GLSL
#define PELAGE_ENVIRONMENT_GLSL
layout(set = 1, binding = 2) uniform textureCube u_irradiance;
layout(set = 1, binding = 3) uniform sampler s_linear;

vec3 environmentIrradiance(vec3 normal) {
    return textureLod(samplerCube(u_irradiance, s_linear), normal, 0.0).rgb;
}
#endif
