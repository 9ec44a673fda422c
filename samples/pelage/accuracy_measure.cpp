// SPDX-License-Identifier: MIT
#include "accuracy_measure.hpp"

#include <pelage/reference/terms.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

namespace pelage::app {

using reference::degree;
using reference::pi;

std::vector<ModelForm> modelForms() {
    std::vector<ModelForm> forms;
    for (const hair::ModelInfo& info : hair::scatteringModels()) {
        forms.push_back({&info, false});
        if (info.corrected) forms.push_back({&info, true});
    }
    return forms;
}

AccuracyEffort quickEffort() {
    return {.inclinations = 5,
            .azimuths = 15,
            .along = 15,
            .furnaceAlong = 60,
            .furnaceAround = 60,
            .nearRows = 500,
            .tableRows = 60,
            .halfFibers = 8,
            .halfRowsPerFiber = 20,
            .pairs = 100};
}

Workers::Workers() : tables_(std::max(std::thread::hardware_concurrency(), 1U)) {}

void Workers::each(std::size_t count, const std::function<void(std::size_t, TableCache&)>& work) {
    std::atomic<std::size_t> next = 0;
    const auto run = [&](TableCache& tables) {
        for (std::size_t i = next.fetch_add(1); i < count; i = next.fetch_add(1)) work(i, tables);
    };
    std::vector<std::jthread> others;
    for (std::size_t i = 1; i < std::min(tables_.size(), count); ++i) others.emplace_back(run, std::ref(tables_[i]));
    run(tables_[0]);
    others.clear();  // joins
}

RowLobes lobesOf(const ModelForm& form, const ScatterQuery& query, TableCache& tables, bool inFloat) {
    hair::MomentTable* table = form.info->usesTable ? &tables.table(query.fiber.eta, query.fiber.betaN) : nullptr;
    const auto run = inFloat ? hair::scatterFloat : hair::scatterDouble;
    const auto s = run(form.info->model, form.published, query.fiber, query.directions, table).lobe;
    return {s[0][0], s[1][0], s[2][0], s[3][0]};
}

double totalOf(const ModelForm& form, const ScatterQuery& query, TableCache& tables) {
    const RowLobes s = lobesOf(form, query, tables);
    return s[0] + s[1] + s[2] + s[3];
}

hair::FiberDirections directionsOf(double thetaI, double thetaO, double phi) {
    return {std::sin(thetaI), std::abs(std::cos(thetaI)), std::sin(thetaO), std::abs(std::cos(thetaO)), phi, {}};
}

ScatterQuery TruthGrid::query(double thetaI, double thetaO, double phi) const {
    ScatterQuery query;
    query.fiber.eta = eta;
    query.fiber.betaM = betaM;
    query.fiber.betaN = betaN;
    query.fiber.sigmaA.fill(sigma);
    query.fiber.color.fill(std::exp(-4.0 * sigma));  // as in `pelage scatter`: the inverse of sigmaFromPathColor
    query.directions = directionsOf(thetaI, thetaO, phi);
    return query;
}

TruthGrid truthGrid(Workers& workers, double betaN, double sigma, const AccuracyEffort& effort) {
    TruthGrid grid{.betaN = betaN, .sigma = sigma};
    for (std::size_t i = 0; i < effort.inclinations; ++i) {
        grid.thetas.push_back((0.5 + 86.5 * static_cast<double>(i) / static_cast<double>(effort.inclinations - 1)) *
                              degree);
    }
    for (std::size_t j = 0; j < effort.azimuths; ++j) {
        grid.phis.push_back(pi * (static_cast<double>(j) + 0.5) / static_cast<double>(effort.azimuths));
    }
    const reference::Fiber fiber{TruthGrid::eta, TruthGrid::betaM, betaN, 0, sigma};
    grid.around.resize(grid.thetas.size() * grid.phis.size());
    workers.each(grid.around.size(), [&](std::size_t k, TableCache&) {
        const double theta = grid.thetas[k / grid.phis.size()], phi = grid.phis[k % grid.phis.size()];
        grid.around[k] = reference::farFieldAzimuthal(fiber, std::cos(theta), phi).value;
    });
    return grid;
}

LobeDistance distanceAround(Workers& workers, const ModelForm& form, const TruthGrid& truth) {
    const auto variances = reference::longitudinalVariances(TruthGrid::betaM);
    std::vector<RowLobes> found(truth.around.size());
    workers.each(found.size(), [&](std::size_t k, TableCache& tables) {
        const double theta = truth.thetas[k / truth.phis.size()], phi = truth.phis[k % truth.phis.size()];
        found[k] = lobesOf(form, truth.query(-theta, theta, phi), tables);
        for (std::size_t p = 0; p < 4; ++p) {
            found[k][p] /= reference::longitudinal(variances[p], -std::sin(theta), std::cos(theta), std::sin(theta),
                                                   std::cos(theta));
        }
    });
    LobeDistance distance{.energyLeast = 1e9};
    std::array<double, 4> difference{}, square{}, peak{}, worst{};
    for (std::size_t i = 0; i < truth.thetas.size(); ++i) {
        const double weight = std::cos(truth.thetas[i]);
        double here = 0, there = 0;
        for (std::size_t k = i * truth.phis.size(); k < (i + 1) * truth.phis.size(); ++k) {
            for (std::size_t p = 0; p < 4; ++p) {
                const double exact = truth.around[k].p[p], error = std::abs(found[k][p] - exact);
                difference[p] += weight * error * error;
                square[p] += weight * exact * exact;
                peak[p] = std::max(peak[p], exact);
                worst[p] = std::max(worst[p], error);
                here += found[k][p];
                there += exact;
            }
        }
        distance.energyLeast = std::min(distance.energyLeast, here / there);
        distance.energyMost = std::max(distance.energyMost, here / there);
    }
    for (std::size_t p = 0; p < 4; ++p) {
        distance.relative[p] = std::sqrt(difference[p] / square[p]);
        if (p < 3) distance.worst = std::max(distance.worst, worst[p] / peak[p]);
    }
    return distance;
}

double distanceOverSphere(Workers& workers, const ModelForm& form, const TruthGrid& truth,
                          const AccuracyEffort& effort) {
    const auto variances = reference::longitudinalVariances(TruthGrid::betaM);
    std::vector<std::pair<double, double>> sums(truth.around.size());  // of squares: difference, truth
    workers.each(sums.size(), [&](std::size_t k, TableCache& tables) {
        const double thetaO = truth.thetas[k / truth.phis.size()], phi = truth.phis[k % truth.phis.size()];
        for (std::size_t i = 0; i < effort.along; ++i) {
            const double thetaI = pi * ((static_cast<double>(i) + 0.5) / static_cast<double>(effort.along) - 0.5);
            double exact = 0;
            for (std::size_t p = 0; p < 4; ++p) {
                exact +=
                    truth.around[k].p[p] * reference::longitudinal(variances[p], std::sin(thetaI), std::cos(thetaI),
                                                                   std::sin(thetaO), std::cos(thetaO));
            }
            const double error = totalOf(form, truth.query(thetaI, thetaO, phi), tables) - exact;
            const double weight = std::cos(thetaI) * std::cos(thetaO);
            sums[k].first += weight * error * error;
            sums[k].second += weight * exact * exact;
        }
    });
    double difference = 0, square = 0;
    for (const auto& sum : sums) {
        difference += sum.first;
        square += sum.second;
    }
    return std::sqrt(difference / square);
}

double whiteFurnace(Workers& workers, const ModelForm& form, double thetaO, const AccuracyEffort& effort) {
    // The far field of chiang is a loop over 512 offsets, and smooth: it needs fewer points and can afford no more.
    const bool slow = form.is(hair::ScatteringModel::Chiang);
    const std::size_t along = slow ? effort.furnaceAlong / 2 : effort.furnaceAlong;
    const std::size_t around = slow ? effort.furnaceAround / 4 : effort.furnaceAround;
    const TruthGrid fiber{.betaN = 0.3, .sigma = 0};
    std::vector<double> sums(along);
    workers.each(along, [&](std::size_t i, TableCache& tables) {
        // theta_i = -pi/2 cos(t): close steps at both ends, where some models have a pole.
        const double t = pi * (static_cast<double>(i) + 0.5) / static_cast<double>(along);
        const double thetaI = -0.5 * pi * std::cos(t);
        for (std::size_t j = 0; j < around; ++j) {
            const double phi = pi * (static_cast<double>(j) + 0.5) / static_cast<double>(around);
            sums[i] += totalOf(form, fiber.query(thetaI, thetaO * degree, phi), tables);
        }
        sums[i] *= std::cos(thetaI) * 0.5 * pi * std::sin(t);
    });
    double total = 0;
    for (const double sum : sums) total += sum;
    return total * (pi / static_cast<double>(along)) * (2.0 * pi / static_cast<double>(around));
}

}  // namespace pelage::app
