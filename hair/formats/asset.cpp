// SPDX-License-Identifier: MIT
// Any asset by its ending, its units made metres, and a description of it for people.
#include "readers.hpp"
#include "reading.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>

namespace pelage::hair {
namespace {

using reading::fault;
using reading::remark;

// A groom in metres spans between 3 cm (an eyebrow) and 4 m (a horse with its tail). One that does not was made in
// other units; the first of these factors that brings it into the usual range is taken.
constexpr float kLeastSpan = 0.03F, kGreatestSpan = 4.0F;
constexpr std::array<float, 5> kFactors = {0.01F, 0.001F, 1e-4F, 10.0F, 100.0F};
constexpr float kLeastWidth = 2e-6F, kGreatestWidth = 5e-3F;  // m

std::string number(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.4g", value);
    return text.data();
}

std::string lowerEnding(const std::string& path) {
    const std::size_t dot = path.find_last_of('.');
    if (dot == std::string::npos || path.find_first_of("/\\", dot) != std::string::npos) return "";
    std::string ending = path.substr(dot);
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return ending;
}

struct Bounds {
    glm::vec3 low = glm::vec3(0), high = glm::vec3(0);
    float span() const { return glm::length(high - low); }
};

Bounds boundsOf(const Groom& groom) {
    Bounds b;
    if (!groom.points.empty()) b.low = b.high = groom.points.front();
    for (const glm::vec3& p : groom.points) {
        b.low = glm::min(b.low, p);
        b.high = glm::max(b.high, p);
    }
    return b;
}

void scaleToMetres(Groom& groom, const std::string& path, Diagnostics& notes) {
    const float span = boundsOf(groom).span();
    if (span >= kLeastSpan && span <= kGreatestSpan) return;
    const auto found = std::find_if(kFactors.begin(), kFactors.end(),
                                    [&](float f) { return span * f >= 0.1F && span * f <= kGreatestSpan; });
    const float factor = found != kFactors.end() ? *found : 0.6F / span;
    for (glm::vec3& p : groom.points) p *= factor;
    for (float& w : groom.widths) w *= factor;
    groom.defaultWidth *= factor;
    notes.add(remark(Severity::Note, "A101", path,
                     "the groom spans " + number(span) + " units, which is no head of hair in metres; scaled by " +
                         number(factor) + " to " + number(span * factor) + " m",
                     "export the groom in metres to be sure"));
}

void repairWidths(Groom& groom, const std::string& path, Diagnostics& notes) {
    const auto plausible = [](float w) { return w >= kLeastWidth && w <= kGreatestWidth; };
    const Groom standard;
    const bool all = std::all_of(groom.widths.begin(), groom.widths.end(), plausible);
    if (plausible(groom.defaultWidth) && all) return;
    const float found = all ? groom.defaultWidth : *std::max_element(groom.widths.begin(), groom.widths.end());
    if (!all) groom.widths.clear();
    groom.defaultWidth = plausible(groom.defaultWidth) ? groom.defaultWidth : standard.defaultWidth;
    notes.add(remark(Severity::Note, "A102", path,
                     "the groom gives strands a width of " + number(found) + " m, expected " + number(kLeastWidth) +
                         " to " + number(kGreatestWidth) + " m; " + number(groom.defaultWidth) + " m is used instead",
                     "set the thickness in metres"));
}

Result<LoadedAsset> finishGroom(Result<Groom> groom, const std::string& path, Diagnostics notes) {
    if (!groom) return tl::unexpected(std::move(groom.error()));
    scaleToMetres(*groom, path, notes);
    repairWidths(*groom, path, notes);
    return LoadedAsset{std::move(*groom), std::move(notes)};
}

std::string boundsText(const glm::vec3& low, const glm::vec3& high) {
    std::string text = "bounds    ";
    for (int i = 0; i < 3; ++i) text += (i ? ", " : "") + number(low[i]) + " .. " + number(high[i]);
    return text + " m\n";
}

std::string lengthsText(const std::vector<double>& lengths) {
    if (lengths.empty()) return "";
    std::vector<double> sorted = lengths;
    std::sort(sorted.begin(), sorted.end());
    return "lengths   " + number(sorted.front()) + " .. " + number(sorted.back()) + " m, median " +
           number(sorted[sorted.size() / 2]) + " m\n";
}

std::string imageText(const char* label, const Image8& image) {
    if (image.empty()) return std::string(label) + "none\n";
    return label + std::to_string(image.width) + " x " + std::to_string(image.height) + ", " +
           std::to_string(image.channels) + " channels\n";
}

std::string describeGroom(const Groom& groom) {
    std::vector<double> lengths;
    for (std::uint32_t s = 0; s < groom.strandCount(); ++s) {
        double length = 0;
        for (std::size_t i = groom.firstPoint[s] + std::size_t{1}; i < groom.firstPoint[s + 1]; ++i) {
            length += glm::length(groom.points[i] - groom.points[i - 1]);
        }
        lengths.push_back(length);
    }
    const Bounds b = boundsOf(groom);
    return "strands   " + std::to_string(groom.strandCount()) + "\npoints    " + std::to_string(groom.points.size()) +
           "\n" + boundsText(b.low, b.high) + lengthsText(lengths) + "widths    " +
           (groom.widths.empty() ? number(groom.defaultWidth * 1e6) + " um everywhere\n" : "per point\n");
}

std::string describeCards(const Geometry& g) {
    return "triangles " + std::to_string(g.indices.size() / 3) + "\nvertices  " + std::to_string(g.vertices.size()) +
           "\nislands   " + std::to_string(g.strandCount) + "\n" + boundsText(g.boundsMin, g.boundsMax) +
           imageText("colour    ", g.colorMap) + imageText("strand ID ", g.strandIdMap) + "direction from texture v\n";
}

}  // namespace

Result<LoadedAsset> loadAsset(const std::string& path) {
    const std::string ending = lowerEnding(path);
    const bool known = ending == ".glb" || ending == ".gltf" || ending == ".tfx" || ending == ".hair";
    if (!known) {
        return tl::unexpected(fault("A100", path,
                                    "the ending \"" + ending + "\" is not known, expected .glb, .gltf, .tfx or .hair",
                                    "convert the asset, or correct its ending"));
    }
    const auto bytes = readFile(path);
    if (!bytes) return tl::unexpected(bytes.error());
    Diagnostics notes;
    if (ending == ".tfx") {
        auto groom = reading::readTfx(*bytes, path, notes);
        return finishGroom(std::move(groom), path, std::move(notes));
    }
    if (ending == ".hair") {
        auto groom = reading::readHair(*bytes, path, notes);
        return finishGroom(std::move(groom), path, std::move(notes));
    }
    auto cards = reading::readGltf(*bytes, path, reading::folderOf(path), notes);
    if (!cards) return tl::unexpected(std::move(cards.error()));
    return LoadedAsset{std::move(*cards), std::move(notes)};
}

std::string describe(const LoadedAsset& loaded, const std::string& path) {
    std::string text = "file      " + path + "\nformat    " + lowerEnding(path) + "\n";
    const Groom* groom = std::get_if<Groom>(&loaded.asset);
    text += groom != nullptr ? describeGroom(*groom) : describeCards(std::get<Geometry>(loaded.asset));
    return text + loaded.notes.text();
}

}  // namespace pelage::hair
