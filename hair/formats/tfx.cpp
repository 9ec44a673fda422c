// SPDX-License-Identifier: MIT
// TressFX 4 grooms. Header of 160 bytes: float version; then as unsigned 32-bit numbers the strand count, the points
// per strand, and offsets from the start of the file of positions (float4, w is the inverse mass), strand texture
// coordinates (float2), vertex texture coordinates (float2), strand thickness and vertex colour; 0 means absent.
#include "groom_builder.hpp"
#include "readers.hpp"
#include "reading.hpp"

#include <algorithm>
#include <array>

namespace pelage::hair {
namespace {

using reading::fault;
constexpr std::size_t kHeaderBytes = 160;
constexpr std::size_t kPointBytes = 16;

struct Header {
    float version = 0;
    std::uint32_t strands = 0, pointsPerStrand = 0, positions = 0;
};

Diagnostic promisesMore(const std::string& name, const Header& h, std::size_t size) {
    return fault("T004", name,
                 "the header promises " + std::to_string(h.strands) + " strands of " +
                     std::to_string(h.pointsPerStrand) + " points (" +
                     std::to_string(std::uint64_t{h.strands} * h.pointsPerStrand) + " points of 16 bytes from byte " +
                     std::to_string(h.positions) + "), but the file ends at byte " + std::to_string(size),
                 "the file is cut off or its header is damaged: copy or export it again");
}

Result<Header> readHeader(std::span<const std::byte> bytes, const std::string& name) {
    if (bytes.size() < kHeaderBytes) {
        return tl::unexpected(fault("T001", name,
                                    "the file has " + std::to_string(bytes.size()) +
                                        " bytes, expected at least the 160 bytes of a TressFX header",
                                    "the file is cut off or is no .tfx file"));
    }
    Header h;
    h.version = reading::valueAt<float>(bytes, 0);
    h.strands = reading::valueAt<std::uint32_t>(bytes, 4);
    h.pointsPerStrand = reading::valueAt<std::uint32_t>(bytes, 8);
    h.positions = reading::valueAt<std::uint32_t>(bytes, 12);
    if (!(h.version >= 4.0F && h.version < 5.0F)) {
        return tl::unexpected(fault("T002", name,
                                    "the file starts with the version " + std::to_string(h.version) +
                                        ", expected 4.0 (the number a TressFX 4 groom begins with)",
                                    "export it as a TressFX 4 .tfx file"));
    }
    if (h.strands == 0 || h.pointsPerStrand < 2) {
        return tl::unexpected(fault("T003", name,
                                    "the header counts " + std::to_string(h.strands) + " strands of " +
                                        std::to_string(h.pointsPerStrand) +
                                        " points, expected at least 1 strand of at least 2 points",
                                    "export the groom again"));
    }
    if (h.positions < kHeaderBytes) {
        return tl::unexpected(fault(
            "T005", name,
            "positions start at byte " + std::to_string(h.positions) + ", inside the header; expected 160 or more",
            "the header is damaged: export the groom again"));
    }
    const std::uint64_t points = std::uint64_t{h.strands} * h.pointsPerStrand;
    if (!reading::fits(h.positions, points, kPointBytes, bytes.size())) {
        return tl::unexpected(promisesMore(name, h, bytes.size()));
    }
    if (points > reading::kMaxVertices) {
        return tl::unexpected(fault("T007", name,
                                    "the groom has " + std::to_string(points) + " points, more than the limit of " +
                                        std::to_string(reading::kMaxVertices),
                                    "export fewer strands; followers can be generated from guides"));
    }
    return h;
}

}  // namespace

Result<Groom> reading::readTfx(std::span<const std::byte> bytes, const std::string& name, Diagnostics& notes) {
    const Result<Header> header = readHeader(bytes, name);
    if (!header) return tl::unexpected(header.error());
    const std::size_t perStrand = header->pointsPerStrand;
    GroomBuilder builder(name, 'T');
    builder.reserve(header->strands, std::size_t{header->strands} * perStrand, false);
    std::vector<glm::vec3> strand(perStrand);
    std::size_t offset = header->positions;
    for (std::uint32_t s = 0; s < header->strands; ++s) {
        for (glm::vec3& p : strand) {
            const auto xyz = reading::valueAt<std::array<float, 3>>(bytes, offset);
            p = {xyz[0], xyz[1], xyz[2]};
            offset += kPointBytes;
        }
        builder.add(strand, {});
    }
    return builder.finish(notes);
}

Result<Groom> parseTfx(std::span<const std::byte> bytes, const std::string& name) {
    Diagnostics notes;
    return reading::readTfx(bytes, name, notes);
}

Result<Groom> loadTfx(const std::string& path) {
    return readFile(path).and_then([&](const std::vector<std::byte>& bytes) { return parseTfx(bytes, path); });
}

}  // namespace pelage::hair
