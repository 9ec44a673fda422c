// SPDX-License-Identifier: MIT
#include "recording.hpp"

#include <algorithm>

namespace pelage::rhi::detail {

void Recording::clear() {
    label.clear();
    packets.clear();
    uses.clear();
    passes.clear();
    bufferRegions.clear();
    bufferImageRegions.clear();
    imageRegions.clear();
    labels.clear();
    offsets.clear();
    bytes.clear();
    references.clear();
    referenced.clear();
    weak.clear();
    weakAt.clear();
    pass.reset();
    scope.clear();
}

void PassState::reset() {
    pipeline = nullptr;
    for (auto& group : groups) {
        group.group = nullptr;
        group.offsets.clear();
        group.dirty = false;
    }
    boundLayout = nullptr;
    push = {};
    pushDirty = groupsChanged = true;
    std::fill(vertexBuffers.begin(), vertexBuffers.end(), Vertex{});
    index = {};
    indexFormat = IndexFormat::Uint32;
    commands = debugGroups = 0;
    scopePacket = 0;
    lastDispatchScope = {};
    merged.clear();
    timestamps = nullptr;
    endTimestamp.reset();
    label.clear();
}

void Recording::keepWeakly(const std::shared_ptr<Object>& object) {
    const auto place = static_cast<std::uint32_t>(weak.size());
    const auto [at, fresh] = weakAt.insert(object.get(), place);
    if (fresh) {
        weak.emplace_back(object.get(), object);
        return;
    }
    auto& known = weak[at];
    if (known.first != nullptr && known.second.expired()) dropDead();  // its address is used again
    known = {object.get(), object};
}

void Recording::dropDead() {
    const auto dead = [](const auto& entry) { return entry.first != nullptr && entry.second.expired(); };
    if (std::none_of(weak.begin(), weak.end(), dead)) return;
    const auto gone = [&](const Object* object) {
        return object != nullptr && std::any_of(weak.begin(), weak.end(), [&](const auto& entry) {
                   return entry.first == object && entry.second.expired();
               });
    };
    std::erase_if(packets, [&](const Packet& p) {
        const auto* upload = std::get_if<packet::Upload>(&p);
        return upload != nullptr && (gone(upload->buffer) || gone(upload->texture));
    });
    for (auto& use : uses)
        if (gone(use.object)) use.object = nullptr;
    for (auto& entry : weak)
        if (dead(entry)) entry = {nullptr, {}};
}

void DeviceObject::takeRecording(Recording& into) {
    {
        const std::lock_guard lock(recordings->mutex);
        if (recordings->count > 0) into = std::move(recordings->spare[--recordings->count]);
    }
    into.id = nextId++;
}

void DeviceObject::giveBack(Recording& recording) {
    recording.clear();
    const std::lock_guard lock(recordings->mutex);
    if (recordings->count < recordings->spare.size()) recordings->spare[recordings->count++] = std::move(recording);
}

}  // namespace pelage::rhi::detail
