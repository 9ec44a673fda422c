// SPDX-License-Identifier: MIT
// Many frames: what the library asks of the heap and of the driver stays flat.
#include <malloc.h>

#include "null_device.hpp"
#include "support/counting_new.hpp"

namespace pelage::test {
namespace {

/// Uploads, a render pass that samples, a chain of dispatches, a copy for the host: everything that a frame repeats.
struct Frame {
    NullDevice& n;
    Buffer uniform = n.buffer("uniform", 256, BufferUsage::Uniform | BufferUsage::CopyDst);
    Buffer numbers = n.buffer("numbers", 256, BufferUsage::Storage | BufferUsage::CopySrc);
    Buffer back = n.buffer("back", 256, BufferUsage::MapRead | BufferUsage::CopyDst);
    ComputePipeline add = n.compute("add.comp");
    RenderPipeline sample = n.pipeline("sample.frag");
    Sampler sampler = NullDevice::get(n.device.createSampler({}));
    BindGroup work = n.group(add.bindGroupLayout(0), {{0, BufferBinding{numbers}}});
    RenderPassDescriptor first, second;
    BindGroup look;
    std::vector<std::byte> bytes = std::vector<std::byte>(256);

    explicit Frame(NullDevice& device) : n(device) { resize(64); }
    void resize(std::uint32_t size) {
        const auto image = [&] {
            return NullDevice::get(NullDevice::get(n.device.createTexture({.label = "target",
                                                                           .size = {size, size, 1},
                                                                           .usage = TextureUsage::RenderAttachment |
                                                                                    TextureUsage::TextureBinding}))
                                       .createView());
        };
        first = {.label = "first", .colorAttachments = {{.view = image()}}};
        second = {.label = "second", .colorAttachments = {{.view = image()}}};
        look = n.group(sample.bindGroupLayout(0), {{0, first.colorAttachments[0].view}, {1, sampler}});
    }
    void draw() {
        NullDevice::get(n.device.queue().writeBuffer(uniform, 0, bytes).map([] { return true; }));
        auto encoder = n.device.createCommandEncoder("frame");
        for (const auto* descriptor : {&first, &second}) {
            auto pass = encoder.beginRenderPass(*descriptor);
            pass.setPipeline(sample);
            if (descriptor == &second) {
                pass.setBindGroup(0, look);
                for (int i = 0; i < 20; ++i) pass.draw(3);
            }
            pass.end();
        }
        auto pass = encoder.beginComputePass();
        pass.setPipeline(add);
        pass.setBindGroup(0, work);
        for (int i = 0; i < 6; ++i) pass.dispatchWorkgroups(1);
        pass.end();
        encoder.copyBufferToBuffer(numbers, 0, back, 0, 256);
        const auto commands = encoder.finish();
        const auto sent = n.device.queue().submit(*commands);
        NullDevice::get(n.device.queue().wait(*sent));
    }
};

TEST(Frames, ASteadyFrameAllocatesNothing) {
    NullDevice n;
    n.driver.oracle = nullptr;
    n.driver.keepCommands = false;
    Frame frame(n);
    for (int i = 0; i < 20; ++i) frame.draw();
    const std::uint64_t before = allocations;
    for (int i = 0; i < 100; ++i) frame.draw();
    EXPECT_EQ(allocations - before, 0U) << "in 100 frames";
}

TEST(Frames, TenThousandWithAResizeEveryFiftyStayFlat) {
    NullDevice n;
    n.driver.oracle = nullptr;
    n.driver.keepCommands = false;
    Frame frame(n);
    const auto run = [&](int count) {
        for (int i = 0; i < count; ++i) {
            if (i % 50 == 49) frame.resize(64 + static_cast<std::uint32_t>(i / 50 % 8) * 32);
            frame.draw();
        }
        n.device.collect();
    };
    run(1000);
    const auto heap = [] { return mallinfo2().uordblks; };
    const auto before = n.device.memoryStatistics();
    const auto objects = n.driver.alive().size();
    const auto bytes = heap();
    const auto taken = n.driver.memoryAllocations;
    run(9000);
    const auto after = n.device.memoryStatistics();
    EXPECT_EQ(after.allocations, before.allocations);
    EXPECT_EQ(after.usedBytes, before.usedBytes);
    EXPECT_EQ(after.allocatedBytes, before.allocatedBytes);
    EXPECT_EQ(n.driver.alive().size(), objects);
    EXPECT_EQ(n.driver.memoryAllocations, taken) << "resizing asks the driver for no memory";
    EXPECT_LT(heap(), bytes + 65536);
}

}  // namespace
}  // namespace pelage::test
