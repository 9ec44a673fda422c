// SPDX-License-Identifier: MIT
// From guides to something that covers a head: follow strands beside each guide, and a width for a groom that has fewer
// strands than a head has hairs.
#include "geometry/vectors.hpp"
#include "random.hpp"

#include <pelage/hair/generate.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pelage::hair {
namespace {

// Median distance from a root to the nearest other root, from at most 500 of them.
float rootSpacing(const Strands& groom) {
    const std::uint32_t count = groom.strandCount(), step = std::max(count / 500U, 1U);
    std::vector<float> nearest;
    for (std::uint32_t a = 0; a < count; a += step) {
        float best = std::numeric_limits<float>::max();
        for (std::uint32_t b = 0; b < count; ++b) {
            if (a == b) continue;
            const glm::vec3 d = groom.points[groom.first[a]] - groom.points[groom.first[b]];
            best = std::min(best, glm::dot(d, d));
        }
        nearest.push_back(best);
    }
    if (nearest.empty()) return 0;
    std::nth_element(nearest.begin(), nearest.begin() + std::ptrdiff_t(nearest.size() / 2), nearest.end());
    const float squared = nearest[nearest.size() / 2];
    return squared < 1e6F ? std::sqrt(squared) : 0.0F;
}

float totalLength(const Strands& groom) {
    double sum = 0;
    for (std::uint32_t s = 0; s < groom.strandCount(); ++s) {
        for (std::uint32_t i = groom.first[s] + 1; i < groom.first[s + 1]; ++i) {
            sum += double(glm::length(groom.points[i] - groom.points[i - 1]));
        }
    }
    return static_cast<float>(sum);
}

/// Nothing of the strands but what is the same for all of them.
Strands like(const Strands& strands) {
    return {
        .name = strands.name, .width = strands.width, .center = strands.center, .subdivisions = strands.subdivisions};
}

}  // namespace

Strands withFollowStrands(const Strands& guides, std::uint32_t perGuide, std::uint32_t seed) {
    Strands result = like(guides);
    const float spacing = rootSpacing(guides);
    const bool widths = !guides.widths.empty(), colors = !guides.colors.empty();
    const std::size_t times = std::size_t{perGuide} + 1;
    result.points.reserve(guides.points.size() * times);
    result.widths.reserve(guides.widths.size() * times);
    result.colors.reserve(guides.colors.size() * times);
    result.first.reserve(guides.strandCount() * times + 1);
    result.first.push_back(0);
    for (std::uint32_t s = 0; s < guides.strandCount(); ++s) {
        Random random(seed, s);
        const std::uint32_t begin = guides.first[s], end = guides.first[s + 1];
        for (std::uint32_t copy = 0; copy <= perGuide; ++copy) {
            // The guide itself, then copies moved aside at the root and a little more towards the tip.
            const glm::vec3 aside =
                copy == 0 ? glm::vec3(0.0F) : random.onSphere() * (spacing * std::sqrt(random.unit()));
            const glm::vec3 spread = copy == 0 ? glm::vec3(0.0F) : random.onSphere() * (0.8F * spacing);
            for (std::uint32_t i = begin; i < end; ++i) {
                const float along = float(i - begin) / float(std::max(end - begin, 2U) - 1);
                result.points.push_back(guides.points[i] + aside + spread * along);
                if (widths) result.widths.push_back(guides.widths[i]);
                if (colors) result.colors.push_back(guides.colors[i]);
            }
            result.first.push_back(static_cast<std::uint32_t>(result.points.size()));
        }
    }
    result.updateBounds();
    return result;
}

Strands decimated(const Strands& strands, float kept, std::uint32_t seed) {
    const std::uint32_t count = strands.strandCount();
    const float share = std::clamp(kept, 0.0F, 1.0F);
    const auto wanted =
        std::clamp(static_cast<std::uint32_t>(std::lround(double(share) * count)), std::min(count, 1U), count);
    // Ranks that do not depend on the share: what is kept at a small share is kept at every larger one.
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    const auto rank = [&](std::uint32_t s) { return Random(seed, 0x500000000ULL + s).next(); };
    std::vector<std::uint64_t> ranks(count);
    for (std::uint32_t s = 0; s < count; ++s) ranks[s] = rank(s);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return ranks[a] < ranks[b]; });
    order.resize(wanted);
    std::sort(order.begin(), order.end());

    Strands result = like(strands);
    const float wider = wanted > 0 ? float(count) / float(wanted) : 1.0F;
    result.width = strands.width * wider;
    result.first.push_back(0);
    for (const std::uint32_t s : order) {
        const std::size_t begin = strands.first[s], end = strands.first[s + 1];
        for (std::size_t i = begin; i < end; ++i) {
            result.points.push_back(strands.points[i]);
            if (!strands.widths.empty()) result.widths.push_back(strands.widths[i] * wider);
            if (!strands.colors.empty()) result.colors.push_back(strands.colors[i]);
        }
        result.ids.push_back(s < strands.ids.size() ? strands.ids[s] : hashUnit(s));
        result.first.push_back(static_cast<std::uint32_t>(result.points.size()));
    }
    result.updateBounds();
    return result;
}

float coveringWidth(const Strands& groom) {
    if (groom.points.empty()) return groom.width;
    glm::vec3 low = groom.points.front(), high = low;
    for (const glm::vec3& p : groom.points) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::vec3 size = high - low;
    // Seen from the side with the largest area, strands of this width lie about two deep.
    const float area = std::max({size.x * size.y, size.y * size.z, size.z * size.x});
    return std::clamp(2.0F * area / std::max(totalLength(groom), 1e-6F), groom.width, 20.0F * groom.width);
}

}  // namespace pelage::hair
