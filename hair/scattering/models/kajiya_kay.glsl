// SPDX-License-Identifier: MIT
// Kajiya and Kay 1989: Kd sin(t, l) + Ks cos^p(theta_i + theta_o). It reflects a colour and knows no absorption. The
// highlight, colourless, is R; the diffuse part is the residual. p = 1 / v makes cos^p as wide as the Gaussian of
// beta_M.
//   published: Kd = colour, Ks = 1, neither normalised: the integral of sin(t, l) is pi^2, that of the highlight
//              2 pi sqrt(pi) Gamma(p/2 + 1) / Gamma(p/2 + 3/2). The highlight lies on the mirror cone, without tilt.
//   corrected: both divided by their integrals and the light split between them, so that nothing is gained; the
//              highlight is tilted by the scales like R of the later models.
#ifndef PELAGE_KAJIYA_KAY_GLSL
#define PELAGE_KAJIYA_KAY_GLSL
#include "fiber.glsl"

// Share of the light in a highlight off the surface: what a smooth fibre of index 1.55 reflects, averaged over its
// width.
const real kajiyaHighlight = 0.075;

// cosine^p, with the sine at hand: near the peak the logarithm of the cosine would lose its digits, and p reaches 7e4.
real kajiyaPower(real cosine, real sine, real p) {
    real q = sine * sine;
    real series = -0.5 * q * (1.0 + q * (0.5 + q * (0.333333333333333333 + q * 0.25)));
    return exp(p * (q < 0.02 ? series : log(clamp(cosine, real(1e-30), real(1.0)))));
}

// Gamma(y) / Gamma(y + 1/2), y >= 1. Interpolation at Chebyshev nodes in 1 / y; relative error 5e-8.
real kajiyaGammaRatio(real y) {
    real u = 1.0 / y;
    real g = 0.9999999147358531 +
             u * (-0.24999163649392353 +
                  u * (0.031115633370910542 +
                       u * (0.008619333953623515 +
                            u * (-0.00468490663399722 + u * (5.33122831831882e-07 + u * 0.0003393440540573227)))));
    return 1.0 / sqrt(y * g);
}

// cos^p(theta_i + theta_o): 1 on the mirror cone; beyond 90 degrees from it there is no highlight.
real kajiyaCone(FiberAngles a, real sinO, real cosO, real p) {
    real mirror = a.cosI * cosO - a.sinI * sinO;
    return mirror > 0.0 ? kajiyaPower(mirror, a.sinI * cosO + a.cosI * sinO, p) : real(0.0);
}

FiberLobes scatterKajiyaKay(FiberAngles a, FiberMaterial m, FiberTable, bool published) {
    real p = m.inverseVariance.x;
    real sinO = published ? a.sinO : a.sinO * m.cosTilt.x + a.cosO * m.sinTilt.x;
    real cosO = published ? a.cosO : a.cosO * m.cosTilt.x - a.sinO * m.sinTilt.x;
    real highlight = kajiyaCone(a, sinO, cosO, p);
    FiberLobes s = noLobes();
    if (published) {
        s.R = real3(highlight);
        s.RES = m.color * a.cosI;
    } else {
        // The highlight's integral is largest at theta_o = 0, where it is its share.
        real norm = 2.0 * pi * sqrt(pi) * kajiyaGammaRatio(0.5 * p + 1.0);
        s.R = real3(kajiyaHighlight * highlight / norm);
        s.RES = m.color * ((1.0 - kajiyaHighlight) * a.cosI / (pi * pi));
    }
    return s;
}
#endif
