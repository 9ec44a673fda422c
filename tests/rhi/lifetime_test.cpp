// SPDX-License-Identifier: MIT
// Objects may go in any order, at any time; nothing leaks and the validation layer stays silent.
#include "common.hpp"

#include <thread>

namespace pelage::test {
namespace {

using Lifetime = RhiTest;

TEST_F(Lifetime, EverythingDroppedRightAfterSubmit) {
    const auto before = device.memoryStatistics();
    for (int i = 0; i < 3; ++i) {
        const auto t = target(64, 64);
        const auto p = pipeline("full.vert", "buffer.frag");
        const auto values = bufferOf("values", std::vector<float>(16, 0.5F), BufferUsage::Storage);
        const auto g = group(p.bindGroupLayout(0), {{0, BufferBinding{values}}});
        auto encoder = device.createCommandEncoder("dropped");
        auto pass = encoder.beginRenderPass(clearPass(view(t)));
        pass.setPipeline(p);
        pass.setBindGroup(0, g);
        pass.draw(3);
        pass.end();
        value(device.queue().submit(value(encoder.finish())));
    }
    succeed(device.waitIdle());
    device.collect();
    const auto after = device.memoryStatistics();
    EXPECT_EQ(after.liveBuffers, before.liveBuffers);
    EXPECT_EQ(after.liveTextures, before.liveTextures);
    EXPECT_EQ(after.livePipelines, before.livePipelines);
}

TEST_F(Lifetime, ABufferMayGoBeforeItsPendingWrite) {
    std::vector<std::uint32_t> words(64, 7);
    { const auto lost = bufferOf("lost", words, BufferUsage::Storage); }
    const auto kept = bufferOf("kept", words, BufferUsage::CopySrc);  // may have the address of the lost one
    EXPECT_EQ(read<std::uint32_t>(kept, 64), words);
}

TEST_F(Lifetime, ADeviceOutlivesItsHandleWhileObjectsRemain) {
    Buffer survivor;
    BindGroup bound;
    std::weak_ptr<detail::DeviceObject> watch;
    {
        auto other = value(gpu.adapter.requestDevice({.label = "short-lived"}));
        watch = other.shared();
        survivor = value(other.createBuffer(
            {.label = "survivor", .size = 256, .usage = BufferUsage::Storage | BufferUsage::CopyDst}));
        const auto layout = value(other.createBindGroupLayout(
            {.label = "l", .entries = {{.binding = 0, .name = "b", .type = BindingType::StorageBuffer}}}));
        bound =
            value(other.createBindGroup({.label = "g", .layout = layout, .entries = {{0, BufferBinding{survivor}}}}));
        const std::vector<std::byte> zero(256);
        succeed(other.queue().writeBuffer(survivor, 0, zero));  // pending for ever
        auto encoder = other.createCommandEncoder("unsubmitted");
        encoder.clearBuffer(survivor);
        value(encoder.finish());
    }
    EXPECT_FALSE(watch.expired());
    EXPECT_EQ(survivor.size(), 256U);
    survivor = {};
    EXPECT_FALSE(watch.expired());
    bound = {};
    EXPECT_TRUE(watch.expired()) << "nothing keeps the device now";
}

TEST_F(Lifetime, ManyObjectsOfEveryKindInRandomOrder) {
    auto other = value(gpu.adapter.requestDevice({.label = "crowd", .optionalFeatures = gpu.adapter.info().features}));
    std::vector<std::shared_ptr<void>> all;
    const auto keep = [&](auto handle) { all.push_back(handle.shared()); };
    for (int i = 0; i < 50; ++i) {
        keep(value(other.createBuffer(
            {.label = "b", .size = 100U + static_cast<unsigned>(i) * 999U, .usage = BufferUsage::Uniform})));
        const auto t =
            value(other.createTexture({.label = "t", .size = {33, 17, 1}, .usage = TextureUsage::TextureBinding}));
        keep(value(t.createView()));
        keep(t);
        keep(value(other.createSampler({.label = "s"})));
        keep(value(other.createQuerySet({.label = "q", .count = 3})));
    }
    other = {};
    std::uint32_t random = 1;
    while (!all.empty()) {
        random = random * 1664525 + 1013904223;
        const std::size_t i = (random >> 8) % all.size();
        all[i] = all.back();
        all.pop_back();
    }
}

TEST_F(Lifetime, MemoryIsSubAllocatedAndGivenBack) {
    auto other = value(gpu.adapter.requestDevice({.label = "memory"}));
    EXPECT_EQ(other.memoryStatistics().blocks, 0U);
    std::vector<Texture> textures;
    for (int i = 0; i < 1000; ++i)
        textures.push_back(
            value(other.createTexture({.label = "small", .size = {16, 16, 1}, .usage = TextureUsage::TextureBinding})));
    auto s = other.memoryStatistics();
    EXPECT_LE(s.blocks, 4U) << "a thousand small textures take few allocations";
    EXPECT_EQ(s.allocations, 1000U);
    EXPECT_EQ(s.liveTextures, 1000U);
    EXPECT_GE(s.usedBytes, 1000U * 16 * 16 * 4);
    textures.clear();
    auto big = value(other.createBuffer({.label = "big", .size = 40U << 20, .usage = BufferUsage::Storage}));
    EXPECT_EQ(other.memoryStatistics().usedBytes, 40U << 20);
    big = {};
    s = other.memoryStatistics();
    EXPECT_EQ(s.usedBytes, 0U);
    EXPECT_LE(s.blocks, 1U) << "one empty block is kept";
}

TEST_F(Lifetime, EncodersRecordOnThreadsWhileOthersCreateAndSubmit) {
    const auto p = compute("add.comp");
    std::vector<std::thread> threads;
    std::array<Buffer, 4> buffers;
    for (std::size_t n = 0; n < 4; ++n)
        threads.emplace_back([&, n] {
            buffers[n] = buffer("threaded", 256, BufferUsage::Storage | BufferUsage::CopyDst | BufferUsage::CopySrc);
            const auto g = group(p.bindGroupLayout(0), {{0, BufferBinding{buffers[n]}}});
            const std::vector<std::byte> zero(256);
            succeed(device.queue().writeBuffer(buffers[n], 0, zero));
            for (int i = 0; i < 10; ++i) {
                auto encoder = device.createCommandEncoder("threaded");
                auto pass = encoder.beginComputePass();
                pass.setPipeline(p);
                pass.setBindGroup(0, g);
                pass.dispatchWorkgroups(1);
                pass.end();
                value(device.queue().submit(value(encoder.finish())));
            }
        });
    for (auto& thread : threads) thread.join();
    for (const auto& b : buffers) EXPECT_EQ(read<std::uint32_t>(b, 64)[5], 1023U);
}

}  // namespace
}  // namespace pelage::test
