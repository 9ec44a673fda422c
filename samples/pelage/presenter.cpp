// SPDX-License-Identifier: MIT
#include "presenter.hpp"

#include <string_view>

namespace pelage::app {

namespace shaders {
std::span<const std::uint32_t> embeddedShader(std::string_view name);
}

namespace {

Result<rhi::ShaderModule> module(const rhi::Device& device, const char* file) {
    const auto code = shaders::embeddedShader(file);
    return device.createShaderModule({.label = file, .code = {code.begin(), code.end()}});
}

bool isSrgb(rhi::TextureFormat format) {
    return format == rhi::TextureFormat::RGBA8UnormSrgb || format == rhi::TextureFormat::BGRA8UnormSrgb;
}

}  // namespace

Result<void> Presenter::makePipeline(rhi::TextureFormat format) {
    if (pipeline_ && format_ == format) return {};
    auto vertex = module(device_, "present.vert");
    if (!vertex) return tl::unexpected(Failure(vertex.error()));
    auto fragment = module(device_, "present.frag");
    if (!fragment) return tl::unexpected(Failure(fragment.error()));
    auto pipeline = device_.createRenderPipeline({
        .label = "present",
        .vertex = {.module = *vertex},
        .fragment = rhi::ProgrammableStage{.module = *fragment,
                                           .constants = {{.name = "decodeSrgb", .value = isSrgb(format) ? 1.0 : 0.0}}},
        .targets = {{.format = format}},
    });
    if (!pipeline) return tl::unexpected(Failure(pipeline.error()));
    pipeline_ = *pipeline;
    format_ = format;
    return {};
}

Result<rhi::Texture> Presenter::readable(rhi::CommandEncoder& encoder, const rhi::Texture& picture) {
    if (rhi::contains(picture.descriptor().usage, rhi::TextureUsage::TextureBinding)) return picture;
    if (!copy_ || copy_.size() != picture.size() || copy_.format() != picture.format()) {
        auto copy = device_.createTexture({.label = "present copy",
                                           .size = picture.size(),
                                           .format = picture.format(),
                                           .usage = rhi::TextureUsage::CopyDst | rhi::TextureUsage::TextureBinding});
        if (!copy) return tl::unexpected(Failure(copy.error()));
        copy_ = *copy;
    }
    encoder.copyTextureToTexture({.texture = picture}, {.texture = copy_}, picture.size());
    return copy_;
}

Result<void> Presenter::encode(rhi::CommandEncoder& encoder, const rhi::Texture& picture, const rhi::Texture& window) {
    if (!picture)
        return tl::unexpected(Failure("A070: the pass tree exports no \"LdrColor\", so nothing can be shown"));
    if (auto made = makePipeline(window.format()); !made) return made;
    auto source = readable(encoder, picture);
    if (!source) return tl::unexpected(source.error());
    auto sourceView = source->createView();
    if (!sourceView) return tl::unexpected(Failure(sourceView.error()));
    auto windowView = window.createView();
    if (!windowView) return tl::unexpected(Failure(windowView.error()));
    auto group = device_.createBindGroup({.label = "present",
                                          .layout = pipeline_.bindGroupLayout(0),
                                          .entries = {{.binding = 0, .resource = *sourceView}}});
    if (!group) return tl::unexpected(Failure(group.error()));

    auto pass = encoder.beginRenderPass(
        {.label = "present", .colorAttachments = {{.view = *windowView, .loadOp = rhi::LoadOp::Clear}}});
    pass.setPipeline(pipeline_);
    pass.setBindGroup(0, *group);
    pass.draw(3);
    pass.end();
    return {};
}

}  // namespace pelage::app
