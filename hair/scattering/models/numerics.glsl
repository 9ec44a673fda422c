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

#ifdef PELAGE_DOUBLE
// exp(-a) I0(a): the power series, whose terms are all positive, and from 30 the asymptotic one.
real besselSeries(real a) {
    real term = 1.0, sum = 1.0;
    if (a < 30.0) {
        for (int k = 1; k < 200 && term > 1e-18 * sum; ++k) {
            term *= 0.25 * a * a / (real(k) * real(k));
            sum += term;
        }
        return sum * exp(-a);
    }
    for (int k = 1; k < 40 && term > 1e-18 * sum; ++k) {
        term *= (2.0 * real(k) - 1.0) * (2.0 * real(k) - 1.0) / (8.0 * real(k) * a);
        sum += term;
    }
    return sum / sqrt(2.0 * pi * a);
}
#endif

// exp(exponent) exp(-a) I0(a) for a >= 0, four at a time: never overflows. The power series in a^2 below 5 (relative
// error 6e-8), the asymptotic form 1 / sqrt(a) times a polynomial in 1 / a above (1.4e-7).
real4 scaledBesselI0(real4 a, real4 exponent) {
#ifdef PELAGE_DOUBLE
    real4 r = exp(exponent);
    for (int k = 0; k < 4; ++k) r[k] *= besselSeries(a[k]);
    return r;
#else
    real4 q = min(a * a, real4(25.0));
    real4 lower = q * 3.5349337952499003e-12 + 4.2223215428152036e-10;
    lower = q * lower + 6.887625288046678e-08;
    lower = q * lower + 6.769073416200177e-06;
    lower = q * lower + 0.0004341087895108569;
    lower = q * lower + 0.01562474540427444;
    lower = q * lower + 0.25000030397169337;
    lower = q * lower + 0.9999999405967178;
    real4 w = real4(1.0) / max(a, real4(1.0));
    real4 upper = w * -1.7565101604603381 + 1.455701172010115;
    upper = w * upper - 0.23573702059330365;
    upper = w * upper + 0.053808947142383545;
    upper = w * upper + 0.027119837558600337;
    upper = w * upper + 0.049880174002632;
    upper = w * upper + 0.3989422548141907;
    real4 isSmall = real4(lessThan(a, real4(5.0)));
    return exp(exponent - isSmall * a) * mix(upper * sqrt(w), lower, isSmall);
#endif
}
real scaledBesselI0(real a, real exponent) { return scaledBesselI0(real4(a), real4(exponent)).x; }

// What is not a finite number above zero becomes zero: a comparison with NaN is false.
real finiteOrZero(real x) { return x > 0.0 && x < 3e38 ? x : 0.0; }
#endif
