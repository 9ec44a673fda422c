// SPDX-License-Identifier: MIT
// One ray through the cross-section of a fibre at inclination theta and offset h = sin(gamma): where it leaves, how far
// it goes inside, how much of it arrives (Chiang 2016, section 4; Marschner 2003, section 4.3).
#ifndef PELAGE_ATTENUATION_GLSL
#define PELAGE_ATTENUATION_GLSL
#include "fiber.glsl"

struct FiberSection {
    real cosine;           // of theta
    real root;             // sqrt(eta^2 - sin^2(theta)) = eta' cos(theta)
    real inverseEtaPerp;   // 1 / eta', 0 at 90 degrees
    real inverseCosT;      // 1 / cos(theta_t)
};

FiberSection fiberSection(FiberMaterial m, real cosine) {
    FiberSection s;
    s.cosine = cosine;
    s.root = sqrt(m.etaExcess + cosine * cosine);
    s.inverseEtaPerp = cosine / s.root;
    s.inverseCosT = m.eta / s.root;
    return s;
}

// cos(gamma_t), by cos^2 = (eta^2 - 1 + cos^2(theta) cos^2(gamma)) / root^2.
real cosRefracted(FiberSection s, FiberMaterial m, real cosGamma) {
    return min(sqrt(m.etaExcess + square(s.cosine * cosGamma)) / s.root, real(1.0));
}

// gamma_t.
real refractedAngle(FiberSection s, real h, real cosGammaT) { return atanRight(h * s.inverseEtaPerp, cosGammaT); }

// Path inside for one segment, in radii: the chord of the circle over cos(theta_t).
real segmentLength(FiberSection s, real cosGammaT) { return 2.0 * cosGammaT * s.inverseCosT; }

// The shortest segment any offset has, at the rim; the least absorption.
real shortestSegment(FiberSection s, FiberMaterial m) { return segmentLength(s, cosRefracted(s, m, real(0.0))); }

// phi - Phi(p, h) in [-pi, pi]; Phi = 2 p gamma_t - 2 gamma + p pi.
real azimuthFrom(real phi, int p, real gamma, real gammaT) {
    real x = phi - (2.0 * real(p) * gammaT - 2.0 * gamma);
    if (p == 1) x = x > 0.0 ? (x - 3.140625) - 0.000967653589793238 : (x + 3.140625) + 0.000967653589793238;
    return wrapAngle(x);
}

// A_0..A_3 in color for the segment's transmittance T = exp(-sigma length).
FiberLobes attenuation(real2 fresnel, real3 sigmaA, real segment) {
    real3 t = exp(-sigmaA * segment);
    real through = fresnel.y * fresnel.y;
    FiberLobes a;
    a.R = real3(fresnel.x);
    a.TT = through * t;
    a.TRT = (through * fresnel.x) * t * t;
    // A_3 = A_2 f T / (1 - f T), with 1 - f T = (1 - f) + f (1 - T).
    real3 left = max(fresnel.y + fresnel.x * (real3(1.0) - t), real3(1e-30));
    a.RES = a.TRT * (fresnel.x * t) / left;
    return a;
}
#endif
