// SPDX-License-Identifier: MIT
// Every invocation takes one material and walks through many directions, random and in the corners of their ranges.
// What it finds goes into a few counters: how often a value was not a number or was negative, and the worst of what is
// bounded.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "visibility/hash.glsl"
#include "scattering/models/models.glsl"

layout(constant_id = 0) const int scatteringModel = 8;
layout(constant_id = 1) const bool asPublished = false;
layout(constant_id = 2) const int points = 64;       // per invocation
layout(constant_id = 3) const bool nonsense = false;  // vectors that are not directions come in
layout(constant_id = 4) const float nearField = 0.0;
layout(local_size_x = 64) in;

layout(set = 0, binding = 0, std430) readonly buffer Materials { FiberMaterial materials[]; };
// Floats above zero keep their order as integers.
layout(set = 0, binding = 1, std430) buffer Found {
    uint notFinite, negative, guardFailed, worstPeak, worstStep, worstSeed, worstTurn, worstMirror, worstTurnRelative;
} found;
layout(set = 0, binding = 2) uniform texture2DArray momentTable;
layout(set = 0, binding = 3) uniform sampler s_linear;
layout(push_constant) uniform Run { uint seed; } run;

uvec3 state;
float next() {
    state = pcg3d(state);
    return float(state.x >> 8) * (1.0 / 16777216.0);
}

#define MOMENT_TEXTURE sampler2DArray(momentTable, s_linear)
#include "material/moment_texture.glsl"

vec3 direction(float z, float phi) {
    float r = sqrt(max(1.0 - z * z, 0.0));
    return vec3(r * cos(phi), r * sin(phi), z);
}

// A direction about the axis u, often at a corner: along u, across it, nearly so, or the other direction again.
vec3 pick(vec3 u, vec3 other) {
    float corner = next();
    float z = 2.0 * next() - 1.0, phi = 6.2831853 * next();
    vec3 free = direction(z, phi);
    if (corner < 0.6) return free;
    if (corner < 0.65) return other;
    if (corner < 0.7) return -other;
    if (corner < 0.75) return u;
    if (corner < 0.8) return -u;
    vec3 across = normalize(cross(u, free) + vec3(1e-20));
    if (corner < 0.85) return across;
    if (corner < 0.9) return normalize(u + across * exp(-20.0 * next()));
    if (corner < 0.95) return normalize(-u + across * exp(-20.0 * next()));
    return normalize(other + across * exp(-20.0 * next()));
}

// Lengths a tangent or a direction should never have.
vec3 broken(vec3 v) {
    float kind = next();
    float zero = next() * 0.0;
    if (kind < 0.15) return v * 0.0;
    if (kind < 0.3) return v * 1e-20;
    if (kind < 0.45) return v * 1e20;
    if (kind < 0.55) return v * 1e-42;
    if (kind < 0.65) return vec3(zero / zero, v.y, v.z);
    if (kind < 0.75) return v / zero;
    return v;
}

// Of a number at least 0; -0.0, whose bits are above all others, included.
uint ordered(float x) { return floatBitsToUint(x) & 0x7fffffffu; }

bool isNumber(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }

void checkOne(vec3 bare, vec3 guarded) {
    for (int c = 0; c < 3; ++c) {
        if (!isNumber(bare[c])) atomicAdd(found.notFinite, 1u);
        else if (bare[c] < 0.0) atomicAdd(found.negative, 1u);
        if (!isNumber(guarded[c]) || guarded[c] < 0.0) atomicAdd(found.guardFailed, 1u);
    }
}

float tallest;  // the largest peak of an azimuthal lobe, times 4

void check(FiberLobes bare, FiberLobes guarded) {
    checkOne(bare.R, guarded.R);
    checkOne(bare.TT, guarded.TT);
    checkOne(bare.TRT, guarded.TRT);
    checkOne(bare.RES, guarded.RES);
}

// The largest of the lobes over their own bounds: M <= norm and N <= peak / 4.
float relative(FiberLobes s, FiberMaterial m) {
    float r = s.R.x / (m.norm.x * tallest);
    r = max(r, s.TT.x / (m.norm.y * tallest));
    r = max(r, s.TRT.x / (m.norm.z * tallest));
    return max(r, s.RES.x / (m.norm.w * tallest));
}

float difference(FiberLobes s, FiberLobes t, FiberMaterial m) {
    FiberLobes d;
    d.R = abs(s.R - t.R);
    d.TT = abs(s.TT - t.TT);
    d.TRT = abs(s.TRT - t.TRT);
    d.RES = abs(s.RES - t.RES);
    return relative(d, m);
}

FiberAngles anglesOf(vec3 u, vec3 wi, vec3 wo, float h) {
    FiberAngles a = fiberAngles(u, wi, wo);
    a.h = h;
    a.cosGamma = sqrt(max((1.0 - h) * (1.0 + h), 0.0));
    return a;
}

FiberLobes bareAt(FiberAngles a, FiberMaterial m) {
    return scatterFiberBare(scatteringModel, asPublished, a, m, sampleMoments(a, momentRow(m, a.cosO, true)));
}

void main() {
    uint id = gl_GlobalInvocationID.x;
    FiberMaterial m = materials[id % uint(materials.length())];
    m.nearField = nearField;
    state = uvec3(id, run.seed, 77u);
    // Slopes per lobe height that a step is measured by: one over the narrowest widths.
    float narrow = scatteringModel == MODEL_pxr && m.glint.x > 0.0 ? max(m.inverseScale, m.glint.y) : m.inverseScale;
    tallest = max(m.peak, scatteringModel == MODEL_pxr && m.glint.x > 0.0 ? 1.1 * m.glint.y : 0.0);
    float slope = sqrt(m.inverseVariance.y) + narrow + 4.0;
    // Roughnesses of 0.2 and more: along the fibre that is a width of 0.17768 (Chiang 2016, equation 7).
    bool ordinary = (scatteringModel != MODEL_pxr || m.glint.y <= 20.0) &&
                    m.deviation.x >= 0.17768 && m.betaN >= 0.2 && m.eta >= 1.2 && m.eta <= 2.0 &&
                    m.sigmaA.x <= 4.0 && abs(m.alpha) <= 0.1;
    if (nonsense) {
        // Numbers that no material has: vectors alone are mended by fiberAngles() before a model sees them.
        float kind = next(), zero = next() * 0.0;
        if (kind < 0.2) m.inverseVariance *= zero / zero;
        else if (kind < 0.4) m.sigmaA = vec3(zero / zero);
        else if (kind < 0.6) m.norm = vec4(1.0) / zero;
        else if (kind < 0.7) m.color = vec3(-1.0, zero / zero, 1.0 / zero);
    }
    for (int i = 0; i < points; ++i) {
        vec3 u = direction(2.0 * next() - 1.0, 6.2831853 * next());
        vec3 wo = pick(u, vec3(0.0, 1.0, 0.0));
        vec3 wi = pick(u, wo);
        float h = next() < 0.2 ? (next() < 0.5 ? -1.0 : 1.0) : 2.0 * next() - 1.0;
        if (nonsense) {
            u = broken(u);
            wo = broken(wo);
            wi = broken(wi);
        }
        FiberAngles a = anglesOf(u, wi, wo, h);
        FiberTable t = sampleMoments(a, momentRow(m, a.cosO, true));
        FiberLobes bare = scatterFiberBare(scatteringModel, asPublished, a, m, t);
        FiberLobes guarded = scatterFiber(scatteringModel, asPublished, a, m, t);
        check(bare, guarded);
        if (nonsense) continue;
        atomicMax(found.worstPeak, ordered(relative(guarded, m)));
        // The light moves by 1e-4 in theta and in phi. (As vectors near the axis, any step turns phi by any angle.)
        FiberAngles moved = a;
        moved.sinI = a.sinI + 1e-4 * a.cosI;
        moved.cosI = abs(a.cosI - 1e-4 * a.sinI);
        float size = inversesqrt(moved.sinI * moved.sinI + moved.cosI * moved.cosI);
        moved.sinI *= size;
        moved.cosI *= size;
        moved.phi = wrapAngle(a.phi + 1e-4);
        moved.cosPhi = clamp(cos(moved.phi), -1.0, 1.0);
        FiberAngles same = a;
        same.cosPhi = clamp(cos(a.phi), -1.0, 1.0);
        FiberLobes after = bareAt(moved, m);
        check(after, after);
        // Models over theta_d have a pole where both directions lie along the fibre at opposite ends.
        bool pole = scatteringModel == MODEL_marschner || scatteringModel == MODEL_thesis ||
                    scatteringModel == MODEL_gerard;
        if (pole && cosThetaD(a) < 0.2) continue;
        FiberLobes before = bareAt(same, m);
        check(before, before);
        float step = difference(after, before, m) / (1e-4 * slope);
        if (atomicMax(found.worstStep, ordered(step)) < ordered(step)) found.worstSeed = id;
        // Everything turned together, by half a turn about an axis that has no meaning to the fibre. The azimuth of a
        // direction near the fibre's own has few digits, whatever the model makes of it.
        vec3 axis = normalize(vec3(0.3, -0.7, 0.648));
        vec3 tu = 2.0 * axis * dot(axis, u) - u, ti = 2.0 * axis * dot(axis, wi) - wi;
        vec3 to = 2.0 * axis * dot(axis, wo) - wo;
        FiberLobes turned = bareAt(anglesOf(tu, ti, to, h), m);
        check(turned, turned);
        float change = difference(turned, bare, m);
        atomicMax(found.worstTurn, ordered(change * a.cosI * a.cosO / slope));
        // Where the fibre is as bright as one that scatters evenly, 1 / (4 pi).
        if (ordinary && a.cosI > 0.5 && a.cosO > 0.5) {
            float all = bare.R.x + bare.TT.x + bare.TRT.x + bare.RES.x;
            float other = turned.R.x + turned.TT.x + turned.TRT.x + turned.RES.x;
            if (all > 0.08) atomicMax(found.worstTurnRelative, ordered(abs(other - all) / all));
        }
        // phi and h mirrored together.
        FiberAngles mirror = a;
        mirror.phi = -a.phi;
        mirror.h = -a.h;
        FiberLobes mirrored = bareAt(mirror, m);
        check(mirrored, mirrored);
        atomicMax(found.worstMirror, ordered(difference(mirrored, bare, m)));
    }
}
