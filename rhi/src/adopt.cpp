// SPDX-License-Identifier: MIT
// A host's device: what it must enable, and the check that it did. Nothing is guessed: a feature that the host does not
// list is off.
#include <algorithm>
#include <cstring>

#include "device_object.hpp"
#include "features.hpp"
#include "recording.hpp"

namespace pelage::rhi {
namespace detail {
namespace {

std::shared_ptr<InstanceObject> hostInstance(PFN_vkGetInstanceProcAddr entry, VkInstance handle) {
    auto instance = std::make_shared<InstanceObject>();
    instance->adopted = true;
    instance->label = "host";
    instance->getProcAddr = entry;
    instance->handle = handle;
    return instance;
}

bool listed(const std::vector<const char*>& all, std::string_view word) {
    return std::any_of(all.begin(), all.end(), [&](const char* e) { return e != nullptr && word == e; });
}

std::string joined(const std::vector<std::string>& parts) {
    std::string text;
    for (const auto& part : parts) text += cat(text.empty() ? "" : ", ", part);
    return text;
}

tl::unexpected<Diagnostics> empty(std::string_view what) {
    return invalid(ErrorCode::InvalidHandle, cat("An empty handle was given for ", what, '.'));
}

Result<std::shared_ptr<AdapterObject>> hostAdapter(const std::shared_ptr<InstanceObject>& instance,
                                                   VkPhysicalDevice device) {
    if (auto loaded = loadInstance(*instance); !loaded) return forward(loaded.error());
    auto adapter = inspectAdapter(instance, device);
    if (adapter) return adapter;
    VkPhysicalDeviceProperties2 p = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    instance->vk.vkGetPhysicalDeviceProperties2(device, &p);
    return fail(ErrorKind::Unsupported, ErrorCode::NoAdapter,
                cat("The device \"", p.properties.deviceName,
                    "\" cannot run Pelage: Vulkan 1.3 with dynamicRendering, synchronization2, maintenance4, "
                    "timelineSemaphore, independentBlend and a queue with graphics and compute are needed."));
}

/// Those of the optional features that the device has and the host's chain enables.
Feature enabledOf(const AdapterObject& adapter, Feature optional, const vulkan::FeatureChain& given) {
    Feature granted = Feature::None;
    for (std::uint32_t bit = 1; bit != 0 && bit <= static_cast<std::uint32_t>(optional); bit <<= 1) {
        const auto one = static_cast<Feature>(bit);
        if (!contains(optional, one) || !contains(adapter.info.features, one)) continue;
        vulkan::FeatureChain needed;
        enableFeatures(adapter, one, needed);
        if (missingFeatures(needed, given).empty()) granted = granted | one;
    }
    return granted;
}

Result<void> checkWanted(const AdapterObject& adapter, Feature wanted) {
    const auto absent =
        static_cast<Feature>(static_cast<std::uint32_t>(wanted) & ~static_cast<std::uint32_t>(adapter.info.features));
    if (!any(absent)) return {};
    return fail(ErrorKind::Unsupported, ErrorCode::MissingFeature,
                cat("The features ", featureNames(absent), " are wanted, and [Adapter \"", adapter.info.name,
                    "\"] does not have them; it has ", featureNames(adapter.info.features), '.'));
}

/// All gaps between what is needed and what the host says, in words.
std::vector<std::string> gapsOf(const vulkan::AdoptDescriptor& d, const AdapterObject& adapter) {
    std::vector<std::string> gaps;
    if (d.apiVersion < VK_API_VERSION_1_3)
        gaps.push_back(cat("API version 1.3 (the instance was created for ", VK_API_VERSION_MAJOR(d.apiVersion), '.',
                           VK_API_VERSION_MINOR(d.apiVersion), ')'));
    for (const char* extension : deviceExtensions(adapter))
        if (!listed(d.enabledDeviceExtensions, extension)) gaps.push_back(cat("extension ", extension));
    vulkan::FeatureChain wanted;
    enableFeatures(adapter, d.features, wanted);
    for (const auto& word : missingFeatures(wanted, readChain(d.enabledFeatures)))
        gaps.push_back(cat("feature ", word));
    std::uint32_t count = 0;
    const auto& vk = adapter.instance->vk;
    vk.vkGetPhysicalDeviceQueueFamilyProperties(adapter.handle, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vk.vkGetPhysicalDeviceQueueFamilyProperties(adapter.handle, &count, families.data());
    constexpr VkQueueFlags both = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    if (d.queueFamily >= count || (families[d.queueFamily].queueFlags & both) != both)
        gaps.push_back(cat("a queue of a family with graphics and compute (family ", d.queueFamily, " is not one)"));
    if (!d.singleThreaded && (!d.queueLock.lock || !d.queueLock.unlock))
        gaps.push_back("a queue lock (or singleThreaded = true, when nobody else touches the queue)");
    return gaps;
}

Result<std::shared_ptr<DeviceObject>> adoptDevice(const vulkan::AdoptDescriptor& d) {
    if (d.getInstanceProcAddr == nullptr) return empty("AdoptDescriptor::getInstanceProcAddr");
    if (d.instance == VK_NULL_HANDLE) return empty("AdoptDescriptor::instance");
    if (d.physicalDevice == VK_NULL_HANDLE) return empty("AdoptDescriptor::physicalDevice");
    if (d.device == VK_NULL_HANDLE) return empty("AdoptDescriptor::device");
    if (d.queue == VK_NULL_HANDLE) return empty("AdoptDescriptor::queue");
    auto instance = hostInstance(d.getInstanceProcAddr, d.instance);
    instance->onMessage = d.onMessage;
    instance->debugUtils = listed(d.enabledInstanceExtensions, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    instance->surfaces = listed(d.enabledInstanceExtensions, VK_KHR_SURFACE_EXTENSION_NAME);
    auto adapter = hostAdapter(instance, d.physicalDevice);
    if (!adapter) return forward(adapter.error());
    if (auto ok = checkWanted(**adapter, d.features); !ok) return forward(ok.error());
    const auto title = cat("[Device \"", d.label, "\"]");
    if (const auto gaps = gapsOf(d, **adapter); !gaps.empty())
        return fail(ErrorKind::Unsupported, ErrorCode::MissingFeature,
                    cat(title, " cannot be adopted; it lacks ", joined(gaps),
                        ". needs() says what to enable, and AdoptDescriptor what was."));
    (*adapter)->queueFamily = d.queueFamily;
    (*adapter)->swapchain = listed(d.enabledDeviceExtensions, VK_KHR_SWAPCHAIN_EXTENSION_NAME);

    auto device = std::make_shared<DeviceObject>();
    device->adopted = true;
    device->adapter = *adapter;
    device->label = d.label;
    device->info = (*adapter)->info;
    const auto on = readChain(d.enabledFeatures);
    device->info.features = d.features | enabledOf(**adapter, d.optionalFeatures, on);
    if (!contains(device->info.features, Feature::WideLines)) device->info.limits.maxLineWidth = 1;
    device->onUncapturedError = d.onUncapturedError;
    device->onDeviceLost = d.onDeviceLost;
    auto toggles = togglesFor((*adapter)->driverId, (*adapter)->driverVersion, d.toggles, title);
    if (!toggles) return forward(toggles.error());
    device->toggles = *toggles;
    device->depthClamp = on.f10.features.depthClamp != 0;
    device->rectangularLines = on.lines.rectangularLines != 0;
    device->allocator = d.allocator;
    device->pipelineCache = d.pipelineCache;
    device->hostPipelineCache = d.pipelineCache != VK_NULL_HANDLE;
    device->queue.handle = d.queue;
    device->queue.hostLock = d.queueLock;
    device->handle = d.device;
    if (auto opened = openDevice(*device, d.pipelines); !opened) return forward(opened.error());
    device->onRelease = d.onRelease;
    return device;
}

}  // namespace
}  // namespace detail

namespace vulkan {

Result<Needs> needs(PFN_vkGetInstanceProcAddr getInstanceProcAddr, VkInstance instance, VkPhysicalDevice physicalDevice,
                    Feature wanted, Feature optional) {
    if (getInstanceProcAddr == nullptr) return detail::empty("getInstanceProcAddr");
    if (instance == VK_NULL_HANDLE) return detail::empty("the instance");
    if (physicalDevice == VK_NULL_HANDLE) return detail::empty("the physical device");
    auto adapter = detail::hostAdapter(detail::hostInstance(getInstanceProcAddr, instance), physicalDevice);
    if (!adapter) return detail::forward(adapter.error());
    if (auto ok = detail::checkWanted(**adapter, wanted); !ok) return detail::forward(ok.error());
    Needs result;
    result.deviceExtensions = detail::deviceExtensions(**adapter);
    detail::enableFeatures(**adapter, wanted | (optional & (*adapter)->info.features), result.features);
    return result;
}

Result<Device> adopt(const AdoptDescriptor& descriptor) {
    return detail::adoptDevice(descriptor).map([](auto object) { return Device(std::move(object)); });
}

}  // namespace vulkan
}  // namespace pelage::rhi
