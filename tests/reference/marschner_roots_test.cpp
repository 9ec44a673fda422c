// SPDX-License-Identifier: MIT
// The roots of Phi(p, h) = phi (Marschner et al. 2003, section 4.3). "Thesis": the later text that thesis.glsl follows,
// cited by its equation numbers.
#include "integrate.hpp"
#include "turns.hpp"

#include <pelage/reference/marschner.hpp>

#include <gtest/gtest.h>

namespace pelage::reference::test {
namespace {

// Every root gives Phi(p, h) = phi up to whole turns, and there are as many as a scan of 4,000 steps over gamma sees.
TEST(Marschner, MarschnerRootsSolveTheirEquation) {
    Random random(81);
    for (int k = 0; k < 600; ++k) {
        const int p = k % 3;
        const double eta = random.between(1.1, 2.2), thetaD = random.between(-1.4, 1.4), phi = random.between(-pi, pi);
        const CrossSection section = sectionAt(eta, thetaD);
        const std::vector<double> roots = marschnerRoots(p, eta, thetaD, phi);
        for (const double h : roots) {
            EXPECT_LE(std::abs(h), 1);
            const double gamma = std::asin(h);  // known to the rounding of h over cos(gamma)
            EXPECT_NEAR(std::remainder(turnAt(section, p, gamma) - phi, 2 * pi), 0, 1e-13 + 1e-15 / std::cos(gamma));
        }
        EXPECT_TRUE(std::is_sorted(roots.begin(), roots.end()));
        bool nearJump = false;
        for (const double jump : jumps(section, p)) nearJump = nearJump || std::abs(phi - jump) < 1e-3;
        if (nearJump) continue;  // two roots may hide in one step
        std::size_t seen = 0;
        for (int step = 0; step < 4000; ++step) {
            const double a = turnAt(section, p, pi * step / 4000 - 0.5 * pi);
            const double b = turnAt(section, p, pi * (step + 1) / 4000 - 0.5 * pi);
            seen += std::floor((a - phi) / (2 * pi)) != std::floor((b - phi) / (2 * pi)) ? 1 : 0;
        }
        EXPECT_EQ(roots.size(), seen) << p << ' ' << eta << ' ' << thetaD << ' ' << phi;
    }
}

// Roots and lobe do not depend on which period the azimuth is given in.
TEST(Marschner, AnyPeriodOfAzimuth) {
    for (int p = 0; p < 3; ++p) {
        const double phi = p == 1 ? 2.5 : 0.2;
        const std::vector<double> roots = marschnerRoots(p, 1.55, 0.3, phi);
        EXPECT_EQ(roots.size(), p == 2 ? 3U : 1U);
        for (const int turns : {-2, -1, 1, 2}) {
            const std::vector<double> same = marschnerRoots(p, 1.55, 0.3, phi + 2 * pi * turns);
            ASSERT_EQ(same.size(), roots.size()) << p << ' ' << turns;
            for (std::size_t k = 0; k < roots.size(); ++k) EXPECT_NEAR(same[k], roots[k], 1e-12);
        }
    }
}

// Thesis, equation 4.14: h_TT^2 = (1/2 + 1/2 cos(phi)) / (1 + a^2 - 2 a sqrt(1/2 - 1/2 cos(phi))) with a = 1 / eta',
// and no light in the dead zone |phi| < 2 asin(1 / eta').
TEST(Marschner, TTRootIsTheClosedForm) {
    for (const double eta : {1.2, 1.33, 1.55, 2.0}) {
        for (const double thetaD : {0.0, 0.5, 1.2}) {
            const double a = 1 / sectionAt(eta, thetaD).etaPerp, dead = 2 * std::asin(a);
            for (double phi = 0.001; phi < pi; phi += 0.05) {
                const std::vector<double> roots = marschnerRoots(1, eta, thetaD, phi);
                if (phi < dead) {
                    EXPECT_TRUE(roots.empty()) << phi;
                    EXPECT_EQ(marschnerSmooth(1, eta, thetaD, phi, 0, PathLength::Chord), 0);
                    continue;
                }
                ASSERT_EQ(roots.size(), 1U) << phi;
                const double square =
                    (0.5 + 0.5 * std::cos(phi)) / (1 + a * a - 2 * a * std::sqrt(0.5 - 0.5 * std::cos(phi)));
                EXPECT_NEAR(roots[0], std::sqrt(square), 1e-13) << phi;
            }
        }
    }
}

// dPhi/dh = 0 at h_c^2 = (4 - eta'^2) / 3 (Marschner 2003, section 4.3); for eta = 1.55 at phi = 18.6 degrees, three
// roots within and one without, and no caustic from theta_d = 46.9 degrees up, where eta' passes 2.
TEST(Marschner, CausticIsWhereTRTTurnsBack) {
    constexpr double eta = 1.55;
    const CrossSection section = sectionAt(eta, 0);
    const double gamma = causticOffset(section, 2);
    EXPECT_NEAR(std::sin(gamma), 0.730, 5e-4);
    EXPECT_NEAR((turnAt(section, 2, gamma) - 2 * pi) / degree, 18.6, 0.05);
    EXPECT_NEAR(turnAt(section, 2, gamma + 1e-4) - turnAt(section, 2, gamma - 1e-4), 0, 1e-11);
    EXPECT_EQ(marschnerRoots(2, eta, 0, 18.5 * degree).size(), 3U);
    EXPECT_EQ(marschnerRoots(2, eta, 0, 18.7 * degree).size(), 1U);
    EXPECT_GT(marschnerSmooth(2, eta, 0, 18.6 * degree, 0, PathLength::Chord),
              5 * marschnerSmooth(2, eta, 0, 0, 0, PathLength::Chord));
    const double limit = std::acos(std::sqrt((eta * eta - 1) / 3));
    EXPECT_NEAR(limit / degree, 46.9, 0.05);
    EXPECT_GT(causticOffset(sectionAt(eta, limit - 1e-6), 2), 0);
    EXPECT_LT(causticOffset(sectionAt(eta, limit + 1e-6), 2), 0);
    for (int p = 0; p < 2; ++p) EXPECT_LT(causticOffset(section, p), 0);
}

}  // namespace
}  // namespace pelage::reference::test
