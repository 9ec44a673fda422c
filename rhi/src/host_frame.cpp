// SPDX-License-Identifier: MIT
// A host's images, buffers and command buffers: wrapped, brought from the state in which they come to the one in which
// they are wanted back, and recorded into without a submission.
#include "device_object.hpp"
#include "features.hpp"
#include "recording.hpp"

namespace pelage::rhi {
namespace detail {
namespace {

constexpr VkAccessFlags2 writeAccess = VK_ACCESS_2_SHADER_WRITE_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT |
                                       VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
                                       VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT |
                                       VK_ACCESS_2_HOST_WRITE_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;

/// The host's last use as if it were a write just now: the next use waits for it and sees what it wrote.
AccessState stateFrom(const DeviceObject& device, VkImageLayout layout, VkPipelineStageFlags2 stages,
                      VkAccessFlags2 access) {
    return {.layout = layout,
            .writeStages = stages,
            .writeAccess = access & writeAccess,
            .wroteAt = device.queue.barriers.boundary()};
}

template <class Shared, class... What>
Result<void> check(const DeviceObject& device, const Shared& handle, const What&... what) {
    if (!handle) return invalid(ErrorCode::InvalidHandle, cat("An empty handle was given for ", what..., '.'));
    return needSameDevice(*handle.get(), device);
}

Result<vulkan::Ticket> record(DeviceObject& device, VkCommandBuffer commands,
                              std::span<const CommandBuffer> commandBuffers,
                              std::span<const vulkan::SharedTexture> textures,
                              std::span<const vulkan::SharedBuffer> buffers) {
    if (commands == VK_NULL_HANDLE)
        return invalid(ErrorCode::InvalidHandle, "An empty handle was given for the command buffer of encodeInto().");
    for (const auto& t : textures)
        if (auto ok = check(device, t.texture, "a shared texture of encodeInto()"); !ok) return forward(ok.error());
    for (const auto& b : buffers)
        if (auto ok = check(device, b.buffer, "a shared buffer of encodeInto()"); !ok) return forward(ok.error());
    const std::lock_guard lock(device.queue.mutex);
    if (device.lost) return forward(lostError(device));
    if (auto ok = checkBuffers(device, commandBuffers); !ok) return forward(ok.error());
    for (const auto& t : textures)
        t.texture.get()->state->states.assign(1, stateFrom(device, t.before.layout, t.before.stages, t.before.access));
    for (const auto& b : buffers)
        b.buffer.get()->state = stateFrom(device, VK_IMAGE_LAYOUT_UNDEFINED, b.before.stages, b.before.access);
    const std::uint64_t value = device.queue.submitted + 1;
    Replay replay(device, commands);
    replayAll(device, replay, commandBuffers);
    for (const auto& t : textures) {
        auto& texture = *t.texture.get();
        texture.markUsed(value);
        const auto layout = t.after.layout;
        if (layout == VK_IMAGE_LAYOUT_UNDEFINED) continue;
        // As a write: whatever the host does next waits for our readers as well.
        replay.handOver(texture, {t.after.stages, t.after.access, layout, true});
    }
    for (const auto& b : buffers) {
        b.buffer.get()->markUsed(value);
        replay.handOver(*b.buffer.get(), {b.after.stages, b.after.access, VK_IMAGE_LAYOUT_UNDEFINED, true});
    }
    replay.finish(nullptr);
    device.began(value, true);
    markSent(device, value, commandBuffers);
    return vulkan::Ticket{value};
}

}  // namespace

void Replay::handOver(TextureObject& texture, const Access& access) {
    const Range all{0, texture.state->mips, 0, texture.state->layers};
    batch_.use(*texture.state, texture.handle, all, access);
}

void Replay::handOver(BufferObject& buffer, const Access& access) {
    batch_.use(buffer.state, access);
}

}  // namespace detail

namespace vulkan {

Result<Texture> wrapImage(const Device& device, VkImage image, const TextureDescriptor& descriptor,
                          std::function<void()> onRelease) {
    if (auto ok = detail::needHandle(device, "the device"); !ok) return detail::forward(ok.error());
    if (image == VK_NULL_HANDLE)
        return device.get()->reported<Texture>(
            detail::invalid(ErrorCode::InvalidHandle, "An empty handle was given for the image of wrapImage()."));
    auto object = std::make_shared<detail::TextureObject>(device.shared(), "Texture", descriptor.label);
    object->descriptor = descriptor;
    if (auto ok = detail::checkDescriptor(*object); !ok)
        return device.get()->reported<Texture>(detail::forward(ok.error()));
    object->handle = image;
    object->ownsImage = false;
    object->onRelease = std::move(onRelease);
    object->state->mips = descriptor.mipLevelCount;
    object->state->layers = object->layers();
    object->state->aspects = detail::aspectsOf(descriptor.format);
    return Texture(std::move(object));
}

Result<Buffer> wrapBuffer(const Device& device, VkBuffer buffer, const BufferDescriptor& descriptor,
                          std::function<void()> onRelease) {
    if (auto ok = detail::needHandle(device, "the device"); !ok) return detail::forward(ok.error());
    auto object = std::make_shared<detail::BufferObject>(device.shared(), "Buffer", descriptor.label);
    if (buffer == VK_NULL_HANDLE || descriptor.size == 0 || descriptor.usage == BufferUsage::None)
        return device.get()->reported<Buffer>(
            detail::invalid(ErrorCode::InvalidHandle,
                            detail::cat(object->describe(), " wraps an empty handle or states no size or usage.")));
    if (any(descriptor.usage & (BufferUsage::MapRead | BufferUsage::MapWrite)))
        return device.get()->reported<Buffer>(detail::invalid(
            ErrorCode::InvalidUsage, detail::cat(object->describe(),
                                                 " is a host's; the host maps it, so MapRead and MapWrite do "
                                                 "not belong here.")));
    object->descriptor = descriptor;
    object->handle = buffer;
    object->ownsBuffer = false;
    object->onRelease = std::move(onRelease);
    return Buffer(std::move(object));
}

Result<Ticket> encodeInto(const Device& device, VkCommandBuffer commands, std::span<const CommandBuffer> commandBuffers,
                          std::span<const SharedTexture> textures, std::span<const SharedBuffer> buffers) {
    if (auto ok = detail::needHandle(device, "the device"); !ok) return detail::forward(ok.error());
    auto ticket = detail::record(*device.get(), commands, commandBuffers, textures, buffers);
    device.get()->collect();
    return device.get()->reported(std::move(ticket));
}

void finished(const Device& device, Ticket ticket) {
    if (!device) return;
    device.get()->finishTicket(ticket.value);
    device.get()->collect();
}

}  // namespace vulkan
}  // namespace pelage::rhi
