// SPDX-License-Identifier: MIT
// Workarounds for faults of drivers, by name (toggles.def).
#pragma once

#include <pelage/rhi/device.hpp>

#include "text.hpp"

namespace pelage::rhi::detail {

struct Toggles {
#define PELAGE_RHI_TOGGLE(word, driver, fixedIn) bool word = false;
#include "toggles.def"
    /// Those that are on.
    std::vector<std::string> names() const;
};
/// As the driver and its version ask for, then as `wanted` says. An unknown name is an error that lists the known.
Result<Toggles> togglesFor(VkDriverId driver, std::uint32_t driverVersion, const std::vector<Toggle>& wanted,
                           const std::string& device);

}  // namespace pelage::rhi::detail
