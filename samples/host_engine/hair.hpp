// SPDX-License-Identifier: MIT
// Hair in the host's frame: the only file besides hair.cpp that knows Pelage.
#pragma once

#include "engine.hpp"

namespace host {

/// A guest that draws a head of hair. `dataDirectory` has Pelage's pass trees and materials.
Guest hairGuest(const std::string& dataDirectory);

}  // namespace host
