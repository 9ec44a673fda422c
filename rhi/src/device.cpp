// SPDX-License-Identifier: MIT
// Making a device: features are asked for and granted by name, and what Pelage always needs is always on.
#include "device_object.hpp"
#include "features.hpp"
#include "pipeline_cache.hpp"
#include "recording.hpp"

namespace pelage::rhi {
namespace detail {

Object::Object(std::shared_ptr<DeviceObject> owner, std::string_view kindName, std::string objectLabel)
    : device(std::move(owner)), kind(kindName), label(std::move(objectLabel)), id(device->nextId++) {}

Result<void> needSameDevice(const Object& object, const DeviceObject& device) {
    if (object.device.get() == &device) return {};
    return invalid(ErrorCode::OtherDevice, cat(object.describe(), " belongs to [Device \"", object.device->label,
                                               "\"], not to [Device \"", device.label, "\"]."));
}

Result<void> openDevice(DeviceObject& device, const BlobCache& pipelines) {
    const auto title = cat("[Device \"", device.label, "\"]");
    const auto& instance = device.adapter->instance->vk;
    auto& vk = device.functions;
    std::string missing;
#define PELAGE_VK_DEVICE(name)                                                                  \
    vk.name = reinterpret_cast<PFN_##name>(instance.vkGetDeviceProcAddr(device.handle, #name)); \
    if (vk.name == nullptr) missing += " " #name;
#define PELAGE_VK_DEVICE_OPTIONAL(name) \
    vk.name = reinterpret_cast<PFN_##name>(instance.vkGetDeviceProcAddr(device.handle, #name));
#include "functions.def"
    if (!missing.empty())
        return fail(ErrorKind::Unsupported, ErrorCode::DriverCall, cat(title, " lacks the functions", missing, '.'));
    device.memory.open(&vk, device.handle, device.adapter->memory, device.allocator);
    if (device.queue.handle == VK_NULL_HANDLE)
        vk.vkGetDeviceQueue(device.handle, device.adapter->queueFamily, 0, &device.queue.handle);
    VkSemaphoreTypeCreateInfo type = {VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO};
    type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
    VkSemaphoreCreateInfo semaphore = {VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, &type};
    if (const auto r = vk.vkCreateSemaphore(device.handle, &semaphore, device.allocator, &device.queue.timeline);
        r != VK_SUCCESS)
        return forward(vulkanError(r, "vkCreateSemaphore", title));
    if (auto ok = openPipelineCache(device, pipelines); !ok) return ok;
    device.queue.uploads = std::make_unique<Recording>();
    device.recordings = std::make_unique<RecordingPool>();
    device.nameObject(VK_OBJECT_TYPE_SEMAPHORE, device.queue.timeline, device.label + " timeline");
    if (!device.adopted) device.nameObject(VK_OBJECT_TYPE_DEVICE, device.handle, device.label);
    return {};
}

namespace {

Result<std::shared_ptr<DeviceObject>> makeDevice(const std::shared_ptr<AdapterObject>& adapter,
                                                 const DeviceDescriptor& descriptor) {
    const auto title = cat("[Device \"", descriptor.label, "\"]");
    const Feature offered = adapter->info.features;
    const auto absent = static_cast<Feature>(static_cast<std::uint32_t>(descriptor.requiredFeatures) &
                                             ~static_cast<std::uint32_t>(offered));
    if (any(absent))
        return fail(ErrorKind::Unsupported, ErrorCode::MissingFeature,
                    cat(title, " requires ", featureNames(absent), ", which [Adapter \"", adapter->info.name,
                        "\"] does not have; it has ", featureNames(offered), '.'));
    const Feature granted = descriptor.requiredFeatures | (descriptor.optionalFeatures & offered);

    auto device = std::make_shared<DeviceObject>();
    device->adapter = adapter;
    device->label = descriptor.label;
    device->info = adapter->info;
    device->info.features = granted;
    if (!contains(granted, Feature::WideLines)) device->info.limits.maxLineWidth = 1;
    device->onUncapturedError = descriptor.onUncapturedError;
    device->onDeviceLost = descriptor.onDeviceLost;
    auto toggles = togglesFor(adapter->driverId, adapter->driverVersion, descriptor.toggles, title);
    if (!toggles) return forward(toggles.error());
    device->toggles = *toggles;

    vulkan::FeatureChain features;
    enableFeatures(*adapter, granted, features);
    device->depthClamp = features.f10.features.depthClamp != 0;
    device->rectangularLines = features.lines.rectangularLines != 0;
    auto extensions = deviceExtensions(*adapter);
    if (adapter->swapchain) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    const float priority = 1;
    VkDeviceQueueCreateInfo queue = {VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueFamilyIndex = adapter->queueFamily;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo info = {VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &features.f10};
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    VkDevice handle = VK_NULL_HANDLE;
    if (const auto r = adapter->instance->vk.vkCreateDevice(adapter->handle, &info, nullptr, &handle); r != VK_SUCCESS)
        return forward(vulkanError(r, "vkCreateDevice", title));
    device->handle = handle;
    if (auto opened = openDevice(*device, descriptor.pipelines); !opened) return forward(opened.error());
    return device;
}

}  // namespace
}  // namespace detail

Result<Device> Adapter::requestDevice(const DeviceDescriptor& descriptor) const {
    if (auto ok = detail::needHandle(*this, "the adapter"); !ok) return detail::forward(ok.error());
    return detail::makeDevice(object_, descriptor).map([](auto object) { return Device(std::move(object)); });
}

const AdapterInfo& Device::info() const {
    return object_->info;
}
Queue Device::queue() const {
    return Queue(object_);
}

bool Device::supports(TextureFormat format, TextureUsage usage, std::uint32_t sampleCount) const {
    if (!object_ || format == TextureFormat::Undefined || usage == TextureUsage::None) return false;
    VkPhysicalDeviceImageFormatInfo2 info = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_IMAGE_FORMAT_INFO_2};
    info.format = detail::toVk(format);
    info.type = VK_IMAGE_TYPE_2D;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = detail::toVk(usage, format);
    VkImageFormatProperties2 properties = {VK_STRUCTURE_TYPE_IMAGE_FORMAT_PROPERTIES_2};
    const auto& adapter = *object_->adapter;
    const auto r = adapter.instance->vk.vkGetPhysicalDeviceImageFormatProperties2(adapter.handle, &info, &properties);
    return r == VK_SUCCESS && (properties.imageFormatProperties.sampleCounts & sampleCount) != 0;
}

Device::MemoryStatistics Device::memoryStatistics() const {
    if (!object_) return {};
    const auto c = object_->memory.counters();
    return {c.allocatedBytes,        c.usedBytes,           c.allocations,          c.blocks,
            object_->liveBuffers,    object_->liveTextures, object_->livePipelines, object_->pipelinesMade,
            object_->pipelinesCached};
}

}  // namespace pelage::rhi
