// SPDX-License-Identifier: MIT
#include "memory.hpp"

#include <algorithm>

#include "text.hpp"

namespace pelage::rhi::detail {

namespace {
constexpr std::uint64_t deviceBlock = 64ULL << 20, hostBlock = 16ULL << 20;

/// Memory types in the order of preference for a use.
std::optional<std::uint32_t> chooseType(const VkPhysicalDeviceMemoryProperties& properties, std::uint32_t allowed,
                                        MemoryUse use) {
    constexpr VkMemoryPropertyFlags device = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    constexpr VkMemoryPropertyFlags host = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    constexpr VkMemoryPropertyFlags cached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    const std::pair<VkMemoryPropertyFlags, VkMemoryPropertyFlags> wishes[3][2] = {
        {{device, 0}, {0, 0}}, {{host, cached}, {host, 0}}, {{host | cached, 0}, {host, 0}}};
    for (const auto& [with, without] : wishes[static_cast<std::size_t>(use)])
        for (std::uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
            const auto flags = properties.memoryTypes[i].propertyFlags;
            if ((allowed >> i & 1) != 0 && (flags & with) == with && (flags & without) == 0) return i;
        }
    return std::nullopt;
}
}  // namespace

struct MemoryBlock {
    MemoryBlock(std::uint64_t size) : list(size) {}
    FreeList list;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::byte* mapped = nullptr;
    std::uint32_t type = 0;
    bool optimalImage = false, dedicated = false;
};

MemoryAllocator::MemoryAllocator() = default;
MemoryAllocator::~MemoryAllocator() = default;

void MemoryAllocator::open(const DeviceFunctions* functions, VkDevice device,
                           const VkPhysicalDeviceMemoryProperties& properties, const VkAllocationCallbacks* allocator) {
    vk_ = functions;
    device_ = device;
    allocator_ = allocator;
    properties_ = properties;
}

void MemoryAllocator::close() {
    for (const auto& block : blocks_) vk_->vkFreeMemory(device_, block->memory, allocator_);
    blocks_.clear();
}

Result<MemoryBlock*> MemoryAllocator::addBlock(std::uint32_t type, bool optimalImage, std::uint64_t size,
                                               bool dedicated, const std::string& object) {
    auto block = std::make_unique<MemoryBlock>(size);
    block->type = type;
    block->optimalImage = optimalImage;
    block->dedicated = dedicated;
    VkMemoryAllocateInfo info = {VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, size, type};
    if (const auto r = vk_->vkAllocateMemory(device_, &info, allocator_, &block->memory); r != VK_SUCCESS)
        return forward(vulkanError(r, cat("vkAllocateMemory of ", size, " bytes"), object));
    if ((properties_.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0) {
        void* pointer = nullptr;
        if (const auto r = vk_->vkMapMemory(device_, block->memory, 0, VK_WHOLE_SIZE, 0, &pointer); r != VK_SUCCESS) {
            vk_->vkFreeMemory(device_, block->memory, allocator_);
            return forward(vulkanError(r, "vkMapMemory", object));
        }
        block->mapped = static_cast<std::byte*>(pointer);
    }
    blocks_.push_back(std::move(block));
    return blocks_.back().get();
}

Result<Allocation> MemoryAllocator::allocate(const VkMemoryRequirements& requirements, MemoryUse use, bool optimalImage,
                                             const std::string& object) {
    const auto type = chooseType(properties_, requirements.memoryTypeBits, use);
    const auto fallback = type ? type : chooseType(properties_, requirements.memoryTypeBits, MemoryUse::Upload);
    if (!fallback)
        return fail(ErrorKind::OutOfMemory, ErrorCode::OutOfMemory, cat(object, " fits none of the memory types."));
    const std::lock_guard lock(mutex_);
    const std::uint64_t blockSize = use == MemoryUse::Device ? deviceBlock : hostBlock;
    MemoryBlock* chosen = nullptr;
    std::optional<std::uint64_t> offset;
    const bool dedicated = requirements.size > blockSize / 4;
    if (!dedicated)
        for (const auto& block : blocks_) {
            if (block->type != *fallback || block->optimalImage != optimalImage || block->dedicated) continue;
            offset = block->list.allocate(requirements.size, requirements.alignment);
            if (!offset) continue;
            chosen = block.get();
            break;
        }
    if (chosen == nullptr) {
        auto block = addBlock(*fallback, optimalImage, dedicated ? requirements.size : blockSize, dedicated, object);
        if (!block) return forward(block.error());
        chosen = *block;
        offset = chosen->list.allocate(requirements.size, requirements.alignment);
    }
    ++allocations_;
    return Allocation{chosen, chosen->memory, *offset, requirements.size,
                      chosen->mapped != nullptr ? chosen->mapped + *offset : nullptr};
}

void MemoryAllocator::release(const Allocation& allocation) {
    if (allocation.block == nullptr) return;
    const std::lock_guard lock(mutex_);
    --allocations_;
    MemoryBlock* block = allocation.block;
    block->list.release(allocation.offset);
    if (!block->list.empty()) return;
    // One empty block of a kind is kept: creating and dropping one resource per frame must not reach the driver.
    const bool another = std::any_of(blocks_.begin(), blocks_.end(), [&](const auto& b) {
        return b.get() != block && b->type == block->type && b->optimalImage == block->optimalImage && !b->dedicated &&
               b->list.empty();
    });
    if (!block->dedicated && !another) return;
    vk_->vkFreeMemory(device_, block->memory, allocator_);
    std::erase_if(blocks_, [&](const auto& b) { return b.get() == block; });
}

std::uint32_t MemoryAllocator::typeOf(const Allocation& allocation) const {
    return allocation.block->type;
}

MemoryCounters MemoryAllocator::counters() const {
    const std::lock_guard lock(mutex_);
    MemoryCounters c;
    for (const auto& block : blocks_) {
        c.allocatedBytes += block->list.size();
        c.usedBytes += block->list.used();
    }
    c.allocations = allocations_;
    c.blocks = static_cast<std::uint32_t>(blocks_.size());
    return c;
}

}  // namespace pelage::rhi::detail
