// SPDX-License-Identifier: MIT
#include "scatter_models.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

namespace pelage::app {

reference::Fiber referenceFiber(const ScatterTuple& tuple) {
    return {tuple.eta, tuple.betaM, tuple.betaN, tuple.alpha * reference::degree, tuple.sigmaA};
}

reference::Angles referenceAngles(const ScatterTuple& tuple) {
    return reference::anglesFromDegrees(tuple.thetaI, tuple.phiI, tuple.thetaO, tuple.phiO);
}

ScatterQuery scatterQuery(const ScatterTuple& tuple) {
    const reference::Angles angles = referenceAngles(tuple);
    ScatterQuery query;
    query.fiber.eta = tuple.eta;
    query.fiber.betaM = tuple.betaM;
    query.fiber.betaN = tuple.betaN;
    query.fiber.alpha = tuple.alpha * reference::degree;
    query.fiber.sigmaA.fill(tuple.sigmaA);
    query.fiber.color.fill(std::exp(-4.0 * tuple.sigmaA));  // the inverse of sigmaFromPathColor
    query.directions = {angles.sinThetaI, angles.cosThetaI, angles.sinThetaO, angles.cosThetaO, angles.phi, tuple.h};
    return query;
}

hair::MomentTable& TableCache::table(double eta, double betaN) {
    const std::pair key(eta, betaN);
    const auto found = std::find_if(tables_.begin(), tables_.end(), [&](const auto& t) { return t.first == key; });
    if (found != tables_.end()) {
        tables_.splice(tables_.begin(), tables_, found);
    } else {
        tables_.emplace_front(key, hair::MomentTable(eta, betaN));
        if (tables_.size() > kept) tables_.pop_back();
    }
    return tables_.front().second;
}

RowLobes evaluate(const ScatterMethod& method, const ScatterTuple& tuple, TableCache& tables) {
    if (!method.model) {
        const reference::Fiber fiber = referenceFiber(tuple);
        const reference::Angles angles = referenceAngles(tuple);
        return tuple.h ? nearField(fiber, angles, *tuple.h).p : farField(fiber, angles).value.p;
    }
    const ScatterQuery query = scatterQuery(tuple);
    hair::MomentTable* table = method.model->usesTable ? &tables.table(tuple.eta, tuple.betaN) : nullptr;
    const auto run = method.inFloat ? hair::scatterFloat : hair::scatterDouble;
    const hair::ScatteredLobes s = run(method.model->model, method.published, query.fiber, query.directions, table);
    return {s.lobe[0][0], s.lobe[1][0], s.lobe[2][0], s.lobe[3][0]};
}

std::vector<std::optional<RowLobes>> evaluateRows(const ScatterMethod& method, std::span<const ScatterRow> rows) {
    std::vector<std::optional<RowLobes>> lobes(rows.size());
    // Blocks of rows are small, as a sharp far field takes a thousand times as long as a near field.
    constexpr std::size_t block = 16;
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        TableCache tables;
        for (;;) {
            const std::size_t first = next.fetch_add(block);
            if (first >= rows.size()) return;
            for (std::size_t i = first; i < std::min(first + block, rows.size()); ++i) {
                if (rows[i].usable) lobes[i] = evaluate(method, rows[i].tuple, tables);
            }
        }
    };
    const std::size_t cores = std::max(std::thread::hardware_concurrency(), 1U);
    std::vector<std::jthread> others;
    for (std::size_t i = 1; i < std::min(cores, (rows.size() + block - 1) / block); ++i) others.emplace_back(work);
    work();
    others.clear();  // joins
    return lobes;
}

}  // namespace pelage::app
