// SPDX-License-Identifier: MIT
// Reading SPIR-V with SPIRV-Cross: the one place where its exceptions are caught. Needs no device.
#pragma once

#include <pelage/rhi/resources.hpp>

namespace pelage::rhi::detail {

struct ReflectedModule {
    ShaderReflection reflection;
    bool writesStorage = false, usesInt64Atomics = false;
};
Result<ReflectedModule> reflect(const std::vector<std::uint32_t>& code, const std::string& object);

}  // namespace pelage::rhi::detail
