// SPDX-License-Identifier: MIT
// A frame's work as text for people.
#pragma once

#include <pelage/hair/renderer.hpp>

#include <string>

namespace pelage::app {

/// Tables of passes and attachments, and one line of counters.
std::string reportText(const hair::FrameReport& report);

}  // namespace pelage::app
