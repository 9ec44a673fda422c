// SPDX-License-Identifier: MIT
// What a frame cost: timestamps and pipeline statistics, read back after its submission.
#include "graph_state.hpp"

#include <algorithm>
#include <cstring>

namespace pelage::passes {
namespace {

template <class T>
T resultAt(const rhi::Buffer& buffer, std::size_t index) {
    T value{};
    if (!buffer) return value;
    const std::span<const std::byte> bytes = buffer.mapped();
    if ((index + 1) * sizeof(T) <= bytes.size()) std::memcpy(&value, bytes.data() + index * sizeof(T), sizeof(T));
    return value;
}

// Compute and copy passes have no statistics query to read.
bool hasStatistics(const PlanPass& pass) {
    return pass.kind == PassKind::Raster || pass.kind == PassKind::Fullscreen;
}

}  // namespace

Result<void> makeQueries(Graph::State& state) {
    if (state.queryCount == 0) return {};
    const auto make = [&](rhi::QueryType type, std::uint32_t count, std::uint64_t bytes, rhi::QuerySet& set,
                          rhi::Buffer& results) -> Result<void> {
        auto queries = state.device.createQuerySet({.label = "passes", .type = type, .count = count});
        if (!queries) return tl::unexpected(std::move(queries.error()));
        auto buffer = state.device.createBuffer({.label = "pass reports",
                                                 .size = count * bytes,
                                                 .usage = rhi::BufferUsage::QueryResolve | rhi::BufferUsage::MapRead});
        if (!buffer) return tl::unexpected(std::move(buffer.error()));
        set = std::move(*queries);
        results = std::move(*buffer);
        return {};
    };
    if (state.device.has(rhi::Feature::Timestamps)) {
        const auto made = make(rhi::QueryType::Timestamp, 2 * state.queryCount, sizeof(std::uint64_t), state.timestamps,
                               state.timestampResults);
        if (!made) return made;
    }
    const bool any = std::any_of(state.plan.passes.begin(), state.plan.passes.end(), hasStatistics);
    if (any && state.device.has(rhi::Feature::PipelineStatistics)) {
        return make(rhi::QueryType::PipelineStatistics, state.queryCount, sizeof(rhi::PipelineStatistics),
                    state.statistics, state.statisticsResults);
    }
    return {};
}

void resolveQueries(const Graph::State& state, rhi::CommandEncoder& encoder) {
    if (state.timestamps) {
        encoder.resolveQuerySet(state.timestamps, 0, 2 * state.queryCount, state.timestampResults, 0);
    }
    if (!state.statistics) return;
    // One call, because each would wait for the one before. Queries of passes without statistics resolve to zero.
    encoder.resolveQuerySet(state.statistics, 0, state.queryCount, state.statisticsResults, 0);
}

std::vector<PassReport> Graph::reports() const {
    std::vector<PassReport> reports;
    if (!state_ || !state_->recorded) return reports;
    const double toMilliseconds = static_cast<double>(state_->device.limits().timestampPeriod) * 1e-6;
    for (std::size_t i = 0; i < state_->passes.size(); ++i) {
        const PassState& own = state_->passes[i];
        PassReport report{
            .name = state_->plan.passes[i].name, .cpuMilliseconds = own.cpuMilliseconds, .draws = own.draws};
        for (std::uint32_t query = own.queries.first; query < own.queries.first + own.queries.count; ++query) {
            const auto begin = resultAt<std::uint64_t>(state_->timestampResults, 2 * query);
            const auto end = resultAt<std::uint64_t>(state_->timestampResults, 2 * query + 1);
            if (end > begin) report.gpuMilliseconds += static_cast<double>(end - begin) * toMilliseconds;
            if (!hasStatistics(state_->plan.passes[i])) continue;
            const auto statistics = resultAt<rhi::PipelineStatistics>(state_->statisticsResults, query);
            report.fragments += statistics.fragmentShaderInvocations;
            report.vertices += statistics.vertexShaderInvocations;
        }
        reports.push_back(std::move(report));
    }
    return reports;
}

double Graph::frameMilliseconds() const {
    if (!state_ || !state_->recorded || !state_->timestamps) return 0;
    std::uint64_t first = ~0ULL, last = 0;
    for (std::uint32_t query = 0; query < state_->queryCount; ++query) {
        first = std::min(first, resultAt<std::uint64_t>(state_->timestampResults, 2 * query));
        last = std::max(last, resultAt<std::uint64_t>(state_->timestampResults, 2 * query + 1));
    }
    return last > first
               ? static_cast<double>(last - first) * static_cast<double>(state_->device.limits().timestampPeriod) * 1e-6
               : 0;
}

}  // namespace pelage::passes
