// SPDX-License-Identifier: MIT
// TressFX 4 grooms. Header of 160 bytes: float version; then as unsigned 32-bit numbers the strand count, the points
// per strand, and offsets from the start of the file of positions (float4, w is the inverse mass), strand texture
// coordinates (float2), vertex texture coordinates (float2), strand thickness and vertex colour; 0 means absent.
#include "clean.hpp"
#include "readers.hpp"
#include "reading.hpp"

#include <algorithm>
#include <array>

namespace pelage::hair {
namespace {

using reading::fault;
using reading::Source;
constexpr std::size_t kHeaderBytes = 160;
constexpr std::size_t kPointBytes = 16;

struct Header {
    float version = 0;
    std::uint32_t strands = 0, pointsPerStrand = 0, positions = 0;
};

tl::unexpected<Diagnostics> promisesMore(const std::string& name, const Header& h, std::uint64_t size) {
    return fault("T004", name,
                 "the header promises " + std::to_string(h.strands) + " strands of " +
                     std::to_string(h.pointsPerStrand) + " points (" +
                     std::to_string(std::uint64_t{h.strands} * h.pointsPerStrand) + " points of 16 bytes from byte " +
                     std::to_string(h.positions) + "), but the file ends at byte " + std::to_string(size),
                 "the file is cut off or its header is damaged: copy or export it again");
}

Result<Header> readHeader(Source& source, const std::string& name) {
    if (source.size() < kHeaderBytes) {
        return fault("T001", name,
                     "the file has " + std::to_string(source.size()) +
                         " bytes, expected at least the 160 bytes of a TressFX header",
                     "the file is cut off or is no .tfx file");
    }
    std::array<std::byte, kHeaderBytes> bytes = {};
    if (!source.read(0, bytes)) return reading::cannotRead(name);
    Header h;
    h.version = reading::valueAt<float>(bytes, 0);
    h.strands = reading::valueAt<std::uint32_t>(bytes, 4);
    h.pointsPerStrand = reading::valueAt<std::uint32_t>(bytes, 8);
    h.positions = reading::valueAt<std::uint32_t>(bytes, 12);
    if (!(h.version >= 4.0F && h.version < 5.0F)) {
        return fault("T002", name,
                     "the file starts with the version " + std::to_string(h.version) +
                         ", expected 4.0 (the number a TressFX 4 groom begins with)",
                     "export it as a TressFX 4 .tfx file");
    }
    if (h.strands == 0 || h.pointsPerStrand < 2) {
        return fault("T003", name,
                     "the header counts " + std::to_string(h.strands) + " strands of " +
                         std::to_string(h.pointsPerStrand) + " points, expected at least 1 strand of at least 2 points",
                     "export the groom again");
    }
    if (h.positions < kHeaderBytes) {
        return fault(
            "T005", name,
            "positions start at byte " + std::to_string(h.positions) + ", inside the header; expected 160 or more",
            "the header is damaged: export the groom again");
    }
    const std::uint64_t points = std::uint64_t{h.strands} * h.pointsPerStrand;
    if (!reading::fits(h.positions, points, kPointBytes, source.size())) {
        return promisesMore(name, h, source.size());
    }
    if (points > reading::kMaxVertices) {
        return fault("T007", name,
                     "the groom has " + std::to_string(points) + " points, more than the limit of " +
                         std::to_string(reading::kMaxVertices),
                     "export fewer strands; followers can be generated from guides");
    }
    return h;
}

}  // namespace

Result<Asset> reading::readTfx(Source& source, const std::string& name, Diagnostics& notes) {
    const Result<Header> header = readHeader(source, name);
    if (!header) return tl::unexpected(header.error());
    Strands strands = {.name = name};
    strands.points.resize(std::size_t{header->strands} * header->pointsPerStrand);
    strands.first.resize(std::size_t{header->strands} + 1);
    for (std::uint32_t s = 0; s <= header->strands; ++s) strands.first[s] = s * header->pointsPerStrand;
    // In blocks, because the fourth number of each point (its inverse mass) is not wanted.
    std::vector<std::array<float, 4>> block;
    constexpr std::size_t kBlock = 65536;  // points
    for (std::size_t at = 0; at < strands.points.size(); at += block.size()) {
        block.resize(std::min(kBlock, strands.points.size() - at));
        if (!source.read(header->positions + at * kPointBytes, block)) return cannotRead(name);
        for (std::size_t i = 0; i < block.size(); ++i) strands.points[at + i] = {block[i][0], block[i][1], block[i][2]};
    }
    return cleaned(std::move(strands), 'T', notes);
}

Result<Strands> parseTfx(std::span<const std::byte> bytes, const std::string& name) {
    return reading::strandsOnly(reading::readTfx, reading::Source(bytes), name);
}

Result<Strands> loadTfx(const std::string& path) {
    return reading::strandsOnly(reading::readTfx, path);
}

}  // namespace pelage::hair
