// SPDX-License-Identifier: MIT
// Memory that textures share, and which texture owns which bytes of it at the moment.
#pragma once

#include "objects.hpp"

namespace pelage::rhi::detail {

/// Ownership of the bytes of one heap. Kept in the order of the queue, under its mutex; needs no device.
class HeapOwners {
public:
    explicit HeapOwners(std::uint64_t size) : spans_{{.end = size}} {}
    /// `texture` becomes the owner of [begin, end). Gives what used those bytes before: stages and writes to wait for.
    AccessState take(std::uint64_t begin, std::uint64_t end, const std::shared_ptr<TextureState>& texture);

private:
    struct Span {
        std::uint64_t begin = 0, end = 0;
        std::shared_ptr<TextureState> owner;
        AccessState residue = {};  // uses by owners before, when there is none now
    };
    /// The index of the span that begins there; one is cut in two where none does.
    std::size_t cut(std::uint64_t at);
    // Vectors that keep their memory, as each frame cuts and joins the same spans.
    std::vector<Span> spans_;  // in the order of their bytes; they cover the heap without gaps
    std::vector<std::shared_ptr<TextureState>> displaced_;  // by the take() that is under way
};

struct TransientHeapObject final : Object {
    TransientHeapObject(std::shared_ptr<DeviceObject> owner, const TransientHeapDescriptor& d)
        : Object(std::move(owner), "TransientHeap", d.label), size(d.size), owners(d.size) {}
    ~TransientHeapObject() override;
    std::uint64_t size = 0;
    std::uint32_t memoryTypes = 0;
    Allocation allocation;
    HeapOwners owners;
};

/// Does a texture with these needs fit its place in its heap? True for textures without one.
Result<void> checkPlace(const TextureObject& texture, const VkMemoryRequirements& needs);
/// Makes the texture the owner of its bytes; the batch waits for what it displaces. The queue's mutex is held.
void takeOver(TextureObject& texture, const Access& access, BarrierBatch& batch);

}  // namespace pelage::rhi::detail
