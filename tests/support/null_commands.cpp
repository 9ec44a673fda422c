// SPDX-License-Identifier: MIT
// What command buffers are told, as accesses and barriers for the oracle.
#include "null_functions.hpp"

#include <atomic>
#include <cstring>

namespace pelage::test {

namespace {
template <class Handle>
std::uint64_t id(Handle handle) {
    return reinterpret_cast<std::uint64_t>(handle);
}
}  // namespace

/// One command of the stream: a barrier, or touches that belong together.
struct NullCommand {
    std::string where;
    std::vector<Touch> touches;
    bool barrier = false;
    std::vector<VkMemoryBarrier2> memory;
    std::vector<VkImageMemoryBarrier2> images;
};

struct NullDriver::Commands {
    NullDriver* driver = nullptr;
    std::uint64_t pool = 0;
    bool recording = false;
    std::vector<NullCommand> list;
    std::vector<std::string> labels;
    std::uint64_t pipelines[2] = {};  // graphics, compute
    std::map<std::uint32_t, std::pair<std::uint64_t, std::vector<std::uint32_t>>> sets[2];
    std::map<std::uint32_t, std::uint64_t> vertexBuffers;
    std::uint64_t indexBuffer = 0, scope = 0, count = 0;

    std::string where(const char* word) {
        std::string text;
        for (const auto& label : labels) text += label + " > ";
        return text + word + " #" + std::to_string(count++);
    }
    void add(const char* word, std::initializer_list<Touch> touches) {
        if (driver->keepCommands) list.push_back({where(word), touches, false, {}, {}});
    }
    void add(const char* word, std::vector<Touch>&& touches) {
        if (driver->keepCommands) list.push_back({where(word), std::move(touches), false, {}, {}});
    }
};

using F = NullDriver::Functions;

namespace {
NullDriver::Commands& of(VkCommandBuffer commands) {
    return *reinterpret_cast<NullDriver::Commands*>(commands);
}
Touch bufferTouch(std::uint64_t buffer, std::uint64_t begin, std::uint64_t end, VkPipelineStageFlags2 stage,
                  VkAccessFlags2 access, bool write) {
    Touch t;
    t.object = buffer;
    t.begin = begin;
    t.end = end;
    t.stages = stage;
    t.access = access;
    t.write = write;
    return t;
}
Touch imageTouch(std::uint64_t image, const VkImageSubresourceLayers& part, VkAccessFlags2 access, bool write,
                 VkImageLayout layout) {
    Touch t;
    t.object = image;
    t.mip = part.mipLevel;
    t.mips = 1;
    t.layer = part.baseArrayLayer;
    t.layers = part.layerCount;
    t.stages = VK_PIPELINE_STAGE_2_COPY_BIT;
    t.access = access;
    t.write = write;
    t.needsContents = !write;
    t.layout = layout;
    return t;
}
}  // namespace

VkResult F::vkCreateCommandPool(VkDevice device, const VkCommandPoolCreateInfo*, const VkAllocationCallbacks*,
                                VkCommandPool* out) {
    auto& d = *reinterpret_cast<NullDriver*>(device);
    const std::lock_guard lock(d.mutex_);
    if (const VkResult r = d.mayFail("vkCreateCommandPool"); r != VK_SUCCESS) return r;
    const auto handle = d.make("VkCommandPool");
    d.pools_[handle];
    *out = reinterpret_cast<VkCommandPool>(handle);
    return VK_SUCCESS;
}
void F::vkDestroyCommandPool(VkDevice device, VkCommandPool pool, const VkAllocationCallbacks*) {
    auto& d = *reinterpret_cast<NullDriver*>(device);
    const std::lock_guard lock(d.mutex_);
    d.destroy("VkCommandPool", id(pool));
    d.pools_.erase(id(pool));
}
VkResult F::vkResetCommandPool(VkDevice device, VkCommandPool pool, VkCommandPoolResetFlags) {
    auto& d = *reinterpret_cast<NullDriver*>(device);
    const std::lock_guard lock(d.mutex_);
    for (auto& c : d.pools_[id(pool)]) {
        c->list.clear();
        c->recording = false;
    }
    return VK_SUCCESS;
}
VkResult F::vkAllocateCommandBuffers(VkDevice device, const VkCommandBufferAllocateInfo* info, VkCommandBuffer* out) {
    auto& d = *reinterpret_cast<NullDriver*>(device);
    const std::lock_guard lock(d.mutex_);
    if (const VkResult r = d.mayFail("vkAllocateCommandBuffers"); r != VK_SUCCESS) return r;
    auto& list = d.pools_[id(info->commandPool)];
    list.push_back(std::make_shared<NullDriver::Commands>());
    list.back()->driver = &d;
    *out = reinterpret_cast<VkCommandBuffer>(list.back().get());
    return VK_SUCCESS;
}
VkResult F::vkBeginCommandBuffer(VkCommandBuffer commands, const VkCommandBufferBeginInfo*) {
    auto& c = of(commands);
    const std::lock_guard lock(c.driver->mutex_);
    if (const VkResult r = c.driver->mayFail("vkBeginCommandBuffer"); r != VK_SUCCESS) return r;
    if (c.recording) c.driver->misuse_.push_back("a command buffer is begun twice");
    c.recording = true;
    c.list.clear();
    c.count = 0;
    return VK_SUCCESS;
}
VkResult F::vkEndCommandBuffer(VkCommandBuffer commands) {
    auto& c = of(commands);
    const std::lock_guard lock(c.driver->mutex_);
    c.recording = false;
    return c.driver->mayFail("vkEndCommandBuffer");
}

VkResult F::vkQueueSubmit2(VkQueue queue, std::uint32_t count, const VkSubmitInfo2* infos, VkFence) {
    auto& d = *reinterpret_cast<NullDriver*>(queue);
    const std::lock_guard lock(d.mutex_);
    if (const VkResult r = d.mayFail("vkQueueSubmit2"); r != VK_SUCCESS) return r;
    ++d.submissions;
    for (std::uint32_t s = 0; s < count; ++s) {
        std::set<std::uint64_t> readback;
        for (std::uint32_t i = 0; i < infos[s].commandBufferInfoCount; ++i) {
            auto& c = of(infos[s].pCommandBufferInfos[i].commandBuffer);
            for (const auto& command : c.list) {
                if (d.oracle == nullptr) break;
                if (!command.barrier) {
                    for (const auto& touch : command.touches) {
                        d.oracle->touch(touch, command.where);
                        const auto b = d.buffers_.find(touch.object);
                        if (touch.write && b != d.buffers_.end() && d.memories_[b->second.memory].type == 2)
                            readback.insert(touch.object);
                    }
                    continue;
                }
                if (d.barrierCalls++ == d.dropBarrier) continue;
                VkDependencyInfo info = {VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
                info.memoryBarrierCount = static_cast<std::uint32_t>(command.memory.size());
                info.pMemoryBarriers = command.memory.data();
                info.imageMemoryBarrierCount = static_cast<std::uint32_t>(command.images.size());
                info.pImageMemoryBarriers = command.images.data();
                d.oracle->barrier(info, command.where);
            }
        }
        // The host waits for the submission and reads what it wrote to memory of the kind that is read back.
        if (d.oracle != nullptr)
            for (const auto buffer : readback) d.oracle->hostReads(buffer);
        for (std::uint32_t i = 0; i < infos[s].signalSemaphoreInfoCount; ++i) {
            const auto& signal = infos[s].pSignalSemaphoreInfos[i];
            if (d.holdSignals)
                d.heldSignals_.emplace_back(id(signal.semaphore), signal.value);
            else
                d.semaphores_[id(signal.semaphore)] = signal.value;
        }
    }
    return VK_SUCCESS;
}

void F::vkCmdBeginDebugUtilsLabelEXT(VkCommandBuffer commands, const VkDebugUtilsLabelEXT* label) {
    if (of(commands).driver->keepCommands) of(commands).labels.emplace_back(label->pLabelName);
}
void F::vkCmdEndDebugUtilsLabelEXT(VkCommandBuffer commands) {
    auto& labels = of(commands).labels;
    if (!labels.empty()) labels.pop_back();
}

void F::vkCmdPipelineBarrier2(VkCommandBuffer commands, const VkDependencyInfo* info) {
    auto& c = of(commands);
    if (!c.driver->keepCommands) return;
    NullCommand command;
    command.where = c.where("barrier");
    command.barrier = true;
    command.memory.assign(info->pMemoryBarriers, info->pMemoryBarriers + info->memoryBarrierCount);
    command.images.assign(info->pImageMemoryBarriers, info->pImageMemoryBarriers + info->imageMemoryBarrierCount);
    c.list.push_back(std::move(command));
}

void F::vkCmdBeginRendering(VkCommandBuffer commands, const VkRenderingInfo* info) {
    auto& c = of(commands);
    if (!c.driver->keepCommands) return;
    static std::atomic<std::uint64_t> scopes{0};
    c.scope = ++scopes;
    std::vector<Touch> touches;
    const auto attach = [&](std::uint64_t view, VkImageLayout layout, bool load, bool depth, bool readOnly) {
        const auto& v = c.driver->views_[view];
        Touch t;
        t.object = v.image;
        t.mip = v.range.baseMipLevel;
        t.mips = 1;
        t.layer = v.range.baseArrayLayer;
        t.layers = v.range.layerCount;
        t.stages = depth ? VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT
                         : VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
        t.write = !readOnly;
        t.access = depth ? VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT : VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT;
        if (t.write)
            t.access |= depth ? VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT : VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
        t.needsContents = load;
        t.layout = layout;
        touches.push_back(t);
    };
    for (std::uint32_t i = 0; i < info->colorAttachmentCount; ++i) {
        const auto& a = info->pColorAttachments[i];
        if (a.imageView == VK_NULL_HANDLE) continue;
        attach(id(a.imageView), a.imageLayout, a.loadOp == VK_ATTACHMENT_LOAD_OP_LOAD, false, false);
        if (a.resolveMode != VK_RESOLVE_MODE_NONE)
            attach(id(a.resolveImageView), a.resolveImageLayout, false, false, false);
    }
    if (const auto* a = info->pDepthAttachment; a != nullptr && a->imageView != VK_NULL_HANDLE) {
        const bool readOnly = a->imageLayout == VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL ||
                              a->imageLayout == VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL;
        attach(id(a->imageView), a->imageLayout, a->loadOp == VK_ATTACHMENT_LOAD_OP_LOAD, true, readOnly);
    }
    c.add("attachments", std::move(touches));
}
void F::vkCmdEndRendering(VkCommandBuffer commands) {
    of(commands).scope = 0;
}

void F::vkCmdBindPipeline(VkCommandBuffer commands, VkPipelineBindPoint point, VkPipeline pipeline) {
    of(commands).pipelines[point] = id(pipeline);
}
void F::vkCmdBindDescriptorSets(VkCommandBuffer commands, VkPipelineBindPoint point, VkPipelineLayout,
                                std::uint32_t first, std::uint32_t count, const VkDescriptorSet* sets,
                                std::uint32_t offsetCount, const std::uint32_t* offsets) {
    auto& c = of(commands);
    if (!c.driver->keepCommands) return;
    for (std::uint32_t i = 0; i < count; ++i)
        c.sets[point][first + i] = {id(sets[i]), std::vector<std::uint32_t>(offsets, offsets + offsetCount)};
}
void F::vkCmdBindVertexBuffers(VkCommandBuffer commands, std::uint32_t first, std::uint32_t count,
                               const VkBuffer* buffers, const VkDeviceSize*) {
    for (std::uint32_t i = 0; i < count; ++i) of(commands).vertexBuffers[first + i] = id(buffers[i]);
}
void F::vkCmdBindIndexBuffer(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize, VkIndexType) {
    of(commands).indexBuffer = id(buffer);
}
void F::vkCmdPushConstants(VkCommandBuffer, VkPipelineLayout, VkShaderStageFlags, std::uint32_t, std::uint32_t,
                           const void*) {}
void F::vkCmdSetViewport(VkCommandBuffer, std::uint32_t, std::uint32_t, const VkViewport*) {}
void F::vkCmdSetScissor(VkCommandBuffer, std::uint32_t, std::uint32_t, const VkRect2D*) {}
void F::vkCmdSetLineWidth(VkCommandBuffer, float) {}

std::vector<Touch> F::bindings(const NullDriver::Commands& c, VkPipelineBindPoint point) {
    std::vector<Touch> touches;
    auto& d = *c.driver;
    if (!d.keepCommands) return touches;
    const auto pipeline = d.pipelines_.find(c.pipelines[point]);
    if (pipeline == d.pipelines_.end()) return touches;
    for (const auto& [place, use] : pipeline->second) {
        const auto bound = c.sets[point].find(place.first);
        if (bound == c.sets[point].end()) continue;
        const auto set = d.sets_.find(bound->second.first);
        if (set == d.sets_.end()) continue;
        const auto found = set->second.descriptors.find(place.second);
        if (found == set->second.descriptors.end()) continue;
        const auto& descriptor = found->second;
        Touch t;
        t.stages = use.stages;
        t.write = use.writes;
        t.scope = c.scope;
        switch (descriptor.type) {
            case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER:
            case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC:
            case VK_DESCRIPTOR_TYPE_STORAGE_BUFFER:
            case VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC: {
                const bool uniform = descriptor.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER ||
                                     descriptor.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC;
                t.object = descriptor.object;
                // Dynamic offsets move the range; the whole buffer is a safe answer then.
                const bool moved = !bound->second.second.empty();
                t.begin = moved ? 0 : descriptor.offset;
                t.end = moved || descriptor.range == VK_WHOLE_SIZE ? ~0ULL : descriptor.offset + descriptor.range;
                t.access = uniform ? VK_ACCESS_2_UNIFORM_READ_BIT : VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
                break;
            }
            case VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE:
            case VK_DESCRIPTOR_TYPE_STORAGE_IMAGE: {
                const auto& view = d.views_[descriptor.object];
                t.object = view.image;
                t.mip = view.range.baseMipLevel;
                t.mips = view.range.levelCount;
                t.layer = view.range.baseArrayLayer;
                t.layers = view.range.layerCount;
                t.layout = descriptor.layout;
                t.needsContents = !use.writes;
                t.access = descriptor.type == VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE ? VK_ACCESS_2_SHADER_SAMPLED_READ_BIT
                                                                               : VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
                break;
            }
            default:
                continue;
        }
        if (t.write) t.access |= VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
        touches.push_back(t);
    }
    return touches;
}

void F::drawn(NullDriver::Commands& c, const char* word, std::initializer_list<Touch> more) {
    if (!c.driver->keepCommands) return;
    auto touches = bindings(c, VK_PIPELINE_BIND_POINT_GRAPHICS);
    for (const auto slot : c.driver->vertexBindings_[c.pipelines[VK_PIPELINE_BIND_POINT_GRAPHICS]])
        touches.push_back(bufferTouch(c.vertexBuffers[slot], 0, ~0ULL, VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT,
                                      VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT, false));
    touches.insert(touches.end(), more.begin(), more.end());
    c.add(word, std::move(touches));
}
void F::vkCmdDraw(VkCommandBuffer commands, std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t) {
    drawn(of(commands), "draw", {});
}
namespace {
Touch indices(const NullDriver::Commands& c) {
    return bufferTouch(c.indexBuffer, 0, ~0ULL, VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, VK_ACCESS_2_INDEX_READ_BIT, false);
}
Touch arguments(VkBuffer buffer) {
    return bufferTouch(id(buffer), 0, ~0ULL, VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                       VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, false);
}
}  // namespace
void F::vkCmdDrawIndexed(VkCommandBuffer commands, std::uint32_t, std::uint32_t, std::uint32_t, std::int32_t,
                         std::uint32_t) {
    drawn(of(commands), "drawIndexed", {indices(of(commands))});
}
void F::vkCmdDrawIndirect(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize, std::uint32_t, std::uint32_t) {
    drawn(of(commands), "drawIndirect", {arguments(buffer)});
}
void F::vkCmdDrawIndexedIndirect(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize, std::uint32_t,
                                 std::uint32_t) {
    drawn(of(commands), "drawIndexedIndirect", {indices(of(commands)), arguments(buffer)});
}
void F::vkCmdDispatch(VkCommandBuffer commands, std::uint32_t, std::uint32_t, std::uint32_t) {
    of(commands).add("dispatch", bindings(of(commands), VK_PIPELINE_BIND_POINT_COMPUTE));
}
void F::vkCmdDispatchIndirect(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize) {
    if (!of(commands).driver->keepCommands) return;
    auto touches = bindings(of(commands), VK_PIPELINE_BIND_POINT_COMPUTE);
    touches.push_back(arguments(buffer));
    of(commands).add("dispatchIndirect", std::move(touches));
}

namespace {
Touch copied(VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size, bool write) {
    return bufferTouch(id(buffer), offset, size == VK_WHOLE_SIZE ? ~0ULL : offset + size, VK_PIPELINE_STAGE_2_COPY_BIT,
                       write ? VK_ACCESS_2_TRANSFER_WRITE_BIT : VK_ACCESS_2_TRANSFER_READ_BIT, write);
}
}  // namespace
void F::vkCmdCopyBuffer(VkCommandBuffer commands, VkBuffer from, VkBuffer to, std::uint32_t, const VkBufferCopy* r) {
    of(commands).add("copyBuffer",
                     {copied(from, r->srcOffset, r->size, false), copied(to, r->dstOffset, r->size, true)});
}
void F::vkCmdCopyBufferToImage(VkCommandBuffer commands, VkBuffer from, VkImage to, VkImageLayout layout, std::uint32_t,
                               const VkBufferImageCopy* r) {
    of(commands).add("copyBufferToImage",
                     {copied(from, r->bufferOffset, 1, false),
                      imageTouch(id(to), r->imageSubresource, VK_ACCESS_2_TRANSFER_WRITE_BIT, true, layout)});
}
void F::vkCmdCopyImageToBuffer(VkCommandBuffer commands, VkImage from, VkImageLayout layout, VkBuffer to, std::uint32_t,
                               const VkBufferImageCopy* r) {
    of(commands).add("copyImageToBuffer",
                     {imageTouch(id(from), r->imageSubresource, VK_ACCESS_2_TRANSFER_READ_BIT, false, layout),
                      copied(to, 0, VK_WHOLE_SIZE, true)});
}
void F::vkCmdCopyImage(VkCommandBuffer commands, VkImage from, VkImageLayout fromLayout, VkImage to,
                       VkImageLayout toLayout, std::uint32_t, const VkImageCopy* r) {
    of(commands).add("copyImage",
                     {imageTouch(id(from), r->srcSubresource, VK_ACCESS_2_TRANSFER_READ_BIT, false, fromLayout),
                      imageTouch(id(to), r->dstSubresource, VK_ACCESS_2_TRANSFER_WRITE_BIT, true, toLayout)});
}
void F::vkCmdFillBuffer(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size,
                        std::uint32_t) {
    auto t = copied(buffer, offset, size, true);
    t.stages = VK_PIPELINE_STAGE_2_CLEAR_BIT;
    of(commands).add("fillBuffer", {t});
}
void F::vkCmdCopyQueryPoolResults(VkCommandBuffer commands, VkQueryPool, std::uint32_t, std::uint32_t count,
                                  VkBuffer buffer, VkDeviceSize offset, VkDeviceSize stride, VkQueryResultFlags) {
    of(commands).add("copyQueries", {copied(buffer, offset, count * stride, true)});
}
void F::vkCmdResetQueryPool(VkCommandBuffer, VkQueryPool, std::uint32_t, std::uint32_t) {}
void F::vkCmdWriteTimestamp2(VkCommandBuffer, VkPipelineStageFlags2, VkQueryPool, std::uint32_t) {}
void F::vkCmdBeginQuery(VkCommandBuffer, VkQueryPool, std::uint32_t, VkQueryControlFlags) {}
void F::vkCmdEndQuery(VkCommandBuffer, VkQueryPool, std::uint32_t) {}

}  // namespace pelage::test
