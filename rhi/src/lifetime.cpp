// SPDX-License-Identifier: MIT
// How objects end: what the queue may still use waits in the graveyard for its timeline value.
#include "device_object.hpp"
#include "pipeline_cache.hpp"
#include "recording.hpp"

#include <algorithm>

namespace pelage::rhi {
namespace detail {

DeviceObject::~DeviceObject() {
    if (handle == VK_NULL_HANDLE) return;
    const auto& f = functions;
    if (f.vkDeviceWaitIdle != nullptr && queue.timeline != VK_NULL_HANDLE) {
        {
            const HostLock lock(queue);
            drain();
        }
        queue.uploads.reset();  // writes that no submission carried are dropped
        while (!graves.empty()) {
            auto grave = std::move(graves.front());
            graves.pop_front();
            grave.destroy(*this);
        }
        for (auto* slots : {&queue.running, &queue.idle})
            for (const auto& slot : *slots) f.vkDestroyCommandPool(handle, slot.pool, allocator);
        for (const auto& chunk : queue.staging) {
            f.vkDestroyBuffer(handle, chunk.buffer, allocator);
            memory.release(chunk.allocation);
        }
        for (auto* pool : pools) f.vkDestroyDescriptorPool(handle, pool, allocator);
        storePipelineCache(*this);
        if (pipelineCache != VK_NULL_HANDLE && !hostPipelineCache)
            f.vkDestroyPipelineCache(handle, pipelineCache, allocator);
        f.vkDestroySemaphore(handle, queue.timeline, allocator);
        memory.close();
    }
    if (!adopted && f.vkDestroyDevice != nullptr) f.vkDestroyDevice(handle, nullptr);
    if (onRelease) onRelease();
}

void DeviceObject::drain() const {
    // A host's device may have queues that other threads use right now; only this one is locked.
    if (adopted)
        functions.vkQueueWaitIdle(queue.handle);
    else
        functions.vkDeviceWaitIdle(handle);
}

void DeviceObject::bury(std::uint64_t value, std::function<void(DeviceObject&)> destroy) {
    if (value <= knownCompleted.load(std::memory_order_relaxed)) {
        destroy(*this);
        return;
    }
    const std::lock_guard lock(graveMutex);
    graves.push_back({value, std::move(destroy)});
}

void DeviceObject::began(std::uint64_t value, bool ticket) {
    const std::lock_guard lock(timelineMutex);
    (ticket ? openTickets : openSubmissions).push_back(value);
    lastBegun = value;
}

void DeviceObject::finishTicket(std::uint64_t value) {
    const std::lock_guard lock(timelineMutex);
    std::erase(openTickets, value);
}

std::uint64_t DeviceObject::completed() {
    std::uint64_t signalled = 0;
    if (const auto r = functions.vkGetSemaphoreCounterValue(handle, queue.timeline, &signalled); r != VK_SUCCESS) {
        if (r == VK_ERROR_DEVICE_LOST && !lost) report(vulkanError(r, "vkGetSemaphoreCounterValue", "the queue"));
        return knownCompleted;  // out of memory: nothing new is known, and a caller that waits asks again
    }
    // Everything before the oldest that may still run is done.
    const std::lock_guard lock(timelineMutex);
    std::erase_if(openSubmissions, [&](std::uint64_t v) { return v <= signalled; });
    std::uint64_t done = lastBegun;
    if (!openSubmissions.empty()) done = std::min(done, openSubmissions.front() - 1);
    if (!openTickets.empty()) done = std::min(done, openTickets.front() - 1);
    if (done > knownCompleted) knownCompleted = done;
    return knownCompleted;
}

void DeviceObject::collect() {
    const std::uint64_t value = completed();
    std::vector<Grave> ready;
    {
        const std::lock_guard lock(graveMutex);
        // Values arrive nearly in order; a later one only delays those behind it by a little.
        while (!graves.empty() && graves.front().value <= value) {
            ready.push_back(std::move(graves.front()));
            graves.pop_front();
        }
    }
    for (auto& grave : ready) grave.destroy(*this);
}

void DeviceObject::nameObject(VkObjectType type, std::uint64_t object, const std::string& text) const {
    const auto& instance = *adapter->instance;
    if (!instance.debugUtils || instance.vk.vkSetDebugUtilsObjectNameEXT == nullptr || text.empty()) return;
    VkDebugUtilsObjectNameInfoEXT named = {VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT};
    named.objectType = type;
    named.objectHandle = object;
    named.pObjectName = text.c_str();
    instance.vk.vkSetDebugUtilsObjectNameEXT(handle, &named);
}

Result<std::pair<VkDescriptorSet, VkDescriptorPool>> DeviceObject::allocateSet(VkDescriptorSetLayout layout,
                                                                               const std::string& object) {
    const std::lock_guard lock(poolMutex);
    VkDescriptorSetAllocateInfo allocate = {VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &layout;
    VkDescriptorSet set = VK_NULL_HANDLE;
    for (std::size_t i = pools.size(); i-- > 0;) {
        allocate.descriptorPool = pools[i];
        const auto r = functions.vkAllocateDescriptorSets(handle, &allocate, &set);
        if (r == VK_SUCCESS) return std::pair(set, pools[i]);
        if (r != VK_ERROR_OUT_OF_POOL_MEMORY && r != VK_ERROR_FRAGMENTED_POOL)
            return forward(vulkanError(r, "vkAllocateDescriptorSets", object));
    }
    constexpr std::uint32_t sets = 256;
    const VkDescriptorPoolSize sizes[] = {
        {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, sets * 4}, {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, sets},
        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, sets * 8}, {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC, sets},
        {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, sets * 8},  {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, sets * 4},
        {VK_DESCRIPTOR_TYPE_SAMPLER, sets * 4}};
    VkDescriptorPoolCreateInfo pool = {VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    pool.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
    pool.maxSets = sets;
    pool.poolSizeCount = static_cast<std::uint32_t>(std::size(sizes));
    pool.pPoolSizes = sizes;
    if (const auto r = functions.vkCreateDescriptorPool(handle, &pool, allocator, &allocate.descriptorPool);
        r != VK_SUCCESS)
        return forward(vulkanError(r, "vkCreateDescriptorPool", object));
    pools.push_back(allocate.descriptorPool);
    if (const auto r = functions.vkAllocateDescriptorSets(handle, &allocate, &set); r != VK_SUCCESS)
        return forward(vulkanError(r, "vkAllocateDescriptorSets", object));
    return std::pair(set, allocate.descriptorPool);
}

void DeviceObject::freeSet(VkDescriptorSet set, VkDescriptorPool pool) {
    const std::lock_guard lock(poolMutex);
    functions.vkFreeDescriptorSets(handle, pool, 1, &set);
}

}  // namespace detail

void Device::collect() const {
    if (object_) object_->collect();
}

}  // namespace pelage::rhi
