// SPDX-License-Identifier: MIT
// Back-to-front order for alpha blending, which is wrong in any other.
#pragma once

#include <pelage/hair/geometry.hpp>

namespace pelage::hair {

/// Sorts the triangles of a mesh, or the segments of strands, by the distance of their centres along `forward`,
/// farthest first; equals stay in their order. `model` takes the geometry to the space of `forward`. Intersecting
/// triangles stay wrong. One object serves many sorts, and allocates only when one is larger than all before it.
class BackToFront {
public:
    /// Three indices a triangle.
    std::span<const std::uint32_t> triangles(const Mesh& mesh, const glm::mat4& model, const glm::vec3& forward);
    /// Strand and point of it where the segment begins; `points` are this frame's, in the order of the strands'.
    std::span<const glm::uvec2> segments(const Strands& strands, std::span<const glm::vec3> points,
                                         const glm::mat4& model, const glm::vec3& forward);

private:
    void sort();

    std::vector<float> depth_;  // along the axis, up to a constant that sorting does not see
    std::vector<std::uint32_t> order_, indices_;
    std::vector<glm::uvec2> segments_, sorted_;
};

}  // namespace pelage::hair
