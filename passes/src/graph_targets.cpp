// SPDX-License-Identifier: MIT
// What a pass draws into, described when the graph is built: a frame puts in no more than the views of images that take
// turns. So a frame like the one before it asks the heap for nothing.
#include "graph_state.hpp"

namespace pelage::passes {

Result<rhi::TextureView> KeptViews::of(const rhi::Texture& texture, const rhi::TextureViewDescriptor& wanted) {
    for (const Kept& kept : kept_) {
        if (kept.texture == texture) return kept.view;
    }
    auto made = texture.createView(wanted);
    if (!made) return made;
    kept_[next_] = {texture, *made};
    next_ = (next_ + 1) % kept_.size();
    return made;
}

namespace {

bool isTarget(const PlanSlot& slot) {
    return slot.resource != ~0U && (slot.use == SlotUse::Color || slot.use == SlotUse::Depth);
}

rhi::RenderPassDescriptor describe(const GraphState& state, const PlanPass& pass, std::uint32_t layer,
                                   std::uint32_t query) {
    rhi::RenderPassDescriptor made{.label = pass.forEachLayer ? pass.name + " " + std::to_string(layer) : pass.name};
    made.timestampWrites = timestampsOf(state, query);
    made.statistics = state.statistics;
    made.statisticsIndex = query;
    for (const PlanSlot& slot : pass.slots) {
        if (!isTarget(slot)) continue;
        if (slot.use == SlotUse::Color) {
            made.colorAttachments.push_back({.loadOp = slot.load, .storeOp = slot.store, .clearValue = slot.clear});
        } else {
            made.depthStencilAttachment = {.depthLoadOp = slot.load,
                                           .depthStoreOp = slot.store,
                                           .depthClearValue = slot.clearDepth,
                                           .depthReadOnly = slot.access == SlotAccess::Read};
        }
    }
    return made;
}

}  // namespace

std::optional<rhi::TimestampWrites> timestampsOf(const GraphState& state, std::uint32_t query) {
    if (!state.timestamps) return std::nullopt;
    return rhi::TimestampWrites{state.timestamps, 2 * query, 2 * query + 1};
}

void describePasses(GraphState& state) {
    for (std::uint32_t i = 0; i < state.plan.resources.size(); ++i) {
        const PlanResource& resource = state.plan.resources[i];
        if (resource.kind == PlanResource::Kind::Import)
            state.lent.push_back({i, resource.name.substr(resource.name.find('.') + 1)});
    }
    for (std::size_t i = 0; i < state.passes.size(); ++i) {
        const PlanPass& pass = state.plan.passes[i];
        PassState& own = state.passes[i];
        own.computePass = {.label = pass.name, .timestampWrites = timestampsOf(state, own.queries.first)};
        own.extent = state.plan.extent;
        for (std::uint32_t s = 0; s < pass.slots.size(); ++s) {
            const PlanSlot& slot = pass.slots[s];
            if (slot.resource == ~0U) continue;
            for (std::uint32_t h = 0; h < state.histories.size(); ++h) {
                const History& history = state.histories[h];
                if (history.last == slot.resource || history.current == slot.resource) own.history = h;
            }
            const PlanResource& resource = state.plan.resources[slot.resource];
            if (!slot.bind.empty() && resource.kind == PlanResource::Kind::Import) own.lentSlots.push_back(s);
            if (!isTarget(slot)) continue;
            own.targetSlots.push_back(s);
            const rhi::Extent3D extent =
                levelExtent(resource.extent, resource.is3D, slot.level == ~0U ? 0 : slot.level);
            own.extent = {extent.width, extent.height, 1};
        }
        if (pass.kind != PassKind::Raster && pass.kind != PassKind::Fullscreen) continue;
        for (std::uint32_t layer = 0; layer < own.queries.count; ++layer)
            own.layers.push_back({.descriptor = describe(state, pass, layer, own.queries.first + layer),
                                  .views = std::vector<KeptViews>(own.targetSlots.size())});
    }
}

Result<void> putViews(GraphState& state, std::size_t pass, std::uint32_t layer) {
    PassState& own = state.passes[pass];
    LayerTargets& targets = own.layers[layer];
    std::size_t color = 0;
    for (std::size_t i = 0; i < own.targetSlots.size(); ++i) {
        const PlanSlot& slot = state.plan.passes[pass].slots[own.targetSlots[i]];
        auto view =
            targets.views[i].of(state.textures[slot.resource], {.dimension = rhi::TextureViewDimension::E2D,
                                                                .baseMipLevel = slot.level == ~0U ? 0 : slot.level,
                                                                .mipLevelCount = 1,
                                                                .baseArrayLayer = layer,
                                                                .arrayLayerCount = 1});
        if (!view) return tl::unexpected(std::move(view.error()));
        if (slot.use == SlotUse::Color) {
            targets.descriptor.colorAttachments[color++].view = std::move(*view);
        } else {
            targets.descriptor.depthStencilAttachment->view = std::move(*view);
        }
    }
    return {};
}

}  // namespace pelage::passes
