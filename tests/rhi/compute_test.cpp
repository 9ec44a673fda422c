// SPDX-License-Identifier: MIT
#include "common.hpp"

namespace pelage::test {
namespace {

using Compute = RhiTest;
constexpr auto storage = BufferUsage::Storage | BufferUsage::CopySrc | BufferUsage::CopyDst;

TEST_F(Compute, ChainOfSixDispatchesHasFiveBarriers) {
    const auto b = buffer("numbers", 64 * 4, storage);
    const auto p = compute("add.comp");
    const auto g = group(p.bindGroupLayout(0), {{0, BufferBinding{b}}});
    auto clear = device.createCommandEncoder("clear");
    clear.clearBuffer(b);
    run(clear);
    const auto fresh = buffer("fresh", 64 * 4, storage);
    const auto h = group(p.bindGroupLayout(0), {{0, BufferBinding{fresh}}});
    const auto chain = [&](const BindGroup& with) {
        auto encoder = device.createCommandEncoder("chain");
        auto pass = encoder.beginComputePass({.label = "chain"});
        pass.setPipeline(p);
        pass.setBindGroup(0, with);
        for (int i = 0; i < 6; ++i) pass.dispatchWorkgroups(1);
        pass.end();
        return run(encoder).counters();
    };
    EXPECT_EQ(chain(h).barriers, 5U) << "a buffer nobody used before";
    const auto second = chain(g);
    EXPECT_EQ(second.barriers, 6U) << "one more for the fill of the submission before";
    EXPECT_EQ(second.dispatches, 6U);
    EXPECT_EQ(read<std::uint32_t>(b, 64), std::vector<std::uint32_t>(64, 63));
}

TEST_F(Compute, TwoReadsHaveNoBarrierBetweenThem) {
    const auto from = bufferOf("from", std::vector<std::uint32_t>(64, 5), BufferUsage::Storage);
    const auto a = buffer("a", 256, storage), b = buffer("b", 256, storage);
    const auto p = compute("copy.comp");
    const auto ga = group(p.bindGroupLayout(0), {{0, BufferBinding{from}}, {1, BufferBinding{a}}});
    const auto gb = group(p.bindGroupLayout(0), {{0, BufferBinding{from}}, {1, BufferBinding{b}}});
    auto encoder = device.createCommandEncoder("two reads");
    auto pass = encoder.beginComputePass();
    pass.setPipeline(p);
    pass.setBindGroup(0, ga);
    pass.dispatchWorkgroups(1);
    pass.setBindGroup(0, gb);
    pass.dispatchWorkgroups(1);
    pass.end();
    EXPECT_EQ(run(encoder).counters().barriers, 1U) << "only the one after the upload";
    EXPECT_EQ(read<std::uint32_t>(a, 64)[63], 6U);
    EXPECT_EQ(read<std::uint32_t>(b, 64)[63], 6U);
}

TEST_F(Compute, WritesAreReadByAFragmentShaderBehindOneBarrier) {
    const auto b = buffer("values", 64, storage);
    const auto add = compute("add.comp", {{"STEP", 0x3f800000}});  // 1.0f in every word
    const auto draw = pipeline("full.vert", "buffer.frag");
    const auto t = target(4, 1);
    const auto gc = group(add.bindGroupLayout(0), {{0, BufferBinding{b}}});
    const auto gd = group(draw.bindGroupLayout(0), {{0, BufferBinding{b}}});
    auto zero = device.createCommandEncoder("zero");
    zero.clearBuffer(b);
    run(zero);
    auto encoder = device.createCommandEncoder("compute then draw");
    auto c = encoder.beginComputePass({.label = "fill"});
    c.setPipeline(add);
    c.setBindGroup(0, gc);
    c.dispatchWorkgroups(1);
    c.end();
    auto pass = encoder.beginRenderPass(clearPass(view(t)));
    pass.setPipeline(draw);
    pass.setBindGroup(0, gd);
    pass.draw(3);
    pass.end();
    EXPECT_EQ(run(encoder).counters().barriers, 2U)
        << "fill -> dispatch, and one for buffer and target before the pass";
    for (const auto& texel : read<Texel>(t)) EXPECT_EQ(texel, (Texel{255, 255, 255, 255}));
}

TEST_F(Compute, DynamicOffsetsChooseTheRange) {
    const std::uint32_t step = std::max(device.limits().minUniformBufferOffsetAlignment, 16U);
    std::vector<std::uint32_t> values(2 * step / 4);
    values[0] = 3;
    values[1] = 4;
    values[step / 4] = 30;
    values[step / 4 + 1] = 40;
    const auto params = bufferOf("params", values, BufferUsage::Uniform);
    const auto out = buffer("out", 16, storage);
    const auto layout = value(device.createBindGroupLayout(
        {.label = "dynamic",
         .entries = {{.binding = 0, .name = "params", .type = BindingType::UniformBuffer, .hasDynamicOffset = true},
                     {.binding = 1, .name = "to", .type = BindingType::StorageBuffer}}}));
    const auto pl = value(device.createPipelineLayout({.label = "dynamic", .bindGroupLayouts = {layout}}));
    const auto p = value(device.createComputePipeline(
        {.label = "uniform", .layout = pl, .compute = {.module = shader("uniform.comp")}}));
    const auto g = group(layout, {{0, BufferBinding{params, 0, 16}}, {1, BufferBinding{out}}});
    for (const std::uint32_t offset : {0U, step}) {
        auto encoder = device.createCommandEncoder("dynamic");
        auto pass = encoder.beginComputePass();
        pass.setPipeline(p);
        pass.setBindGroup(0, g, std::span(&offset, 1));
        pass.dispatchWorkgroups(1);
        pass.end();
        run(encoder);
        EXPECT_EQ(read<std::uint32_t>(out, 1)[0], offset == 0 ? 7U : 70U);
    }
}

TEST_F(Compute, StorageTextureIsPaintedAndSampled) {
    const auto t = value(device.createTexture(
        {.label = "painted",
         .size = {8, 8, 1},
         .usage = TextureUsage::StorageBinding | TextureUsage::TextureBinding | TextureUsage::CopySrc}));
    const auto p = compute("paint.comp");
    const auto g = group(p.bindGroupLayout(0), {{0, view(t)}});
    auto encoder = device.createCommandEncoder("paint");
    auto pass = encoder.beginComputePass();
    pass.setPipeline(p);
    pass.setBindGroup(0, g);
    pass.dispatchWorkgroups(1);
    pass.end();
    EXPECT_EQ(run(encoder).counters().barriers, 1U) << "out of the undefined layout";
    const auto q = pipeline("full.vert", "sample.frag");
    const auto s = value(device.createSampler({.label = "nearest"}));
    EXPECT_EQ(drawTo(target(8, 8), q, group(q.bindGroupLayout(0), {{0, view(t)}, {1, s}}))[9],
              (Texel{51, 102, 153, 255}));
    EXPECT_EQ(read<Texel>(t)[63], (Texel{51, 102, 153, 255}));
}

TEST_F(Compute, WritesToDifferentBytesShareOneScope) {
    const auto b = buffer("b", 1024, storage);
    std::vector<std::uint32_t> word(1);
    for (std::uint32_t i = 0; i < 256; ++i) {
        word[0] = i;
        succeed(device.queue().writeBuffer(b, i * 4, std::as_bytes(std::span(word))));
    }
    word[0] = 1000;
    succeed(device.queue().writeBuffer(b, 40, std::as_bytes(std::span(word))));  // again: the later one wins
    const auto out = read<std::uint32_t>(b, 256);
    for (std::uint32_t i = 0; i < 256; ++i) EXPECT_EQ(out[i], i == 10 ? 1000U : i);
}

}  // namespace
}  // namespace pelage::test
