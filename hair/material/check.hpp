// SPDX-License-Identifier: MIT
// A material type against the SPIR-V of its shaders, in both directions: what a shader reads that no input gives or
// gives in another shape (errors), and what the type gives that no shader reads (warnings).
#pragma once

#include <pelage/materials/material.hpp>
#include <pelage/rhi/rhi.hpp>

#include <functional>
#include <string>

namespace pelage::hair {

/// M051: a member of a block of set 2, a texture or another resource of set 2 that the inputs do not fill as declared.
/// M052 (warning): an input that no shader reads. M050 (warning): an option of which no shader has a specialization
/// constant. The warnings need all shaders of the type; where `module` gives an empty one, what is missing is not
/// known.
Diagnostics checkShaders(const materials::MaterialType& type,
                         const std::function<rhi::ShaderModule(const std::string& file)>& module);

}  // namespace pelage::hair
