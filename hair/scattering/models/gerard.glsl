// SPDX-License-Identifier: MIT
// Gerard, "Fast Real-Time Shading for Polygonal Hair", section 2.1: Marschner's S (marschner.glsl) with
// Henyey-Greenstein lobes over theta_h for the Gaussians, and N from a table without absorption times T at one offset:
// h = 0 for TT, sqrt(3)/2 for TRT. The table is the moment table, so N is roughened by beta_N and tabulated at theta_o.
//   published: (6) has the norm of a sphere, and as a lobe over theta_h the integral 1.29, 2.37, 0.76 for R, TT, TRT;
//              there is no 1/2 for theta_h either, and up to four times the light comes back. g is printed for 10, 5
//              and 20 degrees; between them it is interpolated. exp(-4 sigma) follows the squared chord of Marschner
//              and knows no inclination. TRT as (8): exp(-8 sigma (1 - 3 / (2 eta'^2))), which should read
//              3 / (4 eta'^2), with the printed eta', sqrt((eta^2 - cos^2 + 1) / cos), for
//              sqrt(eta^2 - 1 + cos^2) / cos. (13) of the paper, exp(-11/2 sigma), is what a right (8) gives at
//              theta_d = 0; it is not used here.
//   corrected: the lobe has its integral over the circle, 1, and the g nearest a Gaussian (relative L2 0.14); 1/2 of
//              it; exp(-sigma chord / cos(theta_t)) per segment.
#ifndef PELAGE_GERARD_GLSL
#define PELAGE_GERARD_GLSL
#include "marschner.glsl"
#include "moments.glsl"

// Complete elliptic integral of the second kind at parameter 1 - m1, 0 < m1 <= 1: Abramowitz and Stegun 17.3.36, 2e-8.
real gerardEllipticE(real m1) {
    real a = m1 * (0.44325141463 + m1 * (0.06260601220 + m1 * (0.04757383546 + m1 * 0.01736506451)));
    real b = m1 * (0.24998368310 + m1 * (0.09200180037 + m1 * (0.04069697526 + m1 * 0.00526449639)));
    return 1.0 + a - b * log(m1);
}

real gerardSinh(real x) {
    real q = x * x;
    real series = x * (1.0 + q / 6.0 * (1.0 + q / 20.0 * (1.0 + q / 42.0)));
    return x < 0.25 ? series : 0.5 * (exp(x) - exp(-x));
}

// Henyey-Greenstein of half-width `beta` at x = theta_h - shift. With g = exp(-l) and s = sinh(l / 2),
// 1 + g^2 - 2 g cos(x) = 4 g (s^2 + sin^2(x / 2)), which has no differences in it.
real gerardLobe(real beta, real x, bool published) {
    // Published: through the printed pairs (5, 0.865), (10, 0.752), (20, 0.578), to 0.0004. Corrected: least squares.
    real l = published ? 1.692 * beta / (1.0 + 0.2185 * beta) : 1.21 * beta / (1.0 + 0.1 * beta);
    real s = gerardSinh(0.5 * l), c = sqrt(1.0 + s * s);
    // |x| <= pi/2 + 3/4: the half angle stays inside marschnerSine's range.
    real t = s * s + square(marschnerSine(0.5 * x));
    real shape = s * c / (t * sqrt(t));
    if (published) return shape * exp(0.5 * l) / (8.0 * pi);
    return shape * s / (4.0 * gerardEllipticE(s * s / (c * c)));
}

FiberLobes scatterGerard(FiberAngles a, FiberMaterial m, FiberTable table, bool published) {
    FiberSection section = fiberSection(m, marschnerCosD(a));
    real cone = marschnerCone(a) * (published ? real(1.0) : real(0.5)), h = thetaH(a);
    real lengthTT = 2.0 * section.inverseCosT;
    real lengthTRT = 2.0 * lengthTT * sqrt(max(1.0 - 0.75 * square(section.inverseEtaPerp), real(0.0)));
    if (published) {
        lengthTT = 4.0;
        // Printed for 1.55. Below eta = 1.23 the exponent would change its sign and TRT gain light: bounded.
        real eta2 = (m.eta * m.eta - square(section.cosine) + 1.0) / section.cosine;
        lengthTRT = max(8.0 * (1.0 - 1.5 / eta2), real(0.0));
    }
    real4 n0 = momentLobes(fiberSection(m, a.cosO), table);
    FiberLobes n = noLobes();
    n.R = real3(n0.x * cone * gerardLobe(0.5 * m.deviation.x, h - m.alpha, published));
    n.TT = exp(-m.sigmaA * lengthTT) *
           (n0.y * cone * gerardLobe(0.5 * m.deviation.y, h + 0.5 * m.alpha, published));
    n.TRT = exp(-m.sigmaA * lengthTRT) *
            (n0.z * cone * gerardLobe(0.5 * m.deviation.z, h + 1.5 * m.alpha, published));
    return n;
}
#endif
