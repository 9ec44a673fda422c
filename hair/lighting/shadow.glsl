// SPDX-License-Identifier: MIT
// How much of a light reaches a point: its shadow map, looked up by the technique of the option `shadowMode`. Expects
// options.glsl, frame.glsl and light.glsl.
#ifndef PELAGE_SHADOW_GLSL
#define PELAGE_SHADOW_GLSL

layout(set = 1, binding = 0) uniform texture2DArray u_shadowMap;
layout(set = 1, binding = 1) uniform sampler s_nearest;

// A point in the shadow map of a light, and what its material says of shadows.
struct ShadowPoint {
    LightData light;
    vec2 uv;          // in the map
    float distance;   // m from the light's eye along its view
    float density;    // 1/m, of techniques in which light fades
    float bias;       // m by which the point is moved toward the light
};

// Metres from the light's eye along its view, of a reversed depth (1 near, 0 far). Both kinds of projection are computed
// and one is chosen without a branch: see frame.glsl.
float shadowDistance(LightData light, float depth) {
    float near = light.shadowNear, far = light.shadowFar;
    float central = near * far / (near + depth * (far - near)), parallel = far - depth * (far - near);
    return mix(parallel, central, light.shadowCentral);
}

// How far behind what the light sees first, m; negative before it. `texel` counts from the point's own.
float shadowDepthInside(ShadowPoint point, vec2 texel) {
    vec3 at = vec3(point.uv + texel * point.light.shadowTexel, float(point.light.shadowLayer));
    float depth = textureLod(sampler2DArray(u_shadowMap, s_nearest), at, 0.0).r;
    return point.distance - shadowDistance(point.light, depth) - point.bias;
}

// Texels in the window of the techniques that have one.
float shadowWindow() {
    float width = float(2 * pcfRadius + 1);
    return width * width;
}
#include "shadow_technique_files.glsl"  // generated from the list: the file of each technique

// 1 lit .. 0 dark; what the map does not hold is lit.
float shadowTransmittance(int i, vec3 world, float density, float bias) {
    if (shadowMode == SHADOW_off || !lightHasShadow(i)) return 1.0;
    ShadowPoint point;
    point.light = frame.lights[i];
    vec4 clip = point.light.worldToShadow * vec4(world, 1.0);
    vec3 ndc = clip.xyz / clip.w;
    if (any(greaterThan(abs(ndc.xy), vec2(1.0))) || clip.w <= 0.0) return 1.0;
    point.uv = vec2(0.5 + 0.5 * ndc.x, 0.5 - 0.5 * ndc.y);
    point.distance = shadowDistance(point.light, clamp(ndc.z, 0.0, 1.0));
    point.density = density;
    point.bias = bias;
#define PELAGE_SHADOW_TECHNIQUE(number, word, name, traits) if (shadowMode == number) return shadow##name(point);
#include "lighting/shadow_techniques.def"
#undef PELAGE_SHADOW_TECHNIQUE
    return 1.0;
}
#endif
