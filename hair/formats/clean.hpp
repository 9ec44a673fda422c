// SPDX-License-Identifier: MIT
// Strands as a file has them, made strands that can be drawn.
#pragma once

#include <pelage/base/diagnostic.hpp>
#include <pelage/hair/geometry.hpp>

namespace pelage::hair::reading {

/// Drops strands with bad points, merges points that repeat the one before, gives bad widths the default and sets the
/// bounds, all in place: where nothing is wrong nothing moves. Warnings go to `notes` under codes of the letter
/// `family`; the error (family)006 when no strand is left. `read` has points, first, widths (or none) and its name set.
Result<Strands> cleaned(Strands&& read, char family, Diagnostics& notes);

/// A width that a file may state: positive and finite.
bool isWidth(float width);

}  // namespace pelage::hair::reading
