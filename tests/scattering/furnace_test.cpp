// SPDX-License-Identifier: MIT
// The white furnace on the device: a fibre that absorbs nothing, under a white sphere, returns what it received.
#include "harness.hpp"

#include <cmath>
#include <cstdio>

namespace pelage::test {
namespace {

using hair::ScatteringModel;

class Furnace : public ScatteringHarness {};

// Lobes at least 0.2 wide: the rule has 96 steps.
TEST_F(Furnace, MomentLutKeepsItsEnergyAtEveryInclination) {
    for (const double betaN : {0.2, 0.3, 0.6, 1.0}) {
        for (const double eta : {1.001, 1.02, 1.2, 1.55, 2.0, 3.0}) {
            hair::FiberProperties fiber;
            fiber.eta = eta;
            fiber.betaM = 0.25;
            fiber.betaN = betaN;
            fiber.alpha = -0.05;
            hair::MomentTable table(eta, betaN);
            std::vector<FurnaceView> views;
            for (const double degrees : {-89.9, -89.3, -85.0, -60.0, -30.0, 0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 80.0,
                                         85.0, 88.0, 89.0, 89.5, 89.9}) {
                const double theta = degrees * 3.14159265358979324 / 180.0;
                views.push_back({static_cast<float>(std::sin(theta)), static_cast<float>(std::cos(theta)), 0, 0});
            }
            float low = 9, high = 0;
            for (const float energy : furnace(ScatteringModel::MomentLut, false, false,
                                              {hair::packed(hair::resolveFiber(fiber))}, views, &table)) {
                low = std::min(low, energy);
                high = std::max(high, energy);
            }
            std::printf("moment_lut beta_N %.1f eta %.2f: %.4f to %.4f\n", betaN, eta, static_cast<double>(low),
                        static_cast<double>(high));
            EXPECT_GE(low, 0.98F);
            EXPECT_LE(high, 1.005F);
        }
    }
}

// The stated upper bound of what a model returns of white light, for any fibre with lobes the rule can hold.
TEST_F(Furnace, NoModelReturnsMoreThanItsBound) {
    struct Bound {
        ScatteringModel model;
        float most;
    };
    constexpr Bound bounds[] = {{ScatteringModel::KajiyaKay, 1.01F},  {ScatteringModel::Scheuermann, 1.01F},
                                {ScatteringModel::Marschner, 1.6F},   {ScatteringModel::Karis, 1.3F},
                                {ScatteringModel::Thesis, 1.4F},      {ScatteringModel::Gerard, 2.6F},
                                {ScatteringModel::Chiang, 1.005F},    {ScatteringModel::Pxr, 1.01F},
                                {ScatteringModel::MomentLut, 1.005F}, {ScatteringModel::SegmentCdf, 1.02F}};
    constexpr std::size_t fiberCount = 64, viewCount = 1024;
    const double eta = 1.55, betaN = 0.3;
    hair::MomentTable table(eta, betaN);
    std::uint64_t points = 0;
    for (const Bound& bound : bounds) {
        const hair::ModelInfo& info = *hair::findScatteringModel(bound.model);
        const bool nearField = info.nearField;
        std::mt19937 random(99);
        std::uniform_real_distribution<double> unit(0.0, 1.0);
        std::vector<hair::PackedFiber> fibers;
        for (std::size_t i = 0; i < fiberCount; ++i) {
            hair::FiberProperties f;
            f.eta = info.usesTable ? eta : 1.2 + unit(random);
            f.betaN = info.usesTable ? betaN : 0.2 + 0.8 * unit(random);
            f.betaM = 0.2 + 0.8 * unit(random);
            f.alpha = 0.2 * (unit(random) - 0.5);
            fibers.push_back(hair::packed(hair::resolveFiber(f, nearField)));
        }
        std::vector<FurnaceView> views;
        for (std::size_t i = 0; i < viewCount; ++i) {
            const double theta = 1.569 * (2.0 * unit(random) - 1.0);
            views.push_back({static_cast<float>(std::sin(theta)), static_cast<float>(std::cos(theta)),
                             static_cast<float>(1.99 * (unit(random) - 0.5)), 0});
        }
        float most = 0, least = 9;
        for (const float energy : furnace(bound.model, false, nearField, fibers, views, &table)) {
            EXPECT_TRUE(std::isfinite(energy));
            most = std::max(most, energy);
            least = std::min(least, energy);
        }
        points += viewCount * furnaceSteps * furnaceSteps;
        std::printf("%-12s returns %.3f to %.3f of white light\n", info.id.data(), static_cast<double>(least),
                    static_cast<double>(most));
        EXPECT_LE(most, bound.most) << info.id;
    }
    std::printf("%llu points\n", static_cast<unsigned long long>(points));
}

}  // namespace
}  // namespace pelage::test
