// SPDX-License-Identifier: MIT
// A_p: Fresnel's equations, Bravais' indices, Beer's law along the chord, and the series of internal reflections
// (Chiang et al. 2016, section 4.2).
#include "integrate.hpp"

#include <pelage/reference/terms.hpp>

#include <gtest/gtest.h>

namespace pelage::reference::test {
namespace {

struct Case {
    double eta, theta, h;  // theta in degrees
};
Lobes at(const Case& c, double sigmaA) {
    const CrossSection section = crossSection(c.eta, std::abs(std::cos(c.theta * degree)));
    const double cosGammaO = std::sqrt((1 - c.h) * (1 + c.h));
    return attenuation(section, refract(section, c.h, cosGammaO), cosGammaO, sigmaA);
}

std::vector<Case> cases() {
    std::vector<Case> made;
    for (const double eta : {1.0001, 1.01, 1.33, 1.55, 2.0, 3.0}) {
        for (const double theta : {0.0, 30.0, 60.0, 85.0, 89.9, 90.0}) {
            for (const double h : {0.0, 0.3, -0.7, 0.99, -0.999999, 1.0, -1.0}) made.push_back({eta, theta, h});
        }
    }
    return made;
}

// Straight on ((eta - 1) / (eta + 1))^2; grazing 1; at Brewster's angle only the s wave is reflected.
TEST(Attenuation, FresnelAtTheKnownAngles) {
    for (const double eta : {1.0001, 1.33, 1.55, 3.0}) {
        const double normal = (eta - 1) / (eta + 1);
        EXPECT_NEAR(fresnel(eta, 1).reflected, normal * normal, 1e-16);
        EXPECT_DOUBLE_EQ(fresnel(eta, 0).reflected, 1);
        EXPECT_DOUBLE_EQ(fresnel(eta, 0).transmitted, 0);
        const double s = (eta * eta - 1) / (eta * eta + 1);
        EXPECT_NEAR(fresnel(eta, 1 / std::sqrt(1 + eta * eta)).reflected, 0.5 * s * s, 1e-15);
        for (double cosine = 0; cosine <= 1; cosine += 0.01) {
            const Fresnel f = fresnel(eta, cosine);
            EXPECT_NEAR(f.reflected + f.transmitted, 1, 1e-15);
        }
    }
    // The small complement keeps its digits: near grazing 1 - F = 4 cos(theta) (eta^2 + 1) / (2 sqrt(eta^2 - 1)).
    const double eta = 1.55, tiny = 1e-12;
    EXPECT_NEAR(fresnel(eta, tiny).transmitted / tiny, 2 * (eta * eta + 1) / std::sqrt(eta * eta - 1), 1e-8);
}

// Marschner 2003 gives the cross-section two indices, eta' for the s wave and eta'' = eta^2 / eta' for the p wave
// (Bravais). The same reflectance comes from Fresnel's equations at the true angle, cos(theta) cos(gamma).
TEST(Attenuation, BravaisEqualsProjectedFresnel) {
    double worst = 0;
    for (const double eta : {1.05, 1.33, 1.55, 2.5}) {
        for (double theta = 0; theta < 89; theta += 7) {
            const CrossSection section = crossSection(eta, std::cos(theta * degree));
            const double first = section.etaPerp, second = eta * eta / first;
            for (double gamma = 0; gamma < 89; gamma += 5.5) {
                const double ci = std::cos(gamma * degree), ct = std::cos(std::asin(std::sin(gamma * degree) / first));
                const double rs = (ci - first * ct) / (ci + first * ct), rp = (second * ci - ct) / (second * ci + ct);
                const double projected = fresnel(eta, section.cosThetaO * ci).reflected;
                worst = std::max(worst, std::abs(0.5 * (rs * rs + rp * rp) - projected));
            }
        }
    }
    EXPECT_LE(worst, 1e-14);
}

TEST(Attenuation, AttenuationsSumToOne) {
    double worst = 0;
    for (const Case& c : cases()) worst = std::max(worst, std::abs(at(c, 0).total() - 1));
    Random random(31);
    for (int k = 0; k < 20000; ++k) {
        const double rim = random.scale(1e-16, 1);
        const Case c{1 + random.scale(1e-4, 2), random.between(0, 90), random() < 0.5 ? 1 - rim : rim - 1};
        worst = std::max(worst, std::abs(at(c, 0).total() - 1));
    }
    EXPECT_LE(worst, 1e-13);
}

// One segment is the chord of the circle at the distance h / eta' from its centre, stretched by the inclination inside:
// T = exp(-sigma 2 cos(gamma_t) / cos(theta_t)). (Marschner 2003 prints the square of the chord.)
TEST(Attenuation, PathLengthIsChord) {
    for (const double eta : {1.33, 1.55, 2.0}) {
        for (const double theta : {0.0, 40.0, 75.0, 89.0}) {
            for (const double h : {0.0, 0.5, -0.8660254, 0.99}) {
                const double sine = std::sin(theta * degree), cosine = std::cos(theta * degree);
                const double bravais = std::sqrt(eta * eta - sine * sine) / cosine;
                const double chord = 2 * std::sqrt(1 - h * h / (bravais * bravais));
                const double length = chord / std::sqrt(1 - sine * sine / (eta * eta));
                const Lobes clear = at({eta, theta, h}, 0), dark = at({eta, theta, h}, 0.7);
                EXPECT_NEAR(std::log(clear.p[1] / dark.p[1]) / 0.7, length, 1e-12);
                EXPECT_NEAR(std::log(clear.p[2] / dark.p[2]) / 0.7, 2 * length, 1e-12);
                EXPECT_EQ(clear.p[0], dark.p[0]);
            }
        }
    }
}

// A_p = (1 - f)^2 f^(p - 1) T^p, and A_3 is what all later internal reflections leave: the sum over p >= 3.
TEST(Attenuation, RestIsTheSumOfTheSeries) {
    for (const Case& c : {Case{1.55, 20, 0.4}, Case{1.55, 80, 0.9}, Case{2.4, 88, -0.95}, Case{1.33, 0, 0.999}}) {
        for (const double sigma : {0.0, 0.05, 1.0}) {
            const Lobes a = at(c, sigma);
            const double step = a.p[2] / a.p[1];  // f T
            double term = a.p[2], sum = 0;
            for (int p = 3; p < 4000; ++p) sum += term *= step;
            EXPECT_NEAR(a.p[3], sum, 1e-13);
        }
    }
}

TEST(Attenuation, AbsorptionOnlyDarkens) {
    for (const Case& c : cases()) {
        Lobes before = at(c, 0);
        for (const double sigma : {1e-6, 0.01, 0.3, 2.0, 100.0, 1e4}) {
            const Lobes now = at(c, sigma);
            for (std::size_t p = 0; p < 4; ++p) {
                EXPECT_TRUE(std::isfinite(now.p[p]) && now.p[p] >= 0);
                EXPECT_LE(now.p[p], before.p[p]) << c.eta << ' ' << c.theta << ' ' << c.h << ' ' << sigma << ' ' << p;
            }
            before = now;
        }
    }
}

// Chiang 2016, equation 9, worked by hand at beta_N = 0.3; white absorbs nothing, darker colours more.
TEST(Attenuation, AbsorptionOfAColour) {
    EXPECT_NEAR(sigmaFromColor(0.5, 0.3), std::pow(std::log(2.0) / 5.88841475, 2), 1e-10);
    EXPECT_NEAR(sigmaFromColor(0.1, 1.0), std::pow(std::log(10.0) / 3.375, 2), 1e-13);
    EXPECT_EQ(sigmaFromColor(1, 0.3), 0);
    double before = 0;
    for (double color = 0.95; color > 0.01; color *= 0.8) {
        EXPECT_GT(sigmaFromColor(color, 0.3), before);
        before = sigmaFromColor(color, 0.3);
    }
}

}  // namespace
}  // namespace pelage::reference::test
