// SPDX-License-Identifier: MIT
// moment_lut and segment_cdf against the exact far field: the goals of docs/accuracy.md, in double.
#include <pelage/hair/scattering.hpp>
#include <pelage/reference/terms.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pelage::test {
namespace {

using hair::ScatteringModel;

struct LobeError {
    double relativeL2 = 0;                   // over theta_o and phi, weighted by cos(theta_o)
    double worst = 0;                        // of the lobe's peak
    double leastEnergy = 9, mostEnergy = 0;  // per theta_o, of the exact
};

// A_p N_p of a far-field model against the truth, over theta_o 0.5 to 87.5 degrees and phi 1 to 179.
std::array<LobeError, 4> against(ScatteringModel model, double betaN, double sigmaA) {
    hair::FiberProperties fiber;
    fiber.betaN = betaN;
    fiber.sigmaA = {sigmaA, sigmaA, sigmaA};
    hair::MomentTable table(fiber.eta, betaN);
    const reference::Fiber exactFiber{fiber.eta, fiber.betaM, betaN, 0, sigmaA};
    const auto v = reference::longitudinalVariances(fiber.betaM);
    std::array<LobeError, 4> errors;
    std::array<double, 4> difference{}, size{}, peak{};
    for (double theta = 0.5; theta < 88; theta += 9.66) {
        std::array<double, 4> own{}, all{};
        for (double phi = 1; phi < 180; phi += 3.1) {
            const reference::Angles a = reference::anglesFromDegrees(-theta, phi, theta, 0);
            const auto exact = reference::farFieldAzimuthal(exactFiber, a.cosThetaO, a.phi).value;
            const auto s = hair::scatterDouble(model, false, fiber,
                                               {a.sinThetaI, a.cosThetaI, a.sinThetaO, a.cosThetaO, a.phi, {}}, &table);
            for (std::size_t p = 0; p < 4; ++p) {
                const double m = reference::longitudinal(v[p], a.sinThetaI, a.cosThetaI, a.sinThetaO, a.cosThetaO);
                const double n = s.lobe[p][0] / m, d = n - exact.p[p];
                difference[p] += a.cosThetaO * d * d;
                size[p] += a.cosThetaO * exact.p[p] * exact.p[p];
                peak[p] = std::max(peak[p], exact.p[p]);
                errors[p].worst = std::max(errors[p].worst, std::abs(d));
                own[p] += n;
                all[p] += exact.p[p];
            }
        }
        for (std::size_t p = 0; p < 4; ++p) {
            errors[p].leastEnergy = std::min(errors[p].leastEnergy, own[p] / all[p]);
            errors[p].mostEnergy = std::max(errors[p].mostEnergy, own[p] / all[p]);
        }
    }
    for (std::size_t p = 0; p < 4; ++p) {
        errors[p].relativeL2 = std::sqrt(difference[p] / size[p]);
        errors[p].worst /= peak[p];
    }
    return errors;
}

TEST(MomentLut, FollowsTheExactFarField) {
    for (const double betaN : {0.1, 0.2, 0.3, 0.6, 0.8}) {
        for (const double sigmaA : {0.0, 0.25, 1.0}) {
            const auto errors = against(ScatteringModel::MomentLut, betaN, sigmaA);
            const double bounds[] = {0.005, 0.005, betaN < 0.2 ? 0.02 : 0.015};
            for (std::size_t p = 0; p < 3; ++p) {
                EXPECT_LE(errors[p].relativeL2, bounds[p]) << "lobe " << p << " beta_N " << betaN << " s " << sigmaA;
                EXPECT_LE(errors[p].worst, 0.02) << "lobe " << p << " beta_N " << betaN << " s " << sigmaA;
                EXPECT_GE(errors[p].leastEnergy, 0.99) << "lobe " << p << " beta_N " << betaN << " s " << sigmaA;
                EXPECT_LE(errors[p].mostEnergy, 1.01) << "lobe " << p << " beta_N " << betaN << " s " << sigmaA;
            }
            EXPECT_LE(errors[3].relativeL2, 0.05) << "residual, beta_N " << betaN << " s " << sigmaA;
        }
    }
}

TEST(SegmentCdf, FollowsTheExactFarFieldWithoutATable) {
    for (const double betaN : {0.1, 0.3, 0.8}) {
        const auto errors = against(ScatteringModel::SegmentCdf, betaN, 0.25);
        const double bounds[] = {0.02, 0.06, betaN < 0.2 ? 0.06 : 0.02, 0.01};
        for (std::size_t p = 0; p < 4; ++p) {
            EXPECT_LE(errors[p].relativeL2, bounds[p]) << "lobe " << p << " beta_N " << betaN;
            EXPECT_GE(errors[p].leastEnergy, 0.95);
            EXPECT_LE(errors[p].mostEnergy, 1.05);
        }
    }
}

// exp(-sigma l) averaged over paths falls with sigma, whatever two moments make of it.
TEST(MomentLut, AbsorptionOnlyDarkens) {
    hair::MomentTable table(1.55, 0.3);
    hair::FiberProperties fiber;
    for (const double theta : {0.0, 0.7, 1.4, 1.56}) {
        for (const double phi : {0.0, 0.4, 1.5, 3.1}) {
            double before[4] = {1e9, 1e9, 1e9, 1e9};
            for (double sigma = 1e-3; sigma < 2e4; sigma *= 1.5) {
                fiber.sigmaA = {sigma, sigma, sigma};
                const auto s = hair::scatterDouble(
                    ScatteringModel::MomentLut, false, fiber,
                    {-std::sin(theta), std::cos(theta), std::sin(theta), std::cos(theta), phi, {}}, &table);
                for (std::size_t p = 0; p < 4; ++p) {
                    EXPECT_LE(s.lobe[p][0], before[p] * (1 + 1e-12)) << "lobe " << p << " sigma " << sigma;
                    before[p] = s.lobe[p][0];
                }
            }
            EXPECT_EQ(before[1] + before[2] + before[3], 0) << "black";
        }
    }
}

// The table has the light of the lobes in it: over all azimuths N0 of R, TT, TRT and the residual sum to 1.
TEST(MomentLut, TablesKeepTheLight) {
    for (const double eta : {1.0001, 1.33, 1.55, 2.5, 3.0}) {
        for (const double betaN : {0.05, 0.3, 1.0}) {
            hair::MomentTable table(eta, betaN);
            for (std::uint32_t y = 1; y < table.height(); y += 9) {
                // As moments.glsl reads it: the fall towards 90 degrees is put back.
                const double cosine = y / (table.height() - 1.0),
                             root = std::sqrt((eta - 1) * (eta + 1) + cosine * cosine);
                const double rim = cosine / (cosine + 0.21 * root);
                const double back[] = {1, rim * rim, rim * rim, rim};
                double sum = 0;
                for (std::uint32_t x = 0; x < table.width(); ++x) {
                    const auto n = table.texel(0, x, y);
                    const double ends = x == 0 || x + 1 == table.width() ? 0.5 : 1.0;
                    for (std::size_t p = 0; p < 4; ++p) sum += ends * back[p] * static_cast<double>(n[p]);
                }
                sum *= 2 * reference::pi / (table.width() - 1);
                EXPECT_NEAR(sum, 1.0, 0.003) << "eta " << eta << " beta_N " << betaN << " row " << y;
            }
        }
    }
}

TEST(MomentLut, NamesAreReadAsTheyAreWritten) {
    const auto table = hair::momentTableOf(hair::momentTableName(1.55, 0.1));
    ASSERT_TRUE(table);
    EXPECT_EQ(table->width(), hair::MomentTable(1.55, 0.1).width());
    for (const char* name : {"moments:none", "moments:1.5", "moments:,", "moments:a,b", "moments", "", "other:1,1"}) {
        EXPECT_FALSE(hair::momentTableOf(name)) << name;
    }
}

}  // namespace
}  // namespace pelage::test
