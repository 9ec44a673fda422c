// SPDX-License-Identifier: MIT
// Device memory: blocks per memory type, sub-allocated; large resources get memory of their own. Linear and optimal
// resources never share a block, so bufferImageGranularity is honoured without padding.
#pragma once

#include <pelage/rhi/error.hpp>

#include <memory>
#include <mutex>
#include <vector>

#include "blocks.hpp"
#include "vk.hpp"

namespace pelage::rhi::detail {

struct MemoryBlock;

enum class MemoryUse : std::uint8_t { Device, Upload, Readback };

struct Allocation {
    MemoryBlock* block = nullptr;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::uint64_t offset = 0, size = 0;
    std::byte* mapped = nullptr;  // host-visible memory stays mapped
};

struct MemoryCounters {
    std::uint64_t allocatedBytes = 0, usedBytes = 0;
    std::uint32_t allocations = 0, blocks = 0;
};

class MemoryAllocator {
public:
    MemoryAllocator();
    ~MemoryAllocator();
    MemoryAllocator(const MemoryAllocator&) = delete;
    MemoryAllocator& operator=(const MemoryAllocator&) = delete;

    void open(const DeviceFunctions* functions, VkDevice device, const VkPhysicalDeviceMemoryProperties& properties,
              const VkAllocationCallbacks* allocator);
    void close();
    Result<Allocation> allocate(const VkMemoryRequirements& requirements, MemoryUse use, bool optimalImage,
                                const std::string& object);
    void release(const Allocation& allocation);
    std::uint32_t typeOf(const Allocation& allocation) const;
    MemoryCounters counters() const;

private:
    Result<MemoryBlock*> addBlock(std::uint32_t type, bool optimalImage, std::uint64_t size, bool dedicated,
                                  const std::string& object);
    const DeviceFunctions* vk_ = nullptr;
    VkDevice device_ = VK_NULL_HANDLE;
    const VkAllocationCallbacks* allocator_ = nullptr;
    VkPhysicalDeviceMemoryProperties properties_ = {};
    mutable std::mutex mutex_;
    std::vector<std::unique_ptr<MemoryBlock>> blocks_;
    std::uint32_t allocations_ = 0;
};

}  // namespace pelage::rhi::detail
