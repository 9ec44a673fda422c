// SPDX-License-Identifier: MIT
// R, TT, TRT and glint under artists' controls over the exact lobes, after the ideas of Pekelis et al. 2015 (their
// equations are not public). Widths and shifts are those of the FiberMaterial, which here may be set lobe by lobe;
// gains and tints are applied by the caller. The glint is light taken out of TRT and gathered where the azimuth of TRT
// turns back, the caustic of a smooth fibre, so it costs no energy: gain 1 moves half of TRT.
#ifndef PELAGE_PXR_GLSL
#define PELAGE_PXR_GLSL
#include "chiang.glsl"
#include "moments.glsl"

// cos(gamma) of the offset at which the azimuth of TRT turns back: h_c^2 = (4 - eta'^2) / 3 (Marschner 2003, section
// 4.3), written as cos^2 = (eta'^2 - 1) / 3 = (eta^2 - 1) / (3 cos^2(theta)), which keeps its digits for eta near 1. 1,
// the middle of the fibre, where it does not turn back.
real causticCosine(FiberSection s, FiberMaterial m) {
    return sqrt(min(m.etaExcess / max(3.0 * s.cosine * s.cosine, real(1e-12)), real(1.0)));
}

FiberLobes scatterPxr(FiberAngles a, FiberMaterial m, FiberTable table, bool) {
    FiberSection s = fiberSection(m, a.cosO);
    FiberLobes n;
    if (m.nearField > 0.5) {
        n = azimuthNear(m, s, a.phi, a.h, a.cosGamma);
    } else {
        n = azimuthMoments(a, m, table);
    }
    n = alongFiber(n, longitudinals(a, m));
    real share = m.glint.x / (1.0 + m.glint.x);
    if (share > 0.0) {
        // Two logistics around +-phi_c, of TT's sharp longitudinal width, with the light TRT has over all azimuths: its
        // attenuation at the caustic.
        real cosGamma = causticCosine(s, m), h = sqrt(max(1.0 - cosGamma * cosGamma, real(0.0)));
        real cosGammaT = cosRefracted(s, m, cosGamma);
        real caustic = 4.0 * refractedAngle(s, h, cosGammaT) - 2.0 * atanRight(h, cosGamma);
        FiberMaterial g = m;
        g.inverseScale = m.glint.y;
        real end = exp(-pi * g.inverseScale);
        g.peak = g.inverseScale * (1.0 + end) / (1.0 - end);
        g.sinTilt[1] = m.sinTilt[2] * m.glint.z + m.cosTilt[2] * m.glint.w;
        g.cosTilt[1] = m.cosTilt[2] * m.glint.z - m.sinTilt[2] * m.glint.w;
        real azimuth = 0.5 * (trimmedLogistic(a.phi - caustic, g) + trimmedLogistic(a.phi + caustic, g));
        FiberLobes light = attenuation(fresnelExact(m.eta, m.etaExcess, s.cosine * cosGamma), m.sigmaA,
                                       segmentLength(s, cosGammaT));
        n.TRT = (1.0 - share) * n.TRT + share * light.TRT * azimuth * longitudinals(a, g).y;
    }
    return n;
}
#endif
