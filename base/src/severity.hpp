// SPDX-License-Identifier: MIT
#pragma once

#include <pelage/base/diagnostic.hpp>

namespace pelage {

/// "note", "warning" or "error".
std::string_view severityWord(Severity severity);

}  // namespace pelage
