// SPDX-License-Identifier: MIT
// Before a frame is recorded: the graph for its extent and settings, the uniform blocks of its views, the state of its
// objects.
#include "names.hpp"
#include "state.hpp"

#include <algorithm>
#include <cmath>

namespace pelage::hair {

namespace {

rhi::Extent3D extentOf(const FrameSettings& frame) {
    return {frame.width, frame.height, 1};
}

std::optional<passes::DepthConvention> hostDepthOf(const FrameSettings& frame) {
    return frame.view ? std::optional(frame.view->depth) : std::nullopt;
}

passes::LentImport lentImage(const rhi::Texture& texture) {
    if (!texture) return {};
    return {true, texture.format(), texture.size(), texture.sampleCount()};
}

}  // namespace

GraphInputs::GraphInputs(const Scene& scene, const FrameSettings& frame)
    : extent(extentOf(frame)),
      hostDepth(hostDepthOf(frame)),
      lights(lightOptions(scene, maxLights)),
      settings(frame.settings) {
    for (const auto& [name, texture] : frame.imports) images[name] = lentImage(texture);
    for (const auto& [name, buffer] : frame.buffers)
        if (buffer) buffers.push_back(name);
}

bool GraphInputs::are(const Scene& scene, const FrameSettings& frame) const {
    if (extent != extentOf(frame) || hostDepth != hostDepthOf(frame) || lights != lightOptions(scene, maxLights) ||
        settings != frame.settings)
        return false;
    const bool sameImages =
        std::equal(images.begin(), images.end(), frame.imports.begin(), frame.imports.end(),
                   [](const auto& a, const auto& b) { return a.first == b.first && a.second == lentImage(b.second); });
    std::size_t at = 0;
    for (const auto& [name, buffer] : frame.buffers) {
        if (!buffer) continue;
        if (at == buffers.size() || buffers[at] != name) return false;
        ++at;
    }
    return sameImages && at == buffers.size();
}

Result<void> Renderer::State::buildGraph(const Scene& scene, const FrameSettings& settings, std::uint32_t& shadowSize,
                                         std::uint32_t& shadowLights) {
    if (built && inputs && inputs->are(scene, settings)) {
        shadowSize = inputs->shadowSize;
        shadowLights = inputs->shadowLights;
        return {};
    }
    inputs.reset();
    passes::HostDescription wanted;
    wanted.extent = extentOf(settings);
    wanted.depth = passes::DepthConvention::Reversed;
    wanted.settings = settings.settings;
    // What a tree does not ask for is not lent: a warning about it would not be the caller's doing.
    for (const passes::WantedImport& import : tree->imports()) {
        if (import.name == names::environmentIrradiance)
            wanted.imports[import.name] = {true, rhi::TextureFormat::RGBA16Float, {16, 16, 6}, 1};
        if (import.name == names::displayConstants || import.name == names::frameConstants)
            wanted.imports[import.name] = {true, rhi::TextureFormat::Undefined, {}, 1};
    }
    for (const auto& [name, texture] : settings.imports)
        if (texture) wanted.imports[name] = {true, texture.format(), texture.size(), texture.sampleCount()};
    for (const auto& [name, buffer] : settings.buffers)
        if (buffer) wanted.imports[name] = {true, rhi::TextureFormat::Undefined, {}, 1};
    // The renderer gives its depth to no caller, so depth need not outlive the passes that test against it.
    for (const std::string& name : tree->exports())
        if (name == names::depth) wanted.unwantedExports.push_back(name);
    shadowSize = 1;
    shadowLights = 0;
    for (const passes::SettingInfo& info : tree->settings()) {
        const auto given = wanted.settings.find(info.name);
        const std::uint32_t number = given != wanted.settings.end() ? given->second.number : info.defaultValue.number;
        if (info.name == names::shadowSize) shadowSize = number;
        if (info.name == names::hostDepth && settings.view && given == wanted.settings.end()) {
            const bool reversed = settings.view->depth == passes::DepthConvention::Reversed;
            wanted.settings[info.name] = {passes::SettingValue::Type::Enum, reversed ? 0U : 1U,
                                          reversed ? "reversed" : "conventional"};
        }
        if (info.name == names::shadowLights) {
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
    if (!same()) {
        auto result = graph.build(*tree, wanted);
        if (!result) return tl::unexpected(result.error());
        host = std::move(wanted);
        built = true;
        ++graphBuilds;
    }
    inputs.emplace(scene, settings);
    inputs->shadowSize = shadowSize;
    inputs->shadowLights = shadowLights;
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

Result<void> Renderer::State::prepareObjects(Scene& scene, const FrameViews& frameViews, rhi::CommandEncoder& encoder) {
    objects.resize(scene.objects.size());
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        Object& object = scene.objects[i];
        ObjectState& state = objects[i];
        auto geometry = uploads.geometry(object.geometry);
        if (!geometry) return tl::unexpected(geometry.error());
        state.geometry = *geometry;
        const Strands* strands = strandsOf(object.geometry);
        if (strands != nullptr && !(*geometry)->empty()) {
            const StrandBuffers& rest = (*geometry)->strands->buffers;
            if (auto moved = state.moving.update(device, encoder, object.name, object.moved, *strands, rest); !moved)
                return moved;
        }
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
        if (strands != nullptr) {
            const StrandBuffers& now = state.moving.buffers();
            block.center = glm::vec4(strands->center, std::abs(glm::determinant(glm::mat3(object.transform))));
            block.strides = {now.startStride, now.widthStride, now.colorStride, 0};
        }
        auto written = device.queue().writeBuffer(state.block, 0, std::as_bytes(std::span(&block, 1)));
        if (!written) return tl::unexpected(written.error());
        auto sorted = sortObject(object, state, glm::vec3(frameViews.main.viewForward));
        if (!sorted) return sorted;
    }
    uploads.collect();
    return {};
}

// Alpha blending needs an order; nothing else does.
Result<void> Renderer::State::sortObject(const Object& from, ObjectState& state, const glm::vec3& forward) {
    const bool blends =
        state.shown && std::any_of(state.shown->shaders.begin(), state.shown->shaders.end(), [](const auto& s) {
            return s.enabled && s.state.blend == materials::Blend::Premultiplied;
        });
    if (!blends || state.geometry->empty()) {
        state.sorted = {};
        return {};
    }
    std::span<const std::byte> bytes;
    rhi::BufferUsage usage = rhi::BufferUsage::Index;
    if (const Strands* strands = strandsOf(from.geometry)) {
        const bool moved = !from.moved.buffer && !from.moved.points.empty();
        const auto segments =
            order.segments(*strands, moved ? from.moved.points : strands->points, from.transform, forward);
        state.sortedCount = static_cast<std::uint32_t>(segments.size());
        bytes = std::as_bytes(segments);
        usage = rhi::BufferUsage::Storage;
    } else {
        bytes = std::as_bytes(order.triangles(*meshOf(from.geometry), from.transform, forward));
    }
    usage = usage | rhi::BufferUsage::CopyDst;
    if (!state.sorted || state.sorted.size() != bytes.size() || state.sorted.usage() != usage) {
        auto buffer = device.createBuffer({.label = from.name + " sorted", .size = bytes.size(), .usage = usage});
        if (!buffer) return tl::unexpected(buffer.error());
        state.sorted = *buffer;
    }
    return writeBuffer(device, state.sorted, bytes);
}

}  // namespace pelage::hair
