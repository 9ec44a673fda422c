// SPDX-License-Identifier: MIT
// A FiberMaterial in a storage buffer: PackedFiber of hair/scattering/packed.hpp.
#ifndef PELAGE_PACKED_FIBER_GLSL
#define PELAGE_PACKED_FIBER_GLSL
#include "scattering/models/models.glsl"

struct PackedFiber {
    vec4 fiber0;  // eta, eta^2 - 1, alpha, beta_M
    vec4 fiber1;  // beta_N, 1 / s, peak, near field
    vec4 sigmaA, color;
    vec4 inverseVariance, norm, deviation, sinTilt, cosTilt, glint;
};

FiberMaterial unpackFiber(PackedFiber r) {
    FiberMaterial m;
    m.eta = r.fiber0.x;
    m.etaExcess = r.fiber0.y;
    m.alpha = r.fiber0.z;
    m.betaM = r.fiber0.w;
    m.betaN = r.fiber1.x;
    m.inverseScale = r.fiber1.y;
    m.peak = r.fiber1.z;
    m.offsetFit = 0.0;
    m.nearField = r.fiber1.w;
    m.sigmaA = r.sigmaA.xyz;
    m.color = r.color.xyz;
    m.inverseVariance = r.inverseVariance;
    m.norm = r.norm;
    m.deviation = r.deviation;
    m.sinTilt = r.sinTilt;
    m.cosTilt = r.cosTilt;
    m.glint = r.glint;
    return m;
}
#endif
