// SPDX-License-Identifier: MIT
// Timestamps and statistics. No test asserts a duration: only ratios within one run, and counts.
#include <cstdio>

#include "common.hpp"

namespace pelage::test {
namespace {

using Queries = RhiTest;

TEST_F(Queries, PassTimesSumToTheFrame) {
    if (!device.has(Feature::Timestamps)) GTEST_SKIP() << "no timestamps";
    constexpr std::uint32_t passes = 4;
    const auto set =
        value(device.createQuerySet({.label = "times", .type = QueryType::Timestamp, .count = 2 + 2 * passes}));
    const auto results = buffer("results", 8 * (2 + 2 * passes), BufferUsage::QueryResolve | BufferUsage::CopySrc);
    const auto heavy = compute("heavy.comp");
    const auto draw = pipeline("full.vert", "buffer.frag");
    const auto values = bufferOf("values", std::vector<float>(16, 0.5F), BufferUsage::Storage);
    const auto gd = group(draw.bindGroupLayout(0), {{0, BufferBinding{values}}});
    const auto t = target(1024, 1024);
    const auto frame = [&] {
        auto encoder = device.createCommandEncoder("frame");
        encoder.writeTimestamp(set, 0);
        for (std::uint32_t i = 0; i < passes; ++i) {
            const TimestampWrites writes{set, 2 + 2 * i, 3 + 2 * i};
            if (i % 2 == 0) {
                auto pass = encoder.beginComputePass({.label = "heavy", .timestampWrites = writes});
                // A buffer without earlier uses: no barrier of its own stands between the time stamp and the dispatch.
                const auto numbers = buffer("numbers", 64 * 512 * 4, BufferUsage::Storage);
                pass.setPipeline(heavy);
                pass.setBindGroup(0, group(heavy.bindGroupLayout(0), {{0, BufferBinding{numbers}}}));
                pass.dispatchWorkgroups(512);
                pass.end();
            } else {
                auto descriptor = clearPass(view(t));
                descriptor.timestampWrites = writes;
                auto pass = encoder.beginRenderPass(descriptor);
                pass.setPipeline(draw);
                pass.setBindGroup(0, gd);
                for (int n = 0; n < 20; ++n) pass.draw(3);
                pass.end();
            }
        }
        encoder.writeTimestamp(set, 1);
        encoder.resolveQuerySet(set, 0, 2 + 2 * passes, results, 0);
        run(encoder);
        return read<std::uint64_t>(results, 2 + 2 * passes);
    };
    frame();  // shaders are compiled at their first use
    double best = 0;
    for (int attempt = 0; attempt < 5 && best < 0.98; ++attempt) {  // another process may stand between two stamps
        const auto ticks = frame();
        double sum = 0;
        for (std::uint32_t i = 0; i < passes; ++i) {
            EXPECT_GT(ticks[3 + 2 * i], ticks[2 + 2 * i]) << "pass " << i << " took no time";
            sum += static_cast<double>(ticks[3 + 2 * i] - ticks[2 + 2 * i]);
        }
        best = std::max(best, sum / static_cast<double>(ticks[1] - ticks[0]));
        EXPECT_LE(best, 1.0);
    }
    RecordProperty("sum_over_frame", std::to_string(best));
    std::printf("passes / frame = %.5f\n", best);
    EXPECT_GE(best, 0.98);
}

TEST_F(Queries, UnwrittenQueriesResolveToZero) {
    if (!device.has(Feature::Timestamps)) GTEST_SKIP() << "no timestamps";
    const auto set = value(device.createQuerySet({.label = "sparse", .count = 4}));
    const auto results = buffer("results", 32, BufferUsage::QueryResolve | BufferUsage::CopySrc | BufferUsage::CopyDst);
    const std::vector<std::uint64_t> junk(4, 99);
    succeed(device.queue().writeBuffer(results, 0, std::as_bytes(std::span(junk))));
    auto encoder = device.createCommandEncoder("sparse");
    encoder.writeTimestamp(set, 2);
    encoder.resolveQuerySet(set, 0, 4, results, 0);
    run(encoder);
    const auto out = read<std::uint64_t>(results, 4);
    EXPECT_EQ(out[0], 0U);
    EXPECT_EQ(out[1], 0U);
    EXPECT_GT(out[2], 0U);
    EXPECT_EQ(out[3], 0U);
}

TEST_F(Queries, StatisticsCountFragmentsExactly) {
    if (!device.has(Feature::PipelineStatistics)) GTEST_SKIP() << "no pipeline statistics";
    const auto set =
        value(device.createQuerySet({.label = "counts", .type = QueryType::PipelineStatistics, .count = 2}));
    const auto results =
        buffer("results", 2 * sizeof(PipelineStatistics), BufferUsage::QueryResolve | BufferUsage::CopySrc);
    // The shader reads a buffer: a driver may shade constant colours without invocations.
    const auto p = pipeline("full.vert", "buffer.frag");
    const auto values = bufferOf("values", std::vector<float>(16, 0.5F), BufferUsage::Storage);
    const auto g = group(p.bindGroupLayout(0), {{0, BufferBinding{values}}});
    const auto t = target(64, 64);
    auto encoder = device.createCommandEncoder("statistics");
    for (std::uint32_t i = 0; i < 2; ++i) {
        auto descriptor = clearPass(view(t));
        descriptor.statistics = set;
        descriptor.statisticsIndex = i;
        auto pass = encoder.beginRenderPass(descriptor);
        pass.setPipeline(p);
        pass.setBindGroup(0, g);
        pass.setScissorRect(0, 0, 32, 16);
        pass.draw(3);
        if (i == 1) pass.draw(3);
        pass.end();
    }
    encoder.resolveQuerySet(set, 0, 2, results, 0);
    run(encoder);
    const auto out = read<PipelineStatistics>(results, 2);
    EXPECT_EQ(out[0].fragmentShaderInvocations, 32U * 16);
    EXPECT_EQ(out[1].fragmentShaderInvocations, 2U * 32 * 16);
    EXPECT_EQ(out[0].inputVertices, 3U);
    EXPECT_EQ(out[1].inputVertices, 6U);
    EXPECT_EQ(out[1].vertexShaderInvocations, 6U);
    EXPECT_EQ(out[0].computeShaderInvocations, 0U);
}

TEST_F(Queries, LlvmpipeCountsFullBlocksOneSixteenthTooHigh) {
    // Expects the fault on the driver that has it, so that its end is noticed: each 16x16 block that is covered
    // completely counts 272 fragments.
    if (!device.has(Feature::PipelineStatistics) || device.info().driver.find("Mesa 22.3") == std::string::npos ||
        device.info().name.find("llvmpipe") == std::string::npos)
        GTEST_SKIP() << device.info().driver;
    const auto set =
        value(device.createQuerySet({.label = "counts", .type = QueryType::PipelineStatistics, .count = 1}));
    const auto results =
        buffer("results", sizeof(PipelineStatistics), BufferUsage::QueryResolve | BufferUsage::CopySrc);
    const auto p = pipeline("full.vert", "buffer.frag");
    const auto values = bufferOf("values", std::vector<float>(16, 0.5F), BufferUsage::Storage);
    auto encoder = device.createCommandEncoder("statistics");
    auto descriptor = clearPass(view(target(64, 64)));
    descriptor.statistics = set;
    auto pass = encoder.beginRenderPass(descriptor);
    pass.setPipeline(p);
    pass.setBindGroup(0, group(p.bindGroupLayout(0), {{0, BufferBinding{values}}}));
    pass.draw(3);
    pass.end();
    encoder.resolveQuerySet(set, 0, 1, results, 0);
    run(encoder);
    EXPECT_EQ(read<PipelineStatistics>(results, 1)[0].fragmentShaderInvocations, 16U * 272);
}

}  // namespace
}  // namespace pelage::test
