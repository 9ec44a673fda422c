// SPDX-License-Identifier: MIT
// "A Framework for Real-Time Physically-Based Hair Rendering", chapter 4: Karis' fits of the azimuth, and Tafuri's
// h = 0 for TT and azimuthal roughness for TRT, on Marschner's longitudinal Gaussians (marschner.glsl).
// C = exp(-4 sigma_a); Schlick's Fresnel; s_r = 1.5 (1 - beta_N) clamped to 0..1.
//   published: M over theta_h without 1/2 (4.3); R's Fresnel at cos(wi.wo / 2) (4.12), an angle's cosine of a cosine;
//              paths over cos(theta_d) (4.17), and TRT's at 0.8, which is h / eta for h / eta' (4.24); TRT's lobe
//              s_r exp(s_r (17 cos(phi) - 16.78)) (4.27), whose light shrinks with sqrt(s_r) and is gone at
//              beta_N = 1.
//   corrected: 1/2 M; Fresnel at half the angle, sqrt(1/2 + wi.wo / 2); paths over cos(theta_t); h / eta'; TRT keeps
//              the light that it has at s_r = 1: exp(-16.78) I0(17) over exp(-16.78 s_r) I0(17 s_r).
#ifndef PELAGE_THESIS_GLSL
#define PELAGE_THESIS_GLSL
#include "marschner.glsl"

// cos(x) for |x| <= 1/2.
real thesisCosine(real x) {
    real q = -x * x;
    return 1.0 + q / 2.0 * (1.0 + q / 12.0 * (1.0 + q / 30.0 * (1.0 + q / 56.0 * (1.0 + q / 90.0))));
}

FiberLobes scatterThesis(FiberAngles a, FiberMaterial m, FiberTable, bool published) {
    FiberSection section = fiberSection(m, marschnerCosD(a));
    real cosD = section.cosine;
    real f0 = square((m.eta - 1.0) / (m.eta + 1.0));
    real cone = marschnerCone(a) * (published ? real(1.0) : real(0.5));
    real slant = published ? 1.0 / cosD : section.inverseCosT;

    real dotIO = clamp(a.sinI * a.sinO + a.cosI * a.cosO * a.cosPhi, real(-1.0), real(1.0));
    real fR = fresnelSchlick(f0, published ? thesisCosine(0.5 * dotIO) : sqrt(0.5 + 0.5 * dotIO));
    // TT through the middle (Tafuri), or at Karis' fitted offset (4.16) where that is asked for.
    real h = m.offsetFit > 0.5
                 ? min((1.0 + section.inverseEtaPerp * (0.6 - 0.8 * a.cosPhi)) * cosHalfPhi(a), real(1.0))
                 : real(0.0);
    real fTT = fresnelSchlick(f0, cosD * sqrt(1.0 - h * h));
    real pathTT = sqrt(max(1.0 - square(h * (published ? 1.0 / m.eta : section.inverseEtaPerp)), real(0.0)));
    real fTRT = fresnelSchlick(f0, 0.5 * cosD);  // h = sqrt(3) / 2
    real pathTRT = published ? real(0.8) : sqrt(max(1.0 - 0.75 * square(section.inverseEtaPerp), real(0.0)));

    real s = clamp(1.5 - 1.5 * m.betaN, real(0.0), real(1.0));
    real dTT = exp(-3.65 * a.cosPhi - 3.98);
    // Corrected: scaledBesselI0 has exp(-17 s) in it, which stays in the exponent here.
    real dTRT = published ? s * exp(s * (17.0 * a.cosPhi - 16.78))
                          : exp(17.0 * s * (a.cosPhi - 1.0)) * scaledBesselI0(real(17.0), real(0.22)) /
                                scaledBesselI0(17.0 * s, real(0.0));

    FiberLobes n = noLobes();
    n.R = real3(cone * marschnerLongitudinal(a, m, 0) * fR * 0.25 * cosHalfPhi(a));
    n.TT = exp(m.sigmaA * (-2.0 * pathTT * slant)) * (cone * marschnerLongitudinal(a, m, 1) * square(1.0 - fTT) * dTT);
    n.TRT = exp(m.sigmaA * (-4.0 * pathTRT * slant)) *
            (cone * marschnerLongitudinal(a, m, 2) * square(1.0 - fTRT) * fTRT * dTRT);
    return n;
}
#endif
