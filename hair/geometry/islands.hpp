// SPDX-License-Identifier: MIT
// What cards do not carry and shading needs: strand direction from texture gradients, islands, place along the strand.
#pragma once

#include <pelage/hair/geometry.hpp>

#include <span>

namespace pelage::hair::cards {

/// Area-weighted vertex normals, for vertices whose normal is not unit (all zero: the file had none).
void fillNormals(Mesh& cards);

/// Vertex::tangent from the gradient of v over the triangles; where v has no gradient, `fallback` (one direction per
/// vertex, may be empty or zero; its sense is corrected by the vertices that have both), then any perpendicular.
/// Returns how many vertices had no gradient.
std::uint32_t fillTangents(Mesh& cards, std::span<const glm::vec3> fallback);

/// strandId, along and islandCount from islands: triangles joined by shared vertices, or across seams by
/// edges with equal end positions.
void fillIslands(Mesh& cards);

/// Hair hangs: when on most islands v plainly grows upward, v points from tip to root. Turns v, the image, tangents
/// and `along` round, and returns true.
bool turnRoundIfUpward(Mesh& cards);

}  // namespace pelage::hair::cards
