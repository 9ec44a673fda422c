// SPDX-License-Identifier: MIT
// Before a frame is recorded: the graph for its extent and settings, the uniform blocks of its views, the state of its
// objects.
#include "state.hpp"
#include "visibility/cards/sorting.hpp"

#include <algorithm>

namespace pelage::hair {

Result<void> Renderer::State::buildGraph(const Scene& scene, const FrameSettings& settings, std::uint32_t& shadowSize,
                                          std::uint32_t& shadowLights) {
    passes::HostDescription wanted;
    wanted.extent = {settings.width, settings.height, 1};
    wanted.depth = passes::DepthConvention::Reversed;
    wanted.settings = settings.settings;
    // What a tree does not ask for is not lent: a warning about it would not be the caller's doing.
    for (const passes::WantedImport& import : tree->imports()) {
        if (import.name == "EnvIrradiance")
            wanted.imports[import.name] = {true, rhi::TextureFormat::RGBA16Float, {16, 16, 6}, 1};
        if (import.name == "DisplayConstants" || import.name == "FrameConstants")
            wanted.imports[import.name] = {true, rhi::TextureFormat::Undefined, {}, 1};
    }
    for (const auto& [name, texture] : settings.imports)
        if (texture) wanted.imports[name] = {true, texture.format(), texture.size(), texture.sampleCount()};
    for (const auto& [name, buffer] : settings.buffers)
        if (buffer) wanted.imports[name] = {true, rhi::TextureFormat::Undefined, {}, 1};
    // Nobody can ask this renderer for its depth, so that need not outlive the passes that test against it.
    for (const std::string& name : tree->exports())
        if (name == "Depth") wanted.unwantedExports.push_back(name);
    shadowSize = 1;
    shadowLights = 0;
    for (const passes::SettingInfo& info : tree->settings()) {
        const auto given = wanted.settings.find(info.name);
        const std::uint32_t number = given != wanted.settings.end() ? given->second.number : info.defaultValue.number;
        if (info.name == "shadowSize") shadowSize = number;
        if (info.name == "hostDepth" && settings.view && given == wanted.settings.end()) {
            const bool reversed = settings.view->depth == passes::DepthConvention::Reversed;
            wanted.settings[info.name] = {passes::SettingValue::Type::Enum, reversed ? 0U : 1U,
                                          reversed ? "reversed" : "conventional"};
        }
        if (info.name == "shadowLights") {
            // As many layers as there are lights that cast shadows, unless the caller wants fewer.
            shadowLights = std::min(countShadowLights(scene), given != wanted.settings.end() ? number : info.max);
            wanted.settings[info.name] = {passes::SettingValue::Type::Uint, shadowLights, {}};
        }
    }
    // Full-screen passes that loop over the lights are told of them by settings.
    for (const rhi::ConstantEntry& constant : lightOptions(scene, shadowLights).constants()) {
        const auto isIt = [&](const passes::SettingInfo& info) { return info.name == constant.name; };
        if (std::any_of(tree->settings().begin(), tree->settings().end(), isIt))
            wanted.settings[constant.name] = {
                passes::SettingValue::Type::Uint, static_cast<std::uint32_t>(constant.value), {}};
    }
    const auto same = [&] {
        return built && wanted.extent == host.extent && wanted.settings == host.settings &&
               wanted.imports == host.imports;
    };
    if (same()) return {};
    auto result = graph.build(*tree, wanted);
    if (!result) return tl::unexpected(firstError(result.error()));
    host = std::move(wanted);
    built = true;
    ++graphBuilds;
    return {};
}

Result<void> Renderer::State::writeView(std::size_t index, const FrameBlock& block) {
    if (views.size() <= index) views.resize(index + 1);
    ViewState& view = views[index];
    if (!view.block) {
        auto buffer =
            device.createBuffer({.label = index == 0 ? "frame" : "frame of shadow " + std::to_string(index - 1),
                                 .size = sizeof(FrameBlock),
                                 .usage = rhi::BufferUsage::Uniform | rhi::BufferUsage::CopyDst});
        if (!buffer) return tl::unexpected(buffer.error());
        view.block = *buffer;
    }
    auto written = device.queue().writeBuffer(view.block, 0, std::as_bytes(std::span(&block, 1)));
    if (!written) return tl::unexpected(written.error());
    return {};
}

Result<void> Renderer::State::prepareObjects(Scene& scene, const FrameViews& frameViews) {
    objects.resize(scene.objects.size());
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        Object& object = scene.objects[i];
        ObjectState& state = objects[i];
        auto geometry = uploads.geometry(object.geometry);
        if (!geometry) return tl::unexpected(geometry.error());
        state.geometry = *geometry;
        state.material = &object.material.compile();
        if (auto updated = updatePipelines(state, object); !updated) return updated;
        if (!state.block) {
            auto buffer = device.createBuffer({.label = object.name + " object",
                                               .size = sizeof(ObjectBlock),
                                               .usage = rhi::BufferUsage::Uniform | rhi::BufferUsage::CopyDst});
            if (!buffer) return tl::unexpected(buffer.error());
            state.block = *buffer;
        }
        ObjectBlock block;
        block.model = object.transform;
        block.normalMatrix = glm::mat4(glm::transpose(glm::inverse(glm::mat3(object.transform))));
        if (object.geometry->topology == Topology::Lines) {
            const glm::vec3 middle = glm::vec3(
                object.transform * glm::vec4(0.5F * (object.geometry->boundsMin + object.geometry->boundsMax), 1.0F));
            const auto width = [&](const FrameBlock& view) {
                const float distance = std::max(glm::dot(middle - view.eye, view.viewForward), 1e-4F);
                const float pixels = state.geometry->meanWidth / (view.pixelScale * distance + view.pixelConstant);
                return std::clamp(pixels, 1.0F,
                                  device.has(rhi::Feature::WideLines) ? device.limits().maxLineWidth : 1.0F);
            };
            state.lineWidthMain = width(frameViews.main);
            state.lineWidthShadow = frameViews.shadows.empty() ? 1.0F : width(frameViews.shadows.front());
            block.lineWidth = {state.lineWidthMain, state.lineWidthShadow, 0, 0};
        }
        auto written = device.queue().writeBuffer(state.block, 0, std::as_bytes(std::span(&block, 1)));
        if (!written) return tl::unexpected(written.error());
        // Alpha blending needs an order.
        const bool blends =
            state.shown && std::any_of(state.shown->shaders.begin(), state.shown->shaders.end(), [](const auto& s) {
                return s.enabled && s.state.blend == materials::Blend::Premultiplied;
            });
        if (!blends) {
            state.sortedIndices = {};
            continue;
        }
        const auto sorted = backToFront(*object.geometry, object.transform, frameViews.main.viewForward);
        const auto bytes = std::as_bytes(std::span(sorted));
        if (!state.sortedIndices || state.sortedIndices.size() != bytes.size()) {
            auto buffer = device.createBuffer({.label = object.name + " sorted indices",
                                               .size = bytes.size(),
                                               .usage = rhi::BufferUsage::Index | rhi::BufferUsage::CopyDst});
            if (!buffer) return tl::unexpected(buffer.error());
            state.sortedIndices = *buffer;
        }
        written = device.queue().writeBuffer(state.sortedIndices, 0, bytes);
        if (!written) return tl::unexpected(written.error());
    }
    uploads.collect();
    return {};
}

}  // namespace pelage::hair
