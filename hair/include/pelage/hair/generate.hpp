// SPDX-License-Identifier: MIT
// Procedural assets, so that the project stands alone: a head, grooms from a seed, and cards baked from a groom.
// The same seed gives the same bytes on every machine (own generator, no std distributions).
#pragma once

#include <pelage/hair/geometry.hpp>

namespace pelage::hair {

enum class Style : std::uint8_t { Straight, Wavy, Curly, Ponytail };

/// A head with neck and shoulders, 0.24 m tall from chin to crown, facing +Z, its middle at (0, 1.60, 0); isHair false.
Mesh makeHead();
/// The middle of the head that makeHead() gives; normals of strands lead away from it.
glm::vec3 headCenter();

struct GroomDescriptor {
    Style style = Style::Wavy;
    std::uint32_t strands = 12000;
    std::uint32_t pointsPerStrand = 24;  // >= 2
    float length = 0.26F;                // m, mean
    float width = 80e-6F;                // m, diameter at the root; tapers towards the tip
    std::uint32_t seed = 1;
};
/// Strands rooted on the scalp of makeHead(), combed around it and never inside it, in clumps, with flyaways.
/// Waves and curls are never tighter than 4 points a turn: for pitches of 2.5 cm ask for 4 points per 2.5 cm of length.
/// Ponytail: `length` is that of the tail; strands are longer by their way over the scalp to the tie.
Strands makeGroom(const GroomDescriptor& descriptor);

/// Each guide and `perGuide` copies of it, spread over the distance to the next root: what a renderer does with a groom
/// that holds guides only. Deterministic in `seed`.
Strands withFollowStrands(const Strands& guides, std::uint32_t perGuide, std::uint32_t seed);

/// A share of the strands (0..1, at least one strand), each as much wider as there are fewer: the light that passes
/// through them stays the same on average (exp of minus the summed widths), and only its variance grows. Strands keep
/// their ids. The strands of a small share are among those of every larger one of the same seed.
Strands decimated(const Strands& strands, float kept, std::uint32_t seed);

/// A width (m) at which the groom's strands cover what a head's 100,000 hairs would: at least its `width`, at most
/// 20 times that.
float coveringWidth(const Strands& groom);

struct CardsDescriptor {
    std::uint32_t cards = 180;         // clusters of strands, one card each
    std::uint32_t textureSize = 1024;  // atlas, power of two
    std::uint32_t segments = 12;       // quads along a card
    std::uint32_t seed = 1;
};
/// Cards that stand for a groom: strands clustered by root and shape, one curved strip per cluster along its mean
/// strand, and an atlas with coverage in colorMap.a, strand-ID in strandIdMap, white base colour.
Mesh bakeCards(const Strands& groom, const CardsDescriptor& descriptor);

}  // namespace pelage::hair
