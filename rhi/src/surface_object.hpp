// SPDX-License-Identifier: MIT
#pragma once

#include "device_object.hpp"

namespace pelage::rhi::detail {

struct SurfaceObject {
    ~SurfaceObject();
    bool supports(const AdapterObject& adapter) const;
    Result<void> configure(const std::shared_ptr<DeviceObject>& owner, const SurfaceConfiguration& wanted);
    Result<Texture> acquire();
    Result<bool> present();
    void release();  // the swapchain and all it owns

    std::shared_ptr<InstanceObject> instance;
    VkSurfaceKHR handle = VK_NULL_HANDLE;
    std::shared_ptr<DeviceObject> device;
    SurfaceConfiguration configuration;
    TextureFormat format = TextureFormat::Undefined;
    VkSwapchainKHR swapchain = VK_NULL_HANDLE;
    struct Image {
        std::shared_ptr<TextureObject> texture;
        VkSemaphore acquired = VK_NULL_HANDLE, rendered = VK_NULL_HANDLE;
    };
    std::vector<Image> images;
    VkSemaphore spare = VK_NULL_HANDLE;  // changes places with the acquired semaphore of the image that comes
    std::optional<std::uint32_t> current;
    bool outdated = false;
};

}  // namespace pelage::rhi::detail
