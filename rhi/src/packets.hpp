// SPDX-License-Identifier: MIT
// The packets: what an encoder writes and a submission replays. They point to objects that the recording keeps.
#pragma once

#include <array>
#include <variant>

#include "objects.hpp"

namespace pelage::rhi::detail {

struct AttachmentPacket {
    TextureViewObject* view = nullptr;
    TextureViewObject* resolve = nullptr;
    LoadOp load = LoadOp::Clear;
    StoreOp store = StoreOp::Store;
    VkClearValue clear = {};
    bool readOnly = false;
};
/// Up to N values in place.
template <class T, std::size_t N>
class InlineVector {
public:
    void push_back(const T& value) { values_[count_++] = value; }
    std::size_t size() const { return count_; }
    const T& operator[](std::size_t i) const { return values_[i]; }
    const T* begin() const { return values_.data(); }
    const T* end() const { return values_.data() + count_; }

private:
    std::array<T, N> values_ = {};
    std::size_t count_ = 0;
};
inline constexpr std::size_t maxColors = 8;  // Limits::maxColorAttachments is never above it

struct RenderPassPacket {
    InlineVector<AttachmentPacket, maxColors> colors;
    std::optional<AttachmentPacket> depth;
    Extent3D size;
    std::uint32_t layers = 1;
    QuerySetObject* statistics = nullptr;
    std::uint32_t statisticsIndex = 0;
};

namespace packet {
/// The boundary of a usage scope: the uses first … first + count - 1 are about to happen.
struct Scope {
    std::uint32_t first = 0, count = 0;
};
struct BeginRendering {
    std::uint32_t pass = 0;
};
struct EndRendering {
    std::uint32_t pass = 0;
};
struct BeginLabel {
    std::uint32_t text = 0;
};
struct EndLabel {};
struct BindPipeline {
    PipelineObject* pipeline = nullptr;
    VkPipelineBindPoint point = {};
};
struct BindSet {
    BindGroupObject* group = nullptr;
    PipelineLayoutObject* layout = nullptr;
    VkPipelineBindPoint point = {};
    std::uint32_t index = 0, firstOffset = 0, offsetCount = 0;
};
struct Push {
    PipelineLayoutObject* layout = nullptr;
    std::uint32_t first = 0, size = 0;
};
struct BindVertexBuffer {
    BufferObject* buffer = nullptr;
    std::uint64_t offset = 0;
    std::uint32_t slot = 0;
};
struct BindIndexBuffer {
    BufferObject* buffer = nullptr;
    std::uint64_t offset = 0;
    VkIndexType type = {};
};
struct Viewport {
    VkViewport value = {};
};
struct Scissor {
    VkRect2D value = {};
};
struct LineWidth {
    float value = 1;
};
struct Draw {
    std::uint32_t vertices = 0, instances = 0, firstVertex = 0, firstInstance = 0;
};
struct DrawIndexed {
    std::uint32_t indices = 0, instances = 0, firstIndex = 0;
    std::int32_t baseVertex = 0;
    std::uint32_t firstInstance = 0;
};
struct Dispatch {
    std::uint32_t x = 0, y = 0, z = 0;
};
struct Indirect {  // the arguments lie in a buffer
    enum class Command : std::uint8_t { Draw, DrawIndexed, Dispatch } command = Command::Draw;
    BufferObject* buffer = nullptr;
    std::uint64_t offset = 0;
};
struct CopyBuffer {
    BufferObject* source = nullptr;
    BufferObject* destination = nullptr;
    std::uint32_t region = 0;
};
struct CopyBufferImage {  // either way
    BufferObject* buffer = nullptr;
    TextureObject* texture = nullptr;
    std::uint32_t region = 0;
    bool toImage = true;
};
struct CopyImage {
    TextureObject* source = nullptr;
    TextureObject* destination = nullptr;
    std::uint32_t region = 0;
};
struct Fill {
    BufferObject* buffer = nullptr;
    std::uint64_t offset = 0, size = 0;
};
struct Timestamp {
    QuerySetObject* set = nullptr;
    std::uint32_t index = 0;
    bool begin = false;  // the work that follows is what is timed
};
struct ResolveQueries {
    QuerySetObject* set = nullptr;
    BufferObject* destination = nullptr;
    std::uint64_t offset = 0;
    std::uint32_t first = 0, count = 0;
};
/// Staged bytes to a buffer or texture; the chunk is a raw Vulkan buffer of the queue.
struct Upload {
    VkBuffer staging = VK_NULL_HANDLE;
    BufferObject* buffer = nullptr;
    TextureObject* texture = nullptr;
    std::uint32_t region = 0;  // of buffers, or of images
};
}  // namespace packet

using Packet =
    std::variant<packet::Scope, packet::BeginRendering, packet::EndRendering, packet::BeginLabel, packet::EndLabel,
                 packet::BindPipeline, packet::BindSet, packet::Push, packet::BindVertexBuffer, packet::BindIndexBuffer,
                 packet::Viewport, packet::Scissor, packet::LineWidth, packet::Draw, packet::DrawIndexed,
                 packet::Dispatch, packet::Indirect, packet::CopyBuffer, packet::CopyBufferImage, packet::CopyImage,
                 packet::Fill, packet::Timestamp, packet::ResolveQueries, packet::Upload>;

static_assert(sizeof(Packet) <= 48, "packets are written by the thousand");

}  // namespace pelage::rhi::detail
