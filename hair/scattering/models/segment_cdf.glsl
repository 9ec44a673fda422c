// SPDX-License-Identifier: MIT
// Ours, without a table: the far field of chiang.glsl by segments of gamma. Inside a segment both the azimuth Phi and
// the weight A cos(gamma) / 2 are taken as linear in gamma; the integral of (linear weight) x (logistic around a linear
// Phi) is then exact, by the logistic's first and second antiderivatives. Narrow lobes are no harder than wide ones,
// where sampling h would need a point per width of the logistic.
#ifndef PELAGE_SEGMENT_CDF_GLSL
#define PELAGE_SEGMENT_CDF_GLSL
#include "attenuation.glsl"

const int segmentCount = 8;  // from gamma = 0 to pi/2; the other half is its mirror image
// The ends of the segments and their sines and cosines: gamma = pi/2 (1.5 t - 0.5 t^2) at even steps of t, closer at
// the rim, where Fresnel's reflectance climbs.
const real segmentGamma[9] = {
    0, 0.28225246497095796, 0.53996123733574564, 0.77312631709436319, 0.98174770424681035, 1.1658253987930873,
    1.3253594007331939, 1.4603497100671303, 1.5707963267948966};
const real segmentSin[9] = {
    0, 0.27851968938505306, 0.51410274419322166, 0.69837624940897292, 0.83146961230254524, 0.91911385169005777,
    0.97003125319454397, 0.99390697000235606, 1};
const real segmentCos[9] = {
    1, 0.96043051941556579, 0.85772861000027212, 0.71573082528381859, 0.55557023301960229, 0.3939920400610481,
    0.24298017990326398, 0.11022220729388318, 0};
// 1 / sum of (step x mean of the cosines at its ends): the chords below the cosine lose this much of d(h).
const real segmentNormal = 1.0048974584391095;

// The trimmed logistic D at x, with P = integral of D and Q = integral of P from the start of the turn to -|y|, where y
// is x within its turn: on that side both are small, and keep their digits in the tail. P(y) = 1 - P(-y), Q(y) = Q(-y)
// + y.
struct LogisticPoint {
    real x, turns, y, density, p, q;
};

LogisticPoint logisticPoint(real x, FiberMaterial m) {
    LogisticPoint r;
    r.x = x;
    r.turns = floor(x * 0.159154943091895336 + 0.5);
    r.y = wrapAngle(x);
    real e = exp(-abs(r.y) * m.inverseScale), end = exp(-pi * m.inverseScale);
    real inside = 1.0 / (1.0 + e), tail = end / (1.0 + end), scale = (1.0 + end) / (1.0 - end);
    r.density = m.peak * e * inside * inside;
    r.p = scale * (e * inside - tail);
    r.q = scale * ((log(1.0 + e) - log(1.0 + end)) / m.inverseScale - tail * (pi - abs(r.y)));
    return r;
}

// Integrals over t in 0..1 of (1 - t) D and t D along the straight line from a to b.
real2 segmentWeights(LogisticPoint a, LogisticPoint b, FiberMaterial m) {
    real d = b.x - a.x;
    real2 w;
    if (abs(d) * m.inverseScale < 1.0) {
        // Less than a width: the quotients below would cancel, and Simpson's rule is good.
        real middle = 2.0 * trimmedLogistic(0.5 * (a.x + b.x), m);
        w.x = (a.density + middle) / 6.0;
        w.y = (b.density + middle) / 6.0;
        return w;
    }
    // By parts: [t P] / d - [Q] / d^2.
    real turns = b.turns - a.turns, pA = a.p, pB = b.p, difference = b.q - a.q;
    if (turns == 0.0 && a.y * b.y >= 0.0) {
        // On one side of the peak. D is even: the far side is read backwards.
        if (a.y + b.y > 0.0) d = -d;
    } else {
        // A turn in between adds 1 to P, and to Q what P has gathered since: its integral over a turn is pi.
        if (a.y > 0.0) {
            pA = 1.0 - pA;
            difference -= a.y;
        }
        if (b.y > 0.0) {
            pB = 1.0 - pB;
            difference += b.y;
        }
        pB += turns;
        difference += pi * turns * turns + turns * (b.y + pi);
    }
    real meanP = difference / d;
    w.x = max((meanP - pA) / d, real(0.0));
    w.y = max((pB - meanP) / d, real(0.0));
    return w;
}

FiberLobes scatterSegmentCdf(FiberAngles a, FiberMaterial m, FiberTable, bool) {
    FiberSection s = fiberSection(m, a.cosO);
    FiberLobes n = noLobes(), before = noLobes();
    LogisticPoint last[6];  // R, TT, TRT at +h, then at -h
    for (int k = 0; k <= segmentCount; ++k) {
        real gamma = segmentGamma[k], sinGamma = segmentSin[k], cosGamma = segmentCos[k];
        real cosGammaT = cosRefracted(s, m, cosGamma);
        real gammaT = refractedAngle(s, sinGamma, cosGammaT);
        FiberLobes now = attenuation(fresnelExact(m.eta, m.etaExcess, s.cosine * cosGamma), m.sigmaA,
                                     segmentLength(s, cosGammaT));
        real measure = 0.5 * segmentNormal * cosGamma;  // d(h) / d(gamma); the step comes with the segment
        now.R *= measure;
        now.TT *= measure;
        now.TRT *= measure;
        now.RES *= measure;
        real step = k > 0 ? gamma - segmentGamma[k - 1] : real(0.0);
        // Trapezoids for the residual, whose lobe has no shape.
        n.RES += step * (before.RES + now.RES);
        for (int p = 0; p < 3; ++p) {
            real turn = 2.0 * real(p) * gammaT - 2.0 * gamma, start = a.phi - real(p) * pi;
            for (int side = 0; side < 2; ++side) {
                LogisticPoint point = logisticPoint(side == 0 ? start - turn : start + turn, m);
                int slot = 3 * side + p;
                if (k > 0) {
                    real2 w = step * segmentWeights(last[slot], point, m);
                    if (p == 0) n.R += w.x * before.R + w.y * now.R;
                    if (p == 1) n.TT += w.x * before.TT + w.y * now.TT;
                    if (p == 2) n.TRT += w.x * before.TRT + w.y * now.TRT;
                }
                last[slot] = point;
            }
        }
        before = now;
    }
    n.RES *= 0.5 / pi;
    return alongFiber(n, longitudinals(a, m));
}
#endif
