// SPDX-License-Identifier: MIT
#include "strands.hpp"

#include "geometry/vectors.hpp"

#include <algorithm>
#include <cstring>

namespace pelage::hair {
namespace {

using rhi::BufferUsage;

// Passes of a host's own may read what the vertex shader reads, and copies are how tests look at it.
constexpr BufferUsage kUsage = BufferUsage::Storage | BufferUsage::CopySrc;

tl::unexpected<Diagnostics> misfit(Code code, const std::string& text, const std::string& hint) {
    return tl::unexpected<Diagnostics>(Diagnostic{.code = code, .text = text, .hint = hint});
}

Result<void> check(const Strands& strands) {
    const std::size_t points = strands.points.size();
    const auto wrong = [&](const std::string& what, std::size_t found, std::size_t expected) {
        return misfit("N005",
                      "the strands \"" + strands.name + "\" have " + std::to_string(found) + " " + what +
                          ", expected " + std::to_string(expected),
                      "give one for each, or none");
    };
    if (!strands.widths.empty() && strands.widths.size() != points)
        return wrong("widths", strands.widths.size(), points);
    if (!strands.colors.empty() && strands.colors.size() != points)
        return wrong("colours", strands.colors.size(), points);
    if (!strands.ids.empty() && strands.ids.size() != strands.strandCount())
        return wrong("ids", strands.ids.size(), strands.strandCount());
    for (std::uint32_t s = 0; s < strands.strandCount(); ++s) {
        if (strands.first[s] <= strands.first[s + 1] && strands.first[s + 1] <= points) continue;
        return misfit("N005",
                      "strand " + std::to_string(s) + " of \"" + strands.name + "\" has the points " +
                          std::to_string(strands.first[s]) + " to " + std::to_string(strands.first[s + 1]) + " of " +
                          std::to_string(points),
                      "offsets must grow and end within the points");
    }
    return {};
}

std::vector<float> idsOf(const Strands& strands) {
    std::vector<float> ids(strands.strandCount());
    for (std::uint32_t s = 0; s < ids.size(); ++s) ids[s] = hashUnit(s);
    return ids;
}

}  // namespace

Result<void> writeBuffer(const rhi::Device& device, const rhi::Buffer& buffer, std::span<const std::byte> bytes) {
    constexpr std::size_t slice = std::size_t{1} << 20;
    for (std::size_t at = 0; at < bytes.size(); at += slice) {
        const auto part = bytes.subspan(at, std::min(slice, bytes.size() - at));
        if (auto written = device.queue().writeBuffer(buffer, at, part); !written) return written;
    }
    return {};
}

Result<rhi::Buffer> uploadBuffer(const rhi::Device& device, const std::string& label, BufferUsage usage,
                                 std::span<const std::byte> bytes) {
    const rhi::AdapterType type = device.info().type;
    const bool direct = type == rhi::AdapterType::CPU || type == rhi::AdapterType::IntegratedGPU;
    auto buffer = device.createBuffer({.label = label,
                                       .size = bytes.size(),
                                       .usage = usage | (direct ? BufferUsage::MapWrite : BufferUsage::CopyDst)});
    if (!buffer) return buffer;
    if (direct) {
        std::memcpy(buffer->mapped().data(), bytes.data(), bytes.size());
        return *buffer;
    }
    if (auto written = writeBuffer(device, *buffer, bytes); !written) return tl::unexpected(written.error());
    return *buffer;
}

Pieces piecesOf(const Strands& strands) {
    const auto segmentsOf = [&](std::uint32_t s) {
        const std::uint32_t count = strands.first[s + 1] - strands.first[s];
        return count < 2 ? 0U : count - 1;
    };
    std::uint32_t longest = 1;
    for (std::uint32_t s = 0; s < strands.strandCount(); ++s) longest = std::max(longest, segmentsOf(s));
    // An instance costs about as much as a few places of the curve.
    constexpr std::uint64_t instance = 4;
    Pieces pieces;
    std::uint64_t least = ~std::uint64_t{0}, count = 0;
    for (const std::uint32_t length : {std::min(longest, 64U), 32U, 16U, 8U}) {
        std::uint64_t number = 0;
        for (std::uint32_t s = 0; s < strands.strandCount(); ++s) number += (segmentsOf(s) + length - 1) / length;
        const std::uint64_t cost = number * (length + 1 + instance);
        if (length > longest || cost >= least) continue;
        least = cost;
        count = number;
        pieces.segments = length;
    }
    pieces.list.reserve(count);
    for (std::uint32_t s = 0; s < strands.strandCount(); ++s) {
        for (std::uint32_t begin = 0; begin < segmentsOf(s); begin += pieces.segments)
            pieces.list.emplace_back(s, begin);
    }
    return pieces;
}

Result<GpuStrands> uploadStrands(const rhi::Device& device, const Strands& strands) {
    if (auto checked = check(strands); !checked) return tl::unexpected(checked.error());
    GpuStrands result;
    StrandBuffers& b = result.buffers;
    Result<void> fault = {};
    const auto put = [&](rhi::Buffer& to, const char* what, auto values) {
        if (!fault) return;
        auto made = uploadBuffer(device, strands.name + " " + what, kUsage, std::as_bytes(std::span(values)));
        if (!made) {
            fault = tl::unexpected(made.error());
            return;
        }
        to = *made;
    };
    const glm::vec3 white(1.0F);
    put(b.points, "points", std::span(strands.points));
    put(b.first, "offsets", std::span(strands.first));
    put(b.widths, "widths", strands.widths.empty() ? std::span(&strands.width, 1) : std::span(strands.widths));
    put(b.colors, "colours", strands.colors.empty() ? std::span(&white, 1) : std::span(strands.colors));
    {
        const std::vector<float> made = strands.ids.empty() ? idsOf(strands) : std::vector<float>();
        put(b.ids, "ids", std::span(made.empty() ? strands.ids : made));
    }
    {
        const Pieces pieces = piecesOf(strands);
        put(result.pieces, "pieces", std::span(pieces.list));
        result.pieceCount = static_cast<std::uint32_t>(pieces.list.size());
        result.pieceSegments = pieces.segments;
    }
    if (!fault) return tl::unexpected(fault.error());
    b.previousPoints = b.points;
    b.starts = b.first;
    b.startStride = 1;
    b.widthStride = strands.widths.empty() ? 0 : 1;
    b.colorStride = strands.colors.empty() ? 0 : 1;
    b.strandCount = strands.strandCount();
    for (std::uint32_t s = 0; s < b.strandCount; ++s)
        result.segments += std::max(strands.first[s + 1] - strands.first[s], 1U) - 1U;
    result.segments *= std::clamp(strands.subdivisions, 1U, kMaxSubdivisions);
    return result;
}

Result<rhi::Buffer> MovingPoints::next(const rhi::Device& device, const std::string& name, std::uint64_t bytes) {
    turn_ = 1 - turn_;
    rhi::Buffer& buffer = turns_[turn_];
    if (buffer && buffer.size() == bytes) return buffer;
    auto made = device.createBuffer({.label = name + " points", .size = bytes, .usage = kUsage | BufferUsage::CopyDst});
    if (!made) return made;
    buffer = *made;
    return buffer;
}

Result<void> MovingPoints::updateStarts(const rhi::Device& device, const std::string& name,
                                        std::span<const glm::uvec2> ranges, const Strands& strands) {
    if (starts_ && std::equal(ranges.begin(), ranges.end(), ranges_.begin(), ranges_.end())) return {};
    if (ranges.size() != strands.strandCount()) {
        return misfit("N006",
                      "the object \"" + name + "\" has " + std::to_string(ranges.size()) +
                          " ranges of moved points, expected the " + std::to_string(strands.strandCount()) +
                          " of its strands",
                      "give one range for each strand");
    }
    std::uint64_t end = 0;
    for (std::uint32_t s = 0; s < strands.strandCount(); ++s) {
        const std::uint32_t expected = strands.first[s + 1] - strands.first[s];
        if (ranges[s].y < ranges[s].x || ranges[s].y - ranges[s].x != expected) {
            return misfit("N006",
                          "strand " + std::to_string(s) + " of the object \"" + name + "\" has the moved points " +
                              std::to_string(ranges[s].x) + " to " + std::to_string(ranges[s].y) + ", expected " +
                              std::to_string(expected) + " of them",
                          "a strand keeps its number of points");
        }
        end = std::max<std::uint64_t>(end, ranges[s].y);
    }
    ranges_.assign(ranges.begin(), ranges.end());
    pointCount_ = end;
    auto made = uploadBuffer(device, name + " ranges", kUsage, std::as_bytes(std::span(ranges_)));
    if (!made) return tl::unexpected(made.error());
    starts_ = *made;
    return {};
}

Result<void> MovingPoints::update(const rhi::Device& device, rhi::CommandEncoder& encoder, const std::string& name,
                                  const MovedPoints& moved, const Strands& strands, const StrandBuffers& rest) {
    const StrandBuffers last = std::move(now_);
    now_ = rest;
    if (moved.buffer) {
        if (!moved.ranges.empty()) {
            if (auto updated = updateStarts(device, name, moved.ranges, strands); !updated) return updated;
            now_.starts = starts_;
            now_.startStride = 2;
        }
        const std::uint64_t bytes = 12 * (moved.ranges.empty() ? strands.points.size() : pointCount_);
        if (moved.buffer.size() < bytes) {
            return misfit("N006",
                          "the buffer \"" + moved.buffer.label() + "\" lent to the object \"" + name + "\" has " +
                              std::to_string(moved.buffer.size()) + " bytes, expected at least " +
                              std::to_string(bytes),
                          "float3 at a stride of 12 bytes for every point");
        }
        auto own = next(device, name, bytes);
        if (!own) return tl::unexpected(own.error());
        // A copy, because the host overwrites its buffer and velocities need what was in it.
        encoder.copyBufferToBuffer(moved.buffer, 0, *own, 0, bytes);
        now_.points = *own;
    } else if (!moved.points.empty()) {
        if (moved.points.size() != strands.points.size()) {
            return misfit("N006",
                          "the object \"" + name + "\" has " + std::to_string(moved.points.size()) +
                              " moved points, expected the " + std::to_string(strands.points.size()) +
                              " of its strands",
                          "a strand keeps its number of points");
        }
        const auto bytes = std::as_bytes(moved.points);
        auto own = next(device, name, bytes.size());
        if (!own) return tl::unexpected(own.error());
        if (auto written = writeBuffer(device, *own, bytes); !written) return written;
        now_.points = *own;
    }
    // Points of another layout are not where the same points were before.
    const bool follows = last.points && last.first == now_.first && last.starts == now_.starts;
    now_.previousPoints = follows ? last.points : now_.points;
    return {};
}

}  // namespace pelage::hair
