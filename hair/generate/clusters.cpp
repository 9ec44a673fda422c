// SPDX-License-Identifier: MIT
#include "clusters.hpp"

#include "random.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace pelage::hair {
namespace {

/// Root, middle and tip, weighted: cards may gather strands whose tips part, but not strands from all over the head.
using Feature = std::array<float, 9>;

Feature featureOf(std::span<const glm::vec3> strand) {
    constexpr std::array<float, 3> weights = {1.6F, 1.1F, 0.7F};
    const std::array<glm::vec3, 3> points = {strand.front(), strand[strand.size() / 2], strand.back()};
    Feature f{};
    for (std::size_t p = 0; p < 3; ++p) {
        for (std::size_t c = 0; c < 3; ++c) f[3 * p + c] = weights[p] * points[p][static_cast<int>(c)];
    }
    return f;
}

float distance(const Feature& a, const Feature& b) {
    float sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

std::uint32_t nearest(const Feature& f, const std::vector<Feature>& centers) {
    std::uint32_t best = 0;
    float least = std::numeric_limits<float>::max();
    for (std::uint32_t c = 0; c < centers.size(); ++c) {
        const float d = distance(f, centers[c]);
        if (d < least) least = d, best = c;
    }
    return best;
}

/// Each center becomes the mean of its strands; an empty one stays where it was.
void moveCenters(const std::vector<Feature>& features, const std::vector<std::uint32_t>& owner,
                 std::vector<Feature>& centers) {
    std::vector<std::array<double, 9>> sums(centers.size(), std::array<double, 9>{});
    std::vector<std::uint32_t> counts(centers.size(), 0);
    for (std::size_t s = 0; s < features.size(); ++s) {
        for (std::size_t i = 0; i < 9; ++i) sums[owner[s]][i] += static_cast<double>(features[s][i]);
        ++counts[owner[s]];
    }
    for (std::size_t c = 0; c < centers.size(); ++c) {
        for (std::size_t i = 0; i < 9 && counts[c] > 0; ++i) centers[c][i] = static_cast<float>(sums[c][i] / counts[c]);
    }
}

}  // namespace

std::vector<std::vector<std::uint32_t>> clusterStrands(const Strands& groom, std::uint32_t count, std::uint32_t seed) {
    std::vector<std::uint32_t> strands;
    std::vector<Feature> features;
    for (std::uint32_t s = 0; s < groom.strandCount(); ++s) {
        const auto strand = groom.strand(s);
        if (strand.size() < 2) continue;
        strands.push_back(s);
        features.push_back(featureOf(strand));
    }
    if (strands.empty() || count == 0) return {};
    // Starting centers: strands drawn without repetition.
    std::vector<std::uint32_t> order(strands.size());
    std::iota(order.begin(), order.end(), 0U);
    Random random(seed, 0x400000000ULL);
    const std::size_t k = std::min<std::size_t>(count, strands.size());
    std::vector<Feature> centers;
    for (std::size_t c = 0; c < k; ++c) {
        const std::size_t pick = c + static_cast<std::size_t>(random.next() % (order.size() - c));
        std::swap(order[c], order[pick]);
        centers.push_back(features[order[c]]);
    }
    std::vector<std::uint32_t> owner(strands.size(), 0);
    constexpr int kRounds = 10;
    for (int round = 0; round < kRounds; ++round) {
        bool moved = false;
        for (std::size_t s = 0; s < features.size(); ++s) {
            const std::uint32_t best = nearest(features[s], centers);
            moved = moved || best != owner[s];
            owner[s] = best;
        }
        if (!moved && round > 0) break;
        if (round + 1 < kRounds) moveCenters(features, owner, centers);
    }
    std::vector<std::vector<std::uint32_t>> groups(k);
    for (std::size_t s = 0; s < strands.size(); ++s) groups[owner[s]].push_back(strands[s]);
    std::erase_if(groups, [](const auto& group) { return group.empty(); });
    return groups;
}

}  // namespace pelage::hair
