// SPDX-License-Identifier: MIT
// Queue::writeBuffer and writeTexture: the bytes are copied to staging memory at once, and the copies to where they
// belong are the first thing that the next submission does.
#include "device_object.hpp"
#include "recording.hpp"
#include "texel_copy.hpp"

#include <algorithm>
#include <cstring>

namespace pelage::rhi {
namespace detail {
namespace {

constexpr std::uint64_t chunkSize = 4ULL << 20;

struct Staged {
    VkBuffer buffer = VK_NULL_HANDLE;
    std::uint64_t offset = 0;
};

/// Room for the bytes in a chunk that no running submission reads. The queue's mutex is held.
Result<Staged> stage(DeviceObject& device, std::span<const std::byte> data) {
    auto& chunks = device.queue.staging;
    const std::uint64_t done = device.completed();
    StagingChunk* chosen = nullptr;
    for (auto& chunk : chunks) {
        if (chunk.value != 0 && chunk.value <= done) chunk.value = chunk.used = 0;
        const std::uint64_t start = (chunk.used + 15) & ~std::uint64_t{15};
        if (chunk.value == 0 && start + data.size() <= chunk.allocation.size && chosen == nullptr) chosen = &chunk;
    }
    // Chunks made for one large write are given back once they are idle.
    std::erase_if(chunks, [&](const StagingChunk& c) {
        if (c.allocation.size <= 2 * chunkSize || c.used != 0 || &c == chosen) return false;
        device.functions.vkDestroyBuffer(device.handle, c.buffer, device.allocator);
        device.memory.release(c.allocation);
        return true;
    });
    chosen = nullptr;
    for (auto& chunk : chunks) {
        const std::uint64_t start = (chunk.used + 15) & ~std::uint64_t{15};
        if (chunk.value == 0 && start + data.size() <= chunk.allocation.size) {
            chosen = &chunk;
            break;
        }
    }
    if (chosen == nullptr) {
        StagingChunk chunk;
        VkBufferCreateInfo info = {VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
        info.size = std::max<std::uint64_t>(chunkSize, data.size());
        info.usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
        const auto& f = device.functions;
        if (const auto r = f.vkCreateBuffer(device.handle, &info, device.allocator, &chunk.buffer); r != VK_SUCCESS)
            return forward(vulkanError(r, "vkCreateBuffer", "staging memory"));
        VkBufferMemoryRequirementsInfo2 query = {VK_STRUCTURE_TYPE_BUFFER_MEMORY_REQUIREMENTS_INFO_2};
        query.buffer = chunk.buffer;
        VkMemoryRequirements2 needs = {VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2};
        f.vkGetBufferMemoryRequirements2(device.handle, &query, &needs);
        auto memory = device.memory.allocate(needs.memoryRequirements, MemoryUse::Upload, false, "staging memory");
        if (!memory) {
            f.vkDestroyBuffer(device.handle, chunk.buffer, device.allocator);
            return forward(memory.error());
        }
        chunk.allocation = *memory;
        VkBindBufferMemoryInfo bind = {VK_STRUCTURE_TYPE_BIND_BUFFER_MEMORY_INFO};
        bind.buffer = chunk.buffer;
        bind.memory = memory->memory;
        bind.memoryOffset = memory->offset;
        if (const auto r = f.vkBindBufferMemory2(device.handle, 1, &bind); r != VK_SUCCESS) {
            f.vkDestroyBuffer(device.handle, chunk.buffer, device.allocator);
            device.memory.release(*memory);
            return forward(vulkanError(r, "vkBindBufferMemory2", "staging memory"));
        }
        device.nameObject(VK_OBJECT_TYPE_BUFFER, chunk.buffer, "staging");
        chunks.push_back(chunk);
        chosen = &chunks.back();
    }
    const std::uint64_t start = (chosen->used + 15) & ~std::uint64_t{15};
    std::memcpy(chosen->allocation.mapped + start, data.data(), data.size());
    chosen->used = start + data.size();
    return Staged{chosen->buffer, start};
}

/// Writes that touch different objects, or different bytes of one, share a scope and so need no barrier between them.
bool clashes(const Recording& uploads, const Use& use, const VkBufferCopy& region) {
    for (std::size_t i = uploads.packets.size(); i-- > 0;) {
        if (std::holds_alternative<packet::Scope>(uploads.packets[i])) return false;
        const auto& p = std::get<packet::Upload>(uploads.packets[i]);
        if (p.texture == use.object) return true;
        if (p.buffer != use.object) continue;
        const auto& other = uploads.bufferRegions[p.region];
        if (other.dstOffset < region.dstOffset + region.size && region.dstOffset < other.dstOffset + other.size)
            return true;
    }
    return true;  // there is no scope yet
}

void addUpload(Recording& uploads, const std::shared_ptr<Object>& object, const Use& use, const VkBufferCopy& region,
               packet::Upload upload) {
    uploads.keepWeakly(object);
    if (clashes(uploads, use, region))
        uploads.packets.push_back(packet::Scope{static_cast<std::uint32_t>(uploads.uses.size()), 0});
    for (std::size_t i = uploads.packets.size(); i-- > 0;) {
        auto* scope = std::get_if<packet::Scope>(&uploads.packets[i]);
        if (scope == nullptr) continue;
        const auto begin = uploads.uses.begin() + scope->first;
        const bool there = std::any_of(begin, uploads.uses.end(), [&](const Use& u) { return u.object == use.object; });
        if (!there) {
            uploads.uses.push_back(use);
            ++scope->count;
        }
        break;
    }
    uploads.packets.push_back(upload);
}

Result<void> writeBuffer(DeviceObject& device, const Buffer& buffer, std::uint64_t offset,
                         std::span<const std::byte> data) {
    if (auto ok = needHandle(buffer, "the destination of writeBuffer()"); !ok) return ok;
    auto& b = *buffer.get();
    if (auto ok = needSameDevice(b, device); !ok) return ok;
    if (auto ok = needUsage(b, BufferUsage::CopyDst, "writeBuffer()"); !ok) return ok;
    if (offset > b.descriptor.size || data.size() > b.descriptor.size - offset)
        return invalid(ErrorCode::OutOfRange,
                       cat("writeBuffer() writes the bytes ", offset, " … ", offset + data.size(), " of ", b.describe(),
                           ", which has ", b.descriptor.size, '.'));
    if (data.empty()) return {};
    const std::lock_guard lock(device.queue.mutex);
    if (device.lost)
        return fail(ErrorKind::DeviceLost, ErrorCode::DeviceLost, cat("[Device \"", device.label, "\"] was lost."));
    auto staged = stage(device, data);
    if (!staged) return forward(staged.error());
    packet::Upload upload;
    upload.staging = staged->buffer;
    upload.buffer = &b;
    const VkBufferCopy region = {staged->offset, offset, data.size()};
    auto& uploads = *device.queue.uploads;
    upload.region = static_cast<std::uint32_t>(uploads.bufferRegions.size());
    uploads.bufferRegions.push_back(region);
    addUpload(uploads, buffer.shared(), copyUse(b, UseKind::CopyDestination), region, upload);
    return {};
}

Result<void> writeTexture(DeviceObject& device, const TexelCopyTextureInfo& destination,
                          std::span<const std::byte> data, const TexelCopyBufferLayout& layout, const Extent3D& size) {
    if (auto ok = needHandle(destination.texture, "the destination of writeTexture()"); !ok) return ok;
    auto& t = *destination.texture.get();
    if (auto ok = needSameDevice(t, device); !ok) return ok;
    if (auto ok = needUsage(t, TextureUsage::CopyDst, "writeTexture()"); !ok) return ok;
    // The offset skips bytes of `data`; in staging memory the texels start at a boundary of 16.
    if (layout.offset > data.size())
        return invalid(ErrorCode::OutOfRange,
                       cat("writeTexture() starts at byte ", layout.offset, "; the data has ", data.size(), " bytes."));
    const auto texels = data.subspan(layout.offset);
    auto region = texelCopy(destination, {0, layout.bytesPerRow, layout.rowsPerImage}, size, texels.size(), "the data");
    if (!region) return forward(region.error());
    const std::lock_guard lock(device.queue.mutex);
    if (device.lost)
        return fail(ErrorKind::DeviceLost, ErrorCode::DeviceLost, cat("[Device \"", device.label, "\"] was lost."));
    auto staged = stage(device, texels);
    if (!staged) return forward(staged.error());
    region->bufferOffset = staged->offset;
    auto& uploads = *device.queue.uploads;
    uploads.bufferImageRegions.push_back(*region);
    packet::Upload upload;
    upload.staging = staged->buffer;
    upload.texture = &t;
    upload.region = static_cast<std::uint32_t>(uploads.bufferImageRegions.size() - 1);
    addUpload(uploads, destination.texture.shared(), copyUse(t, region->imageSubresource, UseKind::CopyDestination), {},
              upload);
    return {};
}

}  // namespace

}  // namespace detail

Result<void> Queue::writeBuffer(const Buffer& buffer, std::uint64_t offset, std::span<const std::byte> data) {
    if (!device_) return detail::invalid(ErrorCode::InvalidHandle, "writeBuffer() was called on an empty queue.");
    return device_->reported(detail::writeBuffer(*device_, buffer, offset, data));
}

Result<void> Queue::writeTexture(const TexelCopyTextureInfo& destination, std::span<const std::byte> data,
                                 const TexelCopyBufferLayout& layout, const Extent3D& size) {
    if (!device_) return detail::invalid(ErrorCode::InvalidHandle, "writeTexture() was called on an empty queue.");
    return device_->reported(detail::writeTexture(*device_, destination, data, layout, size));
}

}  // namespace pelage::rhi
