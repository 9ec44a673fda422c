// SPDX-License-Identifier: MIT
// What every test on a device shares: one instance with validation and one device per process, and a guard that fails
// the test in which the validation layer says anything.
#pragma once

#include <gtest/gtest.h>
#include <pelage/rhi/rhi.hpp>

#include <cstdlib>
#include <cstring>
#include <mutex>

namespace pelage::test {

/// Collects what the validation layer says. Our own errors ("R012", "adapter") are not its business.
class Messages {
public:
    void add(const rhi::Message& message) {
        const bool ours = message.id == "adapter" || (message.id.size() == 4 && message.id[0] == 'R');
        const std::lock_guard lock(mutex_);
        (ours ? own_ : layer_).push_back(message);
    }
    std::vector<rhi::Message> takeLayer() { return take(layer_); }
    std::vector<rhi::Message> takeOwn() { return take(own_); }

private:
    std::vector<rhi::Message> take(std::vector<rhi::Message>& from) {
        const std::lock_guard lock(mutex_);
        return std::exchange(from, {});
    }
    std::mutex mutex_;
    std::vector<rhi::Message> layer_, own_;
};

struct Gpu {
    Messages messages;
    rhi::Instance instance;
    rhi::Adapter adapter;
    rhi::Device device;
    std::string failure;  // why there is no device

    /// Lives until the process ends. PELAGE_TEST_ADAPTER chooses another adapter by name, PELAGE_TEST_VALIDATION=0
    /// leaves the layer out.
    static Gpu& get() {
        static Gpu gpu;
        return gpu;
    }

private:
    Gpu() {
        const char* validation = std::getenv("PELAGE_TEST_VALIDATION");
        auto made = rhi::Instance::create({.label = "pelage tests",
                                           .validation = validation == nullptr || std::strcmp(validation, "0") != 0,
                                           .onMessage = [this](const rhi::Message& m) { messages.add(m); }});
        if (!made) {
            failure = made.error().text();
            return;
        }
        instance = *made;
        const char* name = std::getenv("PELAGE_TEST_ADAPTER");
        auto chosen = instance.requestAdapter({.nameContains = name != nullptr ? name : ""});
        if (!chosen) {
            failure = chosen.error().text();
            return;
        }
        adapter = *chosen;
        auto opened = adapter.requestDevice({.label = "tests", .optionalFeatures = adapter.info().features});
        if (!opened)
            failure = opened.error().text();
        else
            device = *opened;
    }
};

/// Put one on the stack: whatever the validation layer says until it goes is a failure of the test.
class ValidationGuard {
public:
    ValidationGuard() { Gpu::get().messages.takeLayer(); }
    ValidationGuard(const ValidationGuard&) = delete;
    ValidationGuard& operator=(const ValidationGuard&) = delete;
    ~ValidationGuard() {
        if (Gpu::get().device) {
            EXPECT_TRUE(Gpu::get().device.waitIdle().has_value());
            Gpu::get().device.collect();
        }
        for (const auto& m : Gpu::get().messages.takeLayer())
            ADD_FAILURE() << "validation layer: " << m.id << '\n' << m.text;
    }
};

/// The value, or a failure of the test with the error's text.
template <class T>
T value(Result<T> result) {
    if (result) return std::move(*result);
    ADD_FAILURE() << result.error().text();
    return {};
}
inline void succeed(const Result<void>& result) {
    if (!result) ADD_FAILURE() << result.error().text();
}

class GpuTest : public ::testing::Test {
protected:
    void SetUp() override {
        // No device is a failure, not a pass: a CPU device is one package away (mesa-vulkan-drivers).
        if (!gpu.device) FAIL() << "no Vulkan device: " << gpu.failure;
    }

    rhi::Buffer buffer(std::string label, std::uint64_t size, rhi::BufferUsage usage) {
        return value(gpu.device.createBuffer({.label = std::move(label), .size = size, .usage = usage}));
    }
    template <class T>
    rhi::Buffer bufferOf(std::string label, const std::vector<T>& data, rhi::BufferUsage usage) {
        auto b = buffer(std::move(label), data.size() * sizeof(T), usage | rhi::BufferUsage::CopyDst);
        succeed(gpu.device.queue().writeBuffer(b, 0, std::as_bytes(std::span(data))));
        return b;
    }
    rhi::TextureView view(const rhi::Texture& texture, const rhi::TextureViewDescriptor& descriptor = {}) {
        return value(texture.createView(descriptor));
    }
    /// Submits and waits.
    rhi::CommandBuffer run(rhi::CommandEncoder& encoder) {
        auto commands = encoder.finish();
        if (!commands) {
            ADD_FAILURE() << commands.error().text();
            return {};
        }
        auto sent = gpu.device.queue().submit(*commands);
        if (!sent)
            ADD_FAILURE() << sent.error().text();
        else
            EXPECT_TRUE(value(gpu.device.queue().wait(*sent)));
        return *commands;
    }
    template <class T>
    std::vector<T> read(const rhi::Buffer& source, std::size_t count, std::uint64_t offset = 0) {
        auto target = buffer("readback", count * sizeof(T), rhi::BufferUsage::MapRead | rhi::BufferUsage::CopyDst);
        auto encoder = gpu.device.createCommandEncoder("read");
        encoder.copyBufferToBuffer(source, offset, target, 0, count * sizeof(T));
        run(encoder);
        std::vector<T> out(count);
        std::memcpy(out.data(), target.mapped().data(), count * sizeof(T));
        return out;
    }
    /// One layer of one mip level, tightly packed.
    template <class T>
    std::vector<T> read(const rhi::Texture& source, std::uint32_t layer = 0, std::uint32_t mip = 0) {
        const auto size = source.size();
        const rhi::Extent3D extent{std::max(size.width >> mip, 1U), std::max(size.height >> mip, 1U), 1};
        const std::uint64_t bytes = std::uint64_t{extent.width} * extent.height * rhi::bytesPerTexel(source.format());
        auto target = buffer("readback", bytes, rhi::BufferUsage::MapRead | rhi::BufferUsage::CopyDst);
        auto encoder = gpu.device.createCommandEncoder("read");
        encoder.copyTextureToBuffer({.texture = source, .mipLevel = mip, .origin = {0, 0, layer}}, {.buffer = target},
                                    extent);
        run(encoder);
        std::vector<T> out(bytes / sizeof(T));
        std::memcpy(out.data(), target.mapped().data(), bytes);
        return out;
    }

    Gpu& gpu = Gpu::get();
    ValidationGuard guard;
};

}  // namespace pelage::test
