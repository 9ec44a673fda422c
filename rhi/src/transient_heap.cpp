// SPDX-License-Identifier: MIT
#include "transient_heap.hpp"

#include "device_object.hpp"

#include <algorithm>

namespace pelage::rhi {
namespace detail {

TransientHeapObject::~TransientHeapObject() {
    if (allocation.block == nullptr) return;
    device->bury(lastUse, [memory = allocation](DeviceObject& d) { d.memory.release(memory); });
}

std::size_t HeapOwners::cut(std::uint64_t at) {
    const auto span = std::partition_point(spans_.begin(), spans_.end(), [at](const Span& s) { return s.end <= at; });
    const auto index = static_cast<std::size_t>(span - spans_.begin());
    if (span == spans_.end() || span->begin == at) return index;
    Span left = *span;
    left.end = at;
    span->begin = at;
    spans_.insert(span, std::move(left));
    return index + 1;
}

AccessState HeapOwners::take(std::uint64_t begin, std::uint64_t end, const std::shared_ptr<TextureState>& texture) {
    const std::size_t first = cut(begin), last = cut(end);
    const auto add = [](AccessState& to, const AccessState& more) {
        to.writeStages |= more.writeStages;
        to.readStages |= more.readStages;
        to.writeAccess |= more.writeAccess;
    };
    AccessState before;
    displaced_.clear();
    for (std::size_t i = first; i < last; ++i) {
        add(before, spans_[i].residue);
        if (spans_[i].owner != nullptr && spans_[i].owner != texture) displaced_.push_back(spans_[i].owner);
    }
    for (const auto& owner : displaced_) {
        const AccessState used = owner->history();
        add(before, used);
        // The rest of its bytes has no owner now, but their next owner must wait for its uses all the same.
        for (Span& span : spans_)
            if (span.owner == owner) {
                add(span.residue, used);
                span.owner = nullptr;
            }
        owner->current = false;
    }
    displaced_.clear();
    spans_[first] = {begin, end, texture, {}};
    spans_.erase(spans_.begin() + static_cast<std::ptrdiff_t>(first) + 1,
                 spans_.begin() + static_cast<std::ptrdiff_t>(last));
    texture->current = true;
    return before;
}

Result<void> checkPlace(const TextureObject& texture, const VkMemoryRequirements& needs) {
    const auto& d = texture.descriptor;
    if (!d.heap) return {};
    const auto& heap = *d.heap.get();
    if (auto ok = needSameDevice(heap, *texture.device); !ok) return ok;
    if ((heap.allocation.offset + d.heapOffset) % needs.alignment != 0)
        return invalid(ErrorCode::OutOfRange, cat(texture.describe(), " is placed at byte ", d.heapOffset, " of ",
                                                  heap.describe(), "; a multiple of ", needs.alignment, " is needed."));
    if (d.heapOffset > heap.size || needs.size > heap.size - d.heapOffset)
        return invalid(ErrorCode::OutOfRange,
                       cat(texture.describe(), " needs ", needs.size, " bytes at byte ", d.heapOffset, " of ",
                           heap.describe(), ", which has ", heap.size, '.'));
    if ((needs.memoryTypeBits & heap.memoryTypes) != heap.memoryTypes)
        return fail(ErrorKind::Unsupported, ErrorCode::FormatUnsupported,
                    cat(texture.describe(), " with the format ", name(d.format), " cannot lie in the memory of ",
                        heap.describe(), " on this device."));
    return {};
}

void takeOver(TextureObject& texture, const Access& access, BarrierBatch& batch) {
    auto& heap = *texture.heap;
    const auto before =
        heap.owners.take(texture.descriptor.heapOffset, texture.descriptor.heapOffset + texture.bytes, texture.state);
    const auto stages = before.writeStages | before.readStages;
    texture.state->discard(stages);
    // The image's own barrier covers that image only; writes through another one need a barrier on memory.
    if (stages != 0) batch.memory(stages, before.writeAccess, access);
}

namespace {

Result<TransientHeap> makeHeap(const std::shared_ptr<DeviceObject>& device, const TransientHeapDescriptor& descriptor) {
    auto object = std::make_shared<TransientHeapObject>(device, descriptor);
    if (descriptor.size == 0)
        return invalid(ErrorCode::InvalidSize, cat(object->describe(), " has size 0; a heap holds at least 1 byte."));
    // All colour formats allow the same memory types, and every depth format its own (Vulkan 1.3, "Resource Memory
    // Association"); the types are checked again when a texture is placed.
    // No device asks more than a megabyte of alignment of an image, so offsets in the heap may be judged by themselves.
    VkMemoryRequirements needs = {descriptor.size, 1U << 20, ~0U};
    for (const auto format : {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_D32_SFLOAT}) {
        VkImageCreateInfo info = {VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = format;
        info.extent = {4, 4, 1};
        info.mipLevels = info.arrayLayers = 1;
        info.samples = VK_SAMPLE_COUNT_1_BIT;
        info.tiling = VK_IMAGE_TILING_OPTIMAL;
        info.usage = VK_IMAGE_USAGE_SAMPLED_BIT;
        VkDeviceImageMemoryRequirements query = {VK_STRUCTURE_TYPE_DEVICE_IMAGE_MEMORY_REQUIREMENTS};
        query.pCreateInfo = &info;
        VkMemoryRequirements2 one = {VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2};
        device->functions.vkGetDeviceImageMemoryRequirements(device->handle, &query, &one);
        const auto both = needs.memoryTypeBits & one.memoryRequirements.memoryTypeBits;
        if (both != 0) needs.memoryTypeBits = both;
    }
    auto memory = device->memory.allocate(needs, MemoryUse::Device, true, object->describe());
    if (!memory) return forward(memory.error());
    object->allocation = *memory;
    object->memoryTypes = 1U << device->memory.typeOf(*memory);
    return TransientHeap(std::move(object));
}

}  // namespace
}  // namespace detail

Result<TransientHeap> Device::createTransientHeap(const TransientHeapDescriptor& descriptor) const {
    if (auto ok = detail::needHandle(*this, "the device"); !ok) return detail::forward(ok.error());
    return object_->reported(detail::makeHeap(object_, descriptor));
}

const std::string& TransientHeap::label() const {
    return object_->label;
}
std::uint64_t TransientHeap::size() const {
    return object_->size;
}

}  // namespace pelage::rhi
