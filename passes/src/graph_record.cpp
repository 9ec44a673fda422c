// SPDX-License-Identifier: MIT
// One frame: the passes of the plan in order, each with its label, its attachments and its queries.
#include "graph_state.hpp"

#include <chrono>

namespace pelage::passes {
namespace {

using Clock = std::chrono::steady_clock;

class Recorder {
public:
    Recorder(GraphState& state, rhi::CommandEncoder& encoder) : state_(state), encoder_(encoder) {}

    Result<void> lend(const FrameImports& imports) {
        for (const LentResource& import : state_.lent) {
            const PlanResource& resource = state_.plan.resources[import.resource];
            if (resource.isBuffer) {
                const auto found = imports.buffers.find(import.name);
                if (found == imports.buffers.end() || !found->second)
                    return fault("P080", "the frame lacks the buffer '" + import.name + "'");
                state_.buffers[import.resource] = found->second;
                continue;
            }
            const auto found = imports.textures.find(import.name);
            if (found == imports.textures.end() || !found->second)
                return fault("P080", "the frame lacks the image '" + import.name + "'");
            const rhi::Texture& texture = found->second;
            const rhi::Extent3D size = texture.size();
            if (texture.format() != resource.format || texture.sampleCount() != resource.samples ||
                size != resource.extent) {
                return fault("P081",
                             "the image '" + import.name + "' is " +
                                 shape(size, texture.format(), texture.sampleCount()) + ", the plan was made for " +
                                 shape(resource.extent, resource.format, resource.samples) + "; build the graph again");
            }
            state_.textures[import.resource] = texture;
        }
        return {};
    }

    Result<void> pass(std::size_t index) {
        const Clock::time_point begin = Clock::now();
        PassState& own = state_.passes[index];
        PassContext given(state_, index);
        for (const PlanSlot& slot : given.pass.slots) {
            if (slot.resource == ~0U || slot.load != rhi::LoadOp::Clear) continue;
            if (state_.plan.resources[slot.resource].isBuffer) encoder_.clearBuffer(state_.buffers[slot.resource]);
        }
        Result<void> done = {};
        const std::uint32_t query = 2 * own.queries.first;
        switch (given.pass.kind) {
            case PassKind::Raster:
            case PassKind::Fullscreen:
                for (; given.viewIndex < own.layers.size() && done; ++given.viewIndex) {
                    done = putViews(state_, index, given.viewIndex);
                    if (!done) break;
                    rhi::RenderPassEncoder recording = encoder_.beginRenderPass(own.layers[given.viewIndex].descriptor);
                    given.raster = &recording;
                    done = own.recorder(given);
                    recording.end();
                }
                break;
            case PassKind::Compute: {
                rhi::ComputePassEncoder recording = encoder_.beginComputePass(own.computePass);
                given.compute = &recording;
                done = own.recorder(given);
                recording.end();
                break;
            }
            case PassKind::Copy:
                if (state_.timestamps) encoder_.writeTimestamp(state_.timestamps, query);
                given.copy = &encoder_;
                done = own.recorder(given);
                if (state_.timestamps) encoder_.writeTimestamp(state_.timestamps, query + 1);
                break;
        }
        own.draws = given.draws;
        own.cpuMilliseconds = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
        return done;
    }

private:
    static tl::unexpected<Diagnostics> fault(Code code, std::string text) {
        return tl::unexpected<Diagnostics>(Diagnostic{.code = code, .text = std::move(text)});
    }

    static std::string shape(const rhi::Extent3D& size, rhi::TextureFormat format, std::uint32_t samples) {
        return std::to_string(size.width) + " x " + std::to_string(size.height) +
               (size.depthOrArrayLayers > 1 ? " x " + std::to_string(size.depthOrArrayLayers) : "") + " " +
               std::string(rhi::name(format)) + (samples > 1 ? ", " + std::to_string(samples) + " samples" : "");
    }

    GraphState& state_;
    rhi::CommandEncoder& encoder_;
};

}  // namespace

PassContext::PassContext(GraphState& state, std::size_t index)
    : pass(state.plan.passes[index]),
      parameters(pass.parameters),
      targets(state.passes[index].targets),
      extent(state.passes[index].extent),
      state_(state),
      index_(index) {}

Result<rhi::BindGroup> PassContext::bindGroup(const rhi::BindGroupLayout& layout) const {
    return bindGroupFor(state_, index_, layout);
}
rhi::Texture PassContext::texture(std::string_view slot) const {
    return textureOf(state_, pass, slot);
}
rhi::Buffer PassContext::buffer(std::string_view slot) const {
    return bufferOf(state_, pass, slot);
}

Result<void> Graph::record(rhi::CommandEncoder& encoder, const FrameImports& imports) {
    if (!state_) {
        return tl::unexpected<Diagnostics>(Diagnostic{.code = rhi::ErrorCode::MissingState,
                                                      .text = "Graph::record() before a build() that worked",
                                                      .kind = ErrorKind::Validation});
    }
    Recorder recorder(*state_, encoder);
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
