// SPDX-License-Identifier: MIT
// Back-to-front order for alpha blending, which is wrong in any other.
#pragma once

#include <pelage/hair/geometry.hpp>

namespace pelage::hair {

/// The indices of `geometry` with its triangles (or segments) sorted by the distance of their centres along `forward`,
/// farthest first. `model` takes the geometry to the space of `forward`. Intersecting triangles stay wrong.
std::vector<std::uint32_t> backToFront(const Geometry& geometry, const glm::mat4& model, const glm::vec3& forward);

}  // namespace pelage::hair
