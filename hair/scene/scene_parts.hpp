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

inline Geometry generate(const GenerateRequest& request, std::uint32_t subdivisions) {
    if (request.source == Source::Head) return std::make_shared<const Mesh>(makeHead());
    Strands strands = makeGroom(request.groom);
    if (request.source == Source::Cards) return std::make_shared<const Mesh>(bakeCards(strands, request.cards));
    strands.subdivisions = subdivisions;
    return std::make_shared<const Strands>(std::move(strands));
}

/// Strands fewer than this are taken as guides.
inline constexpr std::uint32_t fewStrands = 16000;

/// What a scene file and a lone asset ask for when they say nothing: follow strands for what can only be guides, and a
/// width that covers a head for strands that state none. Each is said in a note.
inline Strands withDefaultPolicies(Strands strands, const std::string& path, Diagnostics& notes) {
    const auto note = [&](Code code, const std::string& text) {
        notes.add({.severity = Severity::Note, .code = code, .file = path, .text = text});
    };
    if (const std::uint32_t count = strands.strandCount(); count < fewStrands) {
        const std::uint32_t copies = std::min(fewStrands / count, 15U);
        strands = withFollowStrands(strands, copies, 1);
        note("A103", std::to_string(count) + " strands are few: taken as guides with " + std::to_string(copies) +
                         " follow strands each");
    }
    if (!strands.widths.empty()) return strands;
    const float covering = coveringWidth(strands);
    if (covering > strands.width) {
        note("A104", "the file states no width: strands are drawn " + std::to_string(std::lround(covering * 1e6F)) +
                         " micrometres wide, so that they cover what a full head of hair would");
    }
    strands.width = covering;
    return strands;
}

/// Reads an asset and makes it drawable; what the reader noted is added to `notes`.
inline Result<Geometry> loadGeometry(const std::string& path, std::uint32_t subdivisions, Diagnostics& notes) {
    auto loaded = loadAsset(path);
    if (!loaded) return tl::unexpected(loaded.error());
    notes.append(loaded->notes);
    if (auto* cards = std::get_if<Mesh>(&loaded->asset)) return std::make_shared<const Mesh>(std::move(*cards));
    Strands strands = withDefaultPolicies(std::get<Strands>(std::move(loaded->asset)), path, notes);
    strands.subdivisions = subdivisions;
    return std::make_shared<const Strands>(std::move(strands));
}

/// The material of an object that names none. Cards that bring their own colours keep them ("asset").
inline std::string defaultMaterial(const Geometry& geometry) {
    if (!isHair(geometry)) return "skin";
    const Mesh* cards = meshOf(geometry);
    return cards != nullptr && !cards->colorMap.empty() && cards->strandIdMap.empty() ? "asset" : "brown";
}

}  // namespace pelage::hair::parts
