// SPDX-License-Identifier: MIT
#include "tracking.hpp"

#include <algorithm>

namespace pelage::rhi::detail {

const char* name(UseKind kind) {
    switch (kind) {
        case UseKind::VertexBuffer:
            return "a vertex buffer";
        case UseKind::IndexBuffer:
            return "an index buffer";
        case UseKind::Indirect:
            return "the arguments of an indirect command";
        case UseKind::UniformBuffer:
            return "a uniform buffer";
        case UseKind::StorageBufferRead:
            return "a read-only storage buffer";
        case UseKind::StorageBufferWrite:
            return "a writable storage buffer";
        case UseKind::Sampled:
            return "a sampled texture";
        case UseKind::StorageTextureRead:
            return "a read-only storage texture";
        case UseKind::StorageTextureWrite:
            return "a writable storage texture";
        case UseKind::ColorAttachment:
            return "a colour attachment";
        case UseKind::ResolveTarget:
            return "a resolve target";
        case UseKind::DepthAttachment:
            return "a depth attachment";
        case UseKind::ReadOnlyDepth:
            return "a read-only depth attachment";
        case UseKind::CopySource:
            return "the source of a copy";
        case UseKind::CopyDestination:
            return "the destination of a copy";
        case UseKind::QueryResolve:
            return "the destination of a query resolve";
        case UseKind::Present:
            return "a presented texture";
    }
    return "";
}

bool isWrite(UseKind kind) {
    switch (kind) {
        case UseKind::StorageBufferWrite:
        case UseKind::StorageTextureWrite:
        case UseKind::ColorAttachment:
        case UseKind::ResolveTarget:
        case UseKind::DepthAttachment:
        case UseKind::CopyDestination:
        case UseKind::QueryResolve:
            return true;
        default:
            return false;
    }
}

Access accessOf(UseKind kind, VkPipelineStageFlags2 shaderStages, bool depthFormat) {
    constexpr auto depthStages =
        VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
    // One layout serves sampling and the read-only depth test, so that a pass may do both with one texture.
    constexpr auto depthRead = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
    constexpr auto none = VK_IMAGE_LAYOUT_UNDEFINED;
    switch (kind) {
        case UseKind::VertexBuffer:
            return {VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT, VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT, none, false};
        case UseKind::IndexBuffer:
            return {VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, VK_ACCESS_2_INDEX_READ_BIT, none, false};
        case UseKind::Indirect:
            return {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, none, false};
        case UseKind::UniformBuffer:
            return {shaderStages, VK_ACCESS_2_UNIFORM_READ_BIT, none, false};
        case UseKind::StorageBufferRead:
            return {shaderStages, VK_ACCESS_2_SHADER_STORAGE_READ_BIT, none, false};
        case UseKind::StorageBufferWrite:
            return {shaderStages, VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, none,
                    true};
        case UseKind::Sampled:
            return {shaderStages, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                    depthFormat ? depthRead : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, false};
        case UseKind::StorageTextureRead:
            return {shaderStages, VK_ACCESS_2_SHADER_STORAGE_READ_BIT, VK_IMAGE_LAYOUT_GENERAL, false};
        case UseKind::StorageTextureWrite:
            return {shaderStages, VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                    VK_IMAGE_LAYOUT_GENERAL, true};
        case UseKind::ColorAttachment:
        case UseKind::ResolveTarget:
            // Depth attachments resolve in the colour-attachment stage as well (Vulkan 1.3, "Render pass resolve").
            return {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
                    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, true};
        case UseKind::DepthAttachment:
            return {depthStages,
                    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
                    VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, true};
        case UseKind::ReadOnlyDepth:
            return {depthStages, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT, depthRead, false};
        case UseKind::CopySource:
            return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                    VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, false};
        case UseKind::CopyDestination:
        case UseKind::QueryResolve:
            return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                    VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, true};
        case UseKind::Present:
            return {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, false};
    }
    return {};
}

bool compatible(UseKind a, UseKind b, bool depthFormat) {
    if (isWrite(a) || isWrite(b))
        return a == b && (a == UseKind::StorageBufferWrite || a == UseKind::StorageTextureWrite);
    return accessOf(a, 0, depthFormat).layout == accessOf(b, 0, depthFormat).layout ||
           (a <= UseKind::StorageBufferRead && b <= UseKind::StorageBufferRead);
}

/// Moves the state over one use. True when a barrier is needed, which `transition` then describes.
bool BarrierBatch::step(AccessState& state, const Access& access, VkImageMemoryBarrier2& transition) {
    constexpr VkAccessFlags2 writes = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
                                      VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;
    const bool relayout = access.layout != state.layout;
    transition.oldLayout = state.layout;
    transition.newLayout = access.layout;
    transition.srcStageMask = state.writeStages | state.readStages;
    transition.srcAccessMask = state.writeAccess;
    transition.dstStageMask = access.stages;
    transition.dstAccessMask = access.access;
    const std::uint64_t now = log_ != nullptr ? log_->boundary() : 0;
    if (access.write || relayout) {
        const bool ordered =
            !relayout && log_ != nullptr &&
            (state.writeStages == 0 || log_->orders(state.wroteAt, state.writeStages, state.writeAccess, access)) &&
            (state.readStages == 0 || log_->orders(state.readAt, state.readStages, 0, {.stages = access.stages}));
        const bool needed = relayout || (transition.srcStageMask != 0 && !ordered);
        state = {.layout = access.layout, .writeStages = access.stages, .wroteAt = now, .readAt = now};
        if (access.write) {
            state.writeAccess = access.access & writes;
        } else {
            state.readStages = state.seenStages = access.stages;
            state.seenAccess = access.access;
        }
        return needed;
    }
    state.readStages |= access.stages;
    state.readAt = now;
    const bool visible = (access.stages & ~state.seenStages) == 0 && (access.access & ~state.seenAccess) == 0;
    if (state.writeStages == 0 || visible) return false;
    if (log_ != nullptr && log_->orders(state.wroteAt, state.writeStages, state.writeAccess, access)) return false;
    // The earlier readers are named again so that every stage read so far sees every access read so far.
    state.seenStages |= access.stages;
    state.seenAccess |= access.access;
    transition.srcStageMask = state.writeStages;
    transition.dstStageMask = state.seenStages;
    transition.dstAccessMask = state.seenAccess;
    return true;
}

void BarrierLog::note(const VkMemoryBarrier2& barrier) {
    const auto all = [](VkPipelineStageFlags2 stages) {
        return (stages & VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT) != 0
                   ? ~VkPipelineStageFlags2{VK_PIPELINE_STAGE_2_HOST_BIT}
                   : stages;
    };
    const auto every = [](VkAccessFlags2 access, VkAccessFlags2 words) {
        return (access & words) == words ? ~VkAccessFlags2{0} : access;
    };
    constexpr VkAccessFlags2 anyWrite = VK_ACCESS_2_MEMORY_WRITE_BIT,
                             anything = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    entries_[next_] = {boundary_, all(barrier.srcStageMask), all(barrier.dstStageMask),
                       every(barrier.srcAccessMask, anyWrite), every(barrier.dstAccessMask, anything)};
    next_ = (next_ + 1) % entries_.size();
}

bool BarrierLog::orders(std::uint64_t since, VkPipelineStageFlags2 stages, VkAccessFlags2 written,
                        const Access& access) const {
    return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& e) {
        return e.boundary > since && (stages & ~e.from) == 0 && (access.stages & ~e.to) == 0 &&
               (written & ~e.made) == 0 && (access.access & ~e.seen) == 0;
    });
}

void BarrierBatch::use(AccessState& state, const Access& access) {
    VkImageMemoryBarrier2 t = {};
    Access plain = access;
    plain.layout = state.layout;  // buffers have none
    if (!step(state, plain, t)) return;
    memory(t.srcStageMask, t.srcAccessMask, {t.dstStageMask, t.dstAccessMask, VK_IMAGE_LAYOUT_UNDEFINED, false});
}

void BarrierBatch::memory(VkPipelineStageFlags2 from, VkAccessFlags2 written, const Access& to) {
    memory_ = true;
    memoryBarrier_.srcStageMask |= from;
    memoryBarrier_.srcAccessMask |= written;
    memoryBarrier_.dstStageMask |= to.stages;
    memoryBarrier_.dstAccessMask |= to.access;
}

AccessState TextureState::history() const {
    AccessState all;
    for (const auto& s : states) {
        all.writeStages |= s.writeStages;
        all.readStages |= s.readStages;
        all.writeAccess |= s.writeAccess;
    }
    return all;
}

void TextureState::discard(VkPipelineStageFlags2 stages) {
    states.assign(1, AccessState{.writeStages = stages});
}

void BarrierBatch::use(TextureState& texture, VkImage image, const Range& range, const Access& access) {
    const auto emit = [&](AccessState& state, const Range& part) {
        VkImageMemoryBarrier2 t = {VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
        if (!step(state, access, t)) return;
        if (t.oldLayout == t.newLayout) {
            memory(t.srcStageMask, t.srcAccessMask, {t.dstStageMask, t.dstAccessMask, t.newLayout, false});
            return;
        }
        t.srcQueueFamilyIndex = t.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        t.image = image;
        t.subresourceRange = {texture.aspects, part.baseMip, part.mips, part.baseLayer, part.layers};
        // Subresources of one mip in one run of layers with one history share a barrier.
        if (!images_.empty()) {
            auto& last = images_.back();
            auto& r = last.subresourceRange;
            if (last.image == image && last.oldLayout == t.oldLayout && last.newLayout == t.newLayout &&
                last.srcStageMask == t.srcStageMask && last.srcAccessMask == t.srcAccessMask &&
                r.baseMipLevel == part.baseMip && r.levelCount == part.mips &&
                r.baseArrayLayer + r.layerCount == part.baseLayer) {
                r.layerCount += part.layers;
                return;
            }
        }
        images_.push_back(t);
    };
    const bool whole = range.mips == texture.mips && range.layers == texture.layers;
    if (texture.states.size() == 1 && whole) {
        emit(texture.states[0], range);
        return;
    }
    if (texture.states.size() == 1)
        texture.states.assign(std::size_t{texture.mips} * texture.layers, AccessState(texture.states[0]));
    for (std::uint32_t mip = range.baseMip; mip < range.baseMip + range.mips; ++mip)
        for (std::uint32_t layer = range.baseLayer; layer < range.baseLayer + range.layers; ++layer)
            emit(texture.states[std::size_t{mip} * texture.layers + layer], Range{mip, 1, layer, 1});
    const bool agree = std::all_of(texture.states.begin(), texture.states.end(),
                                   [&](const AccessState& s) { return s == texture.states[0]; });
    if (agree) texture.states.resize(1);
}

void BarrierBatch::full() {
    memory(VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT,
           {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
            VK_IMAGE_LAYOUT_UNDEFINED, false});
}

void BarrierBatch::clear() {
    if (log_ != nullptr) log_->nextBoundary();
    memory_ = false;
    memoryBarrier_ = {};
    images_.clear();
}

void BarrierBatch::record(VkCommandBuffer commands, PFN_vkCmdPipelineBarrier2 call) const {
    VkMemoryBarrier2 barrier = memoryBarrier_;
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
    VkDependencyInfo info = {VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.memoryBarrierCount = memory_ ? 1 : 0;
    info.pMemoryBarriers = &barrier;
    info.imageMemoryBarrierCount = static_cast<std::uint32_t>(images_.size());
    info.pImageMemoryBarriers = images_.data();
    call(commands, &info);
}

}  // namespace pelage::rhi::detail
