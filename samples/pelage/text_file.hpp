// SPDX-License-Identifier: MIT
// Whole files of text; "-" is standard input or output.
#pragma once

#include "failure.hpp"

#include <string>

namespace pelage::app {

Result<std::string> readTextFile(const std::string& path);
/// Writes beside `path` and renames at the end, so that a file is either whole or not there.
Result<void> writeTextFile(const std::string& path, const std::string& text);

}  // namespace pelage::app
