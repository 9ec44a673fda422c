// SPDX-License-Identifier: MIT
// Strands to line segments: a uniform Catmull-Rom curve through the points of each strand.
#include "vectors.hpp"

#include <pelage/hair/geometry.hpp>

#include <algorithm>
#include <span>

namespace pelage::hair {
namespace {

/// One span of the curve, between b and c; a and d are their neighbours.
struct Span {
    glm::vec3 a, b, c, d;

    glm::vec3 at(float t) const {
        const glm::vec3 m0 = 0.5F * (c - a), m1 = 0.5F * (d - b);
        const glm::vec3 e = c - b;
        return b + t * (m0 + t * (3.0F * e - 2.0F * m0 - m1 + t * (m0 + m1 - 2.0F * e)));
    }
    glm::vec3 derivative(float t) const {
        const glm::vec3 m0 = 0.5F * (c - a), m1 = 0.5F * (d - b);
        const glm::vec3 e = c - b;
        return m0 + t * (2.0F * (3.0F * e - 2.0F * m0 - m1) + 3.0F * t * (m0 + m1 - 2.0F * e));
    }
};

Span spanAt(std::span<const glm::vec3> points, std::size_t i) {
    const std::size_t last = points.size() - 1;
    return {points[i == 0 ? 0 : i - 1], points[i], points[i + 1], points[std::min(i + 2, last)]};
}

/// Arc length so far, as a share of the whole, written to `along`.
void parametriseByLength(std::span<Vertex> strand) {
    double length = 0;
    std::vector<double> sums(strand.size(), 0.0);
    for (std::size_t i = 1; i < strand.size(); ++i) {
        length += glm::length(glm::dvec3(strand[i].position) - glm::dvec3(strand[i - 1].position));
        sums[i] = length;
    }
    for (std::size_t i = 0; i < strand.size(); ++i) {
        const double even = static_cast<double>(i) / static_cast<double>(strand.size() - 1);
        strand[i].along = static_cast<float>(length > 0 ? sums[i] / length : even);
        strand[i].uv = {strand[i].strandId, strand[i].along};
    }
}

}  // namespace

void Geometry::updateBounds() {
    boundsMin = boundsMax = vertices.empty() ? glm::vec3(0) : vertices.front().position;
    for (const Vertex& v : vertices) {
        boundsMin = glm::min(boundsMin, v.position);
        boundsMax = glm::max(boundsMax, v.position);
    }
}

Geometry toLines(const Groom& groom, std::uint32_t subdivisions, const glm::vec3& center) {
    const std::uint32_t parts = std::max(subdivisions, 1U);
    Geometry geometry;
    geometry.name = groom.name;
    geometry.topology = Topology::Lines;
    const std::size_t expected = groom.points.size() * parts;
    geometry.vertices.reserve(expected);
    geometry.indices.reserve(2 * expected);
    const auto widthAt = [&](std::size_t point) {
        return point < groom.widths.size() ? groom.widths[point] : groom.defaultWidth;
    };

    for (std::uint32_t s = 0; s < groom.strandCount(); ++s) {
        const std::size_t first = groom.firstPoint[s], end = groom.firstPoint[s + 1];
        if (end > groom.points.size() || end < first + 2) continue;
        const std::span<const glm::vec3> points(groom.points.data() + first, end - first);
        const auto base = static_cast<std::uint32_t>(geometry.vertices.size());
        const std::size_t segments = (points.size() - 1) * parts;
        const float id = hashUnit(s);
        glm::vec3 before = unitOr(points.back() - points.front(), glm::vec3(0, -1, 0));
        for (std::size_t k = 0; k <= segments; ++k) {
            const std::size_t i = std::min(k / parts, points.size() - 2);
            const float t = static_cast<float>(k - i * parts) / static_cast<float>(parts);
            const Span span = spanAt(points, i);
            Vertex v;
            // The curve passes through its points; taking them as they are keeps roots exactly on the scalp.
            v.position = t == 0.0F ? span.b : t == 1.0F ? span.c : span.at(t);
            v.tangent = unitOr(span.derivative(t), unitOr(span.c - span.b, before));
            v.normal = perpendicularOr(v.position - center, v.tangent);
            v.width = glm::mix(widthAt(first + i), widthAt(first + i + 1), t);
            v.strandId = id;
            before = v.tangent;
            geometry.vertices.push_back(v);
            if (k == 0) continue;
            const auto index = static_cast<std::uint32_t>(geometry.vertices.size() - 1);
            geometry.indices.insert(geometry.indices.end(), {index - 1, index});
        }
        parametriseByLength(std::span(geometry.vertices).subspan(base));
        ++geometry.strandCount;
    }
    geometry.updateBounds();
    return geometry;
}

}  // namespace pelage::hair
