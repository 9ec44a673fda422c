// SPDX-License-Identifier: MIT
// The picture of each card's strands, one tall cell per card in one square atlas.
#pragma once

#include "clusters.hpp"

#include <pelage/hair/generate.hpp>

namespace pelage::hair {

class CardAtlas {
public:
    CardAtlas(std::uint32_t cards, std::uint32_t size);

    /// Draws the strands of one card into its cell.
    void draw(std::uint32_t card, const Strands& groom, std::span<const std::uint32_t> members, const CardFrame& frame);
    /// Texture coordinates of a card's point: across and down its cell, both 0..1.
    glm::vec2 uv(std::uint32_t card, float across, float down) const;
    void finish(Mesh& cards);

private:
    struct Cell {
        std::uint32_t x, y, width, height;
    };
    Cell cellOf(std::uint32_t card) const;

    std::uint32_t size_, columns_ = 1, rows_ = 1;
    std::vector<float> coverage_;    // size * size
    std::vector<std::uint8_t> ids_;  // size * size; 0 where nothing is drawn
};

}  // namespace pelage::hair
