// SPDX-License-Identifier: MIT
#include "graph_state.hpp"

namespace pelage::passes {
namespace {

Checked<void> failure(const std::string& file, std::string_view code, const rhi::Error& error,
                      const std::string& what) {
    Diagnostics out;
    Reporter(file, out).error({}, code, what + ": " + rhi::toString(error));
    return tl::unexpected(std::move(out));
}

// One texture for each allocation of the plan.
rhi::Result<void> makeTextures(Graph::State& state) {
    std::vector<rhi::Texture> shared(state.plan.allocations);
    for (std::size_t i = 0; i < state.plan.resources.size(); ++i) {
        const PlanResource& image = state.plan.resources[i];
        if (image.kind == PlanResource::Kind::Constant) {
            const auto found = state.fixtures->constants.find(image.name);
            if (found != state.fixtures->constants.end()) state.textures[i] = found->second;
        }
        if (image.kind != PlanResource::Kind::Transient) continue;
        rhi::Texture& texture = shared[image.allocation];
        if (!texture) {
            auto made = state.device.createTexture({.label = image.name,
                                                    .size = image.extent,
                                                    .sampleCount = image.samples,
                                                    .format = image.format,
                                                    .usage = image.usage});
            if (!made) return tl::unexpected(std::move(made.error()));
            texture = std::move(*made);
        }
        state.textures[i] = texture;
    }
    return {};
}

}  // namespace

Targets targetsOf(const Plan& plan, const PlanPass& pass) {
    Targets targets;
    for (const PlanSlot& slot : pass.slots) {
        if (slot.resource >= plan.resources.size()) continue;
        const PlanResource& image = plan.resources[slot.resource];
        if (slot.use == SlotUse::Color) {
            targets.colors.push_back(image.format);
        } else if (slot.use == SlotUse::Depth) {
            targets.depth = image.format;
            targets.depthReadOnly = slot.access == SlotAccess::Read;
        } else {
            continue;
        }
        targets.samples = image.samples;
    }
    return targets;
}

std::uint32_t Graph::State::layersOf(const PlanPass& pass) const {
    if (!pass.forEachLayer) return 1;
    const auto found = plan.viewCounts.find(pass.view);
    return found == plan.viewCounts.end() ? 1 : found->second;
}

Graph::Graph(Descriptor descriptor) : descriptor_(std::move(descriptor)) {}

Checked<void> Graph::build(const PassTree& tree, const HostDescription& host) {
    HostDescription asked = host;
    if (!asked.supports) {
        asked.supports = [device = descriptor_.device](rhi::TextureFormat format, rhi::TextureUsage usage,
                                                       std::uint32_t samples) {
            return device.supports(format, usage, samples);
        };
    }
    Checked<Plan> plan = tree.compile(asked);
    if (!plan) return tl::unexpected(std::move(plan.error()));

    auto state = std::make_shared<State>();
    state->device = descriptor_.device;
    state->plan = std::move(*plan);
    state->textures.resize(state->plan.resources.size());
    state->buffers.resize(state->plan.resources.size());
    state->passes.resize(state->plan.passes.size());
    if (state_ && state_->fixtures->depth == host.depth) {
        state->fixtures = state_->fixtures;
    } else {
        auto fixtures = makeFixtures(state->device, host.depth);
        if (!fixtures) return failure(tree.file(), "D003", fixtures.error(), "cannot make the samplers and stand-ins");
        state->fixtures = std::move(*fixtures);
    }
    if (const auto made = makeTextures(*state); !made) {
        return failure(tree.file(), "D003", made.error(), "cannot make the images of '" + tree.name() + "'");
    }
    for (std::size_t i = 0; i < state->passes.size(); ++i) {
        state->passes[i].targets = targetsOf(state->plan, state->plan.passes[i]);
        state->passes[i].queries = {state->queryCount, state->layersOf(state->plan.passes[i])};
        state->queryCount += state->passes[i].queries.count;
    }
    if (descriptor_.measure) {
        if (const auto made = makeQueries(*state); !made) {
            return failure(tree.file(), "D003", made.error(), "cannot make the queries of '" + tree.name() + "'");
        }
    }
    Diagnostics out;
    Reporter reporter(tree.file(), out);
    makePipelines(*state, descriptor_.shaders, tree.description(), reporter);
    if (out.hasErrors()) {
        out.sortByPlace();
        return tl::unexpected(std::move(out));
    }
    state_ = std::move(state);
    return {};
}

const Plan& Graph::plan() const {
    static const Plan empty{};
    return state_ ? state_->plan : empty;
}

rhi::Texture Graph::exported(const std::string& name) const {
    if (!state_) return {};
    const auto found = state_->plan.exports.find(name);
    return found == state_->plan.exports.end() ? rhi::Texture{} : state_->textures[found->second];
}

}  // namespace pelage::passes
