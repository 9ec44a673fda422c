// SPDX-License-Identifier: MIT
// Commands whose arguments the device itself wrote.
#include "common.hpp"

namespace pelage::test {
namespace {

using Indirect = RhiTest;
constexpr auto arguments = BufferUsage::Indirect | BufferUsage::Storage | BufferUsage::CopySrc;

TEST_F(Indirect, DispatchTakesItsCountsFromABufferThatTheDispatchBeforeWrote) {
    // copy.comp adds one to each word: {1, 0, 0} becomes the counts 2, 1, 1.
    const auto from = bufferOf("zeros", std::vector<std::uint32_t>{1, 0, 0, 0}, BufferUsage::Storage);
    const auto counts = bufferOf("counts", std::vector<std::uint32_t>{0, 0, 0, 0}, arguments);
    const auto numbers =
        bufferOf("numbers", std::vector<std::uint32_t>(256, 0), BufferUsage::Storage | BufferUsage::CopySrc);
    const auto copy = compute("copy.comp"), add = compute("add.comp");
    const auto write = group(copy.bindGroupLayout(0), {{0, BufferBinding{from}}, {1, BufferBinding{counts}}});
    const auto work = group(add.bindGroupLayout(0), {{0, BufferBinding{numbers}}});
    auto encoder = device.createCommandEncoder("indirect");
    auto pass = encoder.beginComputePass();
    pass.setPipeline(copy);
    pass.setBindGroup(0, write);
    pass.dispatchWorkgroups(1);
    pass.setPipeline(add);
    pass.setBindGroup(0, work);
    pass.dispatchWorkgroupsIndirect(counts);
    pass.end();
    const auto counters = run(encoder).counters();
    EXPECT_EQ(counters.dispatches, 2U);
    EXPECT_EQ(counters.barriers, 2U) << "after the uploads, and before the arguments are read";
    const auto out = read<std::uint32_t>(numbers, 256);
    EXPECT_EQ(out[127], 1U);
    EXPECT_EQ(out[128], 0U) << "two groups of 64, not more";
}

TEST_F(Indirect, DrawsTakeTheirCountsFromABuffer) {
    const auto t = target(8, 8);
    const auto p = pipeline("full.vert", "white.frag");
    const auto nothing = bufferOf("nothing", std::vector<std::uint32_t>{0, 1, 0, 0}, BufferUsage::Indirect);
    const auto three = bufferOf("three", std::vector<std::uint32_t>{9, 3, 1, 0, 0}, BufferUsage::Indirect);
    const auto indexed = bufferOf("indexed", std::vector<std::uint32_t>{3, 1, 0, 0, 0}, BufferUsage::Indirect);
    const auto indices = bufferOf("indices", std::vector<std::uint32_t>{0, 1, 2}, BufferUsage::Index);
    const auto draw = [&](auto record) {
        auto encoder = device.createCommandEncoder("draw");
        auto pass = encoder.beginRenderPass(clearPass(view(t)));
        pass.setPipeline(p);
        record(pass);
        pass.end();
        EXPECT_EQ(run(encoder).counters().draws, 1U);
        return read<Texel>(t)[27][0];
    };
    EXPECT_EQ(draw([&](RenderPassEncoder& pass) { pass.drawIndirect(nothing); }), 0);
    EXPECT_EQ(draw([&](RenderPassEncoder& pass) { pass.drawIndirect(three, 4); }), 255);
    EXPECT_EQ(draw([&](RenderPassEncoder& pass) {
                  pass.setIndexBuffer(indices, IndexFormat::Uint32);
                  pass.drawIndexedIndirect(indexed);
              }),
              255);
}

TEST_F(Indirect, ArgumentsNeedTheirUsageAndTheirPlace) {
    const auto plain = buffer("plain", 64, BufferUsage::Storage);
    const auto small = buffer("small", 16, BufferUsage::Indirect);
    const auto add = compute("add.comp");
    const auto g = group(add.bindGroupLayout(0), {{0, BufferBinding{plain}}});
    const auto codeOf = [&](const Buffer& b, std::uint64_t offset) {
        auto encoder = device.createCommandEncoder("wrong");
        auto pass = encoder.beginComputePass();
        pass.setPipeline(add);
        pass.setBindGroup(0, g);
        pass.dispatchWorkgroupsIndirect(b, offset);
        pass.end();
        device.pushErrorScope();
        EXPECT_FALSE(encoder.finish());
        return device.popErrorScope().value_or(Diagnostic{}).code;
    };
    EXPECT_EQ(codeOf(plain, 0), ErrorCode::InvalidUsage);
    EXPECT_EQ(codeOf(small, 8), ErrorCode::OutOfRange);
    EXPECT_EQ(codeOf(small, 2), ErrorCode::OutOfRange);
}

TEST_F(Indirect, ArgumentsCannotBeWrittenByTheCommandThatReadsThem) {
    const auto both = buffer("both", 64, arguments);
    const auto add = compute("add.comp");
    const auto g = group(add.bindGroupLayout(0), {{0, BufferBinding{both}}});
    auto encoder = device.createCommandEncoder("conflict");
    auto pass = encoder.beginComputePass();
    pass.setPipeline(add);
    pass.setBindGroup(0, g);
    pass.dispatchWorkgroupsIndirect(both);
    pass.end();
    device.pushErrorScope();
    EXPECT_FALSE(encoder.finish());
    EXPECT_EQ(device.popErrorScope().value_or(Diagnostic{}).code, ErrorCode::UsageConflict);
}

}  // namespace
}  // namespace pelage::test
