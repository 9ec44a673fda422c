// SPDX-License-Identifier: MIT
#include "encoder_object.hpp"

#include <algorithm>
#include <cstring>

namespace pelage::rhi::detail {

const Use* ScopeBuilder::add(const Use& use) {
    const auto [head, fresh] = first_.insert(use.object, static_cast<std::uint32_t>(uses_.size()));
    if (fresh) {
        heads_.push_back(head);
        uses_.push_back(use);
        return nullptr;
    }
    const bool depth = use.texture && isDepth(static_cast<const TextureObject*>(use.object)->descriptor.format);
    std::int32_t merged = -1, last = static_cast<std::int32_t>(head);
    for (std::int32_t i = last; i >= 0; i = uses_[static_cast<std::size_t>(i)].next) {
        auto& other = uses_[static_cast<std::size_t>(i)];
        last = i;
        if (use.texture && !other.range.overlaps(use.range)) continue;
        if (!compatible(other.kind, use.kind, depth)) return &other;
        if (other.range == use.range) merged = i;
    }
    if (merged >= 0) {
        auto& other = uses_[static_cast<std::size_t>(merged)];
        other.access.stages |= use.access.stages;
        other.access.access |= use.access.access;
    } else {
        uses_[static_cast<std::size_t>(last)].next = static_cast<std::int32_t>(uses_.size());
        uses_.push_back(use);
        uses_.back().next = -1;
    }
    return nullptr;
}

packet::Scope ScopeBuilder::take(std::vector<Use>& to) {
    packet::Scope scope{static_cast<std::uint32_t>(to.size()), 0};
    for (const std::uint32_t head : heads_) {
        const auto& first = uses_[head];
        if (first.next < 0) {
            to.push_back(first);
            continue;
        }
        // Different parts of one texture: where they overlap, each subresource gets one merged use.
        std::vector<Use> parts;
        bool overlap = false;
        for (auto i = static_cast<std::int32_t>(head); i >= 0; i = uses_[static_cast<std::size_t>(i)].next) {
            const auto& u = uses_[static_cast<std::size_t>(i)];
            for (const auto& p : parts) overlap = overlap || p.range.overlaps(u.range);
            parts.push_back(u);
        }
        if (!overlap) {
            to.insert(to.end(), parts.begin(), parts.end());
            continue;
        }
        const auto begin = to.size();
        for (const auto& part : parts)
            for (std::uint32_t mip = 0; mip < part.range.mips; ++mip)
                for (std::uint32_t layer = 0; layer < part.range.layers; ++layer) {
                    const Range one{part.range.baseMip + mip, 1, part.range.baseLayer + layer, 1};
                    const auto same = std::find_if(to.begin() + static_cast<std::ptrdiff_t>(begin), to.end(),
                                                   [&](const Use& u) { return u.range == one; });
                    if (same != to.end()) {
                        same->access.stages |= part.access.stages;
                        same->access.access |= part.access.access;
                    } else {
                        to.push_back(part);
                        to.back().range = one;
                    }
                }
    }
    scope.count = static_cast<std::uint32_t>(to.size()) - scope.first;
    clear();
    return scope;
}

void ScopeBuilder::clear() {
    uses_.clear();
    heads_.clear();
    first_.clear();
}

void EncoderObject::fail(const Diagnostics& errors, std::string innermost) {
    if (error) return;
    error = errors.first();
    if (!innermost.empty()) error->context.push_back(std::move(innermost));
    if (state == State::RenderPass || state == State::ComputePass)
        error->context.push_back(cat(state == State::RenderPass ? "RenderPass \"" : "ComputePass \"", pass.label, '"'));
    error->context.push_back(cat("CommandEncoder \"", label, '"'));
}

bool EncoderObject::ready(State wanted, std::string_view call) {
    if (error) return false;
    if (state == wanted) return true;
    constexpr std::string_view names[] = {"outside a pass", "in a render pass", "in a compute pass", "after finish()"};
    fail(
        invalid(ErrorCode::EncoderState,
                cat(call, "() was called ", names[static_cast<std::size_t>(state)], "; it belongs ",
                    wanted == State::Open ? "outside a pass, before finish()" : names[static_cast<std::size_t>(wanted)],
                    '.'))
            .value());
    return false;
}

bool EncoderObject::use(const Use& wanted, const CommandName& command) {
    const Use* other = scope.add(wanted);
    if (other == nullptr) return true;
    const auto place = [](const Use& u) {
        return u.binding < 0 ? std::string() : cat(" (group ", u.group, " binding ", u.binding, ')');
    };
    fail(invalid(ErrorCode::UsageConflict,
                 cat(wanted.object->describe(), " is used as ", name(other->kind), place(*other), " and as ",
                     name(wanted.kind), place(wanted), " in one scope."))
             .value(),
         command.text());
    return false;
}

void EncoderObject::closeScope(std::size_t packetIndex) {
    recording.packets[packetIndex] = scope.take(recording.uses);
}

void EncoderObject::setBindGroup(std::uint32_t index, const BindGroup& group, std::span<const std::uint32_t> offsets) {
    if (!accept(group, "bind group ", index)) return;
    const auto& object = *group.get();
    const auto& layout = *object.layout;
    if (index >= device->info.limits.maxBindGroups)
        return fail(
            invalid(ErrorCode::OutOfRange, cat(object.describe(), " is set at index ", index, "; the device has ",
                                               device->info.limits.maxBindGroups, " groups."))
                .value());
    if (offsets.size() != layout.dynamicCount)
        return fail(
            invalid(ErrorCode::BindingMismatch, cat(object.describe(), " is set with ", offsets.size(),
                                                    " dynamic offsets; its layout has ", layout.dynamicCount, '.'))
                .value());
    std::size_t next = 0;
    for (std::size_t i = 0; layout.dynamicCount != 0 && i < layout.entries.size(); ++i) {
        const auto& e = layout.entries[i];
        if (!e.hasDynamicOffset) continue;
        const std::uint32_t offset = offsets[next++];
        const auto& limits = device->info.limits;
        const std::uint32_t alignment = e.type == BindingType::UniformBuffer ? limits.minUniformBufferOffsetAlignment
                                                                             : limits.minStorageBufferOffsetAlignment;
        const auto& bound = object.bound[i];
        if (offset % alignment != 0 || bound.offset + offset + bound.size > bound.bufferSize)
            return fail(invalid(ErrorCode::OutOfRange,
                                cat(object.describe(), " is set with the dynamic offset ", offset, " for binding ",
                                    e.binding, " \"", e.name, "\"; a multiple of ", alignment, " up to ",
                                    bound.bufferSize - bound.offset - bound.size, " is needed."))
                            .value());
    }
    if (pass.groups.size() <= index) pass.groups.resize(index + 1);
    auto& slot = pass.groups[index];
    if (slot.group == &object && std::equal(offsets.begin(), offsets.end(), slot.offsets.begin(), slot.offsets.end()))
        return;
    if (slot.group != &object) pass.groupsChanged = true;
    slot.group = group.get();
    slot.offsets.assign(offsets.begin(), offsets.end());
    slot.dirty = true;
}

void EncoderObject::setPushConstants(std::uint32_t offset, std::span<const std::byte> bytes) {
    const std::uint64_t end = std::uint64_t{offset} + bytes.size();
    const std::uint64_t limit =
        pass.pipeline ? pass.pipeline->layout->pushConstantsSize
                      : std::min<std::uint64_t>(device->info.limits.maxPushConstantsSize, pass.push.size());
    if (end > limit || offset % 4 != 0 || bytes.size() % 4 != 0)
        return fail(
            invalid(ErrorCode::PushConstantRange, cat("Push constants were set for the bytes ", offset, " … ", end,
                                                      "; ", pass.pipeline ? pass.pipeline->describe() : "the device",
                                                      " has ", limit, " bytes, and multiples of 4 are needed."))
                .value());
    std::memcpy(pass.push.data() + offset, bytes.data(), bytes.size());
    pass.pushDirty = true;
}

void EncoderObject::beginLabel(std::string_view text) {
    add(packet::BeginLabel{static_cast<std::uint32_t>(recording.labels.size())});
    recording.labels += text;
    recording.labels += '\0';
}

void EncoderObject::pushDebugGroup(std::string_view text) {
    beginLabel(text);
    ++(state == State::Open ? debugGroups : pass.debugGroups);
}

void EncoderObject::popDebugGroup() {
    auto& depth = state == State::Open ? debugGroups : pass.debugGroups;
    if (depth == 0)
        return fail(
            invalid(ErrorCode::EncoderState, "popDebugGroup() was called without an open debug group.").value());
    --depth;
    add(packet::EndLabel{});
}

bool EncoderObject::queryIndex(const QuerySet& set, QueryType type, std::uint32_t index, std::string_view what) {
    if (!accept(set, what)) return false;
    const auto& object = *set.get();
    if (object.descriptor.type != type) {
        fail(invalid(ErrorCode::QueryRange,
                     cat(object.describe(), " holds ", type == QueryType::Timestamp ? "statistics" : "timestamps", "; ",
                         what, " needs ", type == QueryType::Timestamp ? "timestamps." : "statistics."))
                 .value());
        return false;
    }
    if (index < object.descriptor.count) return true;
    fail(invalid(ErrorCode::QueryRange, cat(object.describe(), " has ", object.descriptor.count, " queries; ", what,
                                            " writes query ", index, '.'))
             .value());
    return false;
}

bool EncoderObject::timestamps(const std::optional<TimestampWrites>& writes) {
    if (!writes) return true;
    for (const auto& index : {writes->beginningOfPassWriteIndex, writes->endOfPassWriteIndex})
        if (index && !queryIndex(writes->querySet, QueryType::Timestamp, *index, "the pass' timestampWrites"))
            return false;
    if (writes->beginningOfPassWriteIndex && writes->beginningOfPassWriteIndex == writes->endOfPassWriteIndex) {
        fail(invalid(ErrorCode::QueryRange,
                     cat(writes->querySet.get()->describe(), " query ", *writes->endOfPassWriteIndex,
                         " is written at the beginning and at the end of one pass."))
                 .value());
        return false;
    }
    return true;
}

void EncoderObject::beginPass(State next, std::string_view passLabel, const std::optional<TimestampWrites>& writes) {
    pass.reset();
    pass.label = passLabel;
    if (writes) {
        pass.timestamps = writes->querySet.get();
        pass.endTimestamp = writes->endOfPassWriteIndex;
    }
    state = next;
    beginLabel(passLabel);
    if (writes && writes->beginningOfPassWriteIndex)
        add(packet::Timestamp{writes->querySet.get(), *writes->beginningOfPassWriteIndex, true});
}

void EncoderObject::endPass() {
    if (pass.debugGroups != 0)
        fail(invalid(ErrorCode::EncoderState,
                     cat(pass.debugGroups, " debug groups were left open at the end of the pass."))
                 .value());
    if (pass.endTimestamp) add(packet::Timestamp{pass.timestamps, *pass.endTimestamp, false});
    add(packet::EndLabel{});
    state = State::Open;
    pass.reset();
}

bool EncoderObject::indirectArguments(const Buffer& buffer, std::uint64_t offset, std::uint64_t size,
                                      const CommandName& command) {
    if (!accept(buffer, "the buffer of ", command.text())) return false;
    auto& object = *buffer.get();
    if (!contains(object.descriptor.usage, BufferUsage::Indirect))
        return fail(invalid(ErrorCode::InvalidUsage,
                            cat(object.describe(), " was created without ", usageNames(BufferUsage::Indirect),
                                ", which indirect commands need."))
                        .value(),
                    command.text()),
               false;
    if (offset % 4 != 0 || offset > object.descriptor.size || size > object.descriptor.size - offset)
        return fail(invalid(ErrorCode::OutOfRange,
                            cat("The arguments are ", size, " bytes at byte ", offset, " of ", object.describe(),
                                ", which has ", object.descriptor.size, "; they start at a multiple of 4."))
                        .value(),
                    command.text()),
               false;
    Use wanted;
    wanted.object = &object;
    wanted.kind = UseKind::Indirect;
    wanted.access = accessOf(UseKind::Indirect, 0, false);
    return use(wanted, command);
}

bool EncoderObject::flushBindings(VkPipelineBindPoint point, VkPipelineStageFlags2 stages, const CommandName& command) {
    const auto stop = [&](Code code, std::string text) {
        fail(invalid(code, std::move(text)).value(), command.text());
        return false;
    };
    auto& layout = *pass.pipeline->layout;
    const bool relayout = pass.boundLayout != &layout;
    if (relayout) {
        pass.boundLayout = &layout;
        pass.pushDirty = true;
        pass.groupsChanged = true;
    }
    for (std::uint32_t i = 0; i < layout.sets.size(); ++i) {
        const auto& wanted = *layout.sets[i];
        if (wanted.entries.empty()) continue;
        if (i >= pass.groups.size() || !pass.groups[i].group)
            return stop(ErrorCode::MissingState,
                        cat(pass.pipeline->describe(), " needs a bind group at index ", i, ", and none is set."));
        auto& slot = pass.groups[i];
        if (!slot.dirty && !relayout) continue;
        const auto& group = *slot.group;
        if (group.layout.get() != &wanted) {
            if (!wanted.fits(*group.layout))
                return stop(ErrorCode::LayoutMismatch,
                            cat(group.describe(), " at index ", i, " was made for ", group.layout->describe(), "; ",
                                pass.pipeline->describe(), " needs ", wanted.describe(), '.'));
            for (std::size_t e = 0; e < wanted.entries.size(); ++e)
                if (isBuffer(wanted.entries[e].type) && group.bound[e].size < wanted.entries[e].minBindingSize)
                    return stop(ErrorCode::OutOfRange,
                                cat(group.describe(), " binds ", group.bound[e].size, " bytes to binding ",
                                    wanted.entries[e].binding, " \"", wanted.entries[e].name, "\"; ",
                                    pass.pipeline->describe(), " needs ", wanted.entries[e].minBindingSize, '.'));
        }
        const auto first = static_cast<std::uint32_t>(recording.offsets.size());
        recording.offsets.insert(recording.offsets.end(), slot.offsets.begin(), slot.offsets.end());
        add(packet::BindSet{slot.group, &layout, point, i, first, static_cast<std::uint32_t>(slot.offsets.size())});
        slot.dirty = false;
    }
    if (pass.groupsChanged)
        for (std::uint32_t i = 0; i < layout.sets.size(); ++i) {
            if (layout.sets[i]->entries.empty()) continue;
            const auto* group = pass.groups[i].group;
            if (!pass.merged.insert(group, 0).second) continue;
            for (auto u : group->uses) {
                u.access.stages &= stages;
                if (u.access.stages == 0) continue;
                u.group = static_cast<std::int32_t>(i);
                if (!use(u, command)) return false;
            }
        }
    if (pass.pushDirty && layout.pushConstantsSize > 0) {
        const auto first = static_cast<std::uint32_t>(recording.bytes.size());
        recording.bytes.insert(recording.bytes.end(), pass.push.begin(), pass.push.begin() + layout.pushConstantsSize);
        add(packet::Push{&layout, first, layout.pushConstantsSize});
        pass.pushDirty = false;
    }
    return true;
}

}  // namespace pelage::rhi::detail
