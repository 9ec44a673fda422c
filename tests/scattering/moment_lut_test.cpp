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

// White furnace around the fibre, on the rows of the table and between them, for every index: over all azimuths N0 of
// the four lobes sum to 1.
TEST(MomentLut, TheTableKeepsTheLightAtEveryInclination) {
    for (const double eta : {1.0001, 1.001, 1.005, 1.05, 1.33, 1.55, 2.5, 3.0}) {
        for (const double betaN : {0.05, 0.3, 1.0}) {
            hair::MomentTable table(eta, betaN);
            for (double degrees = 0; degrees < 89.95; degrees += degrees < 85 ? 3.7 : 0.13) {
                const double cosine = std::cos(degrees * reference::degree);
                const double root = std::sqrt((eta - 1) * (eta + 1) + cosine * cosine);
                // What moments.glsl puts back: momentRim.
                const double rim = cosine / (cosine + 0.21 * root);
                const double back[] = {1, rim * rim, rim * rim, rim};
                double sum = 0;
                const int steps = static_cast<int>(table.width()) - 1;
                for (int x = 0; x <= steps; ++x) {
                    const auto s = table.sample(cosine, reference::pi * x / steps);
                    const double ends = x == 0 || x == steps ? 0.5 : 1.0;
                    for (std::size_t p = 0; p < 4; ++p) {
                        const auto at = [&](std::size_t k) { return static_cast<double>(s.texels[0][k][p]); };
                        const double low = (1 - s.weightX) * at(0) + s.weightX * at(1);
                        const double high = (1 - s.weightX) * at(2) + s.weightX * at(3);
                        sum += ends * back[p] * ((1 - s.weightY) * low + s.weightY * high);
                    }
                }
                sum *= 2 * reference::pi / steps;
                EXPECT_NEAR(sum, 1.0, 0.005) << "eta " << eta << " beta_N " << betaN << " theta " << degrees;
            }
        }
    }
}

// Mirrored at the normal plane, with the scales leaning the other way; and mirrored at the plane of fibre and view.
TEST(EveryModel, ObeysTheMirrorSymmetries) {
    for (const hair::ModelInfo& info : hair::scatteringModels()) {
        hair::MomentTable table(1.55, 0.3);
        hair::FiberProperties fiber, leaning;
        fiber.sigmaA = leaning.sigmaA = {0.1, 0.4, 1.5};
        fiber.alpha = 0.06;
        leaning.alpha = -0.06;
        for (const double i : {-1.5, -0.4, 0.0, 0.7}) {
            for (const double o : {-1.1, 0.0, 0.3, 1.55}) {
                for (const double phi : {0.0, 0.5, 2.2, 3.1}) {
                    for (const bool published : {false, true}) {
                        const auto at = [&](const hair::FiberProperties& f, double sign, double azimuth, double h) {
                            const std::optional<double> offset = info.usesOffset ? std::optional(h) : std::nullopt;
                            return hair::scatterDouble(
                                info.model, published, f,
                                {sign * std::sin(i), std::cos(i), sign * std::sin(o), std::cos(o), azimuth, offset},
                                &table);
                        };
                        const auto s = at(fiber, 1, phi, 0.4), mirrored = at(leaning, -1, phi, 0.4),
                                   turned = at(fiber, 1, -phi, -0.4);
                        for (std::size_t p = 0; p < 4; ++p) {
                            for (std::size_t c = 0; c < 3; ++c) {
                                const double bound = 1e-9 * s.lobe[p][c] + 1e-12;
                                // Scheuermann's smoothstep of t.h fades one end of the hair alone.
                                const bool oneSided = published && info.model == ScatteringModel::Scheuermann;
                                if (!oneSided) {
                                    EXPECT_NEAR(mirrored.lobe[p][c], s.lobe[p][c], bound) << info.id << " lobe " << p;
                                }
                                EXPECT_NEAR(turned.lobe[p][c], s.lobe[p][c], bound) << info.id << " lobe " << p;
                            }
                        }
                    }
                }
            }
        }
    }
}

TEST(MomentLut, NamesAreReadAsTheyAreWritten) {
    const auto table = hair::momentTableOf(hair::momentTableName(1.55, 0.1));
    ASSERT_TRUE(table);
    EXPECT_EQ(table->width(), hair::MomentTable(1.55, 0.1).width());
    for (const char* name : {"moments:none", "moments:1.5", "moments:,", "moments:a,b", "moments:1.5x,0.3",
                             "moments:1.5,0.3y", "moments", "", "other:1,1"}) {
        EXPECT_FALSE(hair::momentTableOf(name)) << name;
    }
}

}  // namespace
}  // namespace pelage::test
