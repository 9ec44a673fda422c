// SPDX-License-Identifier: MIT
// Marschner et al. 2003: S = sum of M_p(theta_h) N_p(theta_d, phi) cos(theta_i) / cos^2(theta_d), a smooth cylinder
// around the fibre and rough along it. M: Gaussians of half our width, as theta_h turns half as fast as theta_i, about
// alpha, -alpha/2, -3/2 alpha. N: R and TT by their exact root and Jacobian; TRT by the paper's cubic in gamma,
//     phi = (12 c / pi - 2) gamma - 16 c / pi^3 gamma^3,  c = asin(1 / eta'),
// with its caustics cut out and replaced by Gaussians (section 5.2.2): k_G = 0.5, Delta eta' = 0.3, w_c = 10 to 25
// degrees by beta_N. They are cut where the cubic turns, not where the exact path does (h_c^2 = (4 - eta'^2) / 3), or
// the cubic's own pole would stay. Circular section (eta* = eta); no paths beyond TRT.
//   published: M without the factor 1/2 that goes with theta_h reflects twice the light it receives; the printed path
//              2 (1 + cos(2 gamma_t)) / cos(theta_t) is the square of the chord. Every root is cut by both caustics,
//              and what is put back is bounded by Delta h_M = 0.5: up to 60 % of TRT is lost.
//   corrected: 1/2 M; the chord; a root is cut by the caustic of its own side of the fibre alone, and the bound is the
//              width of that side, 1: TRT has 0.83 to 1.1 of its light at every theta_d.
#ifndef PELAGE_MARSCHNER_GLSL
#define PELAGE_MARSCHNER_GLSL
#include "attenuation.glsl"

// sin(t) for |t| <= pi / 2: Taylor to t^17, 4e-14.
real marschnerSine(real t) {
    real q = -t * t;
    return t * (1.0 + q / 6.0 * (1.0 + q / 20.0 * (1.0 + q / 42.0 * (1.0 + q / 72.0 * (1.0 + q / 110.0 *
           (1.0 + q / 156.0 * (1.0 + q / 210.0 * (1.0 + q / 272.0))))))));
}

// g of the lobe over theta_h: shift and width of R, TT, TRT.
real marschnerLongitudinal(FiberAngles a, FiberMaterial m, int lobe) {
    real shift = lobe == 0 ? m.alpha : (lobe == 1 ? -0.5 * m.alpha : -1.5 * m.alpha);
    return gaussian(0.5 * m.deviation[lobe], thetaH(a) - shift);
}

// cos(theta_d), bounded away from light and view on opposite ends of the fibre, where 1 / cos^2(theta_d) has its pole.
real marschnerCosD(FiberAngles a) { return clamp(cosThetaD(a), real(1e-3), real(1.0)); }

// cos(theta_i) / cos^2(theta_d).
real marschnerCone(FiberAngles a) { return a.cosI / square(marschnerCosD(a)); }

// A_p at the offset with this cosine of gamma.
FiberLobes marschnerAttenuation(FiberMaterial m, FiberSection s, real cosGamma, bool published) {
    real cosGammaT = cosRefracted(s, m, cosGamma);
    real segment = segmentLength(s, cosGammaT) * (published ? 2.0 * cosGammaT : real(1.0));
    return attenuation(fresnelExact(m.eta, m.etaExcess, s.cosine * cosGamma), m.sigmaA, segment);
}

// N_TT. With delta = gamma - gamma_t = (pi - phi) / 2 and a = 1 / eta': tan(gamma) = sin(delta) / (cos(delta) - a),
// and |2 d(phi)/dh|^-1 = (cos(delta) - a) (1 - a cos(delta)) / (4 D^3), D^2 = 1 + a^2 - 2 a cos(delta). Nothing arrives
// where cos(delta) < a. D^2 is summed from parts above zero: D >= 1 - a.
real3 marschnerTT(FiberAngles a, FiberMaterial m, FiberSection s, bool published) {
    real inverseEta = s.inverseEtaPerp;
    real cosDelta = marschnerSine(0.5 * abs(a.phi)), sinHalfDelta = marschnerSine(0.25 * (pi - abs(a.phi)));
    if (cosDelta <= inverseEta) return real3(0.0);
    real beyond = m.etaExcess / (s.root * s.root) / (1.0 + inverseEta);  // 1 - a
    real d2 = beyond * beyond + 4.0 * inverseEta * sinHalfDelta * sinHalfDelta;
    real d = sqrt(d2), cosGamma = min((cosDelta - inverseEta) / d, real(1.0));
    real density = cosGamma * (beyond + 2.0 * inverseEta * sinHalfDelta * sinHalfDelta) / (4.0 * d2);
    return marschnerAttenuation(m, s, cosGamma, published).TT * density;
}

// The real roots gamma of slope gamma - cubic gamma^3 = phi, cubic > 0; 1e3 stands for none. By 3 sin(u) - 4 sin^3(u) =
// sin(3 u) and its hyperbolic kin.
real3 marschnerRoots(real phi, real slope, real cubic) {
    real size = max(abs(slope), real(1e-5));
    real turn = sqrt(size / (3.0 * cubic));  // where the slope is zero, if it is anywhere
    real y = phi / (0.666666666666666667 * size * turn);
    real3 x = real3(1e3 / turn);
    if (slope > 0.0 && abs(y) <= 1.0) {
        real u = marschnerSine(atanRight(y, sqrt(1.0 - y * y)) / 3.0);
        real v = 1.73205080756887729 * sqrt(1.0 - u * u);
        x.x = 2.0 * u;
        x.y = v - u;
        x.z = -v - u;
    } else {
        real w = exp(log(abs(y) + sqrt(y * y + (slope > 0.0 ? real(-1.0) : real(1.0)))) / 3.0);
        real only = slope > 0.0 ? w + 1.0 / w : w - 1.0 / w;
        x.x = y > 0.0 ? -only : only;
    }
    return turn * x;
}

// The Gaussian around the caustic over its peak.
real marschnerCaustic(real x, real width) { return exp(-0.5 * square(wrapAngle(x) / width)); }

real3 marschnerTRT(FiberAngles a, FiberMaterial m, FiberSection s, bool published) {
    // c at least 1e-3, as at 89.9 degrees: the cubic term must not vanish.
    real c = max(atanRight(s.cosine, sqrt(m.etaExcess)), real(1e-3));
    real slope = 12.0 * c / pi - 2.0, cubic = 16.0 * c / (pi * pi * pi);
    real width = 0.174532925199432958 + 0.261799387799149436 * m.betaN;
    real reach = published ? 0.5 : 1.0, fade = 1.0, turn = 0.0, causticPhi = 0.0;
    if (slope > 0.0) {
        turn = sqrt(slope / (3.0 * cubic));
        causticPhi = 0.666666666666666667 * slope * turn;
        // Delta h = 2 sqrt(2 w_c / |d2(phi)/dh2|), the part of the width whose light the Gaussian stands for;
        // d2(phi)/dgamma2 = 6 cubic turn.
        real cosTurn = marschnerSine(halfPi - turn);
        reach = min(reach, 2.0 * cosTurn * sqrt(width / max(3.0 * cubic * turn, real(1e-6))));
    } else {
        // No caustic above eta' = 2, but N is still high there: faded out over Delta eta'.
        real t = clamp((1.0 / max(s.inverseEtaPerp, real(1e-3)) - 2.0) / 0.3, real(0.0), real(1.0));
        fade = 1.0 - t * t * (3.0 - 2.0 * t);
    }
    real phi = abs(a.phi);
    real near = marschnerCaustic(phi - causticPhi, width), far = marschnerCaustic(phi + causticPhi, width);
    real3 sum = real3(0.0);
    // Paths turn by up to 196 degrees (eta near 1), so some arrive at phi from the other side.
    for (int k = 0; k < 2; ++k) {
        real target = phi - 2.0 * pi * real(k);
        real3 gammas = marschnerRoots(target, slope, cubic);
        for (int r = 0; r < 3; ++r) {
            real gamma = abs(gammas[r]);
            if (gamma > halfPi) continue;
            real cosGamma = marschnerSine(halfPi - gamma);
            // At the pole the cut is zero to a higher order; the bound keeps the two apart.
            real rate = max(abs(slope - 3.0 * cubic * gamma * gamma), real(1e-3));
            real own = marschnerCaustic(target + (gammas[r] > 0.0 ? -causticPhi : causticPhi), width);
            real cut = published ? (1.0 - fade * near) * (1.0 - fade * far) : 1.0 - fade * own;
            sum += marschnerAttenuation(m, s, cosGamma, published).TRT * (0.5 * cosGamma / rate * cut);
        }
    }
    real peak = 0.398942280401432678 / width;
    return sum + marschnerAttenuation(m, s, marschnerSine(halfPi - turn), published).TRT *
                     (fade * 0.5 * reach * peak * (near + far));
}

FiberLobes scatterMarschner(FiberAngles a, FiberMaterial m, FiberTable, bool published) {
    FiberSection s = fiberSection(m, marschnerCosD(a));
    real cone = marschnerCone(a) * (published ? real(1.0) : real(0.5));
    real cosGamma = cosHalfPhi(a);  // R: gamma = -phi / 2
    FiberLobes n = noLobes();
    n.R = real3(fresnelExact(m.eta, m.etaExcess, s.cosine * cosGamma).x * 0.25 * cosGamma);
    n.R *= cone * marschnerLongitudinal(a, m, 0);
    n.TT = marschnerTT(a, m, s, published) * (cone * marschnerLongitudinal(a, m, 1));
    n.TRT = marschnerTRT(a, m, s, published) * (cone * marschnerLongitudinal(a, m, 2));
    return n;
}
#endif
