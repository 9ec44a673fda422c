// SPDX-License-Identifier: MIT
#include "islands.hpp"

#include "vectors.hpp"

#include <algorithm>
#include <compare>
#include <limits>
#include <numeric>
#include <tuple>

namespace pelage::hair::cards {
namespace {

/// Sets of vertices that grow together (union by lower index, with path halving).
class Sets {
public:
    explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }
    std::uint32_t find(std::uint32_t v) {
        while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
        return v;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::uint32_t> parent_;
};

/// Vertices with equal positions share the lowest of their indices.
std::vector<std::uint32_t> places(const std::vector<Vertex>& vertices) {
    std::vector<std::uint32_t> order(vertices.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&](std::uint32_t i) {
        const glm::vec3& p = vertices[i].position;
        return std::tuple(p.x, p.y, p.z, i);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    std::vector<std::uint32_t> place(vertices.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && vertices[order[i - 1]].position == vertices[order[i]].position;
        place[order[i]] = same ? place[order[i - 1]] : order[i];
    }
    return place;
}

/// Joins triangles across seams: those whose edges have the same two end positions. One common position is not enough,
/// because separate cards often start at the same point of the scalp.
void joinSeams(const Mesh& cards, Sets& sets) {
    const std::vector<std::uint32_t> place = places(cards.vertices);
    struct Edge {
        std::uint32_t low, high, vertex;
        auto operator<=>(const Edge&) const = default;
    };
    std::vector<Edge> edges;
    edges.reserve(cards.indices.size());
    for (std::size_t i = 0; i < cards.indices.size(); ++i) {
        const std::uint32_t a = cards.indices[i], b = cards.indices[i % 3 == 2 ? i - 2 : i + 1];
        if (place[a] != place[b]) edges.push_back({std::min(place[a], place[b]), std::max(place[a], place[b]), a});
    }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 1; i < edges.size(); ++i) {
        const Edge &before = edges[i - 1], &edge = edges[i];
        if (before.low == edge.low && before.high == edge.high) sets.join(before.vertex, edge.vertex);
    }
}

struct Corner {
    const Vertex &a, &b, &c;
};
Corner cornersOf(const Mesh& g, std::size_t triangle) {
    const std::uint32_t* i = g.indices.data() + 3 * triangle;
    return {g.vertices[i[0]], g.vertices[i[1]], g.vertices[i[2]]};
}

}  // namespace

void fillNormals(Mesh& cards) {
    std::vector<glm::dvec3> sums(cards.vertices.size(), glm::dvec3(0));
    for (std::size_t t = 0; t < cards.indices.size() / 3; ++t) {
        const auto [a, b, c] = cornersOf(cards, t);
        const glm::dvec3 area = glm::cross(glm::dvec3(b.position) - glm::dvec3(a.position),
                                           glm::dvec3(c.position) - glm::dvec3(a.position));
        for (std::size_t k = 0; k < 3; ++k) sums[cards.indices[3 * t + k]] += area;
    }
    for (std::size_t v = 0; v < sums.size(); ++v) {
        const double length = glm::length(sums[v]);
        const glm::vec3 computed = length > 0 && std::isfinite(length) ? glm::vec3(sums[v] / length) : glm::vec3(0);
        cards.vertices[v].normal = unitOr(cards.vertices[v].normal, unitOr(computed, glm::vec3(0, 0, 1)));
    }
}

std::uint32_t fillTangents(Mesh& cards, std::span<const glm::vec3> fallback) {
    std::vector<glm::dvec3> sums(cards.vertices.size(), glm::dvec3(0));
    for (std::size_t t = 0; t < cards.indices.size() / 3; ++t) {
        const auto [a, b, c] = cornersOf(cards, t);
        const glm::dvec3 e1 = glm::dvec3(b.position) - glm::dvec3(a.position);
        const glm::dvec3 e2 = glm::dvec3(c.position) - glm::dvec3(a.position);
        const glm::dvec2 d1 = glm::dvec2(b.uv) - glm::dvec2(a.uv), d2 = glm::dvec2(c.uv) - glm::dvec2(a.uv);
        const double det = d1.x * d2.y - d2.x * d1.y;
        // Relative to the longest edges, so that the test does not depend on how large the atlas cell is.
        const double scale = std::max(glm::dot(d1, d1), glm::dot(d2, d2));
        if (!(std::abs(det) > 1e-6 * scale)) continue;
        const glm::dvec3 gradient = (e2 * d1.x - e1 * d2.x) * (det > 0 ? 1.0 : -1.0);
        const double length = glm::length(gradient), area = 0.5 * glm::length(glm::cross(e1, e2));
        if (!(length > 0) || !(area > 0)) continue;
        for (std::size_t k = 0; k < 3; ++k) sums[cards.indices[3 * t + k]] += gradient * (area / length);
    }
    // Exporters disagree about which way a bitangent points in the image; the vertices that have both know.
    double agreement = 0;
    for (std::size_t v = 0; v < fallback.size(); ++v) agreement += glm::dot(sums[v], glm::dvec3(fallback[v]));
    const float sense = agreement < 0 ? -1.0F : 1.0F;

    std::uint32_t without = 0;
    for (std::size_t v = 0; v < sums.size(); ++v) {
        Vertex& vertex = cards.vertices[v];
        const double length = glm::length(sums[v]);
        glm::vec3 direction = length > 0 && std::isfinite(length) ? glm::vec3(sums[v] / length) : glm::vec3(0);
        if (direction == glm::vec3(0)) {
            ++without;
            if (v < fallback.size()) direction = sense * fallback[v];
        }
        vertex.tangent = perpendicularOr(direction, vertex.normal);
    }
    return without;
}

void fillIslands(Mesh& cards) {
    const std::size_t count = cards.vertices.size();
    Sets sets(count);
    std::vector<bool> used(count, false);
    for (std::size_t i = 0; i < cards.indices.size(); i += 3) {
        sets.join(cards.indices[i], cards.indices[i + 1]);
        sets.join(cards.indices[i], cards.indices[i + 2]);
        for (std::size_t k = 0; k < 3; ++k) used[cards.indices[i + k]] = true;
    }
    joinSeams(cards, sets);

    constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> islandOf(count, kNone);
    std::vector<glm::vec2> range;  // least and greatest v
    for (std::uint32_t v = 0; v < count; ++v) {
        if (!used[v]) continue;
        const std::uint32_t root = sets.find(v);
        if (islandOf[root] == kNone) {
            islandOf[root] = static_cast<std::uint32_t>(range.size());
            range.emplace_back(cards.vertices[v].uv.y);
        }
        glm::vec2& r = range[islandOf[root]];
        r = {std::min(r.x, cards.vertices[v].uv.y), std::max(r.y, cards.vertices[v].uv.y)};
    }
    for (std::uint32_t v = 0; v < count; ++v) {
        const std::uint32_t island = islandOf[sets.find(v)];
        if (island == kNone) continue;
        Vertex& vertex = cards.vertices[v];
        const float span = range[island].y - range[island].x;
        vertex.strandId = hashUnit(island);
        vertex.along = span > 0 ? glm::clamp((vertex.uv.y - range[island].x) / span, 0.0F, 1.0F) : 0.0F;
    }
    cards.islandCount = static_cast<std::uint32_t>(range.size());
}

bool turnRoundIfUpward(Mesh& cards) {
    // Mean height of the ends of each island. strandId tells islands apart: 24 bits, and a rare collision only merges
    // two votes.
    struct Ends {
        double root = 0, tip = 0;
        std::uint32_t roots = 0, tips = 0;
    };
    std::vector<std::pair<float, std::uint32_t>> order;
    for (std::uint32_t v = 0; v < cards.vertices.size(); ++v) order.emplace_back(cards.vertices[v].strandId, v);
    std::sort(order.begin(), order.end());
    const float plain = 0.05F * (cards.boundsMax.y - cards.boundsMin.y);
    std::uint32_t upward = 0, downward = 0;
    for (std::size_t i = 0; i < order.size();) {
        Ends ends;
        const float id = order[i].first;
        for (; i < order.size() && order[i].first == id; ++i) {
            const Vertex& v = cards.vertices[order[i].second];
            if (v.along < 1.0F / 3) ends.root += v.position.y, ++ends.roots;
            if (v.along > 2.0F / 3) ends.tip += v.position.y, ++ends.tips;
        }
        if (ends.roots == 0 || ends.tips == 0) continue;
        const double rise = ends.tip / ends.tips - ends.root / ends.roots;
        if (std::abs(rise) > plain) ++(rise > 0 ? upward : downward);
    }
    if (upward <= 2 * downward) return false;
    for (Vertex& v : cards.vertices) {
        v.uv.y = 1.0F - v.uv.y;
        v.tangent = -v.tangent;
        v.along = 1.0F - v.along;
    }
    Image8& image = cards.colorMap;
    const std::size_t row = std::size_t{image.width} * image.channels;
    for (std::size_t y = 0; y < image.height / 2; ++y) {
        const auto top = image.texels.begin() + static_cast<std::ptrdiff_t>(y * row);
        const auto bottom = image.texels.begin() + static_cast<std::ptrdiff_t>((image.height - 1 - y) * row);
        std::swap_ranges(top, top + static_cast<std::ptrdiff_t>(row), bottom);
    }
    return true;
}

}  // namespace pelage::hair::cards
