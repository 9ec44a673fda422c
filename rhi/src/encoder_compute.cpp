// SPDX-License-Identifier: MIT
// Compute passes: each dispatch is a scope of its own.
#include "encoder_object.hpp"

namespace pelage::rhi {

using detail::cat;
using detail::EncoderObject;
using detail::invalid;
namespace packet = detail::packet;

ComputePassEncoder CommandEncoder::beginComputePass(const ComputePassDescriptor& descriptor) {
    if (!encoder_) return {};
    auto& e = *encoder_;
    if (e.ready(EncoderObject::State::Open, "beginComputePass") && e.timestamps(descriptor.timestampWrites)) {
        e.scope.clear();
        e.beginPass(EncoderObject::State::ComputePass, descriptor.label, descriptor.timestampWrites);
    }
    return ComputePassEncoder(encoder_);
}

void ComputePassEncoder::setPipeline(const ComputePipeline& pipeline) {
    if (!encoder_ || !encoder_->ready(EncoderObject::State::ComputePass, "setPipeline")) return;
    if (!encoder_->accept(pipeline, "the pipeline") || encoder_->pass.pipeline == pipeline.get()) return;
    encoder_->pass.pipeline = pipeline.get();
    encoder_->add(packet::BindPipeline{pipeline.get(), VK_PIPELINE_BIND_POINT_COMPUTE});
}

void ComputePassEncoder::setBindGroup(std::uint32_t index, const BindGroup& group,
                                      std::span<const std::uint32_t> dynamicOffsets) {
    if (encoder_ && encoder_->ready(EncoderObject::State::ComputePass, "setBindGroup"))
        encoder_->setBindGroup(index, group, dynamicOffsets);
}

void ComputePassEncoder::setPushConstants(std::uint32_t offset, std::span<const std::byte> bytes) {
    if (encoder_ && encoder_->ready(EncoderObject::State::ComputePass, "setPushConstants"))
        encoder_->setPushConstants(offset, bytes);
}

void ComputePassEncoder::dispatchWorkgroups(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    if (!encoder_ || !encoder_->ready(EncoderObject::State::ComputePass, "dispatchWorkgroups")) return;
    auto& e = *encoder_;
    const detail::CommandName command{"dispatch #", e.pass.commands++};
    if (!e.pass.pipeline)
        return e.fail(
            invalid(ErrorCode::MissingState, "dispatchWorkgroups() needs a pipeline, and none is set.").value(),
            command.text());
    const auto limit = e.device->info.limits.maxComputeWorkgroupsPerDimension;
    if (x > limit || y > limit || z > limit)
        return e.fail(invalid(ErrorCode::OutOfRange, cat("dispatchWorkgroups(", x, ", ", y, ", ", z,
                                                         ") is above the device's limit of ", limit, " per dimension."))
                          .value(),
                      command.text());
    if (x == 0 || y == 0 || z == 0) return;
    e.pass.merged.clear();
    if (!e.flushBindings(VK_PIPELINE_BIND_POINT_COMPUTE, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, command)) return;
    // The same groups again: the same uses again.
    if (e.pass.groupsChanged) e.pass.lastDispatchScope = e.scope.take(e.recording.uses);
    e.pass.groupsChanged = false;
    e.add(e.pass.lastDispatchScope);
    e.add(packet::Dispatch{x, y, z});
    ++e.counters.dispatches;
}

void ComputePassEncoder::dispatchWorkgroupsIndirect(const Buffer& buffer, std::uint64_t offset) {
    if (!encoder_ || !encoder_->ready(EncoderObject::State::ComputePass, "dispatchWorkgroupsIndirect")) return;
    auto& e = *encoder_;
    const detail::CommandName command{"dispatch #", e.pass.commands++};
    if (!e.pass.pipeline)
        return e.fail(
            invalid(ErrorCode::MissingState, "dispatchWorkgroupsIndirect() needs a pipeline, and none is set.").value(),
            command.text());
    e.pass.merged.clear();
    e.pass.groupsChanged = true;  // this scope has one use more than the groups'
    if (!e.indirectArguments(buffer, offset, 3 * sizeof(std::uint32_t), command) ||
        !e.flushBindings(VK_PIPELINE_BIND_POINT_COMPUTE, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, command))
        return;
    e.add(e.scope.take(e.recording.uses));
    e.add(packet::Indirect{packet::Indirect::Command::Dispatch, buffer.get(), offset});
    ++e.counters.dispatches;
}

void ComputePassEncoder::pushDebugGroup(std::string_view label) {
    if (encoder_ && encoder_->ready(EncoderObject::State::ComputePass, "pushDebugGroup"))
        encoder_->pushDebugGroup(label);
}
void ComputePassEncoder::popDebugGroup() {
    if (encoder_ && encoder_->ready(EncoderObject::State::ComputePass, "popDebugGroup")) encoder_->popDebugGroup();
}
void ComputePassEncoder::end() {
    if (encoder_ && encoder_->ready(EncoderObject::State::ComputePass, "end")) encoder_->endPass();
}

}  // namespace pelage::rhi
