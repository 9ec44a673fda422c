// SPDX-License-Identifier: MIT
#include <pelage/hair/library.hpp>

#include <cstdint>

extern "C" __attribute__((visibility("default"))) std::uint32_t hostPluginEntry(const char* data) {
    const pelage::hair::Library library(data);
    return static_cast<std::uint32_t>(library.presetNames().size());
}
