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

    rhi::Result<void> lend(const FrameImports& imports) {
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
                size.width != resource.extent.width || size.height != resource.extent.height) {
                return fault("H002: the image '" + name + "' is " + std::to_string(size.width) + " x " +
                             std::to_string(size.height) + " " + std::string(rhi::name(texture.format())) +
                             ", the plan was made for " + std::to_string(resource.extent.width) + " x " +
                             std::to_string(resource.extent.height) + " " + std::string(rhi::name(resource.format)) +
                             "; build the graph again");
            }
            state_.textures[i] = texture;
        }
        return {};
    }

    rhi::Result<void> pass(std::size_t index) {
        const Clock::time_point begin = Clock::now();
        const PlanPass& pass = state_.plan.passes[index];
        PassState& own = state_.passes[index];
        own.draws = 0;
        rhi::Result<void> done = {};
        switch (pass.kind) {
            case PassKind::Raster:
            case PassKind::Fullscreen:
                for (std::uint32_t layer = 0; layer < own.queries.count && done; ++layer) done = draw(index, layer);
                break;
            case PassKind::Compute:
                done = compute(index);
                break;
            case PassKind::Copy:
                copy(pass, own);
                break;
        }
        own.cpuMilliseconds = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
        return done;
    }

private:
    static tl::unexpected<rhi::Error> fault(std::string text) {
        return tl::unexpected(rhi::Error{.code = rhi::ErrorCode::InvalidHandle, .message = std::move(text)});
    }

    std::optional<rhi::TimestampWrites> timestamps(std::uint32_t query) const {
        if (!state_.timestamps) return std::nullopt;
        return rhi::TimestampWrites{state_.timestamps, 2 * query, 2 * query + 1};
    }

    rhi::Result<rhi::TextureView> target(const PlanSlot& slot, std::uint32_t layer) const {
        return state_.textures[slot.resource].createView({.dimension = rhi::TextureViewDimension::E2D,
                                                          .mipLevelCount = 1,
                                                          .baseArrayLayer = layer,
                                                          .arrayLayerCount = 1});
    }

    rhi::Result<void> draw(std::size_t index, std::uint32_t layer) {
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
        const rhi::Result<void> done =
            pass.kind == PassKind::Raster ? raster(index, layer, extent, recording) : fullscreen(index, recording);
        recording.end();
        return done;
    }

    rhi::Result<void> raster(std::size_t index, std::uint32_t layer, const rhi::Extent3D& extent,
                             rhi::RenderPassEncoder& recording) {
        if (!draws_) return {};
        RasterContext context{.pass = state_.plan.passes[index],
                              .viewIndex = layer,
                              .extent = extent,
                              .targets = state_.passes[index].targets,
                              .encoder = recording,
                              .bindGroup = [this, index](const rhi::BindGroupLayout& layout) {
                                  return bindGroupFor(state_, index, layout);
                              }};
        const rhi::Result<void> done = draws_(context);
        state_.passes[index].draws += context.draws;
        return done;
    }

    rhi::Result<void> fullscreen(std::size_t index, rhi::RenderPassEncoder& recording) {
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

    rhi::Result<void> compute(std::size_t index) {
        const PlanPass& pass = state_.plan.passes[index];
        PassState& own = state_.passes[index];
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
        recording.dispatchWorkgroups(pass.dispatch[0], pass.dispatch[1], pass.dispatch[2]);
        recording.end();
        own.draws += 1;
        return {};
    }

    void copy(const PlanPass& pass, const PassState& own) {
        const PlanSlot* from = nullptr;
        const PlanSlot* to = nullptr;
        for (const PlanSlot& slot : pass.slots) (slot.access == SlotAccess::Read ? from : to) = &slot;
        if (state_.timestamps) encoder_.writeTimestamp(state_.timestamps, 2 * own.queries.first);
        if (from && to && from->resource != ~0U && to->resource != ~0U) {
            encoder_.copyTextureToTexture({.texture = state_.textures[from->resource]},
                                          {.texture = state_.textures[to->resource]},
                                          state_.plan.resources[from->resource].extent);
        }
        if (state_.timestamps) encoder_.writeTimestamp(state_.timestamps, 2 * own.queries.first + 1);
    }

    Graph::State& state_;
    rhi::CommandEncoder& encoder_;
    const DrawCallback& draws_;
};

}  // namespace

rhi::Result<void> Graph::record(rhi::CommandEncoder& encoder, const FrameImports& imports, const DrawCallback& draws) {
    if (!state_) {
        return tl::unexpected(rhi::Error{.code = rhi::ErrorCode::MissingState,
                                         .message = "Graph::record() before a build() that worked"});
    }
    Recorder recorder(*state_, encoder, draws);
    if (auto lent = recorder.lend(imports); !lent) return lent;
    encoder.pushDebugGroup("passes");
    for (std::size_t i = 0; i < state_->passes.size(); ++i) {
        if (auto done = recorder.pass(i); !done) {
            encoder.popDebugGroup();
            return done;
        }
    }
    resolveQueries(*state_, encoder);
    encoder.popDebugGroup();
    state_->recorded = true;
    return {};
}

}  // namespace pelage::passes
