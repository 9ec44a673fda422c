// SPDX-License-Identifier: MIT
// Strands on the device: the arrays of struct Strands as they are, and the points of the frames that move them.
#pragma once

#include <pelage/hair/renderer.hpp>
#include <pelage/hair/scene.hpp>
#include <pelage/rhi/rhi.hpp>

#include <array>
#include <vector>

namespace pelage::hair {

/// A buffer with these bytes. Where device memory is the host's own they are written straight into it; elsewhere in
/// slices that fit the queue's staging memory.
Result<rhi::Buffer> uploadBuffer(const rhi::Device& device, const std::string& label, rhi::BufferUsage usage,
                                 std::span<const std::byte> bytes);
/// Writes a buffer in slices that fit the queue's staging memory, which so is reused from frame to frame.
Result<void> writeBuffer(const rhi::Device& device, const rhi::Buffer& buffer, std::span<const std::byte> bytes);

/// A run of segments that one instance draws: `segments` of them from point `begin` of the strand, or what is left of
/// it.
struct Pieces {
    std::vector<glm::uvec2> list = {};  // strand, begin
    std::uint32_t segments = 1;
};
/// Cuts strands into pieces of equal length, so that a few long strands do not make all instances long.
Pieces piecesOf(const Strands& strands);

/// One Strands, shared by the objects that show it.
struct GpuStrands {
    StrandBuffers buffers = {};
    rhi::Buffer pieces = {};
    std::uint32_t pieceCount = 0, pieceSegments = 1;  // segments between two points
    std::uint64_t segments = 0;                       // as drawn, subdivisions included
};
/// N005 when offsets or the arrays beside the points do not fit.
Result<GpuStrands> uploadStrands(const rhi::Device& device, const Strands& strands);

/// The points of one object from frame to frame: two buffers that take turns while it moves.
class MovingPoints {
public:
    /// Takes this frame's points into `buffers`, and makes those of the last frame the previous ones. N006 when they do
    /// not fit the strands.
    Result<void> update(const rhi::Device& device, rhi::CommandEncoder& encoder, const std::string& name,
                        const MovedPoints& moved, const Strands& strands, const StrandBuffers& rest);
    const StrandBuffers& buffers() const { return now_; }

private:
    Result<void> updateStarts(const rhi::Device& device, const std::string& name, std::span<const glm::uvec2> ranges,
                              const Strands& strands);
    Result<rhi::Buffer> next(const rhi::Device& device, const std::string& name, std::uint64_t bytes);

    StrandBuffers now_ = {};
    std::array<rhi::Buffer, 2> turns_ = {};
    std::uint32_t turn_ = 0;
    std::vector<glm::uvec2> ranges_ = {};  // that `starts_` was made of
    rhi::Buffer starts_ = {};
    std::uint64_t pointCount_ = 0;  // that a lent buffer must have
};

}  // namespace pelage::hair
