// SPDX-License-Identifier: MIT
// What fewer digits cost a model, and whether it is reciprocal: measures over random rows. Seeds are fixed.
#include "accuracy_measure.hpp"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace pelage::app {

namespace {

using reference::pi;

constexpr double steepest = 1.48;  // theta to 85 degrees

class Random {
public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    double operator()(double low = 0, double high = 1) { return low + (high - low) * unit_(engine_); }

private:
    std::mt19937 engine_;
    std::uniform_real_distribution<double> unit_{0.0, 1.0};
};

/// The light near the mirror cone, where there is something to be wrong about.
hair::FiberDirections ordinaryDirections(Random& random, double betaM) {
    const double thetaO = random(-steepest, steepest);
    const double thetaI = std::clamp(-thetaO + 3.0 * betaM * random(-1, 1), -steepest, steepest);
    return directionsOf(thetaI, thetaO, random(-pi, pi));
}

/// Ordinary hair: eta 1.3 to 1.8, sigma to 3, beta in a band. Rows like those of tests/scattering/precision_test.cpp.
std::vector<ScatterQuery> bandRows(const RoundingBand& band, bool nearField, std::size_t count) {
    Random random(42);
    std::vector<ScatterQuery> rows;
    for (std::size_t i = 0; i < count; ++i) {
        ScatterQuery row;
        row.fiber.eta = random(1.3, 1.8);
        row.fiber.betaM = random(band.low, band.high);
        row.fiber.betaN = random(band.low, band.high);
        row.fiber.alpha = random(-0.05, 0.05);
        row.fiber.sigmaA.fill(random(0, 3));
        row.directions = ordinaryDirections(random, row.fiber.betaM);
        if (nearField) row.directions.h = random(-0.999, 0.999);
        rows.push_back(row);
    }
    return rows;
}

constexpr RoundingBand bands[] = {{0.2, 1.0, 5e-5}, {0.1, 0.2, 1e-4}, {0.05, 0.1, 2e-4}, {0.02, 0.05, 1e-3}};

double worstOf(const std::vector<RowLobes>& found, const std::vector<RowLobes>& exact) {
    double worst = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        for (std::size_t p = 0; p < 4; ++p) {
            worst = std::max(worst, std::abs(found[i][p] - exact[i][p]) / std::max(exact[i][p], 1e-6));
        }
    }
    return worst;
}

double half(double x) {
    return static_cast<double>(glm::unpackHalf1x16(glm::packHalf1x16(static_cast<float>(x))));
}

hair::FiberDirections halved(const hair::FiberDirections& d) {
    return {half(d.sinThetaI), half(d.cosThetaI), half(d.sinThetaO), half(d.cosThetaO), half(d.phi), d.h};
}

hair::FiberProperties halved(hair::FiberProperties fiber) {
    for (double* x : {&fiber.eta, &fiber.betaM, &fiber.betaN, &fiber.alpha}) *x = half(*x);
    for (double& x : fiber.sigmaA) x = half(x);
    for (double& x : fiber.color) x = half(x);
    return fiber;
}

HalfLoss lossOf(std::vector<double> changes) {
    if (changes.empty()) return {};
    std::sort(changes.begin(), changes.end());
    return {changes[changes.size() / 2], changes.back()};
}

/// S of a row, and with its output, directions or material in halves.
using HalfRow = std::array<double, 4>;

}  // namespace

std::span<const RoundingBand> roundingBands() {
    return bands;
}

Result<std::vector<RoundingResult>> roundingOf(Workers& workers, const DeviceOptions* device,
                                               const AccuracyEffort& effort) {
    std::vector<RoundingResult> results;
    for (const auto model : {hair::ScatteringModel::Chiang, hair::ScatteringModel::MomentLut}) {
        const ModelForm form{hair::findScatteringModel(model), false};
        const bool nearField = !form.info->usesTable;
        for (const RoundingBand& band : bands) {
            const auto rows = bandRows(band, nearField, nearField ? effort.nearRows : effort.tableRows);
            std::vector<RowLobes> exact(rows.size()), cpp(rows.size()), gpu;
            workers.each(rows.size(), [&](std::size_t i, TableCache& tables) {
                exact[i] = lobesOf(form, rows[i], tables);
                cpp[i] = lobesOf(form, rows[i], tables, true);
            });
            RoundingResult result{.form = form, .band = band, .cpp = worstOf(cpp, exact)};
            if (device) {
                const auto found = scatterOnDevice(*device, model, false, rows);
                if (!found) return tl::unexpected(found.error());
                for (const auto& s : *found) gpu.push_back({s.lobe[0][0], s.lobe[1][0], s.lobe[2][0], s.lobe[3][0]});
                result.gpu = worstOf(gpu, exact);
            }
            results.push_back(result);
        }
    }
    return results;
}

HalfResult halfLossOf(Workers& workers, const ModelForm& form, const AccuracyEffort& effort) {
    const bool nearField = form.info->usesOffset && !form.info->usesTable;
    std::vector<std::vector<HalfRow>> found(effort.halfFibers);
    workers.each(effort.halfFibers, [&](std::size_t f, TableCache& tables) {
        Random random(static_cast<std::uint32_t>(1000 + f));
        hair::FiberProperties fiber;
        fiber.eta = random(1.3, 1.8);
        fiber.betaM = random(0.1, 0.9);
        fiber.betaN = random(0.1, 0.9);
        fiber.alpha = random(-0.05, 0.05);
        const double sigma = random(0, 1.5);
        fiber.sigmaA.fill(sigma);
        fiber.color.fill(std::exp(-4.0 * sigma));
        const hair::FiberProperties coarse = halved(fiber);
        for (std::size_t i = 0; i < effort.halfRowsPerFiber; ++i) {
            hair::FiberDirections directions = ordinaryDirections(random, fiber.betaM);
            if (nearField) directions.h = random(-0.999, 0.999);
            const double s = totalOf(form, {fiber, directions}, tables);
            if (s <= 0.01) continue;
            found[f].push_back({s, half(s), totalOf(form, {fiber, halved(directions)}, tables),
                                totalOf(form, {coarse, directions}, tables)});
        }
    });
    std::array<std::vector<double>, 3> changes;
    for (const auto& rows : found) {
        for (const HalfRow& row : rows) {
            for (std::size_t k = 0; k < 3; ++k) changes[k].push_back(std::abs(row[k + 1] / row[0] - 1.0));
        }
    }
    return {form, changes[0].size(), lossOf(changes[0]), lossOf(changes[1]), lossOf(changes[2])};
}

double reciprocityError(Workers& workers, const ModelForm& form, const AccuracyEffort& effort) {
    std::vector<double> errors(effort.pairs);
    workers.each(effort.pairs, [&](std::size_t i, TableCache& tables) {
        Random random(static_cast<std::uint32_t>(5000 + i));
        ScatterQuery there = TruthGrid{.betaN = 0.3, .sigma = 0.25}.query(0, 0, 0);
        there.fiber.alpha = -2.0 * reference::degree;
        there.directions = ordinaryDirections(random, there.fiber.betaM);
        ScatterQuery back = there;
        std::swap(back.directions.sinThetaI, back.directions.sinThetaO);
        std::swap(back.directions.cosThetaI, back.directions.cosThetaO);
        back.directions.phi = -there.directions.phi;
        const double s = totalOf(form, there, tables) / there.directions.cosThetaI;
        const double t = totalOf(form, back, tables) / back.directions.cosThetaI;
        errors[i] = std::max(s, t) > 0 ? std::abs(s - t) / std::max(s, t) : 0.0;
    });
    return *std::max_element(errors.begin(), errors.end());
}

}  // namespace pelage::app
