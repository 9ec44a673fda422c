// SPDX-License-Identifier: MIT
// The one interop header: the only place above rhi/src where Vulkan is seen.
#pragma once

#include <pelage/rhi/device.hpp>

#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan.h>

namespace pelage::rhi::vulkan {

VkInstance instance(const Instance& instance);
PFN_vkGetInstanceProcAddr getInstanceProcAddr(const Instance& instance);
VkPhysicalDevice physicalDevice(const Adapter& adapter);
VkDevice device(const Device& device);
VkImage image(const Texture& texture);
VkBuffer buffer(const Buffer& buffer);

/// Takes ownership of a surface made with instance(): it is destroyed with the last handle.
Surface adoptSurface(const Instance& instance, VkSurfaceKHR surface);

}  // namespace pelage::rhi::vulkan
