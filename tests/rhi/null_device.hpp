// SPDX-License-Identifier: MIT
// A device of the null driver, watched by the oracle.
#pragma once

#include <gtest/gtest.h>
#include <pelage/rhi/vulkan.hpp>

#include "support/null_driver.hpp"

namespace pelage::test {

std::span<const std::uint32_t> embeddedShader(std::string_view name);

using namespace rhi;

/// Everything a test needs on the null driver; several may live at once.
struct NullDevice {
    NullDriver driver;
    HazardOracle oracle;
    std::vector<Diagnostic> errors;  // that no scope caught
    Instance instance;
    Device device;

    NullDevice() {
        driver.oracle = &oracle;
        instance = get(vulkan::createInstance({}, NullDriver::entry()));
        auto adapter = get(instance.requestAdapter());
        device =
            get(adapter.requestDevice({.label = "null",
                                       .optionalFeatures = adapter.info().features,
                                       .onUncapturedError = [this](const Diagnostic& e) { errors.push_back(e); }}));
    }
    template <class T>
    static T get(Result<T> result) {
        if (result) return std::move(*result);
        ADD_FAILURE() << result.error().text();
        return {};
    }
    ShaderModule shader(std::string_view name) const {
        const auto code = embeddedShader(name);
        return get(device.createShaderModule({.label = std::string(name), .code = {code.begin(), code.end()}}));
    }
    ComputePipeline compute(std::string_view name) const {
        return get(device.createComputePipeline({.label = std::string(name), .compute = {.module = shader(name)}}));
    }
    RenderPipeline pipeline(std::string_view fragment) const {
        return get(device.createRenderPipeline({.label = std::string(fragment),
                                                .vertex = {.module = shader("full.vert")},
                                                .fragment = ProgrammableStage{.module = shader(fragment)},
                                                .targets = {{.format = TextureFormat::RGBA8Unorm}}}));
    }
    BindGroup group(const BindGroupLayout& layout, std::vector<BindGroupEntry> entries) const {
        return get(device.createBindGroup({.label = "group", .layout = layout, .entries = std::move(entries)}));
    }
    Buffer buffer(std::string label, std::uint64_t size, BufferUsage usage) const {
        return get(device.createBuffer({.label = std::move(label), .size = size, .usage = usage}));
    }
    CommandBuffer submit(CommandEncoder& encoder) const {
        auto commands = get(encoder.finish());
        if (commands) get(device.queue().submit(commands));
        return commands;
    }
    std::string hazards() const {
        std::string all;
        for (const auto& h : oracle.hazards()) all += h + "\n";
        return all;
    }
};

}  // namespace pelage::test
