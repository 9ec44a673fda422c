// SPDX-License-Identifier: MIT
// One source, three builds: what is left between them is rounding, and its size is known.
#include "gpu.hpp"

#include <pelage/hair/scatter_compute.hpp>

#include <cmath>
#include <cstdio>
#include <functional>
#include <random>

namespace pelage::test {
namespace {

using hair::ScatteringModel;

// Ordinary hair: theta to 85 degrees, eta 1.3..1.8, sigma to 3, beta in a band.
std::vector<hair::ScatterRow> rows(double lowBeta, double highBeta, bool nearField, std::size_t count) {
    std::mt19937 random(42);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<hair::ScatterRow> all;
    for (std::size_t i = 0; i < count; ++i) {
        hair::ScatterRow row;
        row.fiber.eta = 1.3 + 0.5 * unit(random);
        row.fiber.betaM = lowBeta + (highBeta - lowBeta) * unit(random);
        row.fiber.betaN = lowBeta + (highBeta - lowBeta) * unit(random);
        row.fiber.alpha = 0.1 * (unit(random) - 0.5);
        row.fiber.sigmaA = {3.0 * unit(random), unit(random), 0.0};
        // The light near the mirror cone, where there is something to be wrong about.
        const double thetaO = 1.48 * (2.0 * unit(random) - 1.0);
        const double thetaI = std::clamp(-thetaO + 3.0 * row.fiber.betaM * (2.0 * unit(random) - 1.0), -1.48, 1.48);
        row.directions = {std::sin(thetaI),
                          std::cos(thetaI),
                          std::sin(thetaO),
                          std::cos(thetaO),
                          6.2831853071795862 * (unit(random) - 0.5),
                          {}};
        if (nearField) row.directions.h = 1.998 * (unit(random) - 0.5);
        all.push_back(row);
    }
    return all;
}

// Relative to the value, or where the value is a millionth of what the lobe reaches, to that.
double worst(const std::vector<hair::ScatterRow>& all, const std::vector<hair::ScatteredLobes>& found,
             const std::vector<hair::ScatteredLobes>& exact) {
    double largest = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t p = 0; p < 4; ++p) {
            for (std::size_t c = 0; c < 3; ++c) {
                const double e = exact[i].lobe[p][c], scale = std::max(e, 1e-6);
                largest = std::max(largest, std::abs(found[i].lobe[p][c] - e) / scale);
            }
        }
    }
    return largest;
}

struct Band {
    double low, high, bound;
};
// The goals for a GPU's floats against the double build of the same source.
constexpr Band bands[] = {{0.2, 1.0, 5e-5}, {0.1, 0.2, 1e-4}, {0.05, 0.1, 2e-4}, {0.02, 0.05, 1e-3}};

using Scatter = hair::ScatteredLobes (*)(ScatteringModel, bool, const hair::FiberProperties&,
                                         const hair::FiberDirections&, hair::MomentTable*);

std::vector<hair::ScatteredLobes> onCpu(Scatter scatter, ScatteringModel model,
                                        const std::vector<hair::ScatterRow>& all) {
    std::vector<hair::ScatteredLobes> results;
    const bool usesTable = hair::findScatteringModel(model)->usesTable;
    for (const hair::ScatterRow& row : all) {
        std::optional<hair::MomentTable> table;
        if (usesTable) table.emplace(row.fiber.eta, row.fiber.betaN);
        results.push_back(scatter(model, false, row.fiber, row.directions, table ? &*table : nullptr));
    }
    return results;
}

class Precision : public GpuTest {};

TEST_F(Precision, GpuFloatsAreCloseToTheDoubleBuild) {
    hair::ScatterCompute compute(gpu.device);
    for (const ScatteringModel model : {ScatteringModel::Chiang, ScatteringModel::MomentLut}) {
        const bool nearField = model == ScatteringModel::Chiang;
        for (const Band& band : bands) {
            const auto all = rows(band.low, band.high, nearField, nearField ? 20000 : 1000);
            const auto found = compute.evaluate(model, false, all);
            ASSERT_TRUE(found) << found.error().first().text;
            const auto exact = onCpu(hair::scatterDouble, model, all);
            const double gpuError = worst(all, *found, exact);
            const double floatError = worst(all, onCpu(hair::scatterFloat, model, all), exact);
            std::printf("%-12s beta %.2f..%.2f: GPU %.2g, C++ float %.2g, goal %.0e\n",
                        hair::findScatteringModel(model)->id.data(), band.low, band.high, gpuError, floatError,
                        band.bound);
            EXPECT_LE(gpuError, band.bound);
            EXPECT_LE(floatError, band.bound);
        }
    }
}

// segment_cdf takes differences of nearly equal integrals in the tails of its lobes: there its floats are right to a
// share of the lobe, not of the value. 0.01 is an eighth of a fibre that scatters evenly.
TEST_F(Precision, SegmentsAreRightToAShareOfTheLobe) {
    hair::ScatterCompute compute(gpu.device);
    const auto all = rows(0.1, 1.0, false, 5000);
    const auto found = compute.evaluate(ScatteringModel::SegmentCdf, false, all);
    ASSERT_TRUE(found) << found.error().first().text;
    const auto exact = onCpu(hair::scatterDouble, ScatteringModel::SegmentCdf, all);
    double largest = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t p = 0; p < 4; ++p) {
            const double e = exact[i].lobe[p][0];
            largest = std::max(largest, std::abs((*found)[i].lobe[p][0] - e) / std::max(e, 0.01));
        }
    }
    std::printf("segment_cdf  beta 0.10..1.00: GPU %.2g of max(S, 0.01)\n", largest);
    EXPECT_LE(largest, 2e-4);
}

}  // namespace
}  // namespace pelage::test
