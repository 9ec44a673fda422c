// SPDX-License-Identifier: MIT
// Karis 2016, "Physically based hair shading in Unreal", from the slides and third parties' quotations: Gaussians over
// sin(theta_i) + sin(theta_o), whose measure cos(theta_i) d(theta_i) is that of the sphere, so S needs no cosine; N by
// fits at eta = 1.55. Absorption by the colour C = exp(-4 sigma_a). Shifts have the opposite sign of the talk's, whose
// tangent points to the root.
//   published: eta' = 1.19 / cos(theta_d) + 0.36 cos(theta_d) whatever eta; Schlick's Fresnel; R about a mirror, but
//              tilted by 2 alpha, so its highlight is 4 alpha away; lobes of constant width over sin(theta), half of
//              which is past the fibre's ends at grazing view; TT = C^(0.5 cos(gamma_t) / cos(theta_d)) and TRT =
//              C^(0.8 / cos(theta_d)), where the path has 1 / cos(theta_t), so grazing light is black.
//   corrected: eta' exact, and Fresnel of R and TT; the mirror tilted by alpha, TT and TRT by their tilts of theta_o;
//              widths times cos(theta_o), which is what a small turn does to sin(theta), and what falls past the ends
//              put back; absorption along the path at the model's own offsets.
//   Both keep the fits of the azimuth, h of TT and h = sqrt(3)/2 of TRT: those are approximations, not errors. TRT
//   keeps Schlick too, which its fit needs: the exact Fresnel term at that offset is 1.4 times too bright.
#ifndef PELAGE_KARIS_GLSL
#define PELAGE_KARIS_GLSL
#include "attenuation.glsl"

// C^x by exp: C = exp(-4 sigma_a), so no 0^0 and no logarithm of zero.
real3 karisColor(FiberMaterial m, real x) { return exp(m.sigmaA * (-4.0 * x)); }

// Width over sin(theta) of a lobe of `deviation` around theta_o. Where the cosine is gone, the second order is left:
// sin(90 degrees + t) = 1 - t^2 / 2, with deviation v / sqrt(2).
real karisWidth(FiberAngles a, real deviation) {
    return deviation * sqrt(square(a.cosO) + min(0.5 * deviation * deviation, real(1.0)) * square(a.sinO));
}

// The normal distribution function; error 1.5e-4, |x| bounded where it is 0 or 1.
real karisBelow(real x) {
    real z = clamp(x, real(-6.0), real(6.0));
    return 1.0 / (1.0 + exp(-z * (1.5976 + 0.07056 * z * z)));
}

// The Gaussian around `middle` with its part in -1..1 scaled to 1. At least 1/20 of it lies inside: a tilt can push the
// middle past the end.
real karisInside(real width, real sinI, real middle) {
    real inside = karisBelow((1.0 - middle) / width) + karisBelow((1.0 + middle) / width) - 1.0;
    return gaussian(width, sinI - middle) / max(inside, real(0.05));
}

FiberLobes scatterKaris(FiberAngles a, FiberMaterial m, FiberTable, bool published) {
    real cosD = clamp(cosThetaD(a), real(1e-3), real(1.0)), halfCos = cosHalfPhi(a);
    FiberSection section = fiberSection(m, cosD);
    real inverseEta = published ? cosD / (1.19 + 0.36 * cosD * cosD) : section.inverseEtaPerp;
    real f0 = square((m.eta - 1.0) / (m.eta + 1.0));

    // R. sin and cos of the tilt: of 2 alpha or alpha. The width goes to zero with cos(phi / 2), and so does N_R: 1e-3
    // bounds the quotient.
    real sinA = published ? -m.sinTilt.x : m.sinTilt.y, cosA = published ? m.cosTilt.x : m.cosTilt.y;
    real shift = 2.0 * sinA * (cosA * halfCos * a.cosO + sinA * a.sinO);
    real broad = 1.41421356237309505 * max(halfCos, real(1e-3));
    real longR = published ? gaussian(broad * m.deviation.x, a.sinI + a.sinO - shift)
                           : karisInside(broad * karisWidth(a, m.deviation.x), a.sinI, shift - a.sinO);
    real cosHalfAngle = sqrt(max(0.5 + 0.5 * (a.sinI * a.sinO + a.cosI * a.cosO * a.cosPhi), real(0.0)));
    real fR = published ? fresnelSchlick(f0, cosHalfAngle) : fresnelExact(m.eta, m.etaExcess, cosHalfAngle).x;

    // TT. h is a fit and passes 1 for eta below 1.34.
    real h2 = min(square(halfCos * (1.0 + inverseEta * (0.6 - 0.8 * a.cosPhi))), real(1.0));
    real cosTT = cosD * sqrt(1.0 - h2);
    real throughTT = published ? 1.0 - fresnelSchlick(f0, cosTT) : fresnelExact(m.eta, m.etaExcess, cosTT).y;
    real pathTT = 0.5 * sqrt(max(1.0 - h2 * square(inverseEta), real(0.0)));
    real nTT = exp(-3.65 * a.cosPhi - 3.98);

    // TRT.
    real fTRT = fresnelSchlick(f0, 0.5 * cosD);
    real pathTRT = published ? real(0.8) : sqrt(max(1.0 - 0.75 * square(inverseEta), real(0.0)));
    real nTRT = exp(17.0 * a.cosPhi - 16.78);

    real slant = published ? 1.0 / cosD : section.inverseCosT;
    real sinTT = a.sinO * m.cosTilt.y + a.cosO * m.sinTilt.y, sinTRT = a.sinO * m.cosTilt.z + a.cosO * m.sinTilt.z;
    real longTT = published ? gaussian(m.deviation.y, a.sinI + a.sinO + m.alpha)
                            : karisInside(karisWidth(a, m.deviation.y), a.sinI, -sinTT);
    real longTRT = published ? gaussian(m.deviation.z, a.sinI + a.sinO + 4.0 * m.alpha)
                             : karisInside(karisWidth(a, m.deviation.z), a.sinI, -sinTRT);

    FiberLobes s = noLobes();
    s.R = real3(longR * fR * 0.25 * halfCos);
    s.TT = karisColor(m, pathTT * slant) * (longTT * throughTT * throughTT * nTT);
    s.TRT = karisColor(m, pathTRT * slant) * (longTRT * square(1.0 - fTRT) * fTRT * nTRT);
    return s;
}
#endif
