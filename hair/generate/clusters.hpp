// SPDX-License-Identifier: MIT
// Strands that one card can stand for.
#pragma once

#include <pelage/hair/geometry.hpp>

#include <span>
#include <vector>

namespace pelage::hair {

/// Indices of strands, grouped by k-means over root, middle and tip; at most `count` groups, none empty.
std::vector<std::vector<std::uint32_t>> clusterStrands(const Strands& groom, std::uint32_t count, std::uint32_t seed);

/// One cluster seen along its mean strand: stations evenly spaced from the first root to the last tip.
struct CardFrame {
    struct Station {
        glm::vec3 middle = {}, side = {}, outward = {};  // side and outward are unit, perpendicular to the strand
        float halfWidth = 0;                             // m, along `side`
        float rise = 0, bend = 0;                        // m and 1/m: height over `middle` at x is rise + bend x^2
    };
    float length = 0;  // m, along the stations
    std::vector<Station> stations = {};
    std::vector<float> starts = {};  // m, per member: where along the card its root lies

    /// Interpolated; v in 0..1.
    Station at(float v) const;
    glm::vec3 surface(const Station& s, float x) const { return s.middle + s.side * x + s.outward * height(s, x); }
    static float height(const Station& s, float x) { return s.rise + s.bend * x * x; }
};

/// `center` is what the card faces away from.
CardFrame frameOf(const Strands& groom, std::span<const std::uint32_t> members, const glm::vec3& center);

/// The point `arc` m from the root; false before the root and beyond the tip.
bool pointAtArc(std::span<const glm::vec3> strand, float arc, glm::vec3& out);

}  // namespace pelage::hair
