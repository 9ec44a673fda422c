// SPDX-License-Identifier: MIT
// The two drawings of the page, as inline SVG whose columns are the passes: what lives when, and where in the heap.
#pragma once

#include "plan_text.hpp"

#include <pelage/passes/page.hpp>

namespace pelage::passes {

/// Text as it may stand in HTML and in attributes.
std::string escaped(std::string_view text);
/// "37 %" of a whole; "-" when the whole is nothing.
std::string shareText(double part, double whole);

/// Passes as columns with what was measured of them; one row for each image with its life as a bar and, where a pass
/// uses it, how, which version, load and store.
std::string lifeChart(const Plan& plan, const PageOptions& options);
/// Bytes of the heap downwards, passes across: a box is an image, as long as it lives.
std::string heapChart(const Plan& plan);

}  // namespace pelage::passes
