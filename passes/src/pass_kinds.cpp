// SPDX-License-Identifier: MIT
#include "pass_kinds.hpp"

#include <string>

namespace pelage::passes {
namespace {

template <class Pipeline, class Encoder>
Result<void> set(const Pipeline& pipeline, const rhi::BindGroupLayout& layout, const PassContext& context,
                 Encoder& encoder) {
    encoder.setPipeline(pipeline);
    if (!layout) return {};
    auto group = context.bindGroup(layout);
    if (!group) return tl::unexpected(std::move(group.error()));
    encoder.setBindGroup(slotSet, *group);
    return {};
}

Result<void> copyImage(const PassContext& context, const PlanSlot& from, const PlanSlot& to) {
    const rhi::Texture source = context.texture(from.name), target = context.texture(to.name);
    const rhi::TextureDescriptor& descriptor = source.descriptor();
    const bool all = from.level == ~0U;
    for (std::uint32_t i = 0; i < (all ? descriptor.mipLevelCount : 1); ++i) {
        const std::uint32_t level = all ? i : from.level;
        context.copy->copyTextureToTexture(
            {.texture = source, .mipLevel = level}, {.texture = target, .mipLevel = to.level == ~0U ? i : to.level},
            levelExtent(descriptor.size, descriptor.dimension == rhi::TextureDimension::E3D, level));
    }
    return {};
}

Result<void> copyBuffer(const PassContext& context, const PlanSlot& from, const PlanSlot& to) {
    const rhi::Buffer source = context.buffer(from.name), target = context.buffer(to.name);
    if (source.size() != target.size()) {
        return tl::unexpected(Diagnostic{.code = "P081",
                                         .text = "pass '" + context.pass.name + "' copies " +
                                                 std::to_string(source.size()) + " bytes into a buffer of " +
                                                 std::to_string(target.size())});
    }
    context.copy->copyBufferToBuffer(source, 0, target, 0, source.size());
    return {};
}

}  // namespace

PassRecorder fullscreenPass(rhi::RenderPipeline pipeline) {
    rhi::BindGroupLayout layout = pipeline.bindGroupLayout(slotSet);
    return [pipeline = std::move(pipeline), layout = std::move(layout)](PassContext& context) {
        Result<void> ready = set(pipeline, layout, context, *context.raster);
        if (!ready) return ready;
        context.raster->draw(3);
        context.draws += 1;
        return ready;
    };
}

PassRecorder computePass(rhi::ComputePipeline pipeline) {
    rhi::BindGroupLayout layout = pipeline.bindGroupLayout(slotSet);
    return [pipeline = std::move(pipeline), layout = std::move(layout)](PassContext& context) {
        Result<void> ready = set(pipeline, layout, context, *context.compute);
        if (!ready) return ready;
        const PlanPass& pass = context.pass;
        context.draws += 1;
        if (pass.indirect == ~0U) {
            context.compute->dispatchWorkgroups(pass.dispatch[0], pass.dispatch[1], pass.dispatch[2]);
        } else if (const rhi::Buffer counts = context.buffer(pass.slots[pass.indirect].name)) {
            context.compute->dispatchWorkgroupsIndirect(counts, pass.indirectOffset);
        }
        return ready;
    };
}

PassRecorder copyPass() {
    return [](PassContext& context) -> Result<void> {
        const PlanSlot* from = nullptr;
        const PlanSlot* to = nullptr;
        for (const PlanSlot& slot : context.pass.slots) (slot.access == SlotAccess::Read ? from : to) = &slot;
        if (!from || !to || from->resource == ~0U || to->resource == ~0U) return {};
        return context.texture(from->name) ? copyImage(context, *from, *to) : copyBuffer(context, *from, *to);
    };
}

}  // namespace pelage::passes
