// SPDX-License-Identifier: MIT
// How many instructions are left of a shader once its options are constants: a cost that needs no clock.
#pragma once

#include "failure.hpp"

#include <pelage/rhi/resources.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace pelage::app {

/// Freezes the named specialization constants (the others at their defaults), lets SPIRV-Tools fold and remove what is
/// dead, and counts the instructions inside functions. Constants that the shader does not have are ignored.
Result<std::uint32_t> countInstructions(std::span<const std::uint32_t> code,
                                        const std::vector<rhi::ConstantEntry>& constants);

}  // namespace pelage::app
