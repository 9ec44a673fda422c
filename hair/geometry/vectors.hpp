// SPDX-License-Identifier: MIT
// Unit directions with a fallback for vectors that have none, and a hash that is the same on every machine.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>

namespace pelage::hair {

/// Unit vector along `v`, or `fallback` where `v` has no direction. Computed in double: nothing under- or overflows.
glm::vec3 unitOr(const glm::vec3& v, const glm::vec3& fallback);
/// Some unit vector perpendicular to the unit vector `n`.
glm::vec3 anyPerpendicular(const glm::vec3& n);
/// The part of `v` perpendicular to the unit vector `n`, unit; any perpendicular where nothing is left.
glm::vec3 perpendicularOr(const glm::vec3& v, const glm::vec3& n);

/// Uniform in [0, 1], the same on every machine; neighbouring indices are unrelated.
float hashUnit(std::uint32_t index);

}  // namespace pelage::hair
