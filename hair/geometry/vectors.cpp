// SPDX-License-Identifier: MIT
#include "vectors.hpp"

#include <cmath>

namespace pelage::hair {

glm::vec3 unitOr(const glm::vec3& v, const glm::vec3& fallback) {
    const glm::dvec3 d(v);
    const double squared = glm::dot(d, d);
    if (!(squared > 1e-60) || !std::isfinite(squared)) return fallback;
    return glm::vec3(d / std::sqrt(squared));
}

glm::vec3 anyPerpendicular(const glm::vec3& n) {
    const glm::vec3 axis = std::abs(n.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    return unitOr(axis - n * glm::dot(axis, n), glm::vec3(0, 0, 1));
}

glm::vec3 perpendicularOr(const glm::vec3& v, const glm::vec3& n) {
    const glm::vec3 direction = unitOr(v, glm::vec3(0));
    const glm::vec3 rest = direction - n * glm::dot(direction, n);
    // Below a hundredth of a degree the rest is rounding, not direction.
    if (glm::dot(rest, rest) < 3e-8F) return anyPerpendicular(n);
    return unitOr(rest, anyPerpendicular(n));
}

float hashUnit(std::uint32_t index) {
    std::uint64_t x = (std::uint64_t{index} + 1) * 0x9E3779B97F4A7C15ULL;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
    x ^= x >> 31;
    return static_cast<float>(x >> 40) / static_cast<float>((1U << 24) - 1);
}

}  // namespace pelage::hair
