// SPDX-License-Identifier: MIT
// The material of a fibre on the device: its uniform block, its table, and how light meets it, for fragment and compute
// shaders alike: what depends on the place is an argument. Expects options.glsl and material_common.glsl.
#ifndef PELAGE_FIBER_MATERIAL_GLSL
#define PELAGE_FIBER_MATERIAL_GLSL
#include "visibility/hash.glsl"
#include "scattering/models/models.glsl"

// Traits of the model that the options select.
const int modelTraits = 0
#define PELAGE_SCATTERING_MODEL(number, id, name, function, traits, title, source) \
    + int(scatteringModel == number) * (traits)
#include "include/pelage/hair/scattering_models.def"
#undef PELAGE_SCATTERING_MODEL
    ;
const bool usesMomentTable = (modelTraits & TRAIT_TABLE) != 0;
const bool usesOffset = (modelTraits & TRAIT_NEAR_FIELD) != 0;

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
#define FIBER_PARAMETER(type, name) type name;
#define FIBER_POINT(type, name)
#include "scattering/fiber_parameters.def"
    // The same of the wider lobes that the one sample of the environment takes.
#define FIBER_PARAMETER(type, name)
#define FIBER_WIDTH(type, name) type name##Wide;
#define FIBER_POINT(type, name)
#include "scattering/fiber_parameters.def"
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
#define FIBER_PARAMETER(type, name) m.name = material.name;
#define FIBER_POINT(type, name)
#include "scattering/fiber_parameters.def"
    m.sigmaA = sigmaOf(color);
    // Models without absorption reflect the base colour, or what pigments make of white.
    m.color = clamp(color, vec3(0.0), vec3(1.0)) * exp(-4.0 * material.sigmaA);
    m.offsetFit = attenuationModel == ATTENUATION_KARIS_H ? 1.0 : 0.0;
    m.nearField = usesOffset ? 1.0 : 0.0;
    return m;
}

// With the lobes for the one sample that stands for a whole environment (Karis 2016).
FiberMaterial widened(FiberMaterial m) {
    FiberMaterial wide = m;
#define FIBER_PARAMETER(type, name)
#define FIBER_WIDTH(type, name) wide.name = material.name##Wide;
#define FIBER_POINT(type, name)
#include "scattering/fiber_parameters.def"
    return wide;
}

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

// Near-field models know one offset at a time: each pixel takes one at random, evenly over the width of the fibre.
float pixelOffset(vec2 pixel, float strand) {
    return usesOffset ? 2.0 * hash01(uvec3(uvec2(pixel), floatBitsToUint(strand))) - 1.0 : 0.0;
}
#endif
