// SPDX-License-Identifier: MIT
// Everything but Vulkan interop.
#pragma once

#include <pelage/rhi/device.hpp>
