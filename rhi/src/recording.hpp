// SPDX-License-Identifier: MIT
// The packet stream: what an encoder writes and a submission replays. Packets point to objects that the recording
// keeps.
#pragma once

#include <unordered_set>

#include "device_object.hpp"

namespace pelage::rhi::detail {

struct AttachmentPacket {
    TextureViewObject* view = nullptr;
    TextureViewObject* resolve = nullptr;
    LoadOp load = LoadOp::Clear;
    StoreOp store = StoreOp::Store;
    VkClearValue clear = {};
    bool readOnly = false;
};
struct RenderPassPacket {
    std::string label;
    std::vector<AttachmentPacket> colors;
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

struct Recording {
    std::uint64_t id = 0;  // never used twice in one device
    std::string label;
    std::vector<Packet> packets;
    std::vector<Use> uses;
    std::vector<RenderPassPacket> passes;
    std::vector<VkBufferCopy> bufferRegions;
    std::vector<VkBufferImageCopy> bufferImageRegions;
    std::vector<VkImageCopy> imageRegions;
    std::vector<std::string> labels;
    std::vector<std::uint32_t> offsets;
    std::vector<std::byte> bytes;  // push constants
    std::vector<std::shared_ptr<Object>> references;
    std::unordered_set<const Object*> referenced;
    // Pending uploads are held by the device itself, so they must not hold what holds the device.
    std::unordered_map<const Object*, std::weak_ptr<Object>> weak;
    /// Forgets the uploads to objects that are gone.
    void dropDead();

    /// Empty, but with the memory it has.
    void clear();
    void keep(const std::shared_ptr<Object>& object) {
        object->keptBy.store(id, std::memory_order_relaxed);
        if (referenced.insert(object.get()).second) references.push_back(object);
    }
    template <class H>
    void keep(const H& handle) requires requires {
        handle.shared();
    }
    {
        // Usually this recording was the last to keep it; another thread's encoder only makes the question dearer.
        if (handle.get()->keptBy.load(std::memory_order_relaxed) != id) keep(std::shared_ptr<Object>(handle.shared()));
    }
};

struct CommandBufferObject final : Object {
    using Object::Object;
    Recording recording;
    CommandBuffer::Counters counters;
    std::atomic<bool> submitted{false};
};

/// Replays into a Vulkan command buffer with the barriers each scope needs. The queue's mutex is held.
class Replay {
public:
    Replay(DeviceObject& device, VkCommandBuffer commands)
        : device_(device), commands_(commands), batch_(&device.queue.barriers) {}
    void run(const Recording& recording, CommandBuffer::Counters* counters);
    /// After everything: makes what was written visible to the host, and one texture ready to present.
    void finish(TextureObject* present);
    /// Brings a host's resource into the state in which it is wanted back; the barrier stands in finish().
    void handOver(TextureObject& texture, const Access& access);
    void handOver(BufferObject& buffer, const Access& access);

private:
    template <class P>
    void play(const P& p);
    void flushBarriers();
    void beginLabel(const std::string& label);
    void endLabel();
    void beginRendering(const RenderPassPacket& pass);
    void resetQuery(QuerySetObject& set, std::uint32_t index);
    void resolveQueries(const packet::ResolveQueries& p);

    DeviceObject& device_;
    VkCommandBuffer commands_;
    const Recording* recording_ = nullptr;
    CommandBuffer::Counters counters_ = {};
    BarrierBatch batch_;
    bool timestampOpen_ = false, hostReads_ = false;
};

}  // namespace pelage::rhi::detail
