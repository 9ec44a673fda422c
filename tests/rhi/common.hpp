// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "support/gpu.hpp"

namespace pelage::test {

std::span<const std::uint32_t> embeddedShader(std::string_view name);

using namespace rhi;  // the tests are about nothing else

class RhiTest : public GpuTest {
protected:
    Device& device = gpu.device;

    ShaderModule shader(std::string_view name) {
        const auto code = embeddedShader(name);
        EXPECT_FALSE(code.empty()) << "no shader " << name;
        return value(device.createShaderModule({.label = std::string(name), .code = {code.begin(), code.end()}}));
    }
    Texture target(std::uint32_t width, std::uint32_t height, TextureFormat format = TextureFormat::RGBA8Unorm,
                   std::uint32_t samples = 1, TextureUsage more = TextureUsage::CopySrc) {
        return value(device.createTexture({.label = "target",
                                           .size = {width, height, 1},
                                           .sampleCount = samples,
                                           .format = format,
                                           .usage = TextureUsage::RenderAttachment | more}));
    }
    RenderPipelineDescriptor pipelineDescriptor(std::string_view vertex, std::string_view fragment) {
        return {.label = std::string(fragment),
                .vertex = {.module = shader(vertex)},
                .fragment = ProgrammableStage{.module = shader(fragment)},
                .targets = {{.format = TextureFormat::RGBA8Unorm}}};
    }
    RenderPipeline pipeline(std::string_view vertex, std::string_view fragment) {
        return value(device.createRenderPipeline(pipelineDescriptor(vertex, fragment)));
    }
    ComputePipeline compute(std::string_view name, std::vector<ConstantEntry> constants = {}) {
        return value(device.createComputePipeline(
            {.label = std::string(name), .compute = {.module = shader(name), .constants = std::move(constants)}}));
    }
    BindGroup group(const BindGroupLayout& layout, std::vector<BindGroupEntry> entries) {
        return value(device.createBindGroup({.label = "group", .layout = layout, .entries = std::move(entries)}));
    }
    static RenderPassDescriptor clearPass(const TextureView& view, Color color = {}) {
        return {.label = "draw", .colorAttachments = {{.view = view, .clearValue = color}}};
    }
    /// Draws three vertices over a cleared target and gives the target's texels.
    std::vector<std::array<std::uint8_t, 4>> drawTo(const Texture& texture, const RenderPipeline& pipeline,
                                                    const BindGroup& bindings = {}, Color clear = {}) {
        auto encoder = device.createCommandEncoder("draw");
        auto pass = encoder.beginRenderPass(clearPass(view(texture), clear));
        pass.setPipeline(pipeline);
        if (bindings) pass.setBindGroup(0, bindings);
        pass.draw(3);
        pass.end();
        run(encoder);
        return read<std::array<std::uint8_t, 4>>(texture);
    }
};

using Texel = std::array<std::uint8_t, 4>;

}  // namespace pelage::test
