// SPDX-License-Identifier: MIT
// The Vulkan features behind rhi::Feature and those that are always on, in one table: requestDevice() enables it,
// needs() tells a host of it, adopt() checks a host against it.
#pragma once

#include <pelage/rhi/vulkan.hpp>

namespace pelage::rhi::detail {

struct AdapterObject;

/// What to enable for these optional features; linked in place.
void enableFeatures(const AdapterObject& adapter, Feature granted, vulkan::FeatureChain& on);
/// The features of a host's pNext chain, whichever of Vulkan's structures it used.
vulkan::FeatureChain readChain(const VkPhysicalDeviceFeatures2* chain);
/// The names of what `wanted` has on and `given` has not: "timelineSemaphore, synchronization2".
std::vector<std::string> missingFeatures(const vulkan::FeatureChain& wanted, const vulkan::FeatureChain& given);
std::vector<const char*> deviceExtensions(const AdapterObject& adapter);

}  // namespace pelage::rhi::detail
