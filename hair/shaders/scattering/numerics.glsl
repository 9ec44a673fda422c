// SPDX-License-Identifier: MIT
// Inverse trigonometric functions, the wrapped azimuth and the Bessel function I0, to the last digits of a float. In
// double (PELAGE_DOUBLE) the library's functions and a full series stand in, so that the double build of the shared
// source is limited by double and not by a polynomial. Polynomials: interpolation at Chebyshev nodes.
#ifndef PELAGE_NUMERICS_GLSL
#define PELAGE_NUMERICS_GLSL
#include "real.glsl"

// atan(y / x) for x >= 0, in [-pi/2, pi/2]; 0 at the origin. Relative error 1e-7.
real atanRight(real y, real x) {
#ifdef PELAGE_DOUBLE
    return atan(y, x);
#else
    real a = abs(y);
    real large = max(a, x), small = min(a, x);
    real t = large > 0.0 ? small / large : 0.0;
    // Above tan(pi / 8), atan(t) = pi/4 + atan((t - 1) / (t + 1)).
    bool upper = t > 0.414213562373095;
    real z = upper ? (t - 1.0) / (t + 1.0) : t;
    real q = z * z;
    real r = z + z * q *
                     (-0.33333331761166546 +
                      q * (0.19999540483527845 +
                           q * (-0.1426395559579731 + q * (0.10743731475582567 + q * -0.06451928172037104))));
    if (upper) r += 0.785398163397448310;
    if (a > x) r = halfPi - r;
    return y < 0.0 ? -r : r;
#endif
}

// atan2 in [-pi, pi].
real atanFull(real y, real x) {
    real r = atanRight(y, abs(x));
    if (x >= 0.0) return r;
    return y < 0.0 ? -pi - r : pi - r;
}

// x brought to [-pi, pi]. 2 pi in two parts, the first exact in few bits: what is left keeps its digits.
real wrapAngle(real x) {
    real n = floor(x * 0.159154943091895336 + 0.5);
    return (x - n * 6.28125) - n * 0.00193530717958647693;
}

// exp(exponent) I0(a) for a >= 0, where exponent + a stays small: never overflows. The power series in a^2 below 5
// (relative error 6e-8), the asymptotic form exp(a) / sqrt(a) times a polynomial in 1 / a above (1.4e-7). The caller
// passes `exponent` with the a of the exponential already taken out: exp(exponent) exp(-a) I0(a) is the result.
real scaledBesselI0(real a, real exponent) {
#ifdef PELAGE_DOUBLE
    if (a < 30.0) {
        real quarter = 0.25 * a * a, term = 1.0, sum = 1.0;
        for (int k = 1; k < 200; ++k) {
            term *= quarter / (real(k) * real(k));
            sum += term;
            if (term < 1e-18 * sum) break;
        }
        return sum * exp(exponent - a);
    }
    real term = 1.0, sum = 1.0;
    for (int k = 1; k < 40; ++k) {
        real odd = 2.0 * real(k) - 1.0;
        term *= odd * odd / (8.0 * real(k) * a);
        sum += term;
        if (term < 1e-18 * sum) break;
    }
    return sum * exp(exponent) / sqrt(2.0 * pi * a);
#else
    real q = a * a;
    real lower = 0.9999999405967178 +
                 q * (0.25000030397169337 +
                      q * (0.01562474540427444 +
                           q * (0.0004341087895108569 +
                                q * (6.769073416200177e-06 +
                                     q * (6.887625288046678e-08 +
                                          q * (4.2223215428152036e-10 + q * 3.5349337952499003e-12))))));
    real w = 1.0 / max(a, 1.0);
    real upper = 0.3989422548141907 +
                 w * (0.049880174002632 +
                      w * (0.027119837558600337 +
                           w * (0.053808947142383545 +
                                w * (-0.23573702059330365 + w * (1.455701172010115 + w * -1.7565101604603381)))));
    bool isSmall = a < 5.0;
    return exp(isSmall ? exponent - a : exponent) * (isSmall ? lower : upper * sqrt(w));
#endif
}

// What is not a finite number above zero becomes zero: a comparison with NaN is false.
real finiteOrZero(real x) { return x > 0.0 && x < 3e38 ? x : 0.0; }
#endif
