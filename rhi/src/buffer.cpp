// SPDX-License-Identifier: MIT
#include "device_object.hpp"

namespace pelage::rhi {
namespace detail {

BufferObject::~BufferObject() {
    if (handle == VK_NULL_HANDLE) return;
    if (!ownsBuffer) {
        if (onRelease) device->bury(lastUse, [tell = std::move(onRelease)](DeviceObject&) { tell(); });
        return;
    }
    --device->liveBuffers;
    device->bury(lastUse, [buffer = handle, memory = allocation](DeviceObject& d) {
        d.functions.vkDestroyBuffer(d.handle, buffer, d.allocator);
        d.memory.release(memory);
    });
}

namespace {
Result<Buffer> makeBuffer(const std::shared_ptr<DeviceObject>& device, const BufferDescriptor& descriptor) {
    auto object = std::make_shared<BufferObject>(device, "Buffer", descriptor.label);
    object->descriptor = descriptor;
    const auto& limits = device->info.limits;
    if (descriptor.size == 0)
        return invalid(ErrorCode::InvalidSize, cat(object->describe(), " has size 0; a buffer holds at least 1 byte."));
    if (descriptor.size > limits.maxBufferSize)
        return invalid(ErrorCode::InvalidSize,
                       cat(object->describe(), " has size ", descriptor.size, ", which is above the device's limit of ",
                           limits.maxBufferSize, '.'));
    if (descriptor.usage == BufferUsage::None)
        return invalid(ErrorCode::InvalidUsage, cat(object->describe(), " has no usage; at least one is needed."));
    const bool read = contains(descriptor.usage, BufferUsage::MapRead);
    const bool write = contains(descriptor.usage, BufferUsage::MapWrite);
    if (descriptor.mappedAtCreation && !read && !write)
        return invalid(ErrorCode::NotMapped, cat(object->describe(), " is to be mapped at creation and has usage ",
                                                 usageNames(descriptor.usage), "; MapRead or MapWrite is needed."));
    VkBufferCreateInfo info = {VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    // Fills and 4-byte copies may touch the last word.
    info.size = (descriptor.size + 3) & ~std::uint64_t{3};
    info.usage = toVk(descriptor.usage);
    const auto& vk = device->functions;
    VkBuffer buffer = VK_NULL_HANDLE;
    if (const auto r = vk.vkCreateBuffer(device->handle, &info, device->allocator, &buffer); r != VK_SUCCESS)
        return forward(vulkanError(r, "vkCreateBuffer", object->describe()));
    VkBufferMemoryRequirementsInfo2 query = {VK_STRUCTURE_TYPE_BUFFER_MEMORY_REQUIREMENTS_INFO_2};
    query.buffer = buffer;
    VkMemoryRequirements2 needs = {VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2};
    vk.vkGetBufferMemoryRequirements2(device->handle, &query, &needs);
    const auto use = read ? MemoryUse::Readback : write ? MemoryUse::Upload : MemoryUse::Device;
    auto memory = device->memory.allocate(needs.memoryRequirements, use, false, object->describe());
    if (!memory) {
        vk.vkDestroyBuffer(device->handle, buffer, device->allocator);
        return forward(memory.error());
    }
    VkBindBufferMemoryInfo bind = {VK_STRUCTURE_TYPE_BIND_BUFFER_MEMORY_INFO};
    bind.buffer = buffer;
    bind.memory = memory->memory;
    bind.memoryOffset = memory->offset;
    if (const auto r = vk.vkBindBufferMemory2(device->handle, 1, &bind); r != VK_SUCCESS) {
        vk.vkDestroyBuffer(device->handle, buffer, device->allocator);
        device->memory.release(*memory);
        return forward(vulkanError(r, "vkBindBufferMemory2", object->describe()));
    }
    object->handle = buffer;
    object->allocation = *memory;
    ++device->liveBuffers;
    device->nameObject(VK_OBJECT_TYPE_BUFFER, buffer, descriptor.label);
    return Buffer(std::move(object));
}
}  // namespace
}  // namespace detail

Result<Buffer> Device::createBuffer(const BufferDescriptor& descriptor) const {
    if (auto ok = detail::needHandle(*this, "the device"); !ok) return detail::forward(ok.error());
    return object_->reported(detail::makeBuffer(object_, descriptor));
}

const std::string& Buffer::label() const {
    return object_->label;
}
std::uint64_t Buffer::size() const {
    return object_->descriptor.size;
}
BufferUsage Buffer::usage() const {
    return object_->descriptor.usage;
}
Result<void> Buffer::mapAsync(std::function<void(std::span<std::byte>)> ready) const {
    if (auto ok = detail::needHandle(*this, "the buffer"); !ok) return ok;
    auto& device = *object_->device;
    if (mapped().empty())
        return device.reported<void>(detail::invalid(
            ErrorCode::NotMapped,
            detail::cat(object_->describe(), " has the usage ", detail::usageNames(object_->descriptor.usage),
                        "; MapRead or MapWrite is needed for mapAsync().")));
    // The device holds this callback, so the callback must not hold a buffer, which holds the device.
    device.bury(object_->lastUse, [buffer = std::weak_ptr(object_), tell = std::move(ready)](detail::DeviceObject& d) {
        if (const auto alive = buffer.lock()) tell(d.lost ? std::span<std::byte>() : Buffer(alive).mapped());
    });
    return {};
}
std::span<std::byte> Buffer::mapped() const {
    if (!object_ || !any(object_->descriptor.usage & (BufferUsage::MapRead | BufferUsage::MapWrite))) return {};
    return {object_->allocation.mapped, object_->descriptor.size};
}

}  // namespace pelage::rhi
