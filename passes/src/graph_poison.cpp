// SPDX-License-Identifier: MIT
// Makes what a pass leaves unwritten visible: before an image begins in a frame, the bytes it takes over are painted,
// so that a "dontCare" which does not cover everything shows on every device, not only where memory was used before.
#include "graph_state.hpp"

#include <limits>

namespace pelage::passes {

namespace {

// Not a number where there is such a thing, magenta in formats that hold 0..1, an unlikely number in the others.
rhi::Color loud(rhi::TextureFormat format) {
    const std::string_view name = rhi::name(format);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (name.ends_with("loat")) return {nan, nan, nan, nan};
    if (name.ends_with("Uint")) return {127, 127, 127, 127};
    return {1, 0, 1, 1};
}

}  // namespace

Result<void> poison(const GraphState& state, std::uint32_t pass, rhi::CommandEncoder& encoder) {
    for (std::size_t i = 0; i < state.plan.resources.size(); ++i) {
        const PlanResource& image = state.plan.resources[i];
        const bool begins = image.heapOffset != notPlaced && image.firstPass == pass;
        // Only what can be a target can be painted without a shader.
        if (!begins || !contains(image.usage, rhi::TextureUsage::RenderAttachment)) continue;
        for (std::uint32_t target = 0; target < image.layers * image.mipLevels; ++target) {
            auto view = state.textures[i].createView({.dimension = rhi::TextureViewDimension::E2D,
                                                      .baseMipLevel = target / image.layers,
                                                      .mipLevelCount = 1,
                                                      .baseArrayLayer = target % image.layers,
                                                      .arrayLayerCount = 1});
            if (!view) return tl::unexpected(std::move(view.error()));
            rhi::RenderPassDescriptor descriptor{.label = "poison " + image.name};
            if (rhi::isDepth(image.format)) {
                descriptor.depthStencilAttachment = {.view = *view, .depthClearValue = 0.5F};
            } else {
                descriptor.colorAttachments.push_back({.view = *view, .clearValue = loud(image.format)});
            }
            encoder.beginRenderPass(descriptor).end();
        }
    }
    return {};
}

}  // namespace pelage::passes
