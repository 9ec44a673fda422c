// SPDX-License-Identifier: MIT
// Strands to cards: clusters, one curved strip for each, and the atlas that they share.
#include "card_atlas.hpp"
#include "clusters.hpp"

#include "geometry/vectors.hpp"

#include <pelage/hair/generate.hpp>

#include <algorithm>
#include <cmath>

namespace pelage::hair {
namespace {

using glm::vec3;

constexpr std::uint32_t kAcross = 3;  // quads across a card

constexpr float kRootClearance = 0.0018F;  // m

/// Rows lie closer together at the root, where the card turns off the scalp.
float rowAt(std::uint32_t row, std::uint32_t segments) {
    return std::pow(static_cast<float>(row) / static_cast<float>(segments), 1.3F);
}

/// How far (m, outward) the curve bulges over the straight quads next to this row: straight cards cut into the head.
float bulge(const CardFrame& frame, std::uint32_t row, std::uint32_t segments) {
    const auto over = [&](std::uint32_t a, std::uint32_t b) {
        const float va = rowAt(a, segments), vb = rowAt(b, segments);
        const CardFrame::Station low = frame.at(va), mid = frame.at(0.5F * (va + vb)), high = frame.at(vb);
        const vec3 chord = 0.5F * (frame.surface(low, 0) + frame.surface(high, 0));
        return glm::dot(frame.surface(mid, 0) - chord, mid.outward);
    };
    const float before = row > 0 ? over(row - 1, row) : 0.0F;
    const float after = row < segments ? over(row, row + 1) : 0.0F;
    return std::max({before, after, 0.0F});
}

Vertex cardVertex(const CardFrame& frame, float v, float across) {
    const CardFrame::Station station = frame.at(v);
    const float x = station.halfWidth * across;
    Vertex vertex;
    vertex.position = frame.surface(station, x);
    // Differences along the surface itself, so that bends show in the shading.
    const float h = 0.02F;
    const auto point = [&](float at) {
        const CardFrame::Station s = frame.at(at);
        return frame.surface(s, s.halfWidth * across);
    };
    const vec3 alongCard = point(std::min(v + h, 1.0F)) - point(std::max(v - h, 0.0F));
    vertex.tangent = perpendicularOr(alongCard, station.side);
    const vec3 slanted = station.side + station.outward * (2 * station.bend * x);
    vertex.normal = perpendicularOr(glm::cross(slanted, vertex.tangent), vertex.tangent);
    vertex.along = v;
    return vertex;
}

void addCard(const CardFrame& frame, const CardAtlas& atlas, std::uint32_t card, std::uint32_t segments, Mesh& cards) {
    const auto first = static_cast<std::uint32_t>(cards.vertices.size());
    constexpr std::uint32_t columns = kAcross + 1;
    for (std::uint32_t row = 0; row <= segments; ++row) {
        const float v = rowAt(row, segments);
        // Half the roots lie below their mean: without clearance the scalp would hide them.
        const float clearance = kRootClearance * (1.0F - glm::smoothstep(0.10F, 0.40F, v));
        const vec3 lift = frame.at(v).outward * (0.8F * bulge(frame, row, segments) + clearance);
        for (std::uint32_t c = 0; c < columns; ++c) {
            const float u = static_cast<float>(c) / kAcross;
            Vertex vertex = cardVertex(frame, v, 2 * u - 1);
            vertex.position += lift;
            vertex.uv = atlas.uv(card, u, v);
            vertex.strandId = hashUnit(card);
            cards.vertices.push_back(vertex);
        }
    }
    for (std::uint32_t row = 0; row < segments; ++row) {
        for (std::uint32_t c = 0; c < kAcross; ++c) {
            const std::uint32_t a = first + row * columns + c, b = a + 1, d = a + columns, e = d + 1;
            // Counter-clockwise seen from outside: side x strand leads outward.
            cards.indices.insert(cards.indices.end(), {a, b, e, a, e, d});
        }
    }
    ++cards.islandCount;
}

}  // namespace

Mesh bakeCards(const Strands& groom, const CardsDescriptor& descriptor) {
    Mesh cards;
    cards.name = groom.name + " cards";
    const auto groups = clusterStrands(groom, descriptor.cards, descriptor.seed);
    if (groups.empty()) return cards;
    const std::uint32_t segments = std::max(descriptor.segments, 1U);
    const vec3 center = middleOfRoots(groom);
    CardAtlas atlas(static_cast<std::uint32_t>(groups.size()), descriptor.textureSize);
    for (std::uint32_t card = 0; card < groups.size(); ++card) {
        const CardFrame frame = frameOf(groom, groups[card], center);
        atlas.draw(card, groom, groups[card], frame);
        addCard(frame, atlas, card, segments, cards);
    }
    atlas.finish(cards);
    cards.updateBounds();
    return cards;
}

}  // namespace pelage::hair
