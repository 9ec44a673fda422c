// SPDX-License-Identifier: MIT
// Barriers, without a device. Each resource remembers its last write and everything that has read it since; a use at a
// scope boundary turns that memory into at most one entry of the boundary's single vkCmdPipelineBarrier2.
//
//   read after write       a barrier unless this reader's stages and accesses already see the write
//   write after anything   a barrier from the writer and *every* reader since
//   other layout           an image barrier; the transition counts as a write that ends in the stages it was made for
//   read after read        nothing
//
// A barrier on memory is global: one that was made for another resource since may serve as well. The BarrierLog knows
// the last few, so that no second one is made for what is ordered already.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vk.hpp"

namespace pelage::rhi::detail {

enum class UseKind : std::uint8_t {
    VertexBuffer,
    IndexBuffer,
    Indirect,
    UniformBuffer,
    StorageBufferRead,
    StorageBufferWrite,
    Sampled,
    StorageTextureRead,
    StorageTextureWrite,
    ColorAttachment,
    ResolveTarget,
    DepthAttachment,
    ReadOnlyDepth,
    CopySource,
    CopyDestination,
    QueryResolve,
    Present,
};
const char* name(UseKind kind);
bool isWrite(UseKind kind);

struct Access {
    VkPipelineStageFlags2 stages = 0;
    VkAccessFlags2 access = 0;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    bool write = false;
};
/// `shaderStages` are those of the scope that can reach the binding; used by the kinds that shaders do.
Access accessOf(UseKind kind, VkPipelineStageFlags2 shaderStages, bool depthFormat);
/// May both stand in one scope? All reads in one layout may; so may storage writes beside storage writes.
bool compatible(UseKind a, UseKind b, bool depthFormat);

struct AccessState {
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkPipelineStageFlags2 writeStages = 0, readStages = 0;  // the last write; everything that has read it since
    VkAccessFlags2 writeAccess = 0;
    VkPipelineStageFlags2 seenStages = 0;   // by barriers of its own the last write is visible to each of these stages
    VkAccessFlags2 seenAccess = 0;          // for each of these accesses
    std::uint64_t wroteAt = 0, readAt = 0;  // boundaries, as the BarrierLog counts them
    bool operator==(const AccessState&) const = default;
};

/// The last memory barriers of a queue, in its order.
class BarrierLog {
public:
    std::uint64_t boundary() const { return boundary_; }
    void nextBoundary() { ++boundary_; }
    /// A memory barrier stands at this boundary.
    void note(const VkMemoryBarrier2& barrier);
    /// Does a barrier since order these stages before the access, and show it what they wrote? For readers alone
    /// `written` and the access' own bits are 0; a layout transition has written nothing but must be seen all the same.
    bool orders(std::uint64_t since, VkPipelineStageFlags2 stages, VkAccessFlags2 written, const Access& access) const;

private:
    struct Entry {
        std::uint64_t boundary = 0;
        VkPipelineStageFlags2 from = 0, to = 0;
        VkAccessFlags2 made = 0, seen = 0;
    };
    std::uint64_t boundary_ = 1;
    std::array<Entry, 8> entries_ = {};
    std::size_t next_ = 0;
};

struct Range {
    std::uint32_t baseMip = 0, mips = 1, baseLayer = 0, layers = 1;
    bool operator==(const Range&) const = default;
    bool overlaps(const Range& o) const {
        return baseMip < o.baseMip + o.mips && o.baseMip < baseMip + mips && baseLayer < o.baseLayer + o.layers &&
               o.baseLayer < baseLayer + layers;
    }
};

/// One state while all subresources agree, one per (layer, mip) after a partial use made them differ.
struct TextureState {
    std::uint32_t mips = 1, layers = 1;
    VkImageAspectFlags aspects = VK_IMAGE_ASPECT_COLOR_BIT;
    std::vector<AccessState> states = std::vector<AccessState>(1);
    /// False while another texture of the same heap owns bytes of this one; its contents are then undefined.
    bool current = true;

    /// All its uses so far, as one: what the next owner of its memory must wait for.
    AccessState history() const;
    /// Contents undefined; the next use waits for `stages`.
    void discard(VkPipelineStageFlags2 stages);
};

/// What one scope boundary needs.
class BarrierBatch {
public:
    explicit BarrierBatch(BarrierLog* log = nullptr) : log_(log) {}
    void use(AccessState& state, const Access& access);
    void use(TextureState& state, VkImage image, const Range& range, const Access& access);
    /// One memory barrier, whatever it is about.
    void memory(VkPipelineStageFlags2 from, VkAccessFlags2 written, const Access& to);
    /// Everything waits for everything.
    void full();
    bool empty() const { return !memory_ && images_.empty(); }
    void record(VkCommandBuffer commands, PFN_vkCmdPipelineBarrier2 call) const;
    /// Ready for the next boundary.
    void clear();
    const std::vector<VkImageMemoryBarrier2>& images() const { return images_; }
    bool hasMemory() const { return memory_; }
    const VkMemoryBarrier2& memory() const { return memoryBarrier_; }

private:
    bool step(AccessState& state, const Access& access, VkImageMemoryBarrier2& transition);
    BarrierLog* log_ = nullptr;
    bool memory_ = false;
    VkMemoryBarrier2 memoryBarrier_ = {};
    std::vector<VkImageMemoryBarrier2> images_ = {};
};

}  // namespace pelage::rhi::detail
