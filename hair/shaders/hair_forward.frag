// SPDX-License-Identifier: MIT
// The thesis' hair material: R, TT and TRT under punctual lights with shadows, one irradiance sample, ambient.
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
#include "scattering/thesis.glsl"

layout(set = 2, binding = 0, std140) uniform Material {
    vec3 baseColor;
    float strandIdAmp;
    vec3 lobeSigma;
    float azimuthScale;
    vec3 lobeShift;
    float azimuthNorm;
    vec3 lobeWeight;
    float fresnelF0;
    float eta;
    float envRoughness;
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
    ThesisParameters p = ThesisParameters(s.color, material.lobeSigma, material.lobeShift, material.lobeWeight,
                                          material.azimuthScale, material.azimuthNorm, material.fresnelF0, material.eta);
    vec3 radiance = vec3(0.0);
    vec3 ambient = frame.ambient.rgb;
    int count = int(frame.eye.w);
    for (int i = 0; i < count; ++i) {
        Incident incident = incidentLight(frame.lights[i], s.world);
        float lit = shadowTransmittance(frame.lights[i], s.world, material.shadowDensity, material.shadowBias);
        vec3 arriving = incident.irradiance * lit;
        radiance += scatterThesis(s.tangent, incident.direction, s.wo, p) * arriving;
        ambient += arriving * isotropic;
    }
    if (envOn) {
        // Wider lobes stand for the size of what lights the hair (Karis 2016): R, TT, TRT keep their ratios.
        p.sigma = max(material.envRoughness * vec3(1.0, 0.5, 2.0), vec3(0.01));
        radiance += scatterThesisEnvironment(s.tangent, s.normal, s.wo, p) * environmentIrradiance(s.normal) *
                    material.envScale;
    }
    if (ambientOn) radiance += s.color * ambient * material.ambientScatter;
    o_color = finish(radiance, s);
}
