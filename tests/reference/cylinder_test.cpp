// SPDX-License-Identifier: MIT
// The formulas of the cross-section against rays traced through a cylinder in three dimensions.
#include "integrate.hpp"

#include <pelage/reference/cylinder.hpp>
#include <pelage/reference/marschner.hpp>
#include <pelage/reference/terms.hpp>

#include <gtest/gtest.h>

namespace pelage::reference::test {
namespace {

struct Section {
    CrossSection section;
    double gammaO;
    Refracted inside;
    Lobes attenuation;
};
Section sectionAt(double eta, double theta, double h, double sigmaA) {
    Section made{crossSection(eta, std::cos(theta)), std::asin(h), {}, {}};
    const double cosGammaO = std::sqrt((1 - h) * (1 + h));
    made.inside = refract(made.section, h, cosGammaO);
    made.attenuation = attenuation(made.section, made.inside, cosGammaO, sigmaA);
    return made;
}

// Directions (Marschner 2003, equation 3 and the cone theta_i = -theta_r), lengths (the chord over cos(theta_t)) and
// weights (f, (1-f)^2 T, (1-f)^2 f T^2), each from vectors alone. The tracer counts h towards growing azimuths, which
// is -h of equation 3. Vectors lose digits at the very rim and along the axis, so neither is approached closer than
// this.
TEST(Cylinder, RaysTracedThroughACylinderAgree) {
    Random random(41);
    double direction = 0, length = 0, weight = 0, cone = 0;
    for (int k = 0; k < 20000; ++k) {
        const double eta = random.between(1.02, 3), theta = random.between(-80, 80) * degree;
        const double h = random.between(-0.995, 0.995), sigmaA = random() < 0.3 ? 0 : random.scale(0.01, 10);
        const auto paths = traceCylinder(eta, theta, h, sigmaA);
        const Section own = sectionAt(eta, theta, h, sigmaA);
        for (int p = 0; p < 3; ++p) {
            const auto& path = paths[static_cast<std::size_t>(p)];
            const double turn = pathAzimuth(p, own.gammaO, own.inside.gammaT);
            direction = std::max(direction, std::abs(std::remainder(path.phi - turn, 2 * pi)));
            cone = std::max(cone, std::abs(path.sinTheta + std::sin(theta)));
            length = std::max(length, std::abs(path.length - p * 2 * own.inside.cosGammaT / own.section.cosThetaT));
            weight = std::max(weight, std::abs(path.weight - own.attenuation.p[static_cast<std::size_t>(p)]));
        }
    }
    EXPECT_LE(direction, 1e-11);
    EXPECT_LE(cone, 1e-11);
    EXPECT_LE(length, 1e-11);
    EXPECT_LE(weight, 1e-11);
}

// What R, TT and TRT leave of a ray is f^2 (1 - f) when nothing is absorbed: none is made, none is lost.
TEST(Cylinder, TracedEnergyIsConserved) {
    Random random(42);
    for (int k = 0; k < 2000; ++k) {
        const auto paths =
            traceCylinder(random.between(1.05, 2.5), random.between(-80, 80) * degree, random.between(-0.99, 0.99), 0);
        const double f = paths[0].weight, sum = f + paths[1].weight + paths[2].weight;
        EXPECT_NEAR(1 - sum, f * f * (1 - f), 1e-12);
    }
}

// A mirrored ray leaves mirrored.
TEST(Cylinder, TracedPathsAreMirrored) {
    for (const double h : {0.1, 0.5, 0.95}) {
        const auto left = traceCylinder(1.55, 0.4, -h, 0.3), right = traceCylinder(1.55, 0.4, h, 0.3);
        for (std::size_t p = 0; p < 3; ++p) {
            EXPECT_NEAR(std::remainder(left[p].phi + right[p].phi, 2 * pi), 0, 1e-13);
            EXPECT_NEAR(left[p].weight, right[p].weight, 1e-14);
        }
    }
}

// Marschner 2003, equation 8: rays that fall evenly over h, binned by the azimuth they leave at, draw N_p. 400,000 rays
// and 72 bins per path; noise is what the weights in a bin say it is, sqrt(sum of w^2) / n. With 144 bins that are not
// empty, 4.5 sigma is passed by chance once in a thousand runs (the seed is fixed), and chi^2 / bins is 1 +- 0.17.
TEST(Cylinder, RaysOverTheWidthDrawTheAzimuthalLobe) {
    constexpr int bins = 72, rays = 400000;
    for (const double theta : {0.0, 0.6}) {
        constexpr double eta = 1.55, sigmaA = 0.2;
        double sums[3][bins] = {}, squares[3][bins] = {};
        Random random(43);
        for (int k = 0; k < rays; ++k) {
            const auto paths = traceCylinder(eta, theta, random.between(-1, 1), sigmaA);
            for (std::size_t p = 0; p < 3; ++p) {
                const double turn = (paths[p].phi + pi) / (2 * pi) * bins;
                const int bin = std::clamp(static_cast<int>(turn), 0, bins - 1);
                sums[p][bin] += paths[p].weight;
                squares[p][bin] += paths[p].weight * paths[p].weight;
            }
        }
        // Where N_p jumps: the rim of the fibre, and for TRT the caustic.
        const Section rim = sectionAt(eta, theta, 1, 0);
        const double square = (4 - rim.section.etaPerp * rim.section.etaPerp) / 3;
        const Section turning = sectionAt(eta, theta, std::sqrt(std::max(square, 0.0)), 0);
        for (int p = 0; p < 3; ++p) {
            std::vector<double> jumps{std::remainder(pathAzimuth(p, rim.gammaO, rim.inside.gammaT), 2 * pi)};
            if (p == 2) jumps.push_back(std::remainder(pathAzimuth(p, turning.gammaO, turning.inside.gammaT), 2 * pi));
            double chi = 0;
            int filled = 0;
            for (int bin = 0; bin < bins; ++bin) {
                const double from = -pi + 2 * pi * bin / bins, to = from + 2 * pi / bins;
                std::vector<double> ends{from, to};
                for (const double jump : jumps) {
                    for (const double end : {jump, -jump}) {
                        if (end > from && end < to) ends.push_back(end);
                    }
                }
                std::sort(ends.begin(), ends.end());
                double expected = 0;
                for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
                    const auto n = [&](double phi) {
                        return marschnerSmooth(p, eta, theta, phi, sigmaA, PathLength::Chord);
                    };
                    expected += integrateSingular(n, ends[i], ends[i + 1]);
                }
                const double mean = sums[p][bin] / rays;
                const double sigma = std::sqrt(squares[p][bin]) / rays;
                if (sums[p][bin] == 0 || expected * rays < 1e-6) {
                    EXPECT_NEAR(mean, expected, 1e-5) << p << ' ' << from / degree;
                    continue;
                }
                ++filled;
                chi += (mean - expected) * (mean - expected) / (sigma * sigma);
                EXPECT_LE(std::abs(mean - expected), 4.5 * sigma) << "path " << p << " from " << from / degree;
            }
            EXPECT_NEAR(chi / filled, 1, 6 / std::sqrt(static_cast<double>(filled))) << "path " << p;
        }
    }
}

}  // namespace
}  // namespace pelage::reference::test
