// SPDX-License-Identifier: MIT
// The one interop header: the only place above rhi/src where Vulkan is seen. A host that has a VkDevice of its own:
//
//   1. asks needs() before it creates its device, and enables what it says beside what it wants itself;
//   2. adopt()s the device: every gap is listed at once, nothing is created twice, nothing is destroyed at the end;
//   3. wraps its images and buffers once;
//   4. each frame records with encoders as usual and then encodeInto()s its own VkCommandBuffer, saying in which state
//      the wrapped images come and in which they are wanted back. Nothing is submitted and nothing is waited for;
//   5. says finished() when its fence or semaphore says that the frame is done, so that objects can be destroyed.
//
// The order of encodeInto() and Queue::submit() calls must be the order in which the host submits to the queue.
#pragma once

#include <pelage/rhi/device.hpp>

#include <functional>
#include <span>
#include <string>
#include <vector>

#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan.h>

namespace pelage::rhi::vulkan {

// --- Ours, seen by a host.

VkInstance instance(const Instance& instance);
PFN_vkGetInstanceProcAddr getInstanceProcAddr(const Instance& instance);
VkPhysicalDevice physicalDevice(const Adapter& adapter);
VkDevice device(const Device& device);
VkImage image(const Texture& texture);
VkBuffer buffer(const Buffer& buffer);

/// Takes ownership of a surface made with instance(): it is destroyed with the last handle.
Surface adoptSurface(const Instance& instance, VkSurfaceKHR surface);

/// Instance::create with another entry point than the system's loader: a host's, a layer's, a test's.
Result<Instance> createInstance(const InstanceDescriptor& descriptor, PFN_vkGetInstanceProcAddr getInstanceProcAddr);

// --- A host's, seen by us.

/// Feature structures that are linked when they are wanted, so that the whole may be copied.
struct FeatureChain {
    VkPhysicalDeviceFeatures2 f10 = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    VkPhysicalDeviceVulkan11Features f11 = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES};
    VkPhysicalDeviceVulkan12Features f12 = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceVulkan13Features f13 = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkPhysicalDeviceLineRasterizationFeaturesEXT lines = {
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_LINE_RASTERIZATION_FEATURES_EXT};
    /// The first of them, for VkDeviceCreateInfo::pNext; valid while this object stays where it is. `lines` belongs to
    /// an extension and is linked only when that is enabled.
    VkPhysicalDeviceFeatures2* link(bool lineRasterization);
};

/// What a host must enable: what Pelage cannot do without, what it uses where a device has it, and the wanted
/// features. Set more bits as you like; a host that fills its own structures copies these bits.
struct Needs {
    std::uint32_t apiVersion = VK_API_VERSION_1_3;
    std::vector<const char*> deviceExtensions = {};
    FeatureChain features = {};
    /// For VkDeviceCreateInfo::pNext.
    void* chain() { return features.link(!deviceExtensions.empty()); }
};
/// Unsupported when the physical device cannot run Pelage or lacks a wanted feature. Of the optional ones, those that
/// it has.
Result<Needs> needs(PFN_vkGetInstanceProcAddr getInstanceProcAddr, VkInstance instance, VkPhysicalDevice physicalDevice,
                    Feature wanted = Feature::None, Feature optional = Feature::None);

/// Held around every call on the shared queue (submission, presentation, waiting for idle). A host that submits from
/// another thread locks the same mutex; lavapipe has one queue, so this is the usual case there. Taken inside locks of
/// the device: never call into the device, nor drop its last handle, while holding it.
struct QueueLock {
    std::function<void()> lock = {}, unlock = {};
};

struct AdoptDescriptor {
    std::string label = "adopted";
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;  // of a family with graphics and compute
    std::uint32_t queueFamily = 0;
    std::uint32_t apiVersion = VK_API_VERSION_1_3;  // as given to vkCreateInstance
    std::vector<const char*> enabledInstanceExtensions = {}, enabledDeviceExtensions = {};
    /// The pNext chain the device was created with. Never guessed: what is not in it counts as off.
    const VkPhysicalDeviceFeatures2* enabledFeatures = nullptr;
    Feature features = Feature::None;          // wanted; as given to needs()
    Feature optionalFeatures = Feature::None;  // granted where the device has them and the host enabled them
    QueueLock queueLock = {};
    bool singleThreaded = false;  // true: no other thread uses the queue meanwhile, so no lock is needed
    const VkAllocationCallbacks* allocator = nullptr;  // host memory of the driver; outlives the device
    VkPipelineCache pipelineCache = VK_NULL_HANDLE;    // used instead of one of our own; stays the host's
    BlobCache pipelines = {};                          // when there is none of the host's
    std::vector<Toggle> toggles = {};
    MessageCallback onMessage = {};
    std::function<void(const Diagnostic&)> onUncapturedError = {};
    std::function<void(const Diagnostic&)> onDeviceLost = {};
    /// Called once when nothing of ours is left on the device: the host may destroy it now.
    std::function<void()> onRelease = {};
};
/// Verifies everything and lists every gap by name (MissingFeature). Destroying the last handle destroys what we made
/// and leaves instance, device and queue alone.
Result<Device> adopt(const AdoptDescriptor& descriptor);

/// Handles to a host's image or buffer, which must have been created with the usages, size and format that the
/// descriptor states, and must outlive the last submission that uses them. Every encodeInto() whose
/// commands use one lists it; without that its state is taken to be what we last left it in. `onRelease` is called when
/// that has finished and the last handle is gone.
Result<Texture> wrapImage(const Device& device, VkImage image, const TextureDescriptor& descriptor,
                          std::function<void()> onRelease = {});
Result<Buffer> wrapBuffer(const Device& device, VkBuffer buffer, const BufferDescriptor& descriptor,
                          std::function<void()> onRelease = {});

/// How a resource was last used, or is to be used next. The default for an image that comes in says that its contents
/// do not matter; the default for one that goes out leaves it as it is.
struct ImageState {
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    VkAccessFlags2 access = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
};
struct BufferState {
    VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    VkAccessFlags2 access = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
};
struct SharedTexture {
    Texture texture = {};
    ImageState before = {}, after = {};
};
struct SharedBuffer {
    Buffer buffer = {};
    BufferState before = {}, after = {};
};

/// A point in the order of the queue that only the host knows the end of.
struct Ticket {
    std::uint64_t value = 0;
};
/// Records pending writes and the command buffers into `commands`, which is recording, outside a render pass, and of
/// the device's queue family. Binds pipelines, descriptor sets and dynamic state: the host sets its own again.
Result<Ticket> encodeInto(const Device& device, VkCommandBuffer commands, std::span<const CommandBuffer> commandBuffers,
                          std::span<const SharedTexture> textures = {}, std::span<const SharedBuffer> buffers = {});
/// The submission that carried this ticket is done (or will never be made, when the device is lost). From any thread.
void finished(const Device& device, Ticket ticket);

}  // namespace pelage::rhi::vulkan
