// SPDX-License-Identifier: MIT
// The material of a fibre on the device: its uniform block, its table, and how light meets it. Expects options.glsl and
// material_common.glsl.
#ifndef PELAGE_FIBER_MATERIAL_GLSL
#define PELAGE_FIBER_MATERIAL_GLSL
#include "visibility/hash.glsl"
#include "scattering/models/models.glsl"

layout(set = 2, binding = 0, std140) uniform Material {
    vec3 baseColor;
    float strandIdAmp;
    vec3 sigmaA;  // besides that of the base colour
    float colorFit;
    vec3 gainR;
    float envScale;
    vec3 gainTT;
    float ambientScatter;
    vec3 gainTRT;
    float shadowDensity;
    vec3 gainRES;
    float shadowBias;
    vec4 fiber0, fiber1;  // eta, its excess, alpha, beta_M; beta_N, 1 / s, peak
    vec4 inverseVariance, norm, deviation, sinTilt, cosTilt, glint;
    vec4 envInverseVariance, envNorm, envDeviation;
} material;
layout(set = 2, binding = 5) uniform texture2DArray momentTable;

// Absorption of the base colour at a point: exp(-4 sigma) = C (Karis 2016; two paths through the axis), or Chiang 2016
// (9), where C is the colour of a mass of hair.
vec3 sigmaOf(vec3 color) {
    vec3 logColor = log(clamp(color, vec3(1e-4), vec3(1.0)));
    vec3 fitted = logColor * material.colorFit;
    return material.sigmaA + (chiangColor ? fitted * fitted : -0.25 * logColor);
}

FiberMaterial fiberMaterial(vec3 color) {
    FiberMaterial m;
    m.eta = material.fiber0.x;
    m.etaExcess = material.fiber0.y;
    m.alpha = material.fiber0.z;
    m.betaM = material.fiber0.w;
    m.betaN = material.fiber1.x;
    m.inverseScale = material.fiber1.y;
    m.peak = material.fiber1.z;
    m.sigmaA = sigmaOf(color);
    // Models without absorption reflect the base colour, or what pigments make of white.
    m.color = clamp(color, vec3(0.0), vec3(1.0)) * exp(-4.0 * material.sigmaA);
    m.inverseVariance = material.inverseVariance;
    m.norm = material.norm;
    m.deviation = material.deviation;
    m.sinTilt = material.sinTilt;
    m.cosTilt = material.cosTilt;
    m.glint = material.glint;
    m.offsetFit = attenuationModel == ATTENUATION_KARIS_H ? 1.0 : 0.0;
    m.nearField = scatteringModel == MODEL_CHIANG ? 1.0 : 0.0;
    return m;
}

const bool usesMomentTable =
    scatteringModel == MODEL_GERARD || scatteringModel == MODEL_PXR || scatteringModel == MODEL_MOMENT_LUT;

#define MOMENT_TEXTURE sampler2DArray(momentTable, s_material)
#include "moment_texture.glsl"

MomentRow fetchRow(FiberMaterial m, float cosO) {
    MomentRow row;
    row.y = 0.0;
    row.rest = vec4(0.0);
    if (usesMomentTable) row = momentRow(m, cosO, lobeRES);
    return row;
}

// Radiance per E_perp, with the artist's gains. Lobes that are off leave nothing behind.
vec3 scatter(FiberAngles a, FiberMaterial m, MomentRow row, bool withTT) {
    FiberTable t;
    t.lobes = vec4(0.0);
    t.lengths = vec4(0.0);
    t.rest = vec4(0.0);
    if (usesMomentTable) t = sampleMoments(a, row);
    FiberLobes l = scatterFiber(scatteringModel, asPublished, a, m, t);
    vec3 sum = vec3(0.0);
    if (lobeR) sum += material.gainR * l.R;
    if (lobeTT && withTT) sum += material.gainTT * l.TT;
    if (lobeTRT) sum += material.gainTRT * l.TRT;
    if (lobeRES) sum += material.gainRES * l.RES;
    return sum;
}

// chiang knows one offset at a time: a fragment takes one at random, evenly over the width of the fibre.
float fragmentOffset(vec2 pixel, float strand) {
    return 2.0 * hash01(uvec3(uvec2(pixel), floatBitsToUint(strand))) - 1.0;
}
#endif
