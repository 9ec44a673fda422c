// SPDX-License-Identifier: MIT
// One frame: the passes of the plan in order, each with its label, its attachments and its queries.
#include "graph_state.hpp"

#include <chrono>

namespace pelage::passes {
namespace {

using Clock = std::chrono::steady_clock;

class Recorder {
public:
    Recorder(Graph::State& state, rhi::CommandEncoder& encoder, const DrawCallback& draws)
        : state_(state), encoder_(encoder), draws_(draws) {}

    Result<void> lend(const FrameImports& imports) {
        for (std::size_t i = 0; i < state_.plan.resources.size(); ++i) {
            const PlanResource& resource = state_.plan.resources[i];
            if (resource.kind != PlanResource::Kind::Import) continue;
            const std::string name = resource.name.substr(resource.name.find('.') + 1);
            if (resource.isBuffer) {
                const auto found = imports.buffers.find(name);
                if (found == imports.buffers.end() || !found->second)
                    return fault("H001: the frame lacks the buffer '" + name + "'");
                state_.buffers[i] = found->second;
                continue;
            }
            const auto found = imports.textures.find(name);
            if (found == imports.textures.end() || !found->second)
                return fault("H001: the frame lacks the image '" + name + "'");
            const rhi::Texture& texture = found->second;
            const rhi::Extent3D size = texture.size();
            if (texture.format() != resource.format || texture.sampleCount() != resource.samples ||
                size != resource.extent) {
                return fault("H002: the image '" + name + "' is " +
                             shape(size, texture.format(), texture.sampleCount()) + ", the plan was made for " +
                             shape(resource.extent, resource.format, resource.samples) + "; build the graph again");
            }
            state_.textures[i] = texture;
        }
        return {};
    }

    Result<void> pass(std::size_t index) {
        const Clock::time_point begin = Clock::now();
        const PlanPass& pass = state_.plan.passes[index];
        PassState& own = state_.passes[index];
        own.draws = 0;
        Result<void> done = {};
        for (const PlanSlot& slot : pass.slots) {
            if (slot.resource == ~0U || slot.load != rhi::LoadOp::Clear) continue;
            if (state_.plan.resources[slot.resource].isBuffer) encoder_.clearBuffer(state_.buffers[slot.resource]);
        }
        switch (pass.kind) {
            case PassKind::Raster:
            case PassKind::Fullscreen:
                for (std::uint32_t layer = 0; layer < own.queries.count && done; ++layer) done = draw(index, layer);
                break;
            case PassKind::Compute:
                done = compute(index);
                break;
            case PassKind::Copy:
                done = copy(index);
                break;
        }
        own.cpuMilliseconds = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
        return done;
    }

private:
    static tl::unexpected<Diagnostic> fault(std::string text) {
        return tl::unexpected(Diagnostic{.code = rhi::ErrorCode::InvalidHandle, .message = std::move(text)});
    }

    static std::string shape(const rhi::Extent3D& size, rhi::TextureFormat format, std::uint32_t samples) {
        return std::to_string(size.width) + " x " + std::to_string(size.height) +
               (size.depthOrArrayLayers > 1 ? " x " + std::to_string(size.depthOrArrayLayers) : "") + " " +
               std::string(rhi::name(format)) + (samples > 1 ? ", " + std::to_string(samples) + " samples" : "");
    }

    PassContext context(std::size_t index) {
        const PlanPass& pass = state_.plan.passes[index];
        PassContext made{.pass = pass,
                         .parameters = PassParameters(pass.parameters),
                         .targets = state_.passes[index].targets,
                         .extent = state_.plan.extent};
        made.bindGroup = [this, index](const rhi::BindGroupLayout& layout) {
            return bindGroupFor(state_, index, layout);
        };
        made.texture = [this, &pass](std::string_view slot) { return textureOf(state_, pass, slot); };
        made.buffer = [this, &pass](std::string_view slot) { return bufferOf(state_, pass, slot); };
        return made;
    }

    Result<void> byClass(std::size_t index, PassContext& context) {
        const Result<void> done = state_.passes[index].recorder(context);
        state_.passes[index].draws += context.draws;
        return done;
    }

    std::optional<rhi::TimestampWrites> timestamps(std::uint32_t query) const {
        if (!state_.timestamps) return std::nullopt;
        return rhi::TimestampWrites{state_.timestamps, 2 * query, 2 * query + 1};
    }

    Result<rhi::TextureView> target(const PlanSlot& slot, std::uint32_t layer) const {
        return state_.textures[slot.resource].createView({.dimension = rhi::TextureViewDimension::E2D,
                                                          .mipLevelCount = 1,
                                                          .baseArrayLayer = layer,
                                                          .arrayLayerCount = 1});
    }

    Result<void> draw(std::size_t index, std::uint32_t layer) {
        const PlanPass& pass = state_.plan.passes[index];
        PassState& own = state_.passes[index];
        const std::uint32_t query = own.queries.first + layer;
        rhi::RenderPassDescriptor descriptor{.label = pass.forEachLayer ? pass.name + " " + std::to_string(layer)
                                                                        : pass.name};
        descriptor.timestampWrites = timestamps(query);
        descriptor.statistics = state_.statistics;
        descriptor.statisticsIndex = query;
        rhi::Extent3D extent{};
        for (const PlanSlot& slot : pass.slots) {
            if (slot.resource == ~0U || (slot.use != SlotUse::Color && slot.use != SlotUse::Depth)) continue;
            extent = state_.plan.resources[slot.resource].extent;
            auto view = target(slot, layer);
            if (!view) return tl::unexpected(std::move(view.error()));
            if (slot.use == SlotUse::Color) {
                descriptor.colorAttachments.push_back(
                    {.view = *view, .loadOp = slot.load, .storeOp = slot.store, .clearValue = slot.clear});
            } else {
                descriptor.depthStencilAttachment = {.view = *view,
                                                     .depthLoadOp = slot.load,
                                                     .depthStoreOp = slot.store,
                                                     .depthClearValue = slot.clearDepth,
                                                     .depthReadOnly = slot.access == SlotAccess::Read};
            }
        }
        extent.depthOrArrayLayers = 1;
        rhi::RenderPassEncoder recording = encoder_.beginRenderPass(descriptor);
        Result<void> done = {};
        if (own.recorder) {
            PassContext given = context(index);
            given.extent = extent;
            given.viewIndex = layer;
            given.raster = &recording;
            done = byClass(index, given);
        } else {
            done =
                pass.kind == PassKind::Raster ? raster(index, layer, extent, recording) : fullscreen(index, recording);
        }
        recording.end();
        return done;
    }

    Result<void> raster(std::size_t index, std::uint32_t layer, const rhi::Extent3D& extent,
                             rhi::RenderPassEncoder& recording) {
        if (!draws_) return {};
        RasterContext context{
            .pass = state_.plan.passes[index],
            .viewIndex = layer,
            .extent = extent,
            .targets = state_.passes[index].targets,
            .encoder = recording,
            .bindGroup = [this,
                          index](const rhi::BindGroupLayout& layout) { return bindGroupFor(state_, index, layout); },
            .buffer = [this,
                       index](std::string_view slot) { return bufferOf(state_, state_.plan.passes[index], slot); }};
        const Result<void> done = draws_(context);
        state_.passes[index].draws += context.draws;
        return done;
    }

    Result<void> fullscreen(std::size_t index, rhi::RenderPassEncoder& recording) {
        PassState& own = state_.passes[index];
        recording.setPipeline(own.pipeline);
        if (own.layout) {
            auto group = bindGroupFor(state_, index, own.layout);
            if (!group) return tl::unexpected(std::move(group.error()));
            recording.setBindGroup(1, *group);
        }
        recording.draw(3);
        own.draws += 1;
        return {};
    }

    Result<void> compute(std::size_t index) {
        const PlanPass& pass = state_.plan.passes[index];
        PassState& own = state_.passes[index];
        if (own.recorder) {
            PassContext given = context(index);
            rhi::ComputePassEncoder recording =
                encoder_.beginComputePass({.label = pass.name, .timestampWrites = timestamps(own.queries.first)});
            given.compute = &recording;
            const Result<void> done = byClass(index, given);
            recording.end();
            return done;
        }
        rhi::BindGroup group;
        if (own.layout) {
            auto made = bindGroupFor(state_, index, own.layout);
            if (!made) return tl::unexpected(std::move(made.error()));
            group = std::move(*made);
        }
        rhi::ComputePassEncoder recording =
            encoder_.beginComputePass({.label = pass.name, .timestampWrites = timestamps(own.queries.first)});
        recording.setPipeline(own.compute);
        if (group) recording.setBindGroup(1, group);
        const std::uint32_t counts = pass.indirect < pass.slots.size() ? pass.slots[pass.indirect].resource : ~0U;
        if (counts != ~0U) {
            recording.dispatchWorkgroupsIndirect(state_.buffers[counts]);
        } else if (pass.indirect == ~0U) {
            recording.dispatchWorkgroups(pass.dispatch[0], pass.dispatch[1], pass.dispatch[2]);
        }
        recording.end();
        own.draws += 1;
        return {};
    }

    Result<void> copy(std::size_t index) {
        const PassState& own = state_.passes[index];
        if (state_.timestamps) encoder_.writeTimestamp(state_.timestamps, 2 * own.queries.first);
        const Result<void> done = copies(index);
        if (state_.timestamps) encoder_.writeTimestamp(state_.timestamps, 2 * own.queries.first + 1);
        return done;
    }

    Result<void> copies(std::size_t index) {
        if (state_.passes[index].recorder) {
            PassContext given = context(index);
            given.copy = &encoder_;
            return byClass(index, given);
        }
        const PlanSlot* from = nullptr;
        const PlanSlot* to = nullptr;
        for (const PlanSlot& slot : state_.plan.passes[index].slots)
            (slot.access == SlotAccess::Read ? from : to) = &slot;
        if (!from || !to || from->resource == ~0U || to->resource == ~0U) return {};
        const PlanResource& source = state_.plan.resources[from->resource];
        if (!source.isBuffer) {
            encoder_.copyTextureToTexture({.texture = state_.textures[from->resource]},
                                          {.texture = state_.textures[to->resource]}, source.extent);
            return {};
        }
        const rhi::Buffer& a = state_.buffers[from->resource];
        const rhi::Buffer& b = state_.buffers[to->resource];
        if (a.size() != b.size()) {
            return fault("H002: pass '" + state_.plan.passes[index].name + "' copies " + std::to_string(a.size()) +
                         " bytes into a buffer of " + std::to_string(b.size()));
        }
        encoder_.copyBufferToBuffer(a, 0, b, 0, a.size());
        return {};
    }

    Graph::State& state_;
    rhi::CommandEncoder& encoder_;
    const DrawCallback& draws_;
};

}  // namespace

Result<void> Graph::record(rhi::CommandEncoder& encoder, const FrameImports& imports, const DrawCallback& draws) {
    if (!state_) {
        return tl::unexpected(Diagnostic{.code = rhi::ErrorCode::MissingState,
                                         .message = "Graph::record() before a build() that worked"});
    }
    Recorder recorder(*state_, encoder, draws);
    if (auto lent = recorder.lend(imports); !lent) return lent;
    encoder.pushDebugGroup("passes");
    if (auto begun = beginHistories(*state_, encoder); !begun) {
        encoder.popDebugGroup();
        return begun;
    }
    for (std::size_t i = 0; i < state_->passes.size(); ++i) {
        Result<void> done = {};
        if (descriptor_.poison) done = poison(*state_, static_cast<std::uint32_t>(i), encoder);
        if (done) done = recorder.pass(i);
        if (!done) {
            encoder.popDebugGroup();
            return done;
        }
    }
    resolveQueries(*state_, encoder);
    encoder.popDebugGroup();
    endHistories(*state_);
    state_->recorded = true;
    return {};
}

}  // namespace pelage::passes
