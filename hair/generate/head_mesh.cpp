// SPDX-License-Identifier: MIT
// The mannequin's mesh: surface nets (Gibson 1998) over a rectilinear grid that is finer at the face, every vertex then
// moved onto the surface.
#include "head.hpp"

#include <pelage/hair/generate.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pelage::hair {
namespace {

using glm::vec3;

/// Grid planes from `low` to `high`, `fine` apart within [fineLow, fineHigh], growing to `coarse` outside.
std::vector<float> planes(float low, float high, float fineLow, float fineHigh, float fine, float coarse) {
    std::vector<float> list;
    for (float x = fineLow; x < fineHigh; x += fine) list.push_back(x);
    const float growth = 1.25F;
    float step = fine;
    while (list.back() < high) {
        step = std::min(step * growth, coarse);
        list.push_back(list.back() + step);
    }
    step = fine;
    std::vector<float> below;
    while ((below.empty() ? fineLow : below.back()) > low) {
        step = std::min(step * growth, coarse);
        below.push_back((below.empty() ? fineLow : below.back()) - step);
    }
    list.insert(list.begin(), below.rbegin(), below.rend());
    return list;
}

struct Grid {
    std::vector<float> x, y, z;
    std::vector<float> values;  // distances at the corners, x fastest

    std::size_t at(std::size_t i, std::size_t j, std::size_t k) const { return (k * y.size() + j) * x.size() + i; }
    vec3 corner(std::size_t i, std::size_t j, std::size_t k) const { return {x[i], y[j], z[k]}; }
    void sample() {
        values.resize(x.size() * y.size() * z.size());
        for (std::size_t k = 0; k < z.size(); ++k) {
            for (std::size_t j = 0; j < y.size(); ++j) {
                for (std::size_t i = 0; i < x.size(); ++i) values[at(i, j, k)] = headDistance(corner(i, j, k));
            }
        }
    }
};

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// The mean of the points where the surface crosses the edges of cell (i, j, k); false where it does not.
bool cellVertex(const Grid& g, std::size_t i, std::size_t j, std::size_t k, vec3& out) {
    vec3 sum(0);
    int crossings = 0;
    for (unsigned a = 0; a < 8; ++a) {
        for (unsigned axis = 0; axis < 3; ++axis) {
            const unsigned b = a | (1U << axis);
            if (b == a) continue;
            const auto index = [&](unsigned c) { return g.at(i + (c & 1), j + ((c >> 1) & 1), k + ((c >> 2) & 1)); };
            const auto place = [&](unsigned c) {
                return g.corner(i + (c & 1), j + ((c >> 1) & 1), k + ((c >> 2) & 1));
            };
            const float va = g.values[index(a)], vb = g.values[index(b)];
            if ((va < 0) == (vb < 0)) continue;
            sum += glm::mix(place(a), place(b), va / (va - vb));
            ++crossings;
        }
    }
    if (crossings == 0) return false;
    out = sum / static_cast<float>(crossings);
    return true;
}

Vertex skinVertex(vec3 p) {
    p = toHeight(p, 0.0F);
    Vertex v;
    v.position = p;
    v.normal = headNormal(p);
    const vec3 around(p.z, 0, -p.x);
    const vec3 flat = around - v.normal * glm::dot(around, v.normal);
    const vec3 other = glm::cross(v.normal, std::abs(v.normal.y) < 0.9F ? vec3(0, 1, 0) : vec3(1, 0, 0));
    v.tangent = glm::normalize(glm::dot(flat, flat) > 1e-8F ? flat : other);
    v.uv = {0.5F + std::atan2(p.x, p.z) / 6.2831853F, (1.73F - p.y) / 0.5F};
    return v;
}

}  // namespace

Mesh makeHead() {
    Grid g;
    g.x = planes(-0.24F, 0.24F, -0.0901F, 0.0901F, 0.0053F, 0.018F);
    g.y = planes(1.22F, 1.74F, 1.485F, 1.615F, 0.0050F, 0.018F);
    g.z = planes(-0.15F, 0.13F, -0.0351F, 0.119F, 0.0056F, 0.013F);
    g.sample();
    Mesh head;
    head.name = "head";
    head.isHair = false;
    std::vector<std::uint32_t> vertexOf(g.values.size(), kNone);  // by the cell's lowest corner
    for (std::size_t k = 0; k + 1 < g.z.size(); ++k) {
        for (std::size_t j = 0; j + 1 < g.y.size(); ++j) {
            for (std::size_t i = 0; i + 1 < g.x.size(); ++i) {
                vec3 p;
                if (!cellVertex(g, i, j, k, p)) continue;
                vertexOf[g.at(i, j, k)] = static_cast<std::uint32_t>(head.vertices.size());
                head.vertices.push_back(skinVertex(p));
            }
        }
    }
    // One quad per grid edge that crosses the surface, between the four cells around the edge.
    const std::array<std::size_t, 3> step = {1, g.x.size(), g.x.size() * g.y.size()};
    for (std::size_t k = 1; k + 1 < g.z.size(); ++k) {
        for (std::size_t j = 1; j + 1 < g.y.size(); ++j) {
            for (std::size_t i = 1; i + 1 < g.x.size(); ++i) {
                const std::size_t here = g.at(i, j, k);
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const bool inside = g.values[here] < 0;
                    if (inside == (g.values[here + step[axis]] < 0)) continue;
                    const std::size_t u = step[(axis + 1) % 3], v = step[(axis + 2) % 3];
                    std::array<std::uint32_t, 4> quad = {vertexOf[here - u - v], vertexOf[here - v], vertexOf[here],
                                                         vertexOf[here - u]};
                    if (!inside) std::swap(quad[1], quad[3]);
                    for (const std::size_t c : {0, 1, 2, 0, 2, 3}) head.indices.push_back(quad[c]);
                }
            }
        }
    }
    head.updateBounds();
    return head;
}

}  // namespace pelage::hair
