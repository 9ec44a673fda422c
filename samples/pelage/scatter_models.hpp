// SPDX-License-Identifier: MIT
// Rows of scattering, evaluated on the CPU: the truth, or a model in float or double.
#pragma once

#include "scatter_device.hpp"
#include "scatter_rows.hpp"

#include <pelage/hair/moment_table.hpp>
#include <pelage/reference/fiber.hpp>

#include <list>
#include <utility>

namespace pelage::app {

/// A row as the truth takes it.
reference::Fiber referenceFiber(const ScatterTuple& tuple);
reference::Angles referenceAngles(const ScatterTuple& tuple);
/// A row as a model takes it: all three wavelengths absorb alike, and models that know a colour and no absorption get
/// C = exp(-4 sigma_a).
ScatterQuery scatterQuery(const ScatterTuple& tuple);

/// Moment tables last asked for. Tables fill as they are read, so each thread has a set of its own.
class TableCache {
public:
    hair::MomentTable& table(double eta, double betaN);

private:
    static constexpr std::size_t kept = 8;
    std::list<std::pair<std::pair<double, double>, hair::MomentTable>> tables_;  // the last used first
};

/// How rows are evaluated, and by what.
struct ScatterMethod {
    const hair::ModelInfo* model = nullptr;  // null: the truth
    bool published = false;
    bool inFloat = false;
};
RowLobes evaluate(const ScatterMethod& method, const ScatterTuple& tuple, TableCache& tables);

/// Usable rows on all cores; nothing for the others.
std::vector<std::optional<RowLobes>> evaluateRows(const ScatterMethod& method, std::span<const ScatterRow> rows);

}  // namespace pelage::app
