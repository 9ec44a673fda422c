// SPDX-License-Identifier: MIT
#include "graph_state.hpp"

namespace pelage::passes {
namespace {

Result<void> failure(const PassTree& tree, const Diagnostics& faults, const std::string& what) {
    Diagnostics out;
    Reporter(tree.file(), out).forward({}, faults, what + " of pass tree '" + tree.name() + "'");
    return tl::unexpected(std::move(out));
}

rhi::TextureDescriptor descriptorOf(const PlanResource& image) {
    return {.label = image.name,
            .size = image.extent,
            .mipLevelCount = image.mipLevels,
            .sampleCount = image.samples,
            .dimension = image.is3D ? rhi::TextureDimension::E3D : rhi::TextureDimension::E2D,
            .format = image.format,
            .usage = image.usage};
}

// A device may keep some format out of the heap's kind of memory; such an image has its own.
Result<rhi::Texture> makeTexture(const rhi::Device& device, const PlanResource& image, const rhi::TransientHeap& heap) {
    rhi::TextureDescriptor descriptor = descriptorOf(image);
    if (heap) {
        descriptor.heap = heap;
        descriptor.heapOffset = image.heapOffset;
        device.pushErrorScope();
        auto placed = device.createTexture(descriptor);
        device.popErrorScope();
        if (placed || placed.error().first().code != rhi::ErrorCode::FormatUnsupported) return placed;
        descriptor.heap = {};
        descriptor.heapOffset = 0;
    }
    return device.createTexture(descriptor);
}

// The images and buffers that the plan creates. Histories are made by makeHistories().
Result<void> makeResources(GraphState& state) {
    rhi::TransientHeap heap;
    if (state.plan.heapBytes > 0) {
        auto made = state.device.createTransientHeap({.label = "transient images", .size = state.plan.heapBytes});
        if (!made) return tl::unexpected(std::move(made.error()));
        heap = std::move(*made);
    }
    for (std::size_t i = 0; i < state.plan.resources.size(); ++i) {
        const PlanResource& resource = state.plan.resources[i];
        if (resource.kind == PlanResource::Kind::Constant) {
            const auto found = state.fixtures->constants.find(resource.name);
            if (found != state.fixtures->constants.end()) state.textures[i] = found->second;
        }
        if (resource.kind != PlanResource::Kind::Transient || resource.partner != ~0U) continue;
        if (resource.isBuffer) {
            auto made = state.device.createBuffer(
                {.label = resource.name, .size = resource.bytes, .usage = resource.bufferUsage});
            if (!made) return tl::unexpected(std::move(made.error()));
            state.buffers[i] = std::move(*made);
            continue;
        }
        auto made = makeTexture(state.device, resource, heap);
        if (!made) return tl::unexpected(std::move(made.error()));
        state.textures[i] = std::move(*made);
    }
    return {};
}

// What the host says in words and numbers; its callbacks cannot be compared.
bool same(const HostDescription& a, const HostDescription& b) {
    return a.extent == b.extent && a.depth == b.depth && a.settings == b.settings && a.imports == b.imports &&
           a.unwantedExports == b.unwantedExports && a.maxSide == b.maxSide && a.maxSide3D == b.maxSide3D &&
           a.maxLayers == b.maxLayers && a.maxBytes == b.maxBytes;
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

std::uint32_t GraphState::layersOf(const PlanPass& pass) const {
    if (!pass.forEachLayer) return 1;
    const auto found = plan.viewCounts.find(pass.view);
    return found == plan.viewCounts.end() ? 1 : found->second;
}

Graph::Graph(Descriptor descriptor) : descriptor_(std::move(descriptor)) {}

Result<void> Graph::build(const PassTree& tree, const HostDescription& host) {
    if (state_ && !stale_ && state_->tree == tree.shared() && same(state_->host, host)) return {};
    HostDescription asked = host;
    if (!asked.supports) {
        asked.supports = [device = descriptor_.device](rhi::TextureFormat format, rhi::TextureUsage usage,
                                                       std::uint32_t samples) {
            return device.supports(format, usage, samples);
        };
    }
    const rhi::Limits& limits = descriptor_.device.limits();
    asked.maxSide = std::min(asked.maxSide, limits.maxTextureDimension2D);
    asked.maxLayers = std::min(asked.maxLayers, limits.maxTextureArrayLayers);
    if (!asked.memory) {
        asked.memory = [device = descriptor_.device](const PlanResource& image) {
            const auto need = device.memoryRequirements(descriptorOf(image));
            return need ? MemoryNeed{need->size, need->alignment} : MemoryNeed{image.bytes, 1};
        };
    }
    if (asked.classes.empty()) asked.classes = descriptor_.classes.infos();
    Result<Plan> plan = tree.compile(asked);
    if (!plan) return tl::unexpected(std::move(plan.error()));

    auto state = std::make_shared<GraphState>();
    state->device = descriptor_.device;
    state->plan = std::move(*plan);
    state->tree = tree.shared();
    state->host = host;
    state->textures.resize(state->plan.resources.size());
    state->buffers.resize(state->plan.resources.size());
    state->passes.resize(state->plan.passes.size());
    if (state_ && state_->fixtures->depth == host.depth) {
        state->fixtures = state_->fixtures;
    } else {
        auto fixtures = makeFixtures(state->device, host.depth);
        if (!fixtures) return failure(tree, fixtures.error(), "the samplers and stand-ins");
        state->fixtures = std::move(*fixtures);
    }
    auto made = makeResources(*state);
    if (made) made = makeHistories(*state, state_.get());
    if (!made) return failure(tree, made.error(), "the images and buffers");
    for (std::size_t i = 0; i < state->passes.size(); ++i) {
        state->passes[i].targets = targetsOf(state->plan, state->plan.passes[i]);
        state->passes[i].queries = {state->queryCount, state->layersOf(state->plan.passes[i])};
        state->queryCount += state->passes[i].queries.count;
    }
    if (descriptor_.measure) {
        if (const auto queries = makeQueries(*state); !queries) return failure(tree, queries.error(), "the queries");
    }
    describePasses(*state);
    Diagnostics out;
    Reporter reporter(tree.description().files, out);
    makePipelines(*state, descriptor_.shaders, descriptor_.classes, tree.description(), reporter);
    if (out.hasErrors()) {
        out.sortByPlace();
        return tl::unexpected(std::move(out));
    }
    state_ = std::move(state);
    ++plansMade_;
    stale_ = false;
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

rhi::Buffer Graph::exportedBuffer(const std::string& name) const {
    if (!state_) return {};
    const auto found = state_->plan.exports.find(name);
    return found == state_->plan.exports.end() ? rhi::Buffer{} : state_->buffers[found->second];
}

}  // namespace pelage::passes
