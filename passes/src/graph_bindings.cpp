// SPDX-License-Identifier: MIT
// Bind groups of set 1: what the shader names is looked up among the slots of the pass and the samplers.
#include "graph_state.hpp"

#include <algorithm>

namespace pelage::passes {
namespace {

using rhi::BindGroupLayoutEntry;
using rhi::BindingType;
using rhi::TextureViewDimension;

class Binder {
public:
    Binder(GraphState& state, std::size_t index) : state_(state), pass_(state.plan.passes[index]) {}

    Result<rhi::BindGroupEntry> entry(const BindGroupLayoutEntry& wanted) const {
        rhi::BindGroupEntry made{.binding = wanted.binding};
        if (wanted.type == BindingType::Sampler || wanted.type == BindingType::ComparisonSampler) {
            const auto found = state_.fixtures->samplers.find(wanted.name);
            if (found == state_.fixtures->samplers.end()) {
                return missing(wanted, "samplers are s_linear, s_nearest, s_linearRepeat and s_shadow");
            }
            made.resource = found->second;
            return made;
        }
        const PlanSlot* slot = nullptr;
        std::vector<std::string> binds;
        for (const PlanSlot& each : pass_.slots) {
            if (!each.bind.empty()) binds.push_back(each.bind);
            if (each.bind == wanted.name) slot = &each;
        }
        if (!slot) return missing(wanted, didYouMean(wanted.name, binds));
        const bool buffer = wanted.type == BindingType::UniformBuffer || wanted.type == BindingType::StorageBuffer ||
                            wanted.type == BindingType::ReadOnlyStorageBuffer;
        if (buffer) {
            const rhi::Buffer found = slot->resource == ~0U ? rhi::Buffer{} : state_.buffers[slot->resource];
            if (!found) return kind(wanted, *slot, "a buffer, and the slot has none");
            made.resource = rhi::BufferBinding{.buffer = found};
            return made;
        }
        auto view = viewFor(wanted, *slot);
        if (!view) return tl::unexpected(std::move(view.error()));
        made.resource = std::move(*view);
        return made;
    }

private:
    tl::unexpected<Diagnostics> missing(const BindGroupLayoutEntry& wanted, const std::string& hint) const {
        return shaderFault("P074",
                           "a shader of pass '" + pass_.name + "' uses '" + wanted.name + "' (set 1, binding " +
                               std::to_string(wanted.binding) + ") but no slot of the pass binds it",
                           hint);
    }
    tl::unexpected<Diagnostics> kind(const BindGroupLayoutEntry& wanted, const PlanSlot& slot, const std::string& text,
                                     const std::string& hint = {}) const {
        return shaderFault(
            "P075", "'" + wanted.name + "' in a shader of '" + pass_.name + "." + slot.name + "' is " + text, hint);
    }

    // An optional slot that nothing feeds still needs something to bind.
    rhi::Texture standIn(const BindGroupLayoutEntry& wanted) const {
        const char* name = wanted.viewDimension == TextureViewDimension::Cube  ? "const.blackCube"
                           : wanted.viewDimension == TextureViewDimension::E3D ? "const.transparent3D"
                           : wanted.type == BindingType::DepthTexture          ? "const.depthFar"
                                                                               : "const.black";
        return state_.fixtures->constants.at(name);
    }

    Result<rhi::TextureView> viewFor(const BindGroupLayoutEntry& wanted, const PlanSlot& slot) const {
        const rhi::Texture texture = slot.resource == ~0U ? standIn(wanted) : state_.textures[slot.resource];
        if (!texture) return kind(wanted, slot, "an image, and the slot has none");
        const bool manySamples = texture.sampleCount() > 1;
        if (manySamples != (wanted.type == BindingType::MultisampledTexture)) {
            return kind(wanted, slot,
                        manySamples ? "a single-sampled texture, the image has " +
                                          std::to_string(texture.sampleCount()) + " samples"
                                    : "a multisampled texture, the image has 1 sample",
                        manySamples ? "read it as texture2DMS" : "read it as texture2D");
        }
        const bool is3D = texture.descriptor().dimension == rhi::TextureDimension::E3D;
        if (is3D != (wanted.viewDimension == TextureViewDimension::E3D)) {
            return kind(wanted, slot, is3D ? "a 2D texture, the image is 3D" : "a 3D texture, the image is 2D",
                        is3D ? "read it as texture3D" : "read it as texture2D");
        }
        rhi::TextureViewDescriptor view{.dimension = wanted.viewDimension};
        if (wanted.viewDimension == TextureViewDimension::Cube) {
            if (!texture.descriptor().cubeCompatible) return kind(wanted, slot, "a cube, the image is none");
            view.arrayLayerCount = 6;
        } else if (wanted.viewDimension == TextureViewDimension::E2D) {
            view.arrayLayerCount = 1;
        }
        const bool storage =
            wanted.type == BindingType::StorageTexture || wanted.type == BindingType::ReadOnlyStorageTexture;
        if (storage) view.mipLevelCount = 1;
        if (slot.level != ~0U && slot.resource != ~0U) {
            view.baseMipLevel = slot.level;
            view.mipLevelCount = 1;
        }
        return texture.createView(view);
    }

    GraphState& state_;
    const PlanPass& pass_;
};

// A group that was made with other objects of the host than those lent now is another group.
const void* lentTo(const GraphState& state, const PlanSlot& slot) {
    const rhi::Texture& texture = state.textures[slot.resource];
    return texture ? static_cast<const void*>(texture.get()) : state.buffers[slot.resource].get();
}

bool isSame(const CachedGroup& cached, const GraphState& state, std::size_t index) {
    const PassState& own = state.passes[index];
    for (std::size_t i = 0; i < own.lentSlots.size(); ++i) {
        if (cached.lent[i] != lentTo(state, state.plan.passes[index].slots[own.lentSlots[i]])) return false;
    }
    return true;
}

// A host with several frames in flight lends other objects each time: the groups of some frames are kept.
constexpr std::size_t keptGroups = 4;

}  // namespace

rhi::Texture textureOf(const GraphState& state, const PlanPass& pass, std::string_view name) {
    for (const PlanSlot& slot : pass.slots) {
        if (slot.name == name && slot.resource != ~0U) return state.textures[slot.resource];
    }
    return {};
}

rhi::Buffer bufferOf(const GraphState& state, const PlanPass& pass, std::string_view name) {
    for (const PlanSlot& slot : pass.slots) {
        if (slot.name == name && slot.resource != ~0U) return state.buffers[slot.resource];
    }
    return {};
}

tl::unexpected<Diagnostics> shaderFault(Code code, std::string text, std::string hint) {
    return tl::unexpected<Diagnostics>(Diagnostic{.code = code, .text = std::move(text), .hint = std::move(hint)});
}

Result<rhi::BindGroup> bindGroupFor(GraphState& state, std::size_t pass, const rhi::BindGroupLayout& layout) {
    if (!layout) return shaderFault("P074", "pass '" + state.plan.passes[pass].name + "': empty bind group layout");
    PassState& own = state.passes[pass];
    const std::uint32_t turn = own.history == ~0U ? 0 : state.histories[own.history].turn;
    std::size_t alike = 0;
    for (const CachedGroup& cached : own.groups) {
        if (cached.layout != layout || cached.turn != turn) continue;
        if (isSame(cached, state, pass)) return cached.group;
        ++alike;
    }

    const Binder binder(state, pass);
    rhi::BindGroupDescriptor descriptor{.label = state.plan.passes[pass].name, .layout = layout};
    for (const BindGroupLayoutEntry& wanted : layout.entries()) {
        auto entry = binder.entry(wanted);
        if (!entry) return tl::unexpected(std::move(entry.error()));
        descriptor.entries.push_back(std::move(*entry));
    }
    auto group = state.device.createBindGroup(descriptor);
    if (!group) return group;
    CachedGroup cached{.layout = layout, .turn = turn, .group = *group};
    for (const std::uint32_t slot : own.lentSlots)
        cached.lent.push_back(lentTo(state, state.plan.passes[pass].slots[slot]));
    if (alike >= keptGroups) {  // the oldest goes
        own.groups.erase(std::find_if(own.groups.begin(), own.groups.end(), [&](const CachedGroup& old) {
            return old.layout == layout && old.turn == turn;
        }));
    }
    own.groups.push_back(std::move(cached));
    return group;
}

}  // namespace pelage::passes
