// SPDX-License-Identifier: MIT
// From guides to something that covers a head: follow strands beside each guide, and a width for a groom that has fewer
// strands than a head has hairs.
#include "random.hpp"

#include <pelage/hair/generate.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pelage::hair {
namespace {

// Median distance from a root to the nearest other root, from at most 500 of them.
float rootSpacing(const Groom& groom) {
    const std::uint32_t count = groom.strandCount(), step = std::max(count / 500U, 1U);
    std::vector<float> nearest;
    for (std::uint32_t a = 0; a < count; a += step) {
        float best = std::numeric_limits<float>::max();
        for (std::uint32_t b = 0; b < count; ++b) {
            if (a == b) continue;
            const glm::vec3 d = groom.points[groom.firstPoint[a]] - groom.points[groom.firstPoint[b]];
            best = std::min(best, glm::dot(d, d));
        }
        nearest.push_back(best);
    }
    if (nearest.empty()) return 0;
    std::nth_element(nearest.begin(), nearest.begin() + std::ptrdiff_t(nearest.size() / 2), nearest.end());
    const float squared = nearest[nearest.size() / 2];
    return squared < 1e6F ? std::sqrt(squared) : 0.0F;
}

float totalLength(const Groom& groom) {
    double sum = 0;
    for (std::uint32_t s = 0; s < groom.strandCount(); ++s) {
        for (std::uint32_t i = groom.firstPoint[s] + 1; i < groom.firstPoint[s + 1]; ++i) {
            sum += double(glm::length(groom.points[i] - groom.points[i - 1]));
        }
    }
    return static_cast<float>(sum);
}

}  // namespace

Groom withFollowStrands(const Groom& guides, std::uint32_t perGuide, std::uint32_t seed) {
    Groom result = {.name = guides.name, .defaultWidth = guides.defaultWidth};
    const float spacing = rootSpacing(guides);
    const bool widths = !guides.widths.empty();
    result.firstPoint.push_back(0);
    for (std::uint32_t s = 0; s < guides.strandCount(); ++s) {
        Random random(seed, s);
        const std::uint32_t begin = guides.firstPoint[s], end = guides.firstPoint[s + 1];
        for (std::uint32_t copy = 0; copy <= perGuide; ++copy) {
            // The guide itself, then copies moved aside at the root and a little more towards the tip.
            const glm::vec3 aside =
                copy == 0 ? glm::vec3(0.0F) : random.onSphere() * (spacing * std::sqrt(random.unit()));
            const glm::vec3 spread = copy == 0 ? glm::vec3(0.0F) : random.onSphere() * (0.8F * spacing);
            for (std::uint32_t i = begin; i < end; ++i) {
                const float along = float(i - begin) / float(std::max(end - begin, 2U) - 1);
                result.points.push_back(guides.points[i] + aside + spread * along);
                if (widths) result.widths.push_back(guides.widths[i]);
            }
            result.firstPoint.push_back(static_cast<std::uint32_t>(result.points.size()));
        }
    }
    return result;
}

float coveringWidth(const Groom& groom) {
    if (groom.points.empty()) return groom.defaultWidth;
    glm::vec3 low = groom.points.front(), high = low;
    for (const glm::vec3& p : groom.points) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::vec3 size = high - low;
    // Seen from the side with the largest area, strands of this width lie about two deep.
    const float area = std::max({size.x * size.y, size.y * size.z, size.z * size.x});
    return std::clamp(2.0F * area / std::max(totalLength(groom), 1e-6F), groom.defaultWidth,
                      20.0F * groom.defaultWidth);
}

}  // namespace pelage::hair
