// SPDX-License-Identifier: MIT
// M_p: d'Eon et al. 2011, equation 7; widths of Chiang et al. 2016, equation 7.
#include "integrate.hpp"

#include <pelage/reference/terms.hpp>

#include <gtest/gtest.h>

namespace pelage::reference::test {
namespace {

constexpr double variances[] = {1e-5, 5.4e-5, 1e-3, 0.02, 0.0846, 0.5, 1, 27, 100};
constexpr double inclinations[] = {0, 15, -45, 80, -85, 89, 89.9, -89.9};

// exp(-x) I0(x) against the standard library's function in 80 bits, which knows nothing of this one.
TEST(Longitudinal, BesselAgreesWithTheLibrary) {
    double worst = 0;
    for (double x = 1e-6; x < 700; x *= 1.003) {
        const long double exact = std::cyl_bessel_i(0.0L, static_cast<long double>(x)) * std::exp(-1.0L * x);
        worst = std::max(worst, std::abs(static_cast<double>(scaledBesselI0(x) / exact - 1)));
    }
    EXPECT_LE(worst, 4e-15);
    EXPECT_DOUBLE_EQ(scaledBesselI0(0), 1);
}

// The two series meet without a step, and far out the function is 1 / sqrt(2 pi x) (DLMF 10.40.1).
TEST(Longitudinal, BesselHasNoSeam) {
    const double below = scaledBesselI0(std::nextafter(30.0, 0.0)), above = scaledBesselI0(30.0);
    EXPECT_NEAR(below / above, 1, 4e-15);
    for (const double x : {1e4, 1e6, 1e8}) {
        const double tail = 1 + 1 / (8 * x) + 9 / (128 * x * x);
        EXPECT_NEAR(scaledBesselI0(x) * std::sqrt(2 * pi * x), tail, 1e-11);
    }
}

// Integral of M cos(theta_i) d(theta_i) = 1, for every width and inclination, tilted too: tilting theta_o keeps the
// lobe normalised where tilting theta_i would not.
TEST(Longitudinal, LongitudinalIntegratesToOne) {
    double worst = 0;
    for (const double v : variances) {
        for (const double theta : inclinations) {
            for (const double alpha : {0.0, 2.0, -3.0, 10.0}) {
                for (int lobe = 0; lobe < 4; ++lobe) {
                    double s = 0, c = 0;
                    tilt(alpha * degree, lobe, std::sin(theta * degree), std::cos(theta * degree), s, c);
                    const auto f = [&](double x) {
                        return longitudinal(v, std::sin(x), std::cos(x), s, c) * std::cos(x);
                    };
                    const double peak = -std::atan2(s, c);
                    const double sum = integrate(f, endsAround(peak, std::sqrt(v), -0.5 * pi, 0.5 * pi));
                    worst = std::max(worst, std::abs(sum - 1));
                    if (alpha == 0) break;  // the four are the same
                }
            }
        }
    }
    EXPECT_LE(worst, 1e-10);
}

// M is a von Mises-Fisher distribution of concentration 1 / v about the mirrored view, summed around the fibre
// (d'Eon 2013): the integral over psi of exp(cos(Delta) / v) / (4 pi v sinh(1 / v)).
TEST(Longitudinal, LongitudinalIsAnAveragedVonMisesFisherLobe) {
    for (const double v : {0.01, 0.0846, 0.5, 2.0}) {
        for (const double o : {0.0, 0.7, -1.3}) {
            for (const double i : {-1.2, -0.7, 0.1, 1.3}) {
                // cos(Delta) - 1 in the exponent and 1 - exp(-2 / v) below: no overflow.
                double sum = 0;
                const int count = 400;  // the rule of equal steps is exact for a periodic analytic function
                for (int k = 0; k < count; ++k) {
                    const double cosine =
                        -std::sin(i) * std::sin(o) + std::cos(i) * std::cos(o) * std::cos(2 * pi * k / count);
                    sum += std::exp((cosine - 1) / v) / (2 * pi * v * (1 - std::exp(-2 / v))) * 2 * pi / count;
                }
                const double m = longitudinal(v, std::sin(i), std::cos(i), std::sin(o), std::cos(o));
                EXPECT_NEAR(m, sum, 1e-12 * (1 + sum)) << v << ' ' << i << ' ' << o;
            }
        }
    }
}

// Wide lobes turn into an even one: 1/2, whose integral over the sphere's inclinations is 1.
TEST(Longitudinal, WideLobeIsEven) {
    for (const double i : {-1.5, 0.0, 0.8}) {
        EXPECT_NEAR(longitudinal(1e6, std::sin(i), std::cos(i), 0.3, std::sqrt(0.91)), 0.5, 1e-6);
    }
}

// theta_i + theta_o = 0 is the mirror direction and the peak; exchanging the two directions changes nothing.
TEST(Longitudinal, PeaksAtTheMirrorAndIsReciprocal) {
    const double v = 0.01;
    const auto m = [&](double i, double o) {
        return longitudinal(v, std::sin(i), std::cos(i), std::sin(o), std::cos(o));
    };
    for (const double o : {-0.8, 0.0, 0.5}) {
        EXPECT_GT(m(-o, o), m(-o + 0.05, o));
        EXPECT_GT(m(-o, o), m(-o - 0.05, o));
        EXPECT_DOUBLE_EQ(m(0.2, o), m(o, 0.2));
    }
}

// Chiang 2016, equation 7, worked by hand for beta_M = 0.3 and 1; TT is half as wide, TRT and the rest twice.
TEST(Longitudinal, VariancesFollowChiang) {
    const auto v = longitudinalVariances(0.3);
    EXPECT_NEAR(v[0], 0.2908800001290 * 0.2908800001290, 1e-12);
    EXPECT_DOUBLE_EQ(v[1], v[0] / 4);
    EXPECT_DOUBLE_EQ(v[2], v[0] * 4);
    EXPECT_DOUBLE_EQ(v[3], v[0] * 4);
    EXPECT_NEAR(longitudinalVariances(1)[0], 5.238 * 5.238, 1e-12);
}

// The tilt is a rotation of theta_o by -2 alpha, +alpha, +4 alpha and 0; past 90 degrees the cosine is mirrored.
TEST(Longitudinal, TiltRotatesTheView) {
    constexpr double multiple[] = {-2, 1, 4, 0};
    for (int lobe = 0; lobe < 4; ++lobe) {
        for (const double theta : {-89.0, -20.0, 0.0, 35.0, 88.0}) {
            const double alpha = 3 * degree, turned = theta * degree + multiple[lobe] * alpha;
            double s = 0, c = 0;
            tilt(alpha, lobe, std::sin(theta * degree), std::cos(theta * degree), s, c);
            EXPECT_NEAR(s, std::sin(turned), 1e-15);
            EXPECT_NEAR(c, std::abs(std::cos(turned)), 1e-15);
        }
    }
}

}  // namespace
}  // namespace pelage::reference::test
