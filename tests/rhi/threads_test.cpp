// SPDX-License-Identifier: MIT
// Several threads with one device: objects made, recorded, submitted and dropped at once. For ThreadSanitizer, which
// sees what these assertions cannot.
#include <atomic>
#include <thread>

#include "null_device.hpp"

namespace pelage::test {
namespace {

TEST(Threads, RecordSubmitAndDropSideBySide) {
    NullDevice n;
    n.driver.oracle = nullptr;
    n.driver.keepCommands = false;
    const auto shared = n.buffer("shared", 1024, BufferUsage::CopyDst | BufferUsage::Storage);
    const auto add = n.compute("add.comp");
    const auto group = n.group(add.bindGroupLayout(0), {{0, BufferBinding{shared}}});
    const auto target = NullDevice::get(n.device.createTexture(
        {.label = "target", .size = {64, 64, 1}, .usage = TextureUsage::RenderAttachment | TextureUsage::CopyDst}));
    std::atomic<std::uint32_t> submitted{0}, failed{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&, t] {
            const std::vector<std::byte> bytes(64);
            for (int i = 0; i < 100; ++i) {
                const auto own = n.device.createBuffer({.label = "own", .size = 256, .usage = BufferUsage::CopyDst});
                const auto view = target.createView();
                // The same pipeline from every thread: one is made.
                const auto pipeline = n.device.createComputePipeline({.compute = {.module = n.shader("add.comp")}});
                if (!own || !view || !pipeline) ++failed;
                auto encoder = n.device.createCommandEncoder("thread");
                encoder.clearBuffer(*own);
                auto pass = encoder.beginComputePass();
                pass.setPipeline(*pipeline);
                pass.setBindGroup(0, group);
                pass.dispatchWorkgroups(1);
                pass.end();
                auto render = encoder.beginRenderPass({.label = "r", .colorAttachments = {{.view = *view}}});
                render.end();
                if (!n.device.queue().writeBuffer(shared, static_cast<std::uint64_t>(t) * 64, bytes)) ++failed;
                const auto commands = encoder.finish();
                if (!commands) ++failed;
                const auto sent = n.device.queue().submit(*commands);
                if (!sent || !n.device.queue().wait(*sent)) ++failed;
                ++submitted;
                n.device.collect();
            }
        });
    for (auto& thread : threads) thread.join();
    EXPECT_EQ(submitted, 400U);
    EXPECT_EQ(failed, 0U);
    EXPECT_TRUE(n.errors.empty()) << toString(n.errors.front());
}

TEST(Threads, TwoDevicesDoNotKnowOfEachOther) {
    std::vector<std::thread> threads;
    NullDevice first, second;
    for (auto* n : {&first, &second})
        threads.emplace_back([n] {
            for (int i = 0; i < 100; ++i) {
                const auto b = n->buffer("b", 64, BufferUsage::CopyDst);
                auto encoder = n->device.createCommandEncoder();
                encoder.clearBuffer(b);
                n->submit(encoder);
            }
        });
    for (auto& thread : threads) thread.join();
    const auto foreign = first.buffer("first's", 64, BufferUsage::CopyDst);
    auto encoder = second.device.createCommandEncoder();
    encoder.clearBuffer(foreign);
    const auto refused = encoder.finish();
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().first().code, ErrorCode::OtherDevice);
}

}  // namespace
}  // namespace pelage::test
