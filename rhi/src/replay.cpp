// SPDX-License-Identifier: MIT
// From packets to Vulkan. The only place that records commands.
#include "device_object.hpp"
#include "recording.hpp"
#include "transient_heap.hpp"

#include <algorithm>

namespace pelage::rhi::detail {

void Replay::flushBarriers() {
    if (!batch_.empty()) {
        batch_.record(commands_, device_.functions.vkCmdPipelineBarrier2);
        if (batch_.hasMemory()) device_.queue.barriers.note(batch_.memory());
        ++counters_.barriers;
    }
    batch_.clear();
}

void Replay::beginLabel(const char* label) {
    const auto& instance = *device_.adapter->instance;
    if (!instance.debugUtils || instance.vk.vkCmdBeginDebugUtilsLabelEXT == nullptr) return;
    VkDebugUtilsLabelEXT info = {VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
    info.pLabelName = label;
    instance.vk.vkCmdBeginDebugUtilsLabelEXT(commands_, &info);
}

void Replay::endLabel() {
    const auto& instance = *device_.adapter->instance;
    if (instance.debugUtils && instance.vk.vkCmdEndDebugUtilsLabelEXT != nullptr)
        instance.vk.vkCmdEndDebugUtilsLabelEXT(commands_);
}

void Replay::resetQuery(QuerySetObject& set, std::uint32_t index) {
    device_.functions.vkCmdResetQueryPool(commands_, set.handle, index, 1);
    set.written[index] = true;
}

namespace {
/// About 30 MB of llvmpipe's binned triangles.
constexpr std::uint64_t batchVertices = std::uint64_t{1} << 16;
}  // namespace

void Replay::makeRoom(std::uint64_t vertices) {
    if (!device_.toggles.drawInBatches) return;
    if (drawn_ > 0 && drawn_ + vertices > batchVertices) {
        const auto& f = device_.functions;
        f.vkCmdEndRendering(commands_);
        VkMemoryBarrier2 all = {VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
        all.srcStageMask = all.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        all.srcAccessMask = all.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
        VkDependencyInfo dependency = {VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
        dependency.memoryBarrierCount = 1;
        dependency.pMemoryBarriers = &all;
        f.vkCmdPipelineBarrier2(commands_, &dependency);
        ++counters_.barriers;
        startRendering(*pass_, true);
        drawn_ = 0;
    }
    drawn_ += vertices;
}

void Replay::draw(const packet::Draw& p) {
    const std::uint64_t whole = std::uint64_t{p.vertices} * p.instances;
    if (!device_.toggles.drawInBatches || whole <= batchVertices) {
        makeRoom(whole);
        device_.functions.vkCmdDraw(commands_, p.vertices, p.instances, p.firstVertex, p.firstInstance);
        return;
    }
    const auto most = static_cast<std::uint32_t>(std::max<std::uint64_t>(batchVertices / p.vertices, 1));
    for (std::uint32_t at = 0; at < p.instances; at += most) {
        const std::uint32_t count = std::min(most, p.instances - at);
        makeRoom(std::uint64_t{p.vertices} * count);
        device_.functions.vkCmdDraw(commands_, p.vertices, count, p.firstVertex, p.firstInstance + at);
    }
}

void Replay::beginRendering(const RenderPassPacket& pass) {
    if (pass.statistics != nullptr) {
        resetQuery(*pass.statistics, pass.statisticsIndex);
        device_.functions.vkCmdBeginQuery(commands_, pass.statistics->handle, pass.statisticsIndex, 0);
    }
    pass_ = &pass;
    drawn_ = 0;
    startRendering(pass, false);
}

/// `goesOn`: after an interruption, with what the attachments held before it.
void Replay::startRendering(const RenderPassPacket& pass, bool goesOn) {
    const bool batches = device_.toggles.drawInBatches;
    const auto attachment = [&](const AttachmentPacket& a, VkImageLayout layout) {
        VkRenderingAttachmentInfo info = {VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
        if (a.view == nullptr) return info;
        info.imageView = a.view->handle;
        info.imageLayout = layout;
        info.loadOp = a.load == LoadOp::Load || goesOn ? VK_ATTACHMENT_LOAD_OP_LOAD
                      : a.load == LoadOp::Clear        ? VK_ATTACHMENT_LOAD_OP_CLEAR
                                                       : VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        // Storing what was only read would count as a write of it.
        info.storeOp = a.readOnly                             ? VK_ATTACHMENT_STORE_OP_NONE
                       : a.store == StoreOp::Store || batches ? VK_ATTACHMENT_STORE_OP_STORE
                                                              : VK_ATTACHMENT_STORE_OP_DONT_CARE;
        info.clearValue = a.clear;
        if (a.resolve != nullptr) {
            const auto numeric = formatInfo(a.view->texture->descriptor.format).numeric;
            info.resolveMode =
                numeric == NumericClass::Float ? VK_RESOLVE_MODE_AVERAGE_BIT : VK_RESOLVE_MODE_SAMPLE_ZERO_BIT;
            info.resolveImageView = a.resolve->handle;
            info.resolveImageLayout = layout;
        }
        return info;
    };
    InlineVector<VkRenderingAttachmentInfo, maxColors> colors;
    for (const auto& c : pass.colors) colors.push_back(attachment(c, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL));
    VkRenderingAttachmentInfo depth = {};
    VkRenderingInfo info = {VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea = {{0, 0}, {pass.size.width, pass.size.height}};
    info.layerCount = pass.layers;
    info.colorAttachmentCount = static_cast<std::uint32_t>(colors.size());
    info.pColorAttachments = colors.begin();
    if (pass.depth) {
        depth = attachment(*pass.depth, pass.depth->readOnly ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL
                                                             : VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
        info.pDepthAttachment = &depth;
    }
    device_.functions.vkCmdBeginRendering(commands_, &info);
}

void Replay::resolveQueries(const packet::ResolveQueries& p) {
    const auto& f = device_.functions;
    const std::uint64_t size =
        p.set->descriptor.type == QueryType::Timestamp ? sizeof(std::uint64_t) : sizeof(PipelineStatistics);
    // Waiting for a query that was never written would wait for ever: such queries are zero.
    std::uint32_t i = p.first;
    while (i < p.first + p.count) {
        const bool written = p.set->written[i];
        std::uint32_t end = i + 1;
        while (end < p.first + p.count && p.set->written[end] == written) ++end;
        const std::uint64_t offset = p.offset + (i - p.first) * size;
        if (written)
            f.vkCmdCopyQueryPoolResults(commands_, p.set->handle, i, end - i, p.destination->handle, offset, size,
                                        VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
        else
            f.vkCmdFillBuffer(commands_, p.destination->handle, offset, (end - i) * size, 0);
        i = end;
    }
}

template <class P>
void Replay::play(const P& p) {
    using namespace packet;
    const auto& f = device_.functions;
    const Recording& r = *recording_;
    if constexpr (std::is_same_v<P, Scope>) {
        for (std::uint32_t i = p.first; i < p.first + p.count; ++i) {
            const Use& use = r.uses[i];
            if (use.object == nullptr) continue;  // an upload whose destination is gone
            if (use.texture) {
                auto& texture = static_cast<TextureObject&>(*use.object);
                if (!texture.state->current) takeOver(texture, use.access, batch_);
                batch_.use(*texture.state, texture.handle, use.range, use.access);
            } else {
                auto& buffer = static_cast<BufferObject&>(*use.object);
                batch_.use(buffer.state, use.access);
                hostReads_ =
                    hostReads_ || (isWrite(use.kind) && contains(buffer.descriptor.usage, BufferUsage::MapRead));
            }
        }
        if (timestampOpen_) batch_.full();
        timestampOpen_ = false;
        flushBarriers();
    } else if constexpr (std::is_same_v<P, BeginRendering>) {
        beginRendering(r.passes[p.pass]);
    } else if constexpr (std::is_same_v<P, EndRendering>) {
        f.vkCmdEndRendering(commands_);
        const auto& pass = r.passes[p.pass];
        if (pass.statistics != nullptr) f.vkCmdEndQuery(commands_, pass.statistics->handle, pass.statisticsIndex);
    } else if constexpr (std::is_same_v<P, BeginLabel>) {
        beginLabel(r.labels.data() + p.text);
    } else if constexpr (std::is_same_v<P, EndLabel>) {
        endLabel();
    } else if constexpr (std::is_same_v<P, BindPipeline>) {
        f.vkCmdBindPipeline(commands_, p.point, p.pipeline->handle);
    } else if constexpr (std::is_same_v<P, BindSet>) {
        f.vkCmdBindDescriptorSets(commands_, p.point, p.layout->handle, p.index, 1, &p.group->set, p.offsetCount,
                                  r.offsets.data() + p.firstOffset);
    } else if constexpr (std::is_same_v<P, Push>) {
        f.vkCmdPushConstants(commands_, p.layout->handle, p.layout->pushStages, 0, p.size, r.bytes.data() + p.first);
    } else if constexpr (std::is_same_v<P, BindVertexBuffer>) {
        f.vkCmdBindVertexBuffers(commands_, p.slot, 1, &p.buffer->handle, &p.offset);
    } else if constexpr (std::is_same_v<P, BindIndexBuffer>) {
        f.vkCmdBindIndexBuffer(commands_, p.buffer->handle, p.offset, p.type);
    } else if constexpr (std::is_same_v<P, Viewport>) {
        f.vkCmdSetViewport(commands_, 0, 1, &p.value);
    } else if constexpr (std::is_same_v<P, Scissor>) {
        f.vkCmdSetScissor(commands_, 0, 1, &p.value);
    } else if constexpr (std::is_same_v<P, LineWidth>) {
        f.vkCmdSetLineWidth(commands_, p.value);
    } else if constexpr (std::is_same_v<P, Draw>) {
        draw(p);
    } else if constexpr (std::is_same_v<P, DrawIndexed>) {
        makeRoom(std::uint64_t{p.indices} * p.instances);
        f.vkCmdDrawIndexed(commands_, p.indices, p.instances, p.firstIndex, p.baseVertex, p.firstInstance);
    } else if constexpr (std::is_same_v<P, Dispatch>) {
        f.vkCmdDispatch(commands_, p.x, p.y, p.z);
    } else if constexpr (std::is_same_v<P, Indirect>) {
        if (p.command == Indirect::Command::Draw)
            f.vkCmdDrawIndirect(commands_, p.buffer->handle, p.offset, 1, sizeof(VkDrawIndirectCommand));
        else if (p.command == Indirect::Command::DrawIndexed)
            f.vkCmdDrawIndexedIndirect(commands_, p.buffer->handle, p.offset, 1, sizeof(VkDrawIndexedIndirectCommand));
        else
            f.vkCmdDispatchIndirect(commands_, p.buffer->handle, p.offset);
    } else if constexpr (std::is_same_v<P, CopyBuffer>) {
        f.vkCmdCopyBuffer(commands_, p.source->handle, p.destination->handle, 1, &r.bufferRegions[p.region]);
    } else if constexpr (std::is_same_v<P, CopyBufferImage>) {
        const auto& region = r.bufferImageRegions[p.region];
        if (p.toImage)
            f.vkCmdCopyBufferToImage(commands_, p.buffer->handle, p.texture->handle,
                                     VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
        else
            f.vkCmdCopyImageToBuffer(commands_, p.texture->handle, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                     p.buffer->handle, 1, &region);
    } else if constexpr (std::is_same_v<P, CopyImage>) {
        f.vkCmdCopyImage(commands_, p.source->handle, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, p.destination->handle,
                         VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &r.imageRegions[p.region]);
    } else if constexpr (std::is_same_v<P, Fill>) {
        f.vkCmdFillBuffer(commands_, p.buffer->handle, p.offset, p.size, 0);
    } else if constexpr (std::is_same_v<P, Timestamp>) {
        resetQuery(*p.set, p.index);
        f.vkCmdWriteTimestamp2(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, p.set->handle, p.index);
        timestampOpen_ = p.begin && device_.toggles.barrierAfterBeginTimestamp;
    } else if constexpr (std::is_same_v<P, ResolveQueries>) {
        resolveQueries(p);
    } else {
        static_assert(std::is_same_v<P, Upload>);
        if (p.buffer != nullptr)
            f.vkCmdCopyBuffer(commands_, p.staging, p.buffer->handle, 1, &r.bufferRegions[p.region]);
        else
            f.vkCmdCopyBufferToImage(commands_, p.staging, p.texture->handle, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                                     &r.bufferImageRegions[p.region]);
    }
}

void Replay::run(const Recording& recording, CommandBuffer::Counters* counters) {
    recording_ = &recording;
    if (counters != nullptr) counters_ = *counters;
    counters_.barriers = 0;
    beginLabel(recording.label.c_str());
    for (const auto& packet : recording.packets) std::visit([this](const auto& p) { play(p); }, packet);
    endLabel();
    if (counters != nullptr) *counters = counters_;
}

void Replay::finish(TextureObject* present) {
    if (present != nullptr) {
        const Range all{0, present->state->mips, 0, present->state->layers};
        batch_.use(*present->state, present->handle, all, accessOf(UseKind::Present, 0, false));
    }
    flushBarriers();
    if (!hostReads_) return;
    // Waiting for the timeline does not make writes visible to the host; this does. It belongs to no command buffer.
    VkMemoryBarrier2 barrier = {VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
    VkDependencyInfo info = {VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.memoryBarrierCount = 1;
    info.pMemoryBarriers = &barrier;
    device_.functions.vkCmdPipelineBarrier2(commands_, &info);
}

}  // namespace pelage::rhi::detail
