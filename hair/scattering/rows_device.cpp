// SPDX-License-Identifier: MIT
#include <pelage/hair/scatter_compute.hpp>

#include "packed.hpp"

#include <pelage/hair/renderer.hpp>

#include <algorithm>
#include <cstring>
#include <map>

namespace pelage::hair {

namespace detail {
std::span<const std::uint32_t> embeddedShader(std::string_view name);
}

namespace {

using Vec4 = std::array<float, 4>;

// Row of rows.comp.
struct GpuRow {
    PackedAngles angles;
    alignas(16) PackedFiber fiber;
    Vec4 weights;
    Vec4 texels[12];
};
struct GpuResult {
    Vec4 lobe[4];
};

GpuRow pack(const ScatterRow& row, MomentTable* table) {
    const ResolvedDirections d = resolveDirections(row.directions);
    GpuRow r{.angles = packed(d), .fiber = packed(resolveFiber(row.fiber, row.directions.h.has_value()))};
    if (table != nullptr) {
        const MomentTable::Sample s = table->sample(d.cosO, d.phi);
        r.weights = {static_cast<float>(s.weightX), static_cast<float>(s.weightY)};
        for (std::size_t i = 0; i < 12; ++i) r.texels[i] = s.texels[i / 4][i % 4];
    }
    return r;
}

// Rows in one dispatch: 6.5 MB.
constexpr std::size_t chunk = 16384;

}  // namespace

Result<std::vector<ScatteredLobes>> ScatterCompute::evaluate(ScatteringModel model, bool published,
                                                             std::span<const ScatterRow> rows) {
    const auto code = detail::embeddedShader("rows.comp");
    auto module = device_.createShaderModule({.label = "scatter_rows", .code = {code.begin(), code.end()}});
    if (!module) return tl::unexpected(module.error());
    auto pipeline = device_.createComputePipeline(
        {.label = "scatter_rows",
         .compute = {.module = *module,
                     .constants = {{.name = "scatteringModel", .value = static_cast<double>(model)},
                                   {.name = "asPublished", .value = published ? 1.0 : 0.0}}}});
    if (!pipeline) return tl::unexpected(pipeline.error());
    const ModelInfo* info = findScatteringModel(model);
    const bool usesTable = info && info->usesTable;
    std::map<std::pair<double, double>, MomentTable> tables;

    std::vector<ScatteredLobes> all;
    all.reserve(rows.size());
    using rhi::BufferUsage;
    for (std::size_t start = 0; start < rows.size(); start += chunk) {
        const std::size_t count = std::min(chunk, rows.size() - start);
        std::vector<GpuRow> sent;
        sent.reserve(count);
        tables.clear();
        for (const ScatterRow& row : rows.subspan(start, count)) {
            MomentTable* table = nullptr;
            if (usesTable) {
                // The texels a row needs are copied into it: a few tables are enough for rows that share one.
                const std::pair key{row.fiber.eta, row.fiber.betaN};
                if (tables.size() > 8) tables.clear();
                table = &tables.try_emplace(key, key.first, key.second).first->second;
            }
            sent.push_back(pack(row, table));
        }
        const std::uint64_t inBytes = count * sizeof(GpuRow), outBytes = count * sizeof(GpuResult);
        auto source = device_.createBuffer(
            {.label = "scatter rows", .size = inBytes, .usage = BufferUsage::Storage | BufferUsage::CopyDst});
        if (!source) return tl::unexpected(source.error());
        auto target = device_.createBuffer(
            {.label = "scatter results", .size = outBytes, .usage = BufferUsage::Storage | BufferUsage::CopySrc});
        if (!target) return tl::unexpected(target.error());
        auto back = device_.createBuffer(
            {.label = "scatter read back", .size = outBytes, .usage = BufferUsage::MapRead | BufferUsage::CopyDst});
        if (!back) return tl::unexpected(back.error());
        if (auto done = device_.queue().writeBuffer(*source, 0, std::as_bytes(std::span(sent))); !done) {
            return tl::unexpected(done.error());
        }
        auto group =
            device_.createBindGroup({.label = "scatter rows",
                                     .layout = pipeline->bindGroupLayout(0),
                                     .entries = {{.binding = 0, .resource = rhi::BufferBinding{.buffer = *source}},
                                                 {.binding = 1, .resource = rhi::BufferBinding{.buffer = *target}}}});
        if (!group) return tl::unexpected(group.error());
        auto encoder = device_.createCommandEncoder("scatter rows");
        auto pass = encoder.beginComputePass({.label = "scatter rows"});
        pass.setPipeline(*pipeline);
        pass.setBindGroup(0, *group);
        pass.dispatchWorkgroups(static_cast<std::uint32_t>((count + 63) / 64));
        pass.end();
        encoder.copyBufferToBuffer(*target, 0, *back, 0, outBytes);
        auto commands = encoder.finish();
        if (!commands) return tl::unexpected(commands.error());
        auto submission = device_.queue().submit(*commands);
        if (!submission) return tl::unexpected(submission.error());
        if (auto done = device_.queue().wait(*submission); !done) return tl::unexpected(done.error());
        std::vector<GpuResult> results(count);
        std::memcpy(results.data(), back->mapped().data(), outBytes);
        for (const GpuResult& result : results) {
            ScatteredLobes lobes;
            for (std::size_t p = 0; p < 4; ++p) {
                for (std::size_t c = 0; c < 3; ++c) lobes.lobe[p][c] = static_cast<double>(result.lobe[p][c]);
            }
            all.push_back(lobes);
        }
    }
    return all;
}

}  // namespace pelage::hair
