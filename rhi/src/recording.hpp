// SPDX-License-Identifier: MIT
// The packet stream with what belongs to it, and its replay.
#pragma once

#include "device_object.hpp"
#include "packets.hpp"
#include "pass_state.hpp"

namespace pelage::rhi::detail {

struct Recording {
    std::uint64_t id = 0;  // never used twice in one device
    std::string label;
    std::vector<Packet> packets;
    std::vector<Use> uses;
    std::vector<RenderPassPacket> passes;
    std::vector<VkBufferCopy> bufferRegions;
    std::vector<VkBufferImageCopy> bufferImageRegions;
    std::vector<VkImageCopy> imageRegions;
    std::string labels;  // each ends with a zero
    std::vector<std::uint32_t> offsets;
    std::vector<std::byte> bytes;  // push constants
    std::vector<std::shared_ptr<Object>> references;
    PointerMap referenced;
    // Pending uploads are held by the device itself, so they must not hold what holds the device.
    std::vector<std::pair<const Object*, std::weak_ptr<Object>>> weak;
    PointerMap weakAt;  // the place in `weak`
    void keepWeakly(const std::shared_ptr<Object>& object);
    /// Forgets the uploads to objects that are gone.
    void dropDead();

    // What the encoder works with; here, so that it is used again together with the rest.
    PassState pass;
    ScopeBuilder scope;
    /// Empty, but with the memory it has.
    void clear();
    void keep(const std::shared_ptr<Object>& object) {
        object->keptBy.store(id, std::memory_order_relaxed);
        if (referenced.insert(object.get(), 0).second) references.push_back(object);
    }
    template <class H>
    void keep(const H& handle) requires requires {
        handle.shared();
    }
    {
        // Usually this recording was the last to keep the object; where another encoder was, the map is asked.
        if (handle.get()->keptBy.load(std::memory_order_relaxed) != id) keep(std::shared_ptr<Object>(handle.shared()));
    }
};

struct CommandBufferObject final : Object {
    using Object::Object;
    Recording recording;
    CommandBuffer::Counters counters;
    std::atomic<bool> submitted{false};
};

/// Recordings that are to be used again.
struct RecordingPool {
    std::mutex mutex;
    std::array<Recording, 8> spare;
    std::size_t count = 0;
};

/// Replays into a Vulkan command buffer with the barriers each scope needs. The queue's mutex is held.
class Replay {
public:
    Replay(DeviceObject& device, VkCommandBuffer commands)
        : device_(device), commands_(commands), batch_(device.queue.batch) {}
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
    void beginLabel(const char* label);
    void endLabel();
    void beginRendering(const RenderPassPacket& pass);
    void startRendering(const RenderPassPacket& pass, bool goesOn);
    void draw(const packet::Draw& p);
    /// Toggle drawInBatches: room for this many vertices more, after an interruption where there was none.
    void makeRoom(std::uint64_t vertices);
    void resetQuery(QuerySetObject& set, std::uint32_t index);
    void resolveQueries(const packet::ResolveQueries& p);

    DeviceObject& device_;
    VkCommandBuffer commands_;
    const Recording* recording_ = nullptr;
    CommandBuffer::Counters counters_ = {};
    BarrierBatch& batch_;
    bool timestampOpen_ = false, hostReads_ = false;
    const RenderPassPacket* pass_ = nullptr;  // the one that is being replayed
    std::uint64_t drawn_ = 0;                 // vertices since its last interruption
};

}  // namespace pelage::rhi::detail
