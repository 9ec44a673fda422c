// SPDX-License-Identifier: MIT
// The curve of a strand: uniform Catmull-Rom as a cubic Hermite spline whose tangent at a point is half the way from
// the point before to the point after (Catmull and Rom 1974). visibility/strands/strands.vert computes the same on the
// device.
#include <pelage/hair/geometry.hpp>

#include <algorithm>

namespace pelage::hair {
namespace {

/// One span of the curve, between b and c, with its tangents there.
struct Span {
    glm::vec3 b, c, m0, m1;
};

Span spanAt(std::span<const glm::vec3> points, std::size_t i) {
    const glm::vec3 &a = points[i == 0 ? 0 : i - 1], &b = points[i], &c = points[i + 1],
                    &d = points[std::min(i + 2, points.size() - 1)];
    return {b, c, 0.5F * (c - a), 0.5F * (d - b)};
}

}  // namespace

glm::vec3 curveAt(std::span<const glm::vec3> points, std::size_t segment, float t) {
    const auto [b, c, m0, m1] = spanAt(points, segment);
    // Taking the points as they are keeps roots exactly on the scalp.
    if (t <= 0.0F) return b;
    if (t >= 1.0F) return c;
    const glm::vec3 e = c - b;
    return b + t * (m0 + t * (3.0F * e - 2.0F * m0 - m1 + t * (m0 + m1 - 2.0F * e)));
}

glm::vec3 curveDerivative(std::span<const glm::vec3> points, std::size_t segment, float t) {
    const auto [b, c, m0, m1] = spanAt(points, segment);
    const glm::vec3 e = c - b;
    return m0 + t * (2.0F * (3.0F * e - 2.0F * m0 - m1) + 3.0F * t * (m0 + m1 - 2.0F * e));
}

}  // namespace pelage::hair
