// SPDX-License-Identifier: MIT
// Every call of the driver that can fail does so in turn: one clear error each time, nothing leaked, nothing destroyed
// twice, and the program goes on to its end.
#include <algorithm>

#include "null_device.hpp"

namespace pelage::test {
namespace {

/// A little of everything, written as an application that stops at its first error would be. Gives that error.
std::optional<Diagnostic> program(NullDriver& driver, const std::function<void()>& ready) {
    std::optional<Diagnostic> error;
    // Keeps the first error; the value is empty afterwards.
    const auto take = [&](auto result) {
        using T = typename decltype(result)::value_type;
        if (!result && !error) error = result.error().first();
        if constexpr (!std::is_void_v<T>) return result ? std::move(*result) : T();
    };
    const auto code = [](std::string_view name) {
        const auto words = embeddedShader(name);
        return ShaderModuleDescriptor{.label = std::string(name), .code = {words.begin(), words.end()}};
    };
    ready();
    const auto instance = take(vulkan::createInstance({}, NullDriver::entry()));
    if (!instance) return error;
    const auto adapter = take(instance.requestAdapter());
    if (!adapter) return error;
    const auto device = take(adapter.requestDevice({.optionalFeatures = adapter.info().features}));
    if (!device) return error;
    device.pushErrorScope();
    for (int frame = 0; frame < 2 && !error; ++frame) {
        const auto b = take(device.createBuffer(
            {.label = "b", .size = 256, .usage = BufferUsage::Storage | BufferUsage::CopyDst | BufferUsage::CopySrc}));
        const auto back = take(
            device.createBuffer({.label = "back", .size = 256, .usage = BufferUsage::CopyDst | BufferUsage::MapRead}));
        const auto heap = take(device.createTransientHeap({.label = "heap", .size = 1 << 20}));
        const auto t =
            take(device.createTexture({.label = "t",
                                       .size = {16, 16, 1},
                                       .usage = TextureUsage::RenderAttachment | TextureUsage::TextureBinding,
                                       .heap = heap}));
        const auto own = take(device.createTexture(
            {.label = "own",
             .size = {16, 16, 1},
             .usage = TextureUsage::RenderAttachment | TextureUsage::CopySrc | TextureUsage::CopyDst}));
        const auto sampler = take(device.createSampler({}));
        const auto queries = take(device.createQuerySet({.label = "q", .count = 2}));
        const auto compute = take(
            device.createComputePipeline({.compute = {.module = take(device.createShaderModule(code("add.comp")))}}));
        const auto draw = take(device.createRenderPipeline(
            {.vertex = {.module = take(device.createShaderModule(code("full.vert")))},
             .fragment = ProgrammableStage{.module = take(device.createShaderModule(code("sample.frag")))},
             .targets = {{.format = TextureFormat::RGBA8Unorm}}}));
        if (error) break;
        const auto from = take(t.createView()), to = take(own.createView());
        const auto g =
            take(device.createBindGroup({.layout = compute.bindGroupLayout(0), .entries = {{0, BufferBinding{b}}}}));
        const auto h =
            take(device.createBindGroup({.layout = draw.bindGroupLayout(0), .entries = {{0, from}, {1, sampler}}}));
        if (error) break;
        const std::vector<std::byte> bytes(256), texels(1024);
        take(device.queue().writeBuffer(b, 0, bytes));
        take(device.queue().writeTexture({.texture = own}, texels, {}, {16, 16, 1}));
        auto encoder = device.createCommandEncoder("frame");
        auto clear = encoder.beginRenderPass({.label = "clear", .colorAttachments = {{.view = from}}});
        clear.end();
        auto pass = encoder.beginRenderPass(
            {.label = "draw", .colorAttachments = {{.view = to}}, .timestampWrites = TimestampWrites{queries, 0U, 1U}});
        pass.setPipeline(draw);
        pass.setBindGroup(0, h);
        pass.draw(3);
        pass.end();
        auto work = encoder.beginComputePass();
        work.setPipeline(compute);
        work.setBindGroup(0, g);
        work.dispatchWorkgroups(1);
        work.end();
        encoder.copyBufferToBuffer(b, 0, back, 0, 256);
        const auto commands = take(encoder.finish());
        if (error) break;
        const auto sent = take(device.queue().submit(commands));
        if (error) break;
        take(device.queue().wait(sent));
        device.collect();
    }
    take(device.waitIdle());
    // A scope saw what a caller could have ignored.
    if (const auto scoped = device.popErrorScope(); scoped && !error) error = scoped;
    (void)driver;
    return error;
}

TEST(Faults, EveryDriverCallMayFailAndNothingLeaks) {
    std::vector<std::string> calls;
    {
        NullDriver driver;
        const auto error = program(driver, [] {});
        ASSERT_FALSE(error) << toString(*error);
        EXPECT_TRUE(driver.alive().empty()) << driver.alive().front();
        EXPECT_TRUE(driver.misuse().empty()) << driver.misuse().front();
        calls = driver.calls();
    }
    EXPECT_GT(calls.size(), 60U);
    for (const VkResult result : {VK_ERROR_OUT_OF_DEVICE_MEMORY, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_DEVICE_LOST})
        for (std::uint64_t n = 1; n <= calls.size(); ++n) {
            NullDriver driver;
            const auto error = program(driver, [&] { driver.failCall(n, result); });
            const auto where = calls[n - 1] + " (call " + std::to_string(n) + ")";
            ASSERT_TRUE(driver.failed()) << where;
            EXPECT_TRUE(driver.alive().empty()) << where << " leaks " << driver.alive().front();
            EXPECT_TRUE(driver.misuse().empty()) << where << ": " << driver.misuse().front();
            // Not to know how far the queue is is not an error: a caller that waits asks again.
            if (!error && result != VK_ERROR_DEVICE_LOST && calls[n - 1] == "vkGetSemaphoreCounterValue") continue;
            ASSERT_TRUE(error) << where << " failed and nobody was told";
            const auto kind = result == VK_ERROR_DEVICE_LOST ? ErrorKind::DeviceLost : ErrorKind::OutOfMemory;
            EXPECT_EQ(error->kind, kind) << where << ": " << toString(*error);
            if (kind == ErrorKind::OutOfMemory) {
                EXPECT_NE(error->text.find(*driver.failed()), std::string::npos)
                    << where << " is not named in: " << toString(*error);
            }
        }
}

TEST(Faults, AfterDeviceLossEveryCallSaysSoOnceToldAndNoneReachesTheDriver) {
    NullDriver driver;
    const auto instance = NullDevice::get(vulkan::createInstance({}, NullDriver::entry()));
    int told = 0;
    {
        const auto device = NullDevice::get(NullDevice::get(instance.requestAdapter())
                                                .requestDevice({.onUncapturedError = [](const Diagnostic&) {},
                                                                .onDeviceLost =
                                                                    [&](const Diagnostic& e) {
                                                                        ++told;
                                                                        EXPECT_EQ(e.kind, ErrorKind::DeviceLost);
                                                                    }}));
        const auto b = NullDevice::get(device.createBuffer({.label = "b", .size = 64, .usage = BufferUsage::CopyDst}));
        const auto commands = [&] {
            auto encoder = device.createCommandEncoder();
            encoder.clearBuffer(b);
            return NullDevice::get(encoder.finish());
        };
        const auto first = commands(), second = commands();
        driver.failCall(static_cast<std::uint64_t>(1), VK_ERROR_DEVICE_LOST);
        while (!driver.failed()) (void)device.queue().submit(first);
        const auto before = driver.submissions;
        for (int i = 0; i < 3; ++i) {
            const auto again = device.queue().submit(second);
            ASSERT_FALSE(again);
            EXPECT_EQ(again.error().first().kind, ErrorKind::DeviceLost);
        }
        const std::vector<std::byte> bytes(4);
        EXPECT_EQ(device.queue().writeBuffer(b, 0, bytes).error().first().code, ErrorCode::DeviceLost);
        EXPECT_EQ(driver.submissions, before);
        EXPECT_EQ(told, 1);
    }
    EXPECT_TRUE(driver.alive().empty()) << driver.alive().front();
}

}  // namespace
}  // namespace pelage::test
