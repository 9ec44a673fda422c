// SPDX-License-Identifier: MIT
// Roots uniform over the scalp, and curves evenly spaced by length.
#include "guides.hpp"
#include "head.hpp"

#include <algorithm>

namespace pelage::hair {
namespace {

/// The parting runs a little left of the middle, from the forehead to the whorl.
float sideOfParting(const glm::vec3& p) {
    return p.x > 0.012F ? 1.0F : -1.0F;
}

struct ScalpTriangle {
    glm::vec3 a, b, c;
};

}  // namespace

std::vector<Root> scatterRoots(std::uint32_t count, std::uint32_t seed) {
    const Mesh head = makeHead();
    std::vector<ScalpTriangle> triangles;
    std::vector<double> areas;  // running sum
    double sum = 0;
    for (std::size_t i = 0; i < head.indices.size(); i += 3) {
        const auto corner = [&](std::size_t k) { return head.vertices[head.indices[i + k]].position; };
        const ScalpTriangle t = {corner(0), corner(1), corner(2)};
        if (!isScalp(t.a) && !isScalp(t.b) && !isScalp(t.c)) continue;
        sum += 0.5 * static_cast<double>(glm::length(glm::cross(t.b - t.a, t.c - t.a)));
        triangles.push_back(t);
        areas.push_back(sum);
    }
    // Roots of a number never move when more are asked for; a strand that falls off the hairline is drawn again.
    std::vector<Root> roots(count);
    for (std::uint32_t s = 0; s < count; ++s) {
        Random random(seed, 0x100000000ULL + s);
        for (int attempt = 0; attempt < 64; ++attempt) {
            const double target = static_cast<double>(random.unit()) * sum;
            const auto found = std::upper_bound(areas.begin(), areas.end() - 1, target);
            const ScalpTriangle& t = triangles[static_cast<std::size_t>(found - areas.begin())];
            float u = random.unit(), v = random.unit();
            if (u + v > 1) u = 1 - u, v = 1 - v;
            const glm::vec3 p = toHeight(t.a + u * (t.b - t.a) + v * (t.c - t.a), 0.0F);
            roots[s] = {p, sideOfParting(p)};
            if (isScalp(p)) break;
        }
    }
    return roots;
}

float lengthOf(std::span<const glm::vec3> curve) {
    float length = 0;
    for (std::size_t i = 1; i < curve.size(); ++i) length += glm::length(curve[i] - curve[i - 1]);
    return length;
}

std::vector<glm::vec3> resample(std::span<const glm::vec3> curve, std::uint32_t points) {
    std::vector<glm::vec3> out;
    out.reserve(points);
    const float step = lengthOf(curve) / static_cast<float>(points - 1);
    float travelled = 0;  // up to curve[i]
    std::size_t i = 0;
    for (std::uint32_t k = 0; k + 1 < points; ++k) {
        const float target = step * static_cast<float>(k);
        float piece = glm::length(curve[i + 1] - curve[i]);
        while (travelled + piece < target && i + 2 < curve.size()) {
            travelled += piece;
            ++i;
            piece = glm::length(curve[i + 1] - curve[i]);
        }
        const float t = piece > 0 ? std::clamp((target - travelled) / piece, 0.0F, 1.0F) : 0.0F;
        out.push_back(glm::mix(curve[i], curve[i + 1], t));
    }
    out.push_back(curve.back());
    return out;
}

}  // namespace pelage::hair
