// SPDX-License-Identifier: MIT
// Small hair files in memory, whole and broken.
#pragma once

#include <cstdint>
#include <string>

namespace pelage::test {

/// .hair with strands of `points` points each; `claimed` strands in the header (0: the true number).
std::string hairFile(std::uint32_t strands, std::uint32_t points, std::uint32_t claimed = 0, bool notANumber = false);

/// .tfx with strands of `points` points each; `claimed` strands in the header (0: the true number).
std::string tfxFile(std::uint32_t strands, std::uint32_t points, std::uint32_t claimed = 0, bool notANumber = false);

struct GlbParts {
    bool positions = true, uvs = true;
    bool notANumber = false;
    std::string image = {};  // bytes of a base colour texture called image/png
};
/// A card of two triangles, 2 cm by 20 cm.
std::string glbFile(const GlbParts& parts = {});

}  // namespace pelage::test
