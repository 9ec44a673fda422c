// SPDX-License-Identifier: MIT
// Images and buffers that remember the last frame: two of each, which take turns. What the first frame reads is cleared
// at its beginning.
#include "graph_state.hpp"

namespace pelage::passes {
namespace {

bool sameShape(const PlanResource& a, const PlanResource& b) {
    return a.name == b.name && a.isBuffer == b.isBuffer && a.format == b.format && a.extent == b.extent &&
           a.samples == b.samples && a.layers == b.layers && a.usage == b.usage && a.bufferUsage == b.bufferUsage &&
           a.bytes == b.bytes && (a.partner == ~0U) == (b.partner == ~0U);
}

const History* sameIn(const Graph::State& state, const PlanResource& resource) {
    for (const History& each : state.histories) {
        if (sameShape(state.plan.resources[each.last], resource)) return &each;
    }
    return nullptr;
}

Result<void> makeOne(Graph::State& state, History& history, std::size_t turn) {
    const PlanResource& resource = state.plan.resources[history.last];
    const std::string label = resource.name + (turn == 0 ? " (even frames)" : " (odd frames)");
    if (resource.isBuffer) {
        auto made = state.device.createBuffer({.label = label, .size = resource.bytes, .usage = resource.bufferUsage});
        if (!made) return tl::unexpected(std::move(made.error()));
        history.buffers[turn] = std::move(*made);
        return {};
    }
    auto made = state.device.createTexture({.label = label,
                                            .size = resource.extent,
                                            .sampleCount = resource.samples,
                                            .format = resource.format,
                                            .usage = resource.usage});
    if (!made) return tl::unexpected(std::move(made.error()));
    history.textures[turn] = std::move(*made);
    return {};
}

Result<void> clear(const Graph::State& state, const History& history, rhi::CommandEncoder& encoder) {
    const PlanResource& resource = state.plan.resources[history.last];
    if (resource.isBuffer) {
        encoder.clearBuffer(state.buffers[history.last]);
        return {};
    }
    for (std::uint32_t layer = 0; layer < resource.layers; ++layer) {
        auto view = state.textures[history.last].createView({.dimension = rhi::TextureViewDimension::E2D,
                                                             .mipLevelCount = 1,
                                                             .baseArrayLayer = layer,
                                                             .arrayLayerCount = 1});
        if (!view) return tl::unexpected(std::move(view.error()));
        rhi::RenderPassDescriptor descriptor{.label = "begin " + resource.name};
        if (rhi::isDepth(resource.format)) {
            descriptor.depthStencilAttachment = {.view = *view,
                                                 .depthClearValue = static_cast<float>(resource.historyClear.r)};
        } else {
            descriptor.colorAttachments.push_back({.view = *view, .clearValue = resource.historyClear});
        }
        encoder.beginRenderPass(descriptor).end();
    }
    return {};
}

}  // namespace

Result<void> makeHistories(Graph::State& state, const Graph::State* before) {
    for (std::uint32_t i = 0; i < state.plan.resources.size(); ++i) {
        const PlanResource& resource = state.plan.resources[i];
        if (resource.kind != PlanResource::Kind::History) continue;
        History made{.last = i, .current = resource.partner};
        if (const History* old = before ? sameIn(*before, resource) : nullptr) {
            made.turn = old->turn;
            made.begun = old->begun;
            made.textures = old->textures;
            made.buffers = old->buffers;
        } else {
            for (std::size_t turn = 0; turn < (made.current == ~0U ? 1U : 2U); ++turn) {
                if (auto one = makeOne(state, made, turn); !one) return one;
            }
        }
        state.histories.push_back(std::move(made));
    }
    takeTurns(state);
    return {};
}

void takeTurns(Graph::State& state) {
    for (const History& history : state.histories) {
        const std::size_t now = history.current == ~0U ? 1 : history.turn;
        state.textures[history.last] = history.textures[1 - now];
        state.buffers[history.last] = history.buffers[1 - now];
        if (history.current == ~0U) continue;
        state.textures[history.current] = history.textures[now];
        state.buffers[history.current] = history.buffers[now];
    }
}

Result<void> beginHistories(Graph::State& state, rhi::CommandEncoder& encoder) {
    takeTurns(state);
    for (const History& history : state.histories) {
        if (history.begun) continue;
        if (auto cleared = clear(state, history, encoder); !cleared) return cleared;
    }
    return {};
}

void endHistories(Graph::State& state) {
    for (History& history : state.histories) {
        history.begun = true;
        history.turn = 1 - history.turn;
    }
}

std::uint32_t turnOf(const Graph::State& state, const PlanPass& pass) {
    for (const PlanSlot& slot : pass.slots) {
        if (slot.resource == ~0U) continue;
        for (const History& history : state.histories) {
            if (history.last == slot.resource || history.current == slot.resource) return history.turn;
        }
    }
    return 0;
}

}  // namespace pelage::passes
