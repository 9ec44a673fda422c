// SPDX-License-Identifier: MIT
// Bind groups of set 1: what the shader names is looked up among the slots of the pass and the samplers.
#include "graph_state.hpp"

namespace pelage::passes {
namespace {

using rhi::BindGroupLayoutEntry;
using rhi::BindingType;
using rhi::TextureViewDimension;

class Binder {
public:
    Binder(Graph::State& state, std::size_t index) : state_(state), pass_(state.plan.passes[index]) {}

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
    tl::unexpected<Diagnostic> missing(const BindGroupLayoutEntry& wanted, const std::string& hint) const {
        return tl::unexpected(shaderError("P074", "a shader of pass '" + pass_.name + "' uses '" + wanted.name +
                                                      "' (set 1, binding " + std::to_string(wanted.binding) +
                                                      ") but no slot of the pass binds it" +
                                                      (hint.empty() ? "" : "; hint: " + hint)));
    }
    tl::unexpected<Diagnostic> kind(const BindGroupLayoutEntry& wanted, const PlanSlot& slot,
                                    const std::string& text) const {
        return tl::unexpected(shaderError(
            "P075", "'" + wanted.name + "' in a shader of '" + pass_.name + "." + slot.name + "' is " + text));
    }

    // An optional slot that nothing feeds still needs something to bind.
    rhi::Texture standIn(const BindGroupLayoutEntry& wanted) const {
        const char* name = wanted.viewDimension == TextureViewDimension::Cube ? "const.blackCube"
                           : wanted.type == BindingType::DepthTexture         ? "const.depthFar"
                                                                              : "const.black";
        return state_.fixtures->constants.at(name);
    }

    Result<rhi::TextureView> viewFor(const BindGroupLayoutEntry& wanted, const PlanSlot& slot) const {
        const rhi::Texture texture = slot.resource == ~0U ? standIn(wanted) : state_.textures[slot.resource];
        if (!texture) return kind(wanted, slot, "an image, and the slot has none");
        const bool manySamples = texture.sampleCount() > 1;
        if (manySamples != (wanted.type == BindingType::MultisampledTexture)) {
            return kind(wanted, slot,
                        manySamples
                            ? "a single-sampled texture, the image has " + std::to_string(texture.sampleCount()) +
                                  " samples; hint: read it as texture2DMS"
                            : "a multisampled texture, the image has 1 sample; hint: read it as texture2D");
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
        return texture.createView(view);
    }

    Graph::State& state_;
    const PlanPass& pass_;
};

// Which host objects a group of this pass would hold; a group made with others is made anew.
std::vector<const void*> lentTo(const Graph::State& state, const PlanPass& pass) {
    std::vector<const void*> lent;
    for (const PlanSlot& slot : pass.slots) {
        if (slot.bind.empty() || slot.resource == ~0U) continue;
        if (state.plan.resources[slot.resource].kind != PlanResource::Kind::Import) continue;
        const rhi::Texture& texture = state.textures[slot.resource];
        lent.push_back(texture ? static_cast<const void*>(texture.get()) : state.buffers[slot.resource].get());
    }
    return lent;
}

}  // namespace

rhi::Texture textureOf(const Graph::State& state, const PlanPass& pass, std::string_view name) {
    for (const PlanSlot& slot : pass.slots) {
        if (slot.name == name && slot.resource != ~0U) return state.textures[slot.resource];
    }
    return {};
}

rhi::Buffer bufferOf(const Graph::State& state, const PlanPass& pass, std::string_view name) {
    for (const PlanSlot& slot : pass.slots) {
        if (slot.name == name && slot.resource != ~0U) return state.buffers[slot.resource];
    }
    return {};
}

Diagnostic shaderError(std::string_view code, std::string text) {
    return {.kind = ErrorKind::Validation,
            .code = rhi::ErrorCode::BindingMismatch,
            .message = std::string(code) + ": " + text};
}

Result<rhi::BindGroup> bindGroupFor(Graph::State& state, std::size_t pass, const rhi::BindGroupLayout& layout) {
    if (!layout)
        return tl::unexpected(
            shaderError("P074", "pass '" + state.plan.passes[pass].name + "': empty bind group layout"));
    std::vector<const void*> lent = lentTo(state, state.plan.passes[pass]);
    auto& cache = state.passes[pass].groups;
    const std::pair<const void*, std::uint32_t> key{layout.get(), turnOf(state, state.plan.passes[pass])};
    const auto found = cache.find(key);
    if (found != cache.end() && found->second.lent == lent) return found->second.group;

    const Binder binder(state, pass);
    rhi::BindGroupDescriptor descriptor{.label = state.plan.passes[pass].name, .layout = layout};
    for (const BindGroupLayoutEntry& wanted : layout.entries()) {
        auto entry = binder.entry(wanted);
        if (!entry) return tl::unexpected(std::move(entry.error()));
        descriptor.entries.push_back(std::move(*entry));
    }
    auto group = state.device.createBindGroup(descriptor);
    if (!group) return group;
    cache[key] = {layout, std::move(lent), *group};
    return group;
}

}  // namespace pelage::passes
