// SPDX-License-Identifier: MIT
// Draws: what each needs is checked, and its groups join the scope of the pass.
#include "encoder_object.hpp"

namespace pelage::rhi {

using detail::cat;
using detail::EncoderObject;
using detail::invalid;
using detail::RenderPipelineObject;
namespace packet = detail::packet;
using State = EncoderObject::State;

namespace {

/// Everything a draw needs is set and large enough.
bool readyToDraw(EncoderObject& e, const detail::CommandName& command, std::uint64_t vertices,
                 std::uint64_t instances) {
    const auto stop = [&](Code code, std::string text) {
        e.fail(invalid(code, std::move(text)).value(), command.text());
        return false;
    };
    if (!e.pass.pipeline) return stop(ErrorCode::MissingState, "A draw needs a pipeline, and none is set.");
    const auto& pipeline = static_cast<const RenderPipelineObject&>(*e.pass.pipeline);
    for (std::uint32_t slot = 0; slot < pipeline.vertexSlots.size(); ++slot) {
        const auto& needs = pipeline.vertexSlots[slot];
        if (!needs.used) continue;
        if (slot >= e.pass.vertexBuffers.size() || !e.pass.vertexBuffers[slot].buffer)
            return stop(ErrorCode::MissingState,
                        cat(pipeline.describe(), " needs a vertex buffer in slot ", slot, ", and none is set."));
        const std::uint64_t count = needs.stepMode == VertexStepMode::Vertex ? vertices : instances;
        if (count == 0) continue;
        const auto& bound = e.pass.vertexBuffers[slot];
        const std::uint64_t end = bound.offset + (count - 1) * needs.stride + needs.lastByte;
        if (end > bound.buffer->descriptor.size)
            return stop(ErrorCode::OutOfRange,
                        cat("The draw reads ", end, " bytes of ", bound.buffer->describe(), " in slot ", slot,
                            ", which has ", bound.buffer->descriptor.size, '.'));
    }
    return e.flushBindings(VK_PIPELINE_BIND_POINT_GRAPHICS,
                           VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, command);
}

}  // namespace

void RenderPassEncoder::draw(std::uint32_t vertexCount, std::uint32_t instanceCount, std::uint32_t firstVertex,
                             std::uint32_t firstInstance) {
    if (!encoder_ || !encoder_->ready(State::RenderPass, "draw")) return;
    auto& e = *encoder_;
    const detail::CommandName command{"draw #", e.pass.commands++};
    if (!readyToDraw(e, command, vertexCount == 0 ? 0 : std::uint64_t{firstVertex} + vertexCount,
                     instanceCount == 0 ? 0 : std::uint64_t{firstInstance} + instanceCount))
        return;
    e.pass.groupsChanged = false;
    if (vertexCount == 0 || instanceCount == 0) return;
    e.add(packet::Draw{vertexCount, instanceCount, firstVertex, firstInstance});
    ++e.counters.draws;
}

void RenderPassEncoder::drawIndexed(std::uint32_t indexCount, std::uint32_t instanceCount, std::uint32_t firstIndex,
                                    std::int32_t baseVertex, std::uint32_t firstInstance) {
    if (!encoder_ || !encoder_->ready(State::RenderPass, "drawIndexed")) return;
    auto& e = *encoder_;
    const detail::CommandName command{"drawIndexed #", e.pass.commands++};
    if (!e.pass.index.buffer)
        return e.fail(invalid(ErrorCode::MissingState, "drawIndexed() needs an index buffer, and none is set.").value(),
                      command.text());
    const std::uint64_t stride = e.pass.indexFormat == IndexFormat::Uint16 ? 2 : 4;
    const std::uint64_t end = e.pass.index.offset + (std::uint64_t{firstIndex} + indexCount) * stride;
    if (end > e.pass.index.buffer->descriptor.size)
        return e.fail(
            invalid(ErrorCode::OutOfRange, cat("The draw reads ", end, " bytes of ", e.pass.index.buffer->describe(),
                                               " as indices, which has ", e.pass.index.buffer->descriptor.size, '.'))
                .value(),
            command.text());
    // How far the indices reach is known only on the device; instances are known here.
    if (!readyToDraw(e, command, 0, instanceCount == 0 ? 0 : std::uint64_t{firstInstance} + instanceCount)) return;
    e.pass.groupsChanged = false;
    if (indexCount == 0 || instanceCount == 0) return;
    e.add(packet::DrawIndexed{indexCount, instanceCount, firstIndex, baseVertex, firstInstance});
    ++e.counters.draws;
}

namespace {
void drawFromBuffer(EncoderObject& e, packet::Indirect::Command kind, const Buffer& buffer, std::uint64_t offset,
                    const detail::CommandName& command) {
    const std::uint64_t size = (kind == packet::Indirect::Command::Draw ? 4 : 5) * sizeof(std::uint32_t);
    if (!e.indirectArguments(buffer, offset, size, command) || !readyToDraw(e, command, 0, 0)) return;
    e.pass.groupsChanged = false;
    e.add(packet::Indirect{kind, buffer.get(), offset});
    ++e.counters.draws;
}
}  // namespace

void RenderPassEncoder::drawIndirect(const Buffer& buffer, std::uint64_t offset) {
    if (!encoder_ || !encoder_->ready(State::RenderPass, "drawIndirect")) return;
    drawFromBuffer(*encoder_, packet::Indirect::Command::Draw, buffer, offset,
                   {"drawIndirect #", encoder_->pass.commands++});
}

void RenderPassEncoder::drawIndexedIndirect(const Buffer& buffer, std::uint64_t offset) {
    if (!encoder_ || !encoder_->ready(State::RenderPass, "drawIndexedIndirect")) return;
    auto& e = *encoder_;
    const detail::CommandName command{"drawIndexedIndirect #", e.pass.commands++};
    if (!e.pass.index.buffer)
        return e.fail(
            invalid(ErrorCode::MissingState, "drawIndexedIndirect() needs an index buffer, and none is set.").value(),
            command.text());
    drawFromBuffer(e, packet::Indirect::Command::DrawIndexed, buffer, offset, command);
}

}  // namespace pelage::rhi
