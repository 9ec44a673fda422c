// SPDX-License-Identifier: MIT
#include "device_object.hpp"
#include "surface_object.hpp"

#include <algorithm>

namespace pelage::rhi {
namespace detail {

namespace {

AdapterType typeOf(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return AdapterType::DiscreteGPU;
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return AdapterType::IntegratedGPU;
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return AdapterType::VirtualGPU;
        case VK_PHYSICAL_DEVICE_TYPE_CPU:
            return AdapterType::CPU;
        default:
            return AdapterType::Unknown;
    }
}

Limits limitsOf(const VkPhysicalDeviceLimits& l, std::uint64_t maxBufferSize, bool wideLines) {
    Limits limits;
    limits.maxTextureDimension2D = l.maxImageDimension2D;
    limits.maxTextureArrayLayers = l.maxImageArrayLayers;
    limits.maxBindGroups = l.maxBoundDescriptorSets;
    limits.maxColorAttachments = std::min(l.maxColorAttachments, 8U);
    limits.maxPushConstantsSize = std::min(l.maxPushConstantsSize, 256U);  // what encoders keep
    limits.minUniformBufferOffsetAlignment = static_cast<std::uint32_t>(l.minUniformBufferOffsetAlignment);
    limits.minStorageBufferOffsetAlignment = static_cast<std::uint32_t>(l.minStorageBufferOffsetAlignment);
    limits.maxComputeWorkgroupsPerDimension =
        *std::min_element(l.maxComputeWorkGroupCount, l.maxComputeWorkGroupCount + 3);
    limits.maxUniformBufferBindingSize = l.maxUniformBufferRange;
    limits.maxStorageBufferBindingSize = l.maxStorageBufferRange;
    limits.maxBufferSize = maxBufferSize;
    limits.maxLineWidth = wideLines ? l.lineWidthRange[1] : 1;
    limits.timestampPeriod = l.timestampPeriod;
    return limits;
}

}  // namespace

std::shared_ptr<AdapterObject> inspectAdapter(std::shared_ptr<InstanceObject> instance, VkPhysicalDevice device) {
    const auto& vk = instance->vk;
    VkPhysicalDeviceVulkan13Properties p13 = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_PROPERTIES};
    VkPhysicalDeviceVulkan12Properties p12 = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES, &p13};
    VkPhysicalDeviceProperties2 p = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    vk.vkGetPhysicalDeviceProperties2(device, &p);
    if (p.properties.apiVersion < VK_API_VERSION_1_3) return nullptr;
    p.pNext = &p12;
    vk.vkGetPhysicalDeviceProperties2(device, &p);

    std::uint32_t count = 0;
    vk.vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vk.vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data());
    const auto has = [&](std::string_view word) {
        return std::any_of(extensions.begin(), extensions.end(),
                           [&](const auto& e) { return word == e.extensionName; });
    };

    VkPhysicalDeviceLineRasterizationFeaturesEXT lines = {
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_LINE_RASTERIZATION_FEATURES_EXT};
    VkPhysicalDeviceVulkan13Features f13 = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkPhysicalDeviceVulkan12Features f12 = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, &f13};
    VkPhysicalDeviceFeatures2 f = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &f12};
    const bool lineExtension = has(VK_EXT_LINE_RASTERIZATION_EXTENSION_NAME);
    if (lineExtension) f13.pNext = &lines;
    vk.vkGetPhysicalDeviceFeatures2(device, &f);
    if (f13.dynamicRendering == 0 || f13.synchronization2 == 0 || f13.maintenance4 == 0 || f12.timelineSemaphore == 0 ||
        f.features.independentBlend == 0)
        return nullptr;

    std::uint32_t families = 0;
    vk.vkGetPhysicalDeviceQueueFamilyProperties(device, &families, nullptr);
    std::vector<VkQueueFamilyProperties> queues(families);
    vk.vkGetPhysicalDeviceQueueFamilyProperties(device, &families, queues.data());
    const auto family = std::find_if(queues.begin(), queues.end(), [](const auto& q) {
        constexpr VkQueueFlags both = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
        return (q.queueFlags & both) == both;
    });
    if (family == queues.end()) return nullptr;

    auto adapter = std::make_shared<AdapterObject>();
    adapter->handle = device;
    adapter->driverId = p12.driverID;
    adapter->driverVersion = p.properties.driverVersion;
    std::copy(std::begin(p.properties.pipelineCacheUUID), std::end(p.properties.pipelineCacheUUID),
              adapter->cacheIdentity.begin());
    adapter->queueFamily = static_cast<std::uint32_t>(family - queues.begin());
    adapter->lineRasterization = lineExtension && lines.rectangularLines != 0;
    adapter->swapchain = instance->surfaces && has(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    vk.vkGetPhysicalDeviceMemoryProperties(device, &adapter->memory);
    auto& info = adapter->info;
    info.name = p.properties.deviceName;
    info.driver =
        cat(p12.driverName, ' ', p12.driverInfo, " (Vulkan ", VK_API_VERSION_MAJOR(p.properties.apiVersion), '.',
            VK_API_VERSION_MINOR(p.properties.apiVersion), '.', VK_API_VERSION_PATCH(p.properties.apiVersion), ')');
    info.type = typeOf(p.properties.deviceType);
    info.vendorId = p.properties.vendorID;
    info.deviceId = p.properties.deviceID;
    const auto offer = [&](bool there, Feature feature) {
        if (there) info.features = info.features | feature;
    };
    offer(f.features.wideLines != 0, Feature::WideLines);
    offer(f.features.pipelineStatisticsQuery != 0, Feature::PipelineStatistics);
    offer(family->timestampValidBits != 0 && p.properties.limits.timestampPeriod > 0, Feature::Timestamps);
    offer(f.features.shaderInt64 != 0 && f12.shaderBufferInt64Atomics != 0, Feature::Int64BufferAtomics);
    offer(f.features.fillModeNonSolid != 0, Feature::FillModeNonSolid);
    offer(f.features.samplerAnisotropy != 0, Feature::AnisotropicFiltering);
    offer(f.features.fragmentStoresAndAtomics != 0 && f.features.vertexPipelineStoresAndAtomics != 0,
          Feature::FragmentStores);
    info.limits = limitsOf(p.properties.limits, p13.maxBufferSize, f.features.wideLines != 0);
    adapter->instance = std::move(instance);
    return adapter;
}

namespace {
int rank(AdapterType type, PowerPreference preference) {
    const bool low = preference == PowerPreference::LowPower;
    switch (type) {
        case AdapterType::DiscreteGPU:
            return low ? 3 : 4;
        case AdapterType::IntegratedGPU:
            return low ? 4 : 3;
        case AdapterType::VirtualGPU:
            return 2;
        case AdapterType::CPU:
            return 0;
        case AdapterType::Unknown:
            break;
    }
    return 1;
}
}  // namespace

}  // namespace detail

Result<Adapter> Instance::requestAdapter(const AdapterOptions& options) const {
    using namespace detail;
    if (auto ok = needHandle(*this, "the instance"); !ok) return forward(ok.error());
    const auto all = enumerateAdapters();
    Adapter best;
    int bestRank = -1;
    std::string seen;
    for (const auto& adapter : all) {
        const auto& info = adapter.info();
        seen += cat(seen.empty() ? "" : ", ", '"', info.name, '"');
        if (!options.allowCPU && info.type == AdapterType::CPU) continue;
        if (info.name.find(options.nameContains) == std::string::npos) continue;
        if (options.compatibleSurface && !options.compatibleSurface.get()->supports(*adapter.get())) continue;
        const int r = rank(info.type, options.powerPreference);
        if (r > bestRank) {
            best = adapter;
            bestRank = r;
        }
    }
    if (!best) {
        std::string wanted;
        if (!options.nameContains.empty()) wanted += cat(" whose name contains \"", options.nameContains, '"');
        if (!options.allowCPU) wanted += " that is not a CPU";
        if (options.compatibleSurface) wanted += " that can present to the surface";
        return fail(ErrorKind::Unsupported, ErrorCode::NoAdapter,
                    cat("No Vulkan 1.3 device", wanted, " was found; ",
                        seen.empty() ? std::string("there is none at all") : "there are " + seen, '.'));
    }
    if (best.info().type == AdapterType::CPU)
        object_->message(
            LogLevel::Info, "adapter",
            cat("no GPU found: using the CPU device \"", best.info().name, "\"; pictures are right, times are not"));
    return best;
}

const AdapterInfo& Adapter::info() const {
    return object_->info;
}

}  // namespace pelage::rhi
