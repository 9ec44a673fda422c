// SPDX-License-Identifier: MIT
// Surroundings by name or from an equirectangular picture.
#pragma once

#include "failure.hpp"

#include <pelage/hair/scene.hpp>

#include <string>

namespace pelage::app {

/// "none", "studio", or a path to an equirectangular .hdr or .exr.
Result<hair::Environment> chooseEnvironment(const std::string& text);

}  // namespace pelage::app
