// SPDX-License-Identifier: MIT
#include "features.hpp"

#include "device_object.hpp"

namespace pelage::rhi {
namespace detail {
namespace {

using vulkan::FeatureChain;

/// Calls visit(name, member of a FeatureChain, when) for every Vulkan feature that Pelage may turn on.
/// When: always (an adapter without it is not offered), if it is there, or with an optional feature.
enum class When : std::uint8_t { Always, IfThere, With };
template <class Visit>
void eachFeature(Visit visit) {
#define PELAGE_FEATURE(part, word, when, feature) \
    visit(                                        \
        #word, [](auto& chain) -> auto& { return chain.part.word; }, when, feature)
    using enum When;
    PELAGE_FEATURE(f13, dynamicRendering, Always, Feature::None);
    PELAGE_FEATURE(f13, synchronization2, Always, Feature::None);
    PELAGE_FEATURE(f13, maintenance4, Always, Feature::None);
    PELAGE_FEATURE(f12, timelineSemaphore, Always, Feature::None);
    PELAGE_FEATURE(f10.features, independentBlend, Always, Feature::None);
    // glslang writes `discard` as one of these two.
    PELAGE_FEATURE(f13, shaderTerminateInvocation, IfThere, Feature::None);
    PELAGE_FEATURE(f13, shaderDemoteToHelperInvocation, IfThere, Feature::None);
    PELAGE_FEATURE(f10.features, depthClamp, IfThere, Feature::None);  // PrimitiveState::unclippedDepth
    PELAGE_FEATURE(f10.features, fullDrawIndexUint32, IfThere, Feature::None);
    PELAGE_FEATURE(lines, rectangularLines, IfThere, Feature::None);
    PELAGE_FEATURE(f10.features, wideLines, With, Feature::WideLines);
    PELAGE_FEATURE(f10.features, pipelineStatisticsQuery, With, Feature::PipelineStatistics);
    PELAGE_FEATURE(f10.features, fillModeNonSolid, With, Feature::FillModeNonSolid);
    PELAGE_FEATURE(f10.features, samplerAnisotropy, With, Feature::AnisotropicFiltering);
    PELAGE_FEATURE(f10.features, fragmentStoresAndAtomics, With, Feature::FragmentStores);
    PELAGE_FEATURE(f10.features, vertexPipelineStoresAndAtomics, With, Feature::FragmentStores);
    PELAGE_FEATURE(f10.features, shaderInt64, With, Feature::Int64BufferAtomics);
    PELAGE_FEATURE(f12, shaderBufferInt64Atomics, With, Feature::Int64BufferAtomics);
#undef PELAGE_FEATURE
}

}  // namespace

void enableFeatures(const AdapterObject& adapter, Feature granted, FeatureChain& on) {
    FeatureChain has;
    adapter.instance->vk.vkGetPhysicalDeviceFeatures2(adapter.handle, has.link(adapter.lineRasterization));
    eachFeature([&](const char*, auto member, When when, Feature feature) {
        if (when == When::Always || (when == When::With && contains(granted, feature)))
            member(on) = VK_TRUE;
        else if (when == When::IfThere)
            member(on) = member(has);
    });
    on.link(adapter.lineRasterization);
}

FeatureChain readChain(const VkPhysicalDeviceFeatures2* chain) {
    FeatureChain on;
    const auto* next = reinterpret_cast<const VkBaseInStructure*>(chain);
    for (; next != nullptr; next = next->pNext) {
        switch (next->sType) {
            case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2:
                on.f10.features = reinterpret_cast<const VkPhysicalDeviceFeatures2*>(next)->features;
                break;
            case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES:
                on.f11 = *reinterpret_cast<const VkPhysicalDeviceVulkan11Features*>(next);
                break;
            case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES:
                on.f12 = *reinterpret_cast<const VkPhysicalDeviceVulkan12Features*>(next);
                break;
            case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES:
                on.f13 = *reinterpret_cast<const VkPhysicalDeviceVulkan13Features*>(next);
                break;
            case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_LINE_RASTERIZATION_FEATURES_EXT:
                on.lines = *reinterpret_cast<const VkPhysicalDeviceLineRasterizationFeaturesEXT*>(next);
                break;
            // The same features in the structures of the extensions that they came from.
            case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES:
                on.f13.dynamicRendering =
                    reinterpret_cast<const VkPhysicalDeviceDynamicRenderingFeatures*>(next)->dynamicRendering;
                break;
            case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES:
                on.f13.synchronization2 =
                    reinterpret_cast<const VkPhysicalDeviceSynchronization2Features*>(next)->synchronization2;
                break;
            case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES:
                on.f13.maintenance4 = reinterpret_cast<const VkPhysicalDeviceMaintenance4Features*>(next)->maintenance4;
                break;
            case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES:
                on.f12.timelineSemaphore =
                    reinterpret_cast<const VkPhysicalDeviceTimelineSemaphoreFeatures*>(next)->timelineSemaphore;
                break;
            case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_TERMINATE_INVOCATION_FEATURES:
                on.f13.shaderTerminateInvocation =
                    reinterpret_cast<const VkPhysicalDeviceShaderTerminateInvocationFeatures*>(next)
                        ->shaderTerminateInvocation;
                break;
            case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_DEMOTE_TO_HELPER_INVOCATION_FEATURES:
                on.f13.shaderDemoteToHelperInvocation =
                    reinterpret_cast<const VkPhysicalDeviceShaderDemoteToHelperInvocationFeatures*>(next)
                        ->shaderDemoteToHelperInvocation;
                break;
            default:
                break;
        }
    }
    return on;
}

std::vector<std::string> missingFeatures(const FeatureChain& wanted, const FeatureChain& given) {
    std::vector<std::string> missing;
    eachFeature([&](const char* word, auto member, When, Feature) {
        if (member(wanted) != 0 && member(given) == 0) missing.emplace_back(word);
    });
    return missing;
}

std::vector<const char*> deviceExtensions(const AdapterObject& adapter) {
    std::vector<const char*> names;
    if (adapter.lineRasterization) names.push_back(VK_EXT_LINE_RASTERIZATION_EXTENSION_NAME);
    return names;
}

}  // namespace detail

namespace vulkan {

VkPhysicalDeviceFeatures2* FeatureChain::link(bool lineRasterization) {
    f10.pNext = &f11;
    f11.pNext = &f12;
    f12.pNext = &f13;
    f13.pNext = lineRasterization ? &lines : nullptr;
    lines.pNext = nullptr;
    return &f10;
}

}  // namespace vulkan
}  // namespace pelage::rhi
