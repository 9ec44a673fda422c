// SPDX-License-Identifier: MIT
// The standard surface material, for skin and as a yardstick for hair.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/options.glsl"
#include "shaders/frame.glsl"
#define VARYING in
#include "shaders/varyings.glsl"
#include "lighting/environment.glsl"
#include "lighting/lights.glsl"
#include "material_common.glsl"
#include "scattering/models/standard_pbr.glsl"

layout(set = 2, binding = 0, std140) uniform Material {
    vec3 baseColor;
    float strandIdAmp;
    float metallic;
    float roughness;
    float fresnelF0;
    float specularScale;
    float envScale;
    float ambientScatter;
    float shadowDensity;
    float shadowBias;
} material;
#include "surface.glsl"

// Nothing here discards: what the depth pass has hidden is not shaded.
layout(early_fragment_tests) in;
layout(location = 0) out vec4 o_color;  // scene-linear, premultiplied

void main() {
    Surface s = fetchSurface();
    PbrParameters p = PbrParameters(s.color, material.metallic, material.roughness, material.fresnelF0,
                                    material.specularScale);
    vec3 radiance = vec3(0.0);
    vec3 ambient = frame.ambient;
    for (int i = 0; i < lightCount; ++i) {
        Incident light = arrivingLight(i, s.world, material.shadowDensity, material.shadowBias);
        radiance += scatterStandardPbr(s.normal, light.direction, s.wo, p) * light.irradiance;
        ambient += light.irradiance * isotropic;
    }
    if (envOn) {
        // Diffuse from the irradiance; specular as if the map were the mirror direction, blurred to irradiance.
        vec3 mirror = reflect(-s.wo, s.normal);
        vec3 f0 = mix(vec3(p.f0), p.color, p.metallic);
        radiance += (p.color * (1.0 - p.metallic) * environmentIrradiance(s.normal) +
                     f0 * p.specularScale * environmentIrradiance(mirror)) * (0.3183098862 * material.envScale);
    }
    if (ambientOn) radiance += s.color * ambient * material.ambientScatter;
    o_color = finish(radiance, s);
}
