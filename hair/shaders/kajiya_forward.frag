// SPDX-License-Identifier: MIT
// Kajiya-Kay, the yardstick of speed: the same lights, shadows, environment and ambient term as the hair material.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "options.glsl"
#include "frame.glsl"
#define VARYING in
#include "varyings.glsl"
#include "shadow.glsl"
#include "environment.glsl"
#include "light.glsl"
#include "material_common.glsl"
#include "scattering/kajiya_kay.glsl"

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

// Nothing here discards: what the depth pass has hidden is not shaded.
layout(early_fragment_tests) in;
layout(location = 0) out vec4 o_color;  // scene-linear, premultiplied

void main() {
    Surface s = fetchSurface();
    KajiyaKayParameters p = KajiyaKayParameters(s.color * material.diffuseWeight,
                                                material.specularColor * material.specularWeight,
                                                material.specularExponent, material.specularNorm);
    vec3 radiance = vec3(0.0);
    vec3 ambient = frame.ambient.rgb;
    int count = int(frame.eye.w);
    for (int i = 0; i < count; ++i) {
        Incident incident = incidentLight(frame.lights[i], s.world);
        float lit = shadowTransmittance(frame.lights[i], s.world, material.shadowDensity, material.shadowBias);
        vec3 arriving = incident.irradiance * lit;
        radiance += scatterKajiyaKay(s.tangent, incident.direction, s.wo, p) * arriving;
        ambient += arriving * isotropic;
    }
    if (envOn) {
        radiance += scatterKajiyaKay(s.tangent, s.normal, s.wo, p) * environmentIrradiance(s.normal) *
                    material.envScale;
    }
    if (ambientOn) radiance += s.color * ambient * material.ambientScatter;
    o_color = finish(radiance, s);
}
