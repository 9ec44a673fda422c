// SPDX-License-Identifier: MIT
// What scene files and lone assets share: geometry from an asset or a generator.
#pragma once

#include <pelage/hair/generate.hpp>
#include <pelage/hair/load.hpp>

#include <cmath>
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

/// A groom with fewer strands than this holds guides.
inline constexpr std::uint32_t fewStrands = 16000;

/// Reads an asset and makes it drawable; what the reader noted is added to `notes`.
inline Result<std::shared_ptr<const Geometry>> loadGeometry(const std::string& path, std::uint32_t subdivisions,
                                                             Diagnostics& notes) {
    auto loaded = loadAsset(path);
    if (!loaded) return tl::unexpected(loaded.error());
    notes.append(loaded->notes);
    if (const auto* read = std::get_if<Groom>(&loaded->asset)) {
        Groom groom = *read;
        const auto note = [&](const char* code, const std::string& text) {
            notes.add({.severity = Severity::Note, .code = code, .file = path, .text = text});
        };
        if (groom.strandCount() < fewStrands) {
            const std::uint32_t copies = std::min(fewStrands / groom.strandCount(), 15U);
            groom = withFollowStrands(groom, copies, 1);
            note("A103", std::to_string(read->strandCount()) + " strands are few: taken as guides with " +
                             std::to_string(copies) + " follow strands each");
        }
        if (groom.widths.empty()) {
            groom.defaultWidth = coveringWidth(groom);
            if (groom.defaultWidth > read->defaultWidth) {
                note("A104", "the file states no width: strands are drawn " +
                                 std::to_string(std::lround(groom.defaultWidth * 1e6F)) +
                                 " micrometres wide, so that they cover what a full head of hair would");
            }
        }
        return std::make_shared<const Geometry>(toLines(groom, subdivisions, middleOfRoots(groom)));
    }
    return std::make_shared<const Geometry>(std::move(std::get<Geometry>(loaded->asset)));
}

/// The material of an object that names none. Cards that bring their own colours keep them ("asset").
inline std::string defaultMaterial(const Geometry& geometry) {
    if (!geometry.isHair) return "skin";
    return geometry.colorMap.empty() || !geometry.strandIdMap.empty() ? "brown" : "asset";
}

}  // namespace pelage::hair::parts
