// SPDX-License-Identifier: MIT
// Kajiya-Kay, the yardstick of speed: the same lights, shadows, environment and ambient term as the hair material.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/options.glsl"
#include "shaders/frame.glsl"
#define VARYING in
#include "shaders/varyings.glsl"
#include "lighting/environment.glsl"
#include "lighting/lights.glsl"
#include "material_common.glsl"
#include "scattering/models/kajiya_kay.glsl"

layout(set = 2, binding = 0, std140) uniform Material {
    vec3 baseColor;
    float strandIdAmp;
    vec3 specularColor;
    float specularExponent;
    float specularNorm;
    float specularWeight;
    float diffuseWeight;
    float envScale;
    float ambientScatter;
    float shadowDensity;
    float shadowBias;
} material;
#include "surface.glsl"

// The model with its exponent and its shares under the artist's hand: both parts divided by their integrals.
vec3 kajiyaKay(Surface s, vec3 wi) {
    FiberAngles a = fiberAngles(s.tangent, wi, s.wo);
    vec3 diffuse = s.color * (material.diffuseWeight * a.cosI / (pi * pi));
    return diffuse + material.specularColor * (material.specularWeight * material.specularNorm *
                                               kajiyaCone(a, a.sinO, a.cosO, material.specularExponent));
}

// Nothing here discards: what the depth pass has hidden is not shaded.
layout(early_fragment_tests) in;
layout(location = 0) out vec4 o_color;  // scene-linear, premultiplied

void main() {
    Surface s = fetchSurface();
    vec3 radiance = vec3(0.0);
    vec3 ambient = frame.ambient;
    for (int i = 0; i < lightCount; ++i) {
        Incident light = arrivingLight(i, s.world, material.shadowDensity, material.shadowBias);
        radiance += kajiyaKay(s, light.direction) * light.irradiance;
        ambient += light.irradiance * isotropic;
    }
    if (envOn) {
        radiance += kajiyaKay(s, s.normal) * environmentIrradiance(s.normal) *
                    material.envScale;
    }
    if (ambientOn) radiance += s.color * ambient * material.ambientScatter;
    o_color = finish(radiance, s);
}
