// SPDX-License-Identifier: MIT
// The recorder behind the handles.
#pragma once

#include "device_object.hpp"
#include "recording.hpp"

namespace pelage::rhi::detail {

struct EncoderObject {
    explicit EncoderObject(std::shared_ptr<DeviceObject> owner, std::string name)
        : device(std::move(owner)), label(std::move(name)) {
        device->takeRecording(recording);
        recording.label = label;
    }
    enum class State : std::uint8_t { Open, RenderPass, ComputePass, Finished };

    /// Keeps the first error, with where it happened.
    void fail(const Diagnostics& errors, std::string innermost = {});
    void check(const Result<void>& result, std::string innermost = {}) {
        if (!result) fail(result.error(), std::move(innermost));
    }
    /// True when the call may go on; otherwise the reason is kept.
    bool ready(State wanted, std::string_view call);

    /// The handle is there, of this device, and kept. `what` is put together only for a message.
    template <class H, class... Parts>
    bool accept(const H& handle, const Parts&... what) {
        if (!handle) return fail(needHandle(handle, cat(what...)).error()), false;
        if (handle.get()->device != device) return fail(needSameDevice(*handle.get(), *device).error()), false;
        recording.keep(handle);
        return true;
    }
    void add(const Packet& packet) { recording.packets.push_back(packet); }
    bool use(const Use& use, const CommandName& command = {});
    void closeScope(std::size_t packetIndex);

    // Shared by render and compute passes.
    void setBindGroup(std::uint32_t index, const BindGroup& group, std::span<const std::uint32_t> offsets);
    void setPushConstants(std::uint32_t offset, std::span<const std::byte> bytes);
    void pushDebugGroup(std::string_view text);
    void popDebugGroup();
    bool timestamps(const std::optional<TimestampWrites>& writes);
    bool queryIndex(const QuerySet& set, QueryType type, std::uint32_t index, std::string_view what);
    /// Binds what the pipeline needs and merges its groups into the scope. False after an error.
    bool flushBindings(VkPipelineBindPoint point, VkPipelineStageFlags2 stages, const CommandName& command);
    /// Checks where indirect arguments lie and takes their buffer into the scope.
    bool indirectArguments(const Buffer& buffer, std::uint64_t offset, std::uint64_t size, const CommandName& command);
    void beginPass(State state, std::string_view passLabel, const std::optional<TimestampWrites>& writes);
    void endPass();
    void beginLabel(std::string_view text);

    std::shared_ptr<DeviceObject> device;
    std::string label;
    Recording recording;
    State state = State::Open;
    std::optional<Diagnostic> error;
    std::optional<CommandBuffer> finished;
    PassState& pass = recording.pass;
    ScopeBuilder& scope = recording.scope;
    CommandBuffer::Counters counters;
    std::uint32_t debugGroups = 0;
};

}  // namespace pelage::rhi::detail
