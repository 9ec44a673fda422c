// SPDX-License-Identifier: MIT
// Render passes: the whole pass is one scope, so its barrier stands before it and none inside.
#include "encoder_object.hpp"

#include <algorithm>

namespace pelage::rhi {

using detail::cat;
using detail::EncoderObject;
using detail::invalid;
using detail::UseKind;
namespace packet = detail::packet;

namespace {

using State = EncoderObject::State;

/// Collects the attachments of one pass and checks that they agree.
struct PassBuilder {
    EncoderObject& e;
    std::string_view label;
    detail::RenderPassPacket pass = {};
    std::uint32_t samples = 0;
    const detail::TextureViewObject* first = nullptr;

    bool stop(Code code, std::string text) {
        e.fail(invalid(code, std::move(text)).value(), cat("RenderPass \"", label, '"'));
        return false;
    }
    bool attach(const TextureView& handle, const detail::CommandName& what, bool depth, bool resolve) {
        if (!e.accept(handle, what)) return false;
        const auto& view = *handle.get();
        const auto& t = view.texture->descriptor;
        if (view.texture->handle == VK_NULL_HANDLE)
            return stop(ErrorCode::Surface,
                        cat(view.texture->describe(), " belongs to a surface that was configured again since."));
        if (!contains(t.usage, TextureUsage::RenderAttachment))
            return stop(ErrorCode::InvalidUsage,
                        cat(view.texture->describe(), " was created without ",
                            detail::usageNames(TextureUsage::RenderAttachment), ", which ", what, " needs."));
        if (isDepth(t.format) != depth)
            return stop(ErrorCode::TargetMismatch, cat(view.texture->describe(), " has the format ", name(t.format),
                                                       ", which cannot be ", what, '.'));
        if (view.range.mips != 1)
            return stop(ErrorCode::OutOfRange,
                        cat(view.describe(), " has ", view.range.mips, " mip levels; ", what, " needs a view of 1."));
        if (first == nullptr) {
            first = &view;
            pass.size = view.size;
            pass.layers = view.range.layers;
        } else if (!(view.size == pass.size) || view.range.layers != pass.layers)
            return stop(ErrorCode::InvalidSize,
                        cat(view.describe(), " is ", view.size.width, 'x', view.size.height, " with ",
                            view.range.layers, " layers; ", first->describe(), " is ", pass.size.width, 'x',
                            pass.size.height, " with ", pass.layers, '.'));
        if (resolve) return true;
        if (samples != 0 && samples != t.sampleCount)
            return stop(ErrorCode::SampleCount, cat(view.texture->describe(), " has ", t.sampleCount,
                                                    " samples; the other attachments have ", samples, '.'));
        samples = t.sampleCount;
        return true;
    }
    bool use(const detail::TextureViewObject& view, UseKind kind, bool depth) {
        detail::Use u;
        u.object = view.texture.get();
        u.texture = true;
        u.kind = kind;
        u.range = view.range;
        u.access = detail::accessOf(kind, 0, depth);
        if (e.use(u)) return true;
        e.error->context.insert(e.error->context.begin(), cat("RenderPass \"", label, '"'));
        return false;
    }
    bool color(const RenderPassColorAttachment& a, std::size_t index);
    bool depthStencil(const RenderPassDepthStencilAttachment& a);
};

bool PassBuilder::color(const RenderPassColorAttachment& a, std::size_t index) {
    detail::AttachmentPacket packet;
    if (!a.view && !a.resolveTarget) {  // a gap: the pipeline's target there is Undefined
        pass.colors.push_back(packet);
        return true;
    }
    if (!attach(a.view, {"colour attachment ", static_cast<std::uint32_t>(index)}, false, false)) return false;
    packet.view = a.view.get();
    packet.load = a.loadOp;
    packet.store = a.storeOp;
    const auto& format = a.view.get()->texture->descriptor.format;
    if (detail::formatInfo(format).numeric == detail::NumericClass::Uint)
        packet.clear.color = {
            .uint32 = {static_cast<std::uint32_t>(a.clearValue.r), static_cast<std::uint32_t>(a.clearValue.g),
                       static_cast<std::uint32_t>(a.clearValue.b), static_cast<std::uint32_t>(a.clearValue.a)}};
    else
        packet.clear.color = {.float32 = {static_cast<float>(a.clearValue.r), static_cast<float>(a.clearValue.g),
                                          static_cast<float>(a.clearValue.b), static_cast<float>(a.clearValue.a)}};
    if (!use(*packet.view, UseKind::ColorAttachment, false)) return false;
    if (a.resolveTarget) {
        if (!attach(a.resolveTarget, {"the resolve target of colour attachment ", static_cast<std::uint32_t>(index)},
                    false, true))
            return false;
        packet.resolve = a.resolveTarget.get();
        const auto& target = packet.resolve->texture->descriptor;
        if (packet.view->texture->descriptor.sampleCount == 1 || target.sampleCount != 1)
            return stop(ErrorCode::SampleCount,
                        cat(packet.view->texture->describe(), " with ", packet.view->texture->descriptor.sampleCount,
                            " samples cannot be resolved to ", packet.resolve->texture->describe(), " with ",
                            target.sampleCount, "; several samples are resolved to 1."));
        if (target.format != format)
            return stop(ErrorCode::TargetMismatch,
                        cat(packet.resolve->texture->describe(), " has the format ", name(target.format),
                            "; the attachment resolved to it has ", name(format), '.'));
        if (e.device->toggles.resolveToFirstLayerOnly && packet.resolve->range.baseLayer > 0) {
            e.fail(detail::fail(
                       ErrorKind::Unsupported, ErrorCode::FormatUnsupported,
                       cat(packet.resolve->describe(), " is array layer ", packet.resolve->range.baseLayer,
                           "; this driver resolves only to layer 0 of a texture. Resolve to a texture of its own."))
                       .value(),
                   cat("RenderPass \"", label, '"'));
            return false;
        }
        if (!use(*packet.resolve, UseKind::ResolveTarget, false)) return false;
    }
    pass.colors.push_back(packet);
    return true;
}

bool PassBuilder::depthStencil(const RenderPassDepthStencilAttachment& a) {
    if (!attach(a.view, {"the depth attachment"}, true, false)) return false;
    detail::AttachmentPacket packet;
    packet.view = a.view.get();
    packet.readOnly = a.depthReadOnly;
    packet.load = a.depthReadOnly ? LoadOp::Load : a.depthLoadOp;
    packet.store = a.depthReadOnly ? StoreOp::Store : a.depthStoreOp;
    packet.clear.depthStencil.depth = a.depthClearValue;
    if (!a.depthReadOnly && !(a.depthClearValue >= 0 && a.depthClearValue <= 1))
        return stop(ErrorCode::OutOfRange,
                    cat(packet.view->describe(), " is cleared to depth ", a.depthClearValue, "; 0 … 1 is needed."));
    pass.depth = packet;
    return use(*packet.view, a.depthReadOnly ? UseKind::ReadOnlyDepth : UseKind::DepthAttachment, true);
}

void viewport(EncoderObject& e, float x, float y, float width, float height, float minDepth, float maxDepth) {
    // Upside down, so that clip-space +Y is up as in WebGPU.
    e.add(packet::Viewport{{x, y + height, width, -height, minDepth, maxDepth}});
}

}  // namespace

RenderPassEncoder CommandEncoder::beginRenderPass(const RenderPassDescriptor& d) {
    if (!encoder_) return {};
    auto& e = *encoder_;
    RenderPassEncoder encoder(encoder_);
    if (!e.ready(State::Open, "beginRenderPass") || !e.timestamps(d.timestampWrites)) return encoder;
    e.scope.clear();
    PassBuilder builder{e, d.label};
    const auto limit = e.device->info.limits.maxColorAttachments;
    if (d.colorAttachments.size() > limit) {
        builder.stop(ErrorCode::OutOfRange, cat("The pass has ", d.colorAttachments.size(),
                                                " colour attachments; the device allows ", limit, '.'));
        return encoder;
    }
    for (std::size_t i = 0; i < d.colorAttachments.size(); ++i)
        if (!builder.color(d.colorAttachments[i], i)) return encoder;
    if (d.depthStencilAttachment && !builder.depthStencil(*d.depthStencilAttachment)) return encoder;
    if (builder.first == nullptr) {
        builder.stop(ErrorCode::MissingState, "The pass has no attachments; at least one is needed.");
        return encoder;
    }
    if (d.statistics) {
        if (!e.queryIndex(d.statistics, QueryType::PipelineStatistics, d.statisticsIndex, "the pass' statistics"))
            return encoder;
        builder.pass.statistics = d.statistics.get();
        builder.pass.statisticsIndex = d.statisticsIndex;
    }
    e.beginPass(State::RenderPass, d.label, d.timestampWrites);
    e.pass.scopePacket = e.recording.packets.size();
    e.add(packet::Scope{});  // filled in at the end of the pass
    const auto size = builder.pass.size;
    e.recording.passes.push_back(builder.pass);
    e.add(packet::BeginRendering{static_cast<std::uint32_t>(e.recording.passes.size() - 1)});
    viewport(e, 0, 0, static_cast<float>(size.width), static_cast<float>(size.height), 0, 1);
    e.add(packet::Scissor{{{0, 0}, {size.width, size.height}}});
    e.add(packet::LineWidth{1});
    ++e.counters.renderPasses;
    return encoder;
}

void RenderPassEncoder::setPipeline(const RenderPipeline& pipeline) {
    if (!encoder_ || !encoder_->ready(State::RenderPass, "setPipeline")) return;
    auto& e = *encoder_;
    if (!e.accept(pipeline, "the pipeline") || e.pass.pipeline == pipeline.get()) return;
    const auto& object = *pipeline.get();
    const auto& pass = e.recording.passes.back();
    const auto stop = [&](Code code, auto&&... parts) {
        e.fail(invalid(code, cat(object.describe(), parts...)).value());
    };
    if (object.colorFormats.size() != pass.colors.size())
        return stop(ErrorCode::TargetMismatch, " has ", object.colorFormats.size(), " targets; the pass has ",
                    pass.colors.size(), " colour attachments.");
    for (std::size_t i = 0; i < pass.colors.size(); ++i) {
        const auto* view = pass.colors[i].view;
        const auto format = view != nullptr ? view->texture->descriptor.format : TextureFormat::Undefined;
        if (object.colorFormats[i] != format)
            return stop(ErrorCode::TargetMismatch, " target ", i, " is ", name(object.colorFormats[i]),
                        "; colour attachment ", i, " of the pass is ", name(format), '.');
        if (view != nullptr && view->texture->descriptor.sampleCount != object.sampleCount)
            return stop(ErrorCode::SampleCount, " has ", object.sampleCount, " samples; colour attachment ", i,
                        " of the pass has ", view->texture->descriptor.sampleCount, '.');
    }
    const auto depth = pass.depth ? pass.depth->view->texture->descriptor.format : TextureFormat::Undefined;
    if (object.depthFormat != depth)
        return stop(ErrorCode::TargetMismatch, " has the depth format ", name(object.depthFormat), "; the pass has ",
                    name(depth), '.');
    if (pass.depth && pass.depth->view->texture->descriptor.sampleCount != object.sampleCount)
        return stop(ErrorCode::SampleCount, " has ", object.sampleCount, " samples; the depth attachment has ",
                    pass.depth->view->texture->descriptor.sampleCount, '.');
    if (pass.depth && pass.depth->readOnly && object.writesDepth)
        return stop(ErrorCode::TargetMismatch, " writes depth; the pass' depth attachment is read-only.");
    e.pass.pipeline = pipeline.get();
    e.add(packet::BindPipeline{pipeline.get(), VK_PIPELINE_BIND_POINT_GRAPHICS});
}

void RenderPassEncoder::setBindGroup(std::uint32_t index, const BindGroup& group,
                                     std::span<const std::uint32_t> dynamicOffsets) {
    if (encoder_ && encoder_->ready(State::RenderPass, "setBindGroup"))
        encoder_->setBindGroup(index, group, dynamicOffsets);
}

namespace {
bool geometryBuffer(EncoderObject& e, const Buffer& buffer, BufferUsage usage, std::uint64_t offset, UseKind kind,
                    const detail::CommandName& what) {
    if (!e.accept(buffer, what)) return false;
    auto& object = *buffer.get();
    if (!contains(object.descriptor.usage, usage)) {
        e.fail(invalid(ErrorCode::InvalidUsage, cat(object.describe(), " was created without ",
                                                    detail::usageNames(usage), ", which ", what.text(), " needs."))
                   .value());
        return false;
    }
    if (offset >= object.descriptor.size || offset % 4 != 0) {
        e.fail(invalid(ErrorCode::OutOfRange,
                       cat(object.describe(), " has ", object.descriptor.size, " bytes; ", what.text(),
                           " starts at byte ", offset, ", and a multiple of 4 inside is needed."))
                   .value());
        return false;
    }
    detail::Use use;
    use.object = &object;
    use.kind = kind;
    use.access = detail::accessOf(kind, 0, false);
    return e.use(use);
}
}  // namespace

void RenderPassEncoder::setVertexBuffer(std::uint32_t slot, const Buffer& buffer, std::uint64_t offset) {
    if (!encoder_ || !encoder_->ready(State::RenderPass, "setVertexBuffer")) return;
    auto& e = *encoder_;
    if (slot >= 16)  // Vulkan promises 16 on every device
        return e.fail(
            invalid(ErrorCode::OutOfRange, cat("Vertex buffer slot ", slot, " is above the limit of 15.")).value());
    if (!geometryBuffer(e, buffer, BufferUsage::Vertex, offset, UseKind::VertexBuffer,
                        detail::CommandName{"vertex buffer ", slot}))
        return;
    if (e.pass.vertexBuffers.size() <= slot) e.pass.vertexBuffers.resize(slot + 1);
    auto& bound = e.pass.vertexBuffers[slot];
    if (bound.buffer == buffer.get() && bound.offset == offset) return;
    bound = {buffer.get(), offset};
    e.add(packet::BindVertexBuffer{buffer.get(), offset, slot});
}

void RenderPassEncoder::setIndexBuffer(const Buffer& buffer, IndexFormat format, std::uint64_t offset) {
    if (!encoder_ || !encoder_->ready(State::RenderPass, "setIndexBuffer")) return;
    auto& e = *encoder_;
    if (!geometryBuffer(e, buffer, BufferUsage::Index, offset, UseKind::IndexBuffer,
                        detail::CommandName{"index buffer ", 0}))
        return;
    e.pass.index = {buffer.get(), offset};
    e.pass.indexFormat = format;
    e.add(packet::BindIndexBuffer{buffer.get(), offset,
                                  format == IndexFormat::Uint16 ? VK_INDEX_TYPE_UINT16 : VK_INDEX_TYPE_UINT32});
}

void RenderPassEncoder::setPushConstants(std::uint32_t offset, std::span<const std::byte> bytes) {
    if (encoder_ && encoder_->ready(State::RenderPass, "setPushConstants")) encoder_->setPushConstants(offset, bytes);
}

void RenderPassEncoder::setViewport(float x, float y, float width, float height, float minDepth, float maxDepth) {
    if (!encoder_ || !encoder_->ready(State::RenderPass, "setViewport")) return;
    const auto limit = static_cast<float>(encoder_->device->info.limits.maxTextureDimension2D);
    if (!(width > 0 && height > 0 && width <= limit && height <= limit && minDepth >= 0 && minDepth <= 1 &&
          maxDepth >= 0 && maxDepth <= 1 && x >= -2 * limit && y >= -2 * limit && x + width < 2 * limit &&
          y + height < 2 * limit))
        return encoder_->fail(
            invalid(ErrorCode::OutOfRange,
                    cat("The viewport ", x, ", ", y, ", ", width, 'x', height, " with depth ", minDepth, " … ",
                        maxDepth, " is empty or above the device's limit of ", limit, '.'))
                .value());
    viewport(*encoder_, x, y, width, height, minDepth, maxDepth);
}

void RenderPassEncoder::setScissorRect(std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height) {
    if (!encoder_ || !encoder_->ready(State::RenderPass, "setScissorRect")) return;
    const auto& size = encoder_->recording.passes.back().size;
    if (std::uint64_t{x} + width > size.width || std::uint64_t{y} + height > size.height)
        return encoder_->fail(invalid(ErrorCode::OutOfRange, cat("The scissor rectangle ", x, ", ", y, ", ", width, 'x',
                                                                 height, " reaches outside the attachments, which are ",
                                                                 size.width, 'x', size.height, '.'))
                                  .value());
    encoder_->add(packet::Scissor{{{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)}, {width, height}}});
}

void RenderPassEncoder::setLineWidth(float width) {
    if (!encoder_ || !encoder_->ready(State::RenderPass, "setLineWidth")) return;
    const float limit = encoder_->device->info.limits.maxLineWidth;
    // NaN compares false with everything and becomes 1, the width every device has.
    encoder_->add(packet::LineWidth{
        width >= 1 || limit > 1 ? std::clamp(width > 0 ? width : 1.0F, limit > 1 ? 0.01F : 1.0F, limit) : 1.0F});
}

void RenderPassEncoder::pushDebugGroup(std::string_view label) {
    if (encoder_ && encoder_->ready(State::RenderPass, "pushDebugGroup")) encoder_->pushDebugGroup(label);
}
void RenderPassEncoder::popDebugGroup() {
    if (encoder_ && encoder_->ready(State::RenderPass, "popDebugGroup")) encoder_->popDebugGroup();
}
void RenderPassEncoder::end() {
    if (!encoder_ || !encoder_->ready(State::RenderPass, "end")) return;
    auto& e = *encoder_;
    e.add(packet::EndRendering{static_cast<std::uint32_t>(e.recording.passes.size() - 1)});
    e.closeScope(e.pass.scopePacket);
    e.endPass();
}

}  // namespace pelage::rhi
