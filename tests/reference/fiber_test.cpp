// SPDX-License-Identifier: MIT
// The near field S(wo, wi, h) as a whole: energy, absorption, symmetry, sign of the tilt, extremes.
#include "integrate.hpp"

#include <pelage/reference/terms.hpp>

#include <gtest/gtest.h>

namespace pelage::reference::test {
namespace {

Angles anglesAt(double thetaI, double thetaO, double phi) {
    return {std::sin(thetaI), std::abs(std::cos(thetaI)), std::sin(thetaO), std::abs(std::cos(thetaO)), phi};
}

// Each lobe of S integrated over the sphere of wi, d(omega) = cos(theta_i) d(theta_i) d(phi).
Lobes overTheSphere(const Fiber& fiber, double thetaO, double h) {
    const CrossSection section = crossSection(fiber.eta, std::cos(thetaO));
    const Refracted inside = refract(section, h, std::sqrt((1 - h) * (1 + h)));
    std::vector<double> azimuths{-pi, pi}, inclinations{-0.5 * pi, 0.5 * pi};
    for (int p = 0; p < 3; ++p) {
        const double turn = pathAzimuth(p, std::asin(h), inside.gammaT);
        azimuths.push_back(std::remainder(turn, 2 * pi));       // the peak
        azimuths.push_back(std::remainder(turn + pi, 2 * pi));  // the kink where the tails meet
        double s = 0, c = 0;
        tilt(fiber.alpha, p, std::sin(thetaO), std::cos(thetaO), s, c);
        inclinations.push_back(-std::atan2(s, c));
    }
    Lobes sum;
    for (std::size_t p = 0; p < 4; ++p) {
        const auto overAzimuth = [&](double thetaI) {
            const auto f = [&](double phi) { return nearField(fiber, anglesAt(thetaI, thetaO, phi), h).p[p]; };
            return integrate(f, azimuths) * std::cos(thetaI);
        };
        sum.p[p] = integrate(overAzimuth, inclinations);
    }
    return sum;
}

// A fibre that absorbs nothing in a world of radiance 1 is invisible: the integral of S over the sphere is 1, and each
// lobe's is A_p.
TEST(Fiber, WhiteFurnace) {
    for (const double eta : {1.2, 1.55}) {
        for (const double beta : {0.35, 0.8}) {
            for (const double theta : {0.0, 0.7, -1.4}) {
                for (const double h : {0.0, 0.6, -0.97}) {
                    const Fiber fiber{eta, beta, beta, -3 * degree, 0};
                    const Lobes sum = overTheSphere(fiber, theta, h);
                    EXPECT_NEAR(sum.total(), 1, 1e-6) << eta << ' ' << beta << ' ' << theta << ' ' << h;
                    const CrossSection section = crossSection(eta, std::cos(theta));
                    const double cosGammaO = std::sqrt((1 - h) * (1 + h));
                    const Lobes a = attenuation(section, refract(section, h, cosGammaO), cosGammaO, 0);
                    for (std::size_t p = 0; p < 4; ++p) EXPECT_NEAR(sum.p[p], a.p[p], 1e-6);
                }
            }
        }
    }
}

TEST(Fiber, AbsorptionOnlyDarkens) {
    Random random(51);
    for (int k = 0; k < 2000; ++k) {
        const double h = random.between(-1, 1);
        const Angles angles = anglesAt(random.between(-1.5, 1.5), random.between(-1.5, 1.5), random.between(-pi, pi));
        Fiber fiber{random.between(1.05, 2), random.between(0.1, 1), random.between(0.1, 1), 0.03, 0};
        Lobes before = nearField(fiber, angles, h);
        for (fiber.sigmaA = 0.01; fiber.sigmaA < 50; fiber.sigmaA *= 5) {
            const Lobes now = nearField(fiber, angles, h);
            EXPECT_EQ(now.p[0], before.p[0]);  // light that never enters is white
            for (std::size_t p = 1; p < 4; ++p) EXPECT_LE(now.p[p], before.p[p]);
            before = now;
        }
    }
}

// The cross-section is a circle: mirrored in the plane of the view and the axis, nothing changes.
TEST(Fiber, MirrorSymmetry) {
    Random random(52);
    for (int k = 0; k < 2000; ++k) {
        const double i = random.between(-1.5, 1.5), o = random.between(-1.5, 1.5), phi = random.between(-pi, pi);
        const double h = random.between(-1, 1);
        const Fiber fiber{1.55, 0.3, random.between(0.05, 1), 0.05, 0.1};
        const Lobes one = nearField(fiber, anglesAt(i, o, phi), h), other = nearField(fiber, anglesAt(i, o, -phi), -h);
        for (std::size_t p = 0; p < 4; ++p) EXPECT_NEAR(one.p[p], other.p[p], 1e-11 * one.p[p]);
    }
}

// S does not depend on which period the azimuth is given in.
TEST(Fiber, AnyPeriodOfAzimuth) {
    const Fiber fiber{1.55, 0.3, 0.2, 0, 0.1};
    for (const int turns : {-7, -1, 2, 30}) {
        const double one = nearField(fiber, anglesAt(0.2, -0.3, 1.1), 0.4).total();
        EXPECT_NEAR(nearField(fiber, anglesAt(0.2, -0.3, 1.1 + 2 * pi * turns), 0.4).total(), one, 1e-11 * one);
    }
    EXPECT_NEAR(anglesFromDegrees(0, 350, 0, -350).phi, -20 * degree, 1e-15);
    EXPECT_NEAR(anglesFromDegrees(30, 10, -90, 0).cosThetaO, 0, 1e-16);
}

// With u from root to tip hair has alpha < 0 (scales point to the tip; Marschner 2003, table 1: theta_i + theta_r =
// 2 alpha). Seen straight on, R comes from light on the root's side: its peak over theta_i is at 2 alpha; TT's and
// TRT's are at -alpha and -4 alpha, on the tip's.
TEST(Fiber, HighlightMovesToRoot) {
    const Fiber fiber{1.55, 0.03, 0.3, -3 * degree, 0.1};
    constexpr double expected[] = {-6, 3, 12};
    constexpr double azimuths[] = {0, pi, 0};
    for (std::size_t p = 0; p < 3; ++p) {
        double best = 0, most = -1;
        for (double thetaI = -30; thetaI <= 30; thetaI += 0.05) {
            const double value = nearField(fiber, anglesAt(thetaI * degree, 0, azimuths[p]), 0).p[p];
            if (value > most) {
                most = value;
                best = thetaI;
            }
        }
        EXPECT_NEAR(best, expected[p], 0.2) << p;
    }
}

// Corners of the domain: nothing is infinite, nothing is negative.
TEST(Fiber, ExtremesAreFiniteAndNotNegative) {
    constexpr double etas[] = {1.0001, 1.55, 3}, roughnesses[] = {0.01, 1}, sigmas[] = {0, 100, 1e4};
    constexpr double thetas[] = {-90, -89.9, 0, 80, 90}, azimuths[] = {0, 90, 180, -180};
    constexpr double offsets[] = {-1, -0.9999999, 0, 1};
    std::size_t corner = 0;
    for (bool done = false; !done; ++corner) {
        std::size_t left = corner;
        const auto next = [&](const auto& list) {
            const double value = list[left % std::size(list)];
            left /= std::size(list);
            return value;
        };
        Fiber fiber;
        fiber.eta = next(etas);
        fiber.betaM = next(roughnesses);
        fiber.betaN = next(roughnesses);
        fiber.alpha = 10 * degree;
        fiber.sigmaA = next(sigmas);
        const double i = next(thetas), o = next(thetas), phi = next(azimuths), h = next(offsets);
        done = left > 0;
        for (const double value : nearField(fiber, anglesFromDegrees(i, phi, o, 0), h).p) {
            EXPECT_TRUE(std::isfinite(value) && value >= 0)
                << value << " at eta " << fiber.eta << ", beta " << fiber.betaM << ' ' << fiber.betaN << ", sigma "
                << fiber.sigmaA << ", theta " << i << ' ' << o << ", phi " << phi << ", h " << h;
        }
    }
    EXPECT_EQ(corner, 3 * 2 * 2 * 3 * 5 * 5 * 4 * 4 + 1U);
}

}  // namespace
}  // namespace pelage::reference::test
