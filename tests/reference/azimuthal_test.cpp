// SPDX-License-Identifier: MIT
// N_p: the trimmed logistic of Chiang et al. 2016 (equations 8 and 10), and the turn of each path.
#include "integrate.hpp"

#include <pelage/reference/terms.hpp>

#include <gtest/gtest.h>

namespace pelage::reference::test {
namespace {

constexpr double roughnesses[] = {0.01, 0.05, 0.1, 0.3, 0.6, 0.9, 1.0};

// Integral over a period = 1, wherever the period starts.
TEST(Azimuthal, AzimuthalIntegratesToOne) {
    for (const double beta : roughnesses) {
        const double s = logisticScale(beta);
        const auto f = [&](double x) { return trimmedLogistic(x, s); };
        EXPECT_NEAR(integrate(f, endsAround(0, s, -pi, pi)), 1, 1e-10) << beta;
        for (const double shift : {0.4, 2.0, -3.0}) {
            const double peak = shift > 0 ? 2 * pi : -2 * pi;  // inside [shift, shift + 2 pi] or its mirror
            const double from = shift > 0 ? shift : shift - 2 * pi;
            std::vector<double> ends = endsAround(peak, s, from, from + 2 * pi);
            for (const double kink : {-3 * pi, -pi, pi, 3 * pi}) {
                if (kink > from && kink < from + 2 * pi) ends.push_back(kink);
            }
            EXPECT_NEAR(integrate(f, ends), 1, 1e-10) << beta << ' ' << shift;
        }
    }
}

TEST(Azimuthal, LogisticIsEvenAndPeriodic) {
    for (const double beta : roughnesses) {
        const double s = logisticScale(beta);
        for (const double x : {0.0, 0.01, 0.7, 2.9, pi}) {
            EXPECT_DOUBLE_EQ(trimmedLogistic(x, s), trimmedLogistic(-x, s));
            for (const int periods : {-3, 1, 4}) {
                const double there = trimmedLogistic(x + 2 * pi * periods, s);
                EXPECT_NEAR(there, trimmedLogistic(x, s), 1e-12 * there + 1e-14 / (s * s));  // 2 pi is rounded
            }
        }
    }
}

// The distribution function is the integral of the density, and sampling inverts it.
TEST(Azimuthal, SamplingInvertsTheDistribution) {
    for (const double beta : roughnesses) {
        const double s = logisticScale(beta);
        const auto f = [&](double x) { return trimmedLogistic(x, s); };
        EXPECT_NEAR(trimmedLogisticCdf(-pi, s), 0, 1e-15);
        EXPECT_NEAR(trimmedLogisticCdf(pi, s), 1, 1e-15);
        for (const double x : {-2.5, -0.3, -0.01, 0.0, 0.02, 1.1, 3.0}) {
            std::vector<double> ends = endsAround(0, s, -pi, x);
            EXPECT_NEAR(trimmedLogisticCdf(x, s), integrate(f, ends), 1e-12) << beta << ' ' << x;
        }
        for (double u = 0.001; u < 1; u += 0.037) {
            EXPECT_NEAR(trimmedLogisticCdf(sampleTrimmedLogistic(u, s), s), u, 1e-14) << beta << ' ' << u;
        }
        for (const double u : {0.0, 1 - 0x1p-53}) {
            const double x = sampleTrimmedLogistic(u, s);
            EXPECT_TRUE(x >= -pi && x <= pi) << beta << ' ' << u << ' ' << x;
        }
    }
}

// Chiang 2016, equation 8, worked by hand: sqrt(pi/8) (0.265 b + 1.194 b^2 + 5.372 b^22).
TEST(Azimuthal, ScaleFollowsChiang) {
    EXPECT_NEAR(logisticScale(0.3), 0.626657068657750 * 0.1869600000169, 1e-12);
    EXPECT_NEAR(logisticScale(1.0), 0.626657068657750 * 6.831, 1e-14);
}

// Marschner 2003, equation 3: Phi(p, h) = 2 p gamma_t - 2 gamma_o + p pi. Through the axis light goes straight: R back,
// TT on, TRT back; and Snell holds at the surface of the cross-section.
TEST(Azimuthal, PathsTurnByTheirAngles) {
    Random random(21);
    for (int p = 0; p < 3; ++p) EXPECT_DOUBLE_EQ(pathAzimuth(p, 0, 0), p * pi);
    for (int k = 0; k < 1000; ++k) {
        const CrossSection section = crossSection(random.between(1.01, 3), random.between(0.01, 1));
        const double gammaO = random.between(-0.5 * pi, 0.5 * pi);
        const Refracted inside = refract(section, std::sin(gammaO), std::cos(gammaO));
        EXPECT_NEAR(section.etaPerp * std::sin(inside.gammaT), std::sin(gammaO), 1e-13);
        EXPECT_NEAR(std::cos(inside.gammaT), inside.cosGammaT, 1e-13);
        for (int p = 0; p < 3; ++p) {
            EXPECT_NEAR(pathAzimuth(p, gammaO, inside.gammaT), 2 * p * inside.gammaT - 2 * gammaO + p * pi, 1e-14);
        }
    }
}

}  // namespace
}  // namespace pelage::reference::test
