// SPDX-License-Identifier: MIT
// Vulkan without a loader to link: the prototypes are hidden and every function comes from a table.
#pragma once

#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan.h>

namespace pelage::rhi::detail {

struct GlobalFunctions {
#define PELAGE_VK_GLOBAL(name) PFN_##name name = nullptr;
#include "functions.def"
};
struct InstanceFunctions {
#define PELAGE_VK_INSTANCE(name) PFN_##name name = nullptr;
#define PELAGE_VK_INSTANCE_OPTIONAL(name) PFN_##name name = nullptr;
#include "functions.def"
};
struct DeviceFunctions {
#define PELAGE_VK_DEVICE(name) PFN_##name name = nullptr;
#define PELAGE_VK_DEVICE_OPTIONAL(name) PFN_##name name = nullptr;
#include "functions.def"
};

}  // namespace pelage::rhi::detail
