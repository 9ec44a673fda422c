// SPDX-License-Identifier: MIT
// Presenting to a window. Each swapchain image has its own semaphores: one is free again exactly when its image is.
#include "surface_object.hpp"

#include <pelage/rhi/vulkan.hpp>

#include <algorithm>

namespace pelage::rhi {
namespace detail {

SurfaceObject::~SurfaceObject() {
    release();
    if (handle != VK_NULL_HANDLE) instance->vk.vkDestroySurfaceKHR(instance->handle, handle, nullptr);
}

bool SurfaceObject::supports(const AdapterObject& adapter) const {
    if (instance->vk.vkGetPhysicalDeviceSurfaceSupportKHR == nullptr || !adapter.swapchain) return false;
    VkBool32 yes = VK_FALSE;
    instance->vk.vkGetPhysicalDeviceSurfaceSupportKHR(adapter.handle, adapter.queueFamily, handle, &yes);
    return yes != VK_FALSE;
}

void SurfaceObject::release() {
    if (!device || swapchain == VK_NULL_HANDLE) return;
    const auto& f = device->functions;
    const std::lock_guard lock(device->queue.mutex);
    // Presentation has no fence of its own, so the device is drained; this happens on resize and at the end.
    {
        const HostLock hostLock(device->queue);
        device->drain();
    }
    std::erase_if(device->queue.acquired, [&](const VkSemaphoreSubmitInfo& info) {
        return std::any_of(images.begin(), images.end(), [&](const Image& i) { return i.acquired == info.semaphore; });
    });
    for (auto& image : images) {
        if (image.texture) image.texture->handle = VK_NULL_HANDLE;  // a texture kept by the host has lost its image
        f.vkDestroySemaphore(device->handle, image.acquired, device->allocator);
        f.vkDestroySemaphore(device->handle, image.rendered, device->allocator);
    }
    f.vkDestroySemaphore(device->handle, spare, device->allocator);
    f.vkDestroySwapchainKHR(device->handle, swapchain, device->allocator);
    images.clear();
    spare = VK_NULL_HANDLE;
    swapchain = VK_NULL_HANDLE;
    current.reset();
}

namespace {

tl::unexpected<Diagnostics> surfaceError(std::string message) {
    return fail(ErrorKind::Validation, ErrorCode::Surface, std::move(message));
}

std::optional<VkSurfaceFormatKHR> chooseFormat(const InstanceObject& instance, VkPhysicalDevice adapter,
                                               VkSurfaceKHR surface) {
    std::uint32_t count = 0;
    instance.vk.vkGetPhysicalDeviceSurfaceFormatsKHR(adapter, surface, &count, nullptr);
    std::vector<VkSurfaceFormatKHR> formats(count);
    instance.vk.vkGetPhysicalDeviceSurfaceFormatsKHR(adapter, surface, &count, formats.data());
    formats.resize(count);
    for (const auto wanted :
         {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_B8G8R8A8_SRGB, VK_FORMAT_R8G8B8A8_SRGB})
        for (const auto& f : formats)
            if (f.format == wanted && f.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR) return f;
    return std::nullopt;
}

VkPresentModeKHR chooseMode(const InstanceObject& instance, VkPhysicalDevice adapter, VkSurfaceKHR surface,
                            bool vsync) {
    if (vsync) return VK_PRESENT_MODE_FIFO_KHR;  // always there
    std::uint32_t count = 0;
    instance.vk.vkGetPhysicalDeviceSurfacePresentModesKHR(adapter, surface, &count, nullptr);
    std::vector<VkPresentModeKHR> modes(count);
    instance.vk.vkGetPhysicalDeviceSurfacePresentModesKHR(adapter, surface, &count, modes.data());
    for (const auto wanted : {VK_PRESENT_MODE_MAILBOX_KHR, VK_PRESENT_MODE_IMMEDIATE_KHR})
        if (std::find(modes.begin(), modes.end(), wanted) != modes.end()) return wanted;
    return VK_PRESENT_MODE_FIFO_KHR;
}

}  // namespace

Result<void> SurfaceObject::configure(const std::shared_ptr<DeviceObject>& owner, const SurfaceConfiguration& wanted) {
    release();
    device = owner;
    configuration = wanted;
    outdated = false;
    const auto& adapter = *device->adapter;
    if (adapter.instance != instance || !supports(adapter) || device->functions.vkCreateSwapchainKHR == nullptr)
        return surfaceError(cat("[Device \"", device->label, "\"] cannot present to this surface."));
    VkSurfaceCapabilitiesKHR caps = {};
    if (const auto r = instance->vk.vkGetPhysicalDeviceSurfaceCapabilitiesKHR(adapter.handle, handle, &caps);
        r != VK_SUCCESS)
        return forward(vulkanError(r, "vkGetPhysicalDeviceSurfaceCapabilitiesKHR", "the surface"));
    const auto chosen = chooseFormat(*instance, adapter.handle, handle);
    if (!chosen)
        return surfaceError("The surface offers none of the formats BGRA8Unorm, RGBA8Unorm and their sRGB forms.");
    format = fromVk(chosen->format);
    auto& size = configuration.size;
    size.depthOrArrayLayers = 1;
    if (caps.currentExtent.width != ~0U) {
        size.width = caps.currentExtent.width;
        size.height = caps.currentExtent.height;
    }
    size.width = std::clamp(size.width, caps.minImageExtent.width, std::max(caps.maxImageExtent.width, 1U));
    size.height = std::clamp(size.height, caps.minImageExtent.height, std::max(caps.maxImageExtent.height, 1U));
    if (size.width == 0 || size.height == 0)
        return surfaceError("The window has no area; configure it when it has one.");
    const VkImageUsageFlags usage = toVk(wanted.usage, format);
    if ((usage & ~caps.supportedUsageFlags) != 0)
        return surfaceError(cat("The surface's textures cannot be used as ", usageNames(wanted.usage), '.'));
    VkSwapchainCreateInfoKHR info = {VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
    info.surface = handle;
    info.minImageCount = std::max(caps.minImageCount, 3U);
    if (caps.maxImageCount != 0) info.minImageCount = std::min(info.minImageCount, caps.maxImageCount);
    info.imageFormat = chosen->format;
    info.imageColorSpace = chosen->colorSpace;
    info.imageExtent = {size.width, size.height};
    info.imageArrayLayers = 1;
    info.imageUsage = usage;
    info.preTransform = caps.currentTransform;
    info.compositeAlpha = (caps.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR) != 0
                              ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                              : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
    info.presentMode = chooseMode(*instance, adapter.handle, handle, wanted.vsync);
    info.clipped = VK_TRUE;
    const auto& f = device->functions;
    if (const auto r = f.vkCreateSwapchainKHR(device->handle, &info, device->allocator, &swapchain); r != VK_SUCCESS)
        return forward(vulkanError(r, "vkCreateSwapchainKHR", "the surface"));
    std::uint32_t count = 0;
    f.vkGetSwapchainImagesKHR(device->handle, swapchain, &count, nullptr);
    std::vector<VkImage> handles(count);
    f.vkGetSwapchainImagesKHR(device->handle, swapchain, &count, handles.data());
    VkSemaphoreCreateInfo semaphore = {VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    VkResult r = f.vkCreateSemaphore(device->handle, &semaphore, device->allocator, &spare);
    for (std::uint32_t i = 0; i < count && r == VK_SUCCESS; ++i) {
        auto& image = images.emplace_back();
        image.texture = std::make_shared<TextureObject>(device, "Texture", cat("surface image ", i));
        auto& t = *image.texture;
        t.descriptor = {.label = t.label, .size = size, .format = format, .usage = wanted.usage};
        t.handle = handles[i];
        t.ownsImage = false;
        device->nameObject(VK_OBJECT_TYPE_IMAGE, handles[i], t.label);
        r = f.vkCreateSemaphore(device->handle, &semaphore, device->allocator, &image.acquired);
        if (r == VK_SUCCESS) r = f.vkCreateSemaphore(device->handle, &semaphore, device->allocator, &image.rendered);
    }
    if (r != VK_SUCCESS) {
        release();
        return forward(vulkanError(r, "vkCreateSemaphore", "the surface"));
    }
    return {};
}

Result<Texture> SurfaceObject::acquire() {
    if (swapchain == VK_NULL_HANDLE)
        return surfaceError("getCurrentTexture() was called before the surface was configured.");
    if (current) return Texture(images[*current].texture);
    if (outdated) return Texture();
    std::uint32_t index = 0;
    const auto r =
        device->functions.vkAcquireNextImageKHR(device->handle, swapchain, ~0ULL, spare, VK_NULL_HANDLE, &index);
    if (r == VK_ERROR_OUT_OF_DATE_KHR) {
        outdated = true;
        return Texture();
    }
    if (r != VK_SUCCESS && r != VK_SUBOPTIMAL_KHR)
        return forward(vulkanError(r, "vkAcquireNextImageKHR", "the surface"));
    if (r == VK_SUBOPTIMAL_KHR) outdated = true;  // usable once more
    std::swap(spare, images[index].acquired);
    current = index;
    const std::lock_guard lock(device->queue.mutex);
    VkSemaphoreSubmitInfo wait = {VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO};
    wait.semaphore = images[index].acquired;
    wait.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    device->queue.acquired.push_back(wait);
    // What was presented is not kept: the first use may throw the contents away.
    images[index].texture->state->discard(VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
    return Texture(images[index].texture);
}

Result<bool> SurfaceObject::present() {
    if (!current) return surfaceError("present() was called without getCurrentTexture().");
    auto& image = images[*current];
    const std::uint32_t index = *current;
    current.reset();
    const std::lock_guard lock(device->queue.mutex);
    auto sent = submitLocked(*device, {}, {image.rendered, image.texture.get()});
    if (!sent) return forward(sent.error());
    VkPresentInfoKHR info = {VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &image.rendered;
    info.swapchainCount = 1;
    info.pSwapchains = &swapchain;
    info.pImageIndices = &index;
    const HostLock hostLock(device->queue);
    const auto r = device->functions.vkQueuePresentKHR(device->queue.handle, &info);
    if (r == VK_ERROR_OUT_OF_DATE_KHR || r == VK_SUBOPTIMAL_KHR)
        outdated = true;
    else if (r != VK_SUCCESS)
        return forward(vulkanError(r, "vkQueuePresentKHR", "the surface"));
    return !outdated;
}

}  // namespace detail

Result<void> Surface::configure(const Device& device, const SurfaceConfiguration& configuration) const {
    if (auto ok = detail::needHandle(*this, "the surface"); !ok) return ok;
    if (auto ok = detail::needHandle(device, "the surface's device"); !ok) return ok;
    return device.get()->reported(object_->configure(device.shared(), configuration));
}
TextureFormat Surface::format() const {
    return object_ ? object_->format : TextureFormat::Undefined;
}
Extent3D Surface::size() const {
    return object_ ? object_->configuration.size : Extent3D{};
}
Result<Texture> Surface::getCurrentTexture() const {
    if (auto ok = detail::needHandle(*this, "the surface"); !ok) return detail::forward(ok.error());
    auto result = object_->acquire();
    return object_->device ? object_->device->reported(std::move(result)) : result;
}
Result<bool> Surface::present() const {
    if (auto ok = detail::needHandle(*this, "the surface"); !ok) return detail::forward(ok.error());
    auto result = object_->present();
    return object_->device ? object_->device->reported(std::move(result)) : result;
}

namespace vulkan {

VkInstance instance(const Instance& handle) {
    return handle ? handle.get()->handle : VK_NULL_HANDLE;
}
PFN_vkGetInstanceProcAddr getInstanceProcAddr(const Instance& handle) {
    return handle ? handle.get()->getProcAddr : nullptr;
}
VkPhysicalDevice physicalDevice(const Adapter& handle) {
    return handle ? handle.get()->handle : VK_NULL_HANDLE;
}
VkDevice device(const Device& handle) {
    return handle ? handle.get()->handle : VK_NULL_HANDLE;
}
VkImage image(const Texture& handle) {
    return handle ? handle.get()->handle : VK_NULL_HANDLE;
}
VkBuffer buffer(const Buffer& handle) {
    return handle ? handle.get()->handle : VK_NULL_HANDLE;
}

Surface adoptSurface(const Instance& owner, VkSurfaceKHR surface) {
    if (!owner || surface == VK_NULL_HANDLE) return {};
    auto object = std::make_shared<detail::SurfaceObject>();
    object->instance = owner.shared();
    object->handle = surface;
    return Surface(std::move(object));
}

}  // namespace vulkan
}  // namespace pelage::rhi
