// SPDX-License-Identifier: MIT
// Mip chains on the CPU: box filter; colour in linear light and weighted by opacity, so that what lies outside a card's
// strands does not bleed into them.
#pragma once

#include <pelage/hair/geometry.hpp>

namespace pelage::hair {

/// RGBA (4 channels) or one channel, all levels, the given image first; 2-channel images become RGBA.
std::vector<Image8> mipChain(const Image8& image);

}  // namespace pelage::hair
