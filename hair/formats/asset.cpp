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

struct Format {
    std::string_view ending;
    reading::Reader& read;
};
const Format kFormats[] = {
#define PELAGE_READER(ending, function) {ending, reading::function},
#include "readers.def"
#undef PELAGE_READER
};

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

void scaleToMetres(Strands& groom, const std::string& path, Diagnostics& notes) {
    const float span = glm::length(groom.boundsMax - groom.boundsMin);
    if (span >= kLeastSpan && span <= kGreatestSpan) return;
    const auto found = std::find_if(kFactors.begin(), kFactors.end(),
                                    [&](float f) { return span * f >= 0.1F && span * f <= kGreatestSpan; });
    const float factor = found != kFactors.end() ? *found : 0.6F / span;
    for (glm::vec3& p : groom.points) p *= factor;
    for (float& w : groom.widths) w *= factor;
    groom.width *= factor;
    groom.boundsMin *= factor;
    groom.boundsMax *= factor;
    notes.add(remark(Severity::Note, "A101", path,
                     "the groom spans " + number(span) + " units, which is no head of hair in metres; scaled by " +
                         number(factor) + " to " + number(span * factor) + " m",
                     "export the groom in metres to be sure"));
}

void repairWidths(Strands& groom, const std::string& path, Diagnostics& notes) {
    const auto plausible = [](float w) { return w >= kLeastWidth && w <= kGreatestWidth; };
    const Strands standard;
    const bool all = std::all_of(groom.widths.begin(), groom.widths.end(), plausible);
    if (plausible(groom.width) && all) return;
    const float found = all ? groom.width : *std::max_element(groom.widths.begin(), groom.widths.end());
    if (!all) groom.widths.clear();
    groom.width = plausible(groom.width) ? groom.width : standard.width;
    notes.add(remark(Severity::Note, "A102", path,
                     "the groom gives strands a width of " + number(found) + " m, expected " + number(kLeastWidth) +
                         " to " + number(kGreatestWidth) + " m; " + number(groom.width) + " m is used instead",
                     "set the thickness in metres"));
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

std::string describeStrands(const Strands& strands) {
    std::vector<double> lengths;
    for (std::uint32_t s = 0; s < strands.strandCount(); ++s) {
        const auto points = strands.strand(s);
        double length = 0;
        for (std::size_t i = 1; i < points.size(); ++i) length += glm::length(points[i] - points[i - 1]);
        lengths.push_back(length);
    }
    return "strands   " + std::to_string(strands.strandCount()) + "\npoints    " +
           std::to_string(strands.points.size()) + "\n" + boundsText(strands.boundsMin, strands.boundsMax) +
           lengthsText(lengths) + "widths    " +
           (strands.widths.empty() ? number(strands.width * 1e6) + " um everywhere\n" : "per point\n");
}

std::string describeCards(const Mesh& g) {
    return "triangles " + std::to_string(g.indices.size() / 3) + "\nvertices  " + std::to_string(g.vertices.size()) +
           "\nislands   " + std::to_string(g.islandCount) + "\n" + boundsText(g.boundsMin, g.boundsMax) +
           imageText("colour    ", g.colorMap) + imageText("strand ID ", g.strandIdMap) + "direction from texture v\n";
}

}  // namespace

std::string assetEndings() {
    std::string text;
    for (std::size_t i = 0; i < std::size(kFormats); ++i) {
        if (i > 0) text += i + 1 < std::size(kFormats) ? ", " : " or ";
        text += kFormats[i].ending;
    }
    return text;
}

Result<LoadedAsset> loadAsset(const std::string& path) {
    const std::string ending = lowerEnding(path);
    const auto* const format = std::find_if(std::begin(kFormats), std::end(kFormats),
                                            [&](const Format& each) { return each.ending == ending; });
    if (format == std::end(kFormats)) {
        return fault("A100", path, "the ending \"" + ending + "\" is not known, expected " + assetEndings(),
                     "convert the asset, or correct its ending");
    }
    auto source = reading::Source::open(path);
    if (!source) return tl::unexpected(source.error());
    LoadedAsset loaded;
    auto read = format->read(*source, path, loaded.notes);
    if (!read) return tl::unexpected(std::move(read.error()));
    loaded.asset = std::move(*read);
    if (auto* strands = std::get_if<Strands>(&loaded.asset)) {
        scaleToMetres(*strands, path, loaded.notes);
        repairWidths(*strands, path, loaded.notes);
        strands->center = middleOfRoots(*strands);
    }
    return loaded;
}

Result<Strands> reading::strandsOnly(Reader& reader, Source source, const std::string& name) {
    Diagnostics notes;
    auto asset = reader(source, name, notes);
    if (!asset) return tl::unexpected(std::move(asset.error()));
    return std::get<Strands>(std::move(*asset));
}

Result<Strands> reading::strandsOnly(Reader& reader, const std::string& path) {
    return Source::open(path).and_then([&](Source&& source) { return strandsOnly(reader, std::move(source), path); });
}

std::string describe(const LoadedAsset& loaded, const std::string& path) {
    std::string text = "file      " + path + "\nformat    " + lowerEnding(path) + "\n";
    const Strands* strands = std::get_if<Strands>(&loaded.asset);
    text += strands != nullptr ? describeStrands(*strands) : describeCards(std::get<Mesh>(loaded.asset));
    return text + loaded.notes.text();
}

}  // namespace pelage::hair
