// SPDX-License-Identifier: MIT
// What scene files and lone assets share: geometry from an asset or a generator.
#pragma once

#include <pelage/hair/generate.hpp>
#include <pelage/hair/load.hpp>

#include <memory>
#include <string>
#include <utility>

namespace pelage::hair::parts {

enum class Source : std::uint8_t { Head, Groom, Cards };

/// The generators with all that they can be told.
struct GenerateRequest {
    Source source = Source::Groom;
    GroomDescriptor groom = {};
    CardsDescriptor cards = {};
};

/// The middle of the box around the roots: normals lead away from it when nobody says where the head is.
inline glm::vec3 middleOfRoots(const Groom& groom) {
    if (groom.strandCount() == 0) return headCenter();
    glm::vec3 low = groom.points[groom.firstPoint[0]];
    glm::vec3 high = low;
    for (std::uint32_t strand = 1; strand < groom.strandCount(); ++strand) {
        const glm::vec3 root = groom.points[groom.firstPoint[strand]];
        low = glm::min(low, root);
        high = glm::max(high, root);
    }
    return (low + high) * 0.5F;
}

inline std::shared_ptr<const Geometry> generate(const GenerateRequest& request, std::uint32_t subdivisions) {
    switch (request.source) {
        case Source::Head:
            return std::make_shared<const Geometry>(makeHead());
        case Source::Cards:
            return std::make_shared<const Geometry>(bakeCards(makeGroom(request.groom), request.cards));
        case Source::Groom:
            break;
    }
    return std::make_shared<const Geometry>(toLines(makeGroom(request.groom), subdivisions, headCenter()));
}

/// Reads an asset and makes it drawable; what the reader noted is added to `notes`.
inline Outcome<std::shared_ptr<const Geometry>> loadGeometry(const std::string& path, std::uint32_t subdivisions,
                                                             Diagnostics& notes) {
    auto loaded = loadAsset(path);
    if (!loaded) return tl::unexpected(loaded.error());
    notes.append(loaded->notes);
    if (const auto* groom = std::get_if<Groom>(&loaded->asset)) {
        return std::make_shared<const Geometry>(toLines(*groom, subdivisions, middleOfRoots(*groom)));
    }
    return std::make_shared<const Geometry>(std::move(std::get<Geometry>(loaded->asset)));
}

/// The material of an object that names none.
inline std::string defaultMaterial(const Geometry& geometry) {
    return geometry.isHair ? "brown" : "skin";
}

}  // namespace pelage::hair::parts
