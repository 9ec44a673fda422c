// SPDX-License-Identifier: MIT
// Chiang et al. 2016, near field: the fibre at one offset h, with d'Eon's longitudinal lobe evaluated exactly (common
// implementations use a truncated Bessel series and are up to 2 % dark). Not reciprocal: attenuation is taken at
// theta_o. Without h it is the mean over h, by the midpoint rule in gamma; that is a yardstick, not a way to render.
#ifndef PELAGE_CHIANG_GLSL
#define PELAGE_CHIANG_GLSL
#include "attenuation.glsl"

// A_p N_p at the offset h = sin(gamma).
FiberLobes azimuthNear(FiberMaterial m, FiberSection s, real phi, real h, real cosGamma) {
    real cosGammaT = cosRefracted(s, m, cosGamma);
    real gamma = atanRight(h, cosGamma), gammaT = refractedAngle(s, h, cosGammaT);
    FiberLobes n = attenuation(fresnelExact(m.eta, m.etaExcess, s.cosine * cosGamma), m.sigmaA,
                               segmentLength(s, cosGammaT));
    n.R *= trimmedLogistic(azimuthFrom(phi, 0, gamma, gammaT), m);
    n.TT *= trimmedLogistic(azimuthFrom(phi, 1, gamma, gammaT), m);
    n.TRT *= trimmedLogistic(azimuthFrom(phi, 2, gamma, gammaT), m);
    n.RES *= 0.5 / pi;
    return n;
}

// Offsets of the mean; enough for beta_N >= 0.05.
const int chiangOffsets = 512;

FiberLobes scatterChiang(FiberAngles a, FiberMaterial m, FiberTable, bool) {
    FiberSection s = fiberSection(m, a.cosO);
    FiberLobes n = noLobes();
    if (m.nearField > 0.5) {
        n = azimuthNear(m, s, a.phi, a.h, a.cosGamma);
    } else {
        // gamma by the rotation of (sin, cos) by one step of pi / 512.
        const real cosStep = 0.999981175282601142, sinStep = 0.00613588464915447537;
        real sinGamma = -0.999995293809576172, cosGamma = 0.00306795676296597627;
        for (int k = 0; k < chiangOffsets; ++k) {
            FiberLobes one = azimuthNear(m, s, a.phi, sinGamma, cosGamma);
            real weight = 0.5 * cosGamma * (pi / real(chiangOffsets));
            n.R += weight * one.R;
            n.TT += weight * one.TT;
            n.TRT += weight * one.TRT;
            n.RES += weight * one.RES;
            real next = max(cosGamma * cosStep - sinGamma * sinStep, real(0.0));
            sinGamma = sinGamma * cosStep + cosGamma * sinStep;
            cosGamma = next;
        }
    }
    return alongFiber(n, longitudinals(a, m));
}
#endif
