// SPDX-License-Identifier: MIT
// Cem Yuksel's HAIR format. Header of 128 bytes: "HAIR"; strand count; point count; flags; default segments per strand;
// default thickness, transparency and colour (3 floats); 88 bytes of text. Then, each present if its flag is set:
// segments (16-bit, one per strand), points (3 floats), thickness, transparency (a float per point), colour (3 floats).
#include "clean.hpp"
#include "readers.hpp"
#include "reading.hpp"

#include <algorithm>
#include <array>

namespace pelage::hair {
namespace {

using reading::fault;
using reading::Source;
constexpr std::size_t kHeaderBytes = 128;
constexpr std::uint32_t kMaxSegments = 65535;  // the format's 16 bits

enum Flag : std::uint32_t { Segments = 1, Points = 2, Thickness = 4, Transparency = 8, Colour = 16 };

struct Header {
    std::uint32_t strands = 0, points = 0, flags = 0, defaultSegments = 0;
    float defaultThickness = 0;
    std::size_t segmentsAt = 0, pointsAt = 0, thicknessAt = 0, end = 0;  // bytes from the start of the file
};

void layOut(Header& h) {
    std::uint64_t at = kHeaderBytes;
    h.segmentsAt = at;
    if (h.flags & Segments) at += std::uint64_t{h.strands} * 2;
    h.pointsAt = at;
    at += std::uint64_t{h.points} * 12;
    h.thicknessAt = at;
    if (h.flags & Thickness) at += std::uint64_t{h.points} * 4;
    if (h.flags & Transparency) at += std::uint64_t{h.points} * 4;
    if (h.flags & Colour) at += std::uint64_t{h.points} * 12;
    h.end = at;
}

Result<Header> readHeader(Source& source, const std::string& name) {
    if (source.size() < kHeaderBytes) {
        return fault("H001", name,
                     "the file has " + std::to_string(source.size()) +
                         " bytes, expected at least the 128 bytes of a HAIR header",
                     "the file is cut off or is no .hair file");
    }
    std::array<std::byte, kHeaderBytes> bytes = {};
    if (!source.read(0, bytes)) return reading::cannotRead(name);
    if (std::memcmp(bytes.data(), "HAIR", 4) != 0) {
        const std::string found(reinterpret_cast<const char*>(bytes.data()), 4);
        return fault("H002", name, "the file starts with \"" + found + "\", expected \"HAIR\"",
                     "this is no .hair file of Cem Yuksel's format");
    }
    Header h;
    h.strands = reading::valueAt<std::uint32_t>(bytes, 4);
    h.points = reading::valueAt<std::uint32_t>(bytes, 8);
    h.flags = reading::valueAt<std::uint32_t>(bytes, 12);
    h.defaultSegments = reading::valueAt<std::uint32_t>(bytes, 16);
    h.defaultThickness = reading::valueAt<float>(bytes, 20);
    if (!(h.flags & Points) || h.strands == 0 || h.points == 0) {
        return fault("H003", name,
                     "the header counts " + std::to_string(h.strands) + " strands and " + std::to_string(h.points) +
                         " points with flags " + std::to_string(h.flags) +
                         ", expected at least 1 strand and the points flag (2)",
                     "export the groom again, with points");
    }
    layOut(h);
    if (h.end > source.size()) {
        return fault("H004", name,
                     "the header promises " + std::to_string(h.strands) + " strands with " + std::to_string(h.points) +
                         " points (" + std::to_string(h.end) + " bytes), but the file has " +
                         std::to_string(source.size()) + " bytes",
                     "the file is cut off or its header is damaged: copy or export it again");
    }
    if (h.points > reading::kMaxVertices || h.strands > reading::kMaxVertices) {
        return fault("H007", name,
                     "the groom has " + std::to_string(h.points) + " points, more than the limit of " +
                         std::to_string(reading::kMaxVertices),
                     "export fewer strands");
    }
    return h;
}

/// Where each strand begins. The segments must use every point exactly once; anything else would shift all strands that
/// follow.
Result<std::vector<std::uint32_t>> readFirst(Source& source, const std::string& name, const Header& h) {
    std::vector<std::uint16_t> segments(h.flags & Segments ? h.strands : 0);
    if (!source.read(h.segmentsAt, segments)) return reading::cannotRead(name);
    const std::uint32_t otherwise = std::min(h.defaultSegments, h.points);
    std::vector<std::uint32_t> first(std::size_t{h.strands} + 1);
    std::uint64_t sum = 0;
    for (std::size_t s = 0; s < h.strands; ++s) {
        sum += std::uint64_t{segments.empty() ? otherwise : segments[s]} + 1;
        first[s + 1] = static_cast<std::uint32_t>(sum);
    }
    if (sum != h.points) {
        return fault("H005", name,
                     "the strands' segments add up to " + std::to_string(sum) + " points, expected the " +
                         std::to_string(h.points) + " of the header",
                     "the file is damaged: export the groom again");
    }
    return first;
}

template <class T>
void put(std::vector<std::byte>& out, std::size_t offset, const T& value) {
    std::memcpy(out.data() + offset, &value, sizeof(T));
}

}  // namespace

Result<Asset> reading::readHair(Source& source, const std::string& name, Diagnostics& notes) {
    const Result<Header> header = readHeader(source, name);
    if (!header) return tl::unexpected(header.error());
    auto first = readFirst(source, name, *header);
    if (!first) return tl::unexpected(first.error());
    Strands strands = {.name = name, .first = std::move(*first)};
    if (isWidth(header->defaultThickness)) strands.width = header->defaultThickness;
    strands.points.resize(header->points);
    strands.widths.resize(header->flags & Thickness ? header->points : 0);
    if (!source.read(header->pointsAt, strands.points) || !source.read(header->thicknessAt, strands.widths))
        return cannotRead(name);
    return cleaned(std::move(strands), 'H', notes);
}

Result<Strands> parseHair(std::span<const std::byte> bytes, const std::string& name) {
    return reading::strandsOnly(reading::readHair, reading::Source(bytes), name);
}

Result<Strands> loadHair(const std::string& path) {
    return reading::strandsOnly(reading::readHair, path);
}

std::vector<std::byte> encodeHair(const Strands& groom) {
    Header h;
    h.strands = groom.strandCount();
    h.flags = Segments | Points | (groom.widths.empty() ? 0U : Thickness);
    h.defaultThickness = groom.width;
    std::uint64_t points = 0;
    const auto kept = [&](std::uint32_t s) {  // points of strand s that the format's 16 bits can count
        return std::min(groom.first[s + 1] - groom.first[s], kMaxSegments + 1);
    };
    for (std::uint32_t s = 0; s < h.strands; ++s) points += std::max(kept(s), 1U);
    h.points = static_cast<std::uint32_t>(points);
    layOut(h);

    std::vector<std::byte> out(h.end);
    std::memcpy(out.data(), "HAIR", 4);
    put(out, 4, h.strands);
    put(out, 8, h.points);
    put(out, 12, h.flags);
    put(out, 16, h.defaultSegments);
    put(out, 20, h.defaultThickness);
    put(out, 24, 0.0F);
    put(out, 28, std::array<float, 3>{1, 1, 1});
    const std::string_view info = "Pelage";
    std::memcpy(out.data() + 40, info.data(), info.size());

    std::size_t next = 0;
    for (std::uint32_t s = 0; s < h.strands; ++s) {
        const std::uint32_t first = groom.first[s];
        const std::uint32_t count = std::max(kept(s), 1U);
        put(out, h.segmentsAt + std::size_t{2} * s, static_cast<std::uint16_t>(count - 1));
        for (std::uint32_t i = 0; i < count; ++i, ++next) {
            // A strand without points cannot be told in the format; one point at the origin is dropped when read.
            const bool real = first + i < groom.points.size();
            const glm::vec3 p = real ? groom.points[first + i] : glm::vec3(0);
            put(out, h.pointsAt + 12 * next, std::array<float, 3>{p.x, p.y, p.z});
            if (groom.widths.empty()) continue;
            const bool wide = first + i < groom.widths.size();
            put(out, h.thicknessAt + 4 * next, wide ? groom.widths[first + i] : groom.width);
        }
    }
    return out;
}

}  // namespace pelage::hair
