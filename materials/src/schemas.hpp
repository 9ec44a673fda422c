// SPDX-License-Identifier: MIT
// The texts of hair/data/types/*.schema.json, compiled in.
#pragma once

#include <string_view>

namespace pelage::materials {

std::string_view materialTypeSchema();
std::string_view materialSchema();

}  // namespace pelage::materials
