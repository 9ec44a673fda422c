// SPDX-License-Identifier: MIT
// The few strands that carry the shape of a groom; all others follow them.
#pragma once

#include "random.hpp"

#include <pelage/hair/generate.hpp>

#include <span>
#include <vector>

namespace pelage::hair {

/// A place where a strand leaves the scalp.
struct Root {
    glm::vec3 position = {};  // on the surface of the head
    float side = 1;           // which side of the parting: -1 or +1
};

/// `count` roots, uniform over the scalp by area.
std::vector<Root> scatterRoots(std::uint32_t count, std::uint32_t seed);

/// A polyline of `points` points, evenly spaced, `length` m long, from the root down over head and shoulders.
std::vector<glm::vec3> growGuide(const Root& root, float length, std::uint32_t points, Random& random);

/// A polyline of `points` points from the root back over the scalp to the tie and on into the tail; the tail beyond the
/// tie is `tail` m long, so the strand is longer than that by its way over the scalp.
std::vector<glm::vec3> growPonytail(const Root& root, float tail, std::uint32_t points, Random& random);

/// The same curve with `points` points, evenly spaced by length.
std::vector<glm::vec3> resample(std::span<const glm::vec3> curve, std::uint32_t points);

float lengthOf(std::span<const glm::vec3> curve);

}  // namespace pelage::hair
