// SPDX-License-Identifier: MIT
// Draw lists to draws: the pipeline of a material in a pass, the bind groups of its four sets, the draw.
#include "renderer_state.hpp"

#include <algorithm>
#include <cstddef>

namespace pelage::hair {

namespace {

// The vertex buffer of every drawable: struct Vertex.
const rhi::VertexBufferLayout vertexLayout = {
    .arrayStride = sizeof(Vertex),
    .attributes = {{rhi::VertexFormat::Float32x3, offsetof(Vertex, position), 0},
                   {rhi::VertexFormat::Float32x3, offsetof(Vertex, normal), 1},
                   {rhi::VertexFormat::Float32x3, offsetof(Vertex, tangent), 2},
                   {rhi::VertexFormat::Float32x2, offsetof(Vertex, uv), 3},
                   {rhi::VertexFormat::Float32x3, offsetof(Vertex, strandId), 4}}};

rhi::CompareFunction compareFor(materials::DepthTest test) {
    switch (test) {  // reversed depth: nearer is greater
        case materials::DepthTest::Never:
            return rhi::CompareFunction::Never;
        case materials::DepthTest::Nearer:
            return rhi::CompareFunction::Greater;
        case materials::DepthTest::NearerEqual:
            return rhi::CompareFunction::GreaterEqual;
        case materials::DepthTest::Equal:
            return rhi::CompareFunction::Equal;
        case materials::DepthTest::Always:
            return rhi::CompareFunction::Always;
    }
    return rhi::CompareFunction::Always;
}

std::optional<rhi::BlendState> blendFor(materials::Blend blend) {
    using enum rhi::BlendFactor;
    switch (blend) {
        case materials::Blend::Off:
            return {};
        case materials::Blend::Premultiplied:
            return rhi::BlendState{{rhi::BlendOperation::Add, One, OneMinusSrcAlpha},
                                   {rhi::BlendOperation::Add, One, OneMinusSrcAlpha}};
        case materials::Blend::Additive:
            return rhi::BlendState{{rhi::BlendOperation::Add, One, One}, {rhi::BlendOperation::Add, One, One}};
    }
    return {};
}

// Everything of a material and a pass that a pipeline depends on. By content: another material in the same place of the
// scene must not find this one's pipelines.
std::string pipelineKey(const materials::CompiledMaterial::Shader& shader, const passes::Targets& targets,
                        bool strands) {
    std::string key = shader.use.vertex + "|" + shader.use.fragment + (strands ? "|lines" : "|triangles");
    const auto add = [&](auto value) { key += "|" + std::to_string(value); };
    for (const rhi::ConstantEntry& constant : shader.constants) add(constant.value);
    add(static_cast<int>(shader.state.cull));
    add(static_cast<int>(shader.state.depthTest));
    add(static_cast<int>(shader.state.blend));
    add(shader.state.depthWrite ? 1 : 0);
    add(shader.state.alphaToCoverage ? 1 : 0);
    add(targets.samples);
    add(static_cast<int>(targets.depth));
    add(targets.depthReadOnly ? 1 : 0);
    for (const rhi::TextureFormat format : targets.colors) add(static_cast<int>(format));
    return key;
}

}  // namespace

rhi::Result<rhi::RenderPipeline> Renderer::State::pipeline(ObjectState& object,
                                                           const materials::CompiledMaterial::Shader& shader,
                                                           const passes::Targets& targets) {
    const bool strands = object.geometry->source->topology == Topology::Lines;
    const std::string key =
        pipelineKey(shader, targets, strands) + (shadowsOff ? "s" : "") + (environmentOff ? "e" : "");
    if (const auto found = object.pipelines.find(key); found != object.pipelines.end()) return found->second;

    std::vector<rhi::ConstantEntry> constants = shader.constants;
    materials::RenderState state = shader.state;
    for (rhi::ConstantEntry& constant : constants) {
        if (constant.name == "shadowMode" && shadowsOff) constant.value = 0;
        if (constant.name == "envOn" && environmentOff) constant.value = 0;
        // A strand thinner than a pixel has no edge to test: its coverage is stochastic in every cut-out mode.
        if (constant.name == "alphaMode" && strands && (constant.value == 1 || constant.value == 2)) constant.value = 3;
    }
    if (strands) state.alphaToCoverage = false;
    constants.push_back({"isStrand", strands ? 1.0 : 0.0});
    constants.push_back({"sampleCount", static_cast<double>(targets.samples)});

    auto vertex = module(shader.use.vertex);
    if (!vertex) return tl::unexpected(vertex.error());
    rhi::RenderPipelineDescriptor descriptor;
    descriptor.label = object.geometry->source->name + " " + shader.use.name;
    descriptor.vertex = {*vertex, declaredConstants(*vertex, constants)};
    descriptor.vertexBuffers = {vertexLayout};
    descriptor.primitive = {
        .topology = strands ? rhi::PrimitiveTopology::LineList : rhi::PrimitiveTopology::TriangleList,
        .cullMode = state.cull};
    if (targets.depth != rhi::TextureFormat::Undefined) {
        descriptor.depthStencil = {.format = targets.depth,
                                   .depthWriteEnabled = state.depthWrite && !targets.depthReadOnly,
                                   .depthCompare = compareFor(state.depthTest)};
    }
    descriptor.multisample = {.count = targets.samples,
                              .alphaToCoverageEnabled = state.alphaToCoverage && targets.samples > 1};
    if (!shader.use.fragment.empty()) {
        auto fragment = module(shader.use.fragment);
        if (!fragment) return tl::unexpected(fragment.error());
        descriptor.fragment = {*fragment, declaredConstants(*fragment, constants)};
    }
    for (const rhi::TextureFormat format : targets.colors) {
        descriptor.targets.push_back({.format = format, .blend = blendFor(state.blend)});
    }
    auto made = device.createRenderPipeline(descriptor);
    if (made) object.pipelines.emplace(key, *made);
    return made;
}

rhi::Result<rhi::BindGroup> Renderer::State::groupFor(std::map<const void*, rhi::BindGroup>& cache,
                                                      const rhi::BindGroupLayout& layout, const rhi::Buffer& buffer,
                                                      std::uint64_t size, const char* label) {
    rhi::BindGroup& group = cache[layout.get()];
    if (group) return group;
    auto made = device.createBindGroup(
        {.label = label, .layout = layout, .entries = {{0, rhi::BufferBinding{buffer, 0, size}}}});
    if (!made) return made;
    group = *made;
    return group;
}

rhi::Result<void> Renderer::State::draw(Scene& scene, passes::RasterContext& context) {
    const bool shadow = context.pass.view == "shadow";
    const std::size_t viewIndex = shadow ? 1 + context.viewIndex : 0;
    if (viewIndex >= views.size()) return {};
    rhi::RenderPassEncoder& encoder = context.encoder;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        ObjectState& object = objects[i];
        const Geometry& geometry = *object.geometry->source;
        if (geometry.indices.empty()) continue;
        for (const materials::CompiledMaterial::Shader& shader : object.material->shaders) {
            if (!shader.enabled || shader.use.drawList != context.pass.drawList) continue;
            auto made = pipeline(object, shader, context.targets);
            if (!made) return tl::unexpected(made.error());
            encoder.pushDebugGroup(scene.objects[i].name);
            encoder.setPipeline(*made);
            if (const auto layout = made->bindGroupLayout(0)) {
                auto group =
                    groupFor(views[viewIndex].groups, layout, views[viewIndex].block, sizeof(FrameBlock), "frame");
                if (!group) return tl::unexpected(group.error());
                encoder.setBindGroup(0, *group);
            }
            if (const auto layout = made->bindGroupLayout(1)) {
                auto group = context.bindGroup(layout);
                if (!group) return tl::unexpected(group.error());
                encoder.setBindGroup(1, *group);
            }
            if (const auto layout = made->bindGroupLayout(2)) {
                auto fragment = module(shader.use.fragment);
                if (!fragment) return tl::unexpected(fragment.error());
                auto group = bindings.bindGroup({i, layout.get(), shader.use.fragment}, layout, *fragment,
                                                *object.material, *object.geometry, uploads);
                if (!group) {
                    return tl::unexpected(rhi::Error{
                        rhi::ErrorKind::Validation, rhi::ErrorCode::BindingMismatch, toString(group.error()), {}});
                }
                encoder.setBindGroup(2, *group);
            }
            if (const auto layout = made->bindGroupLayout(3)) {
                auto group = groupFor(object.groups, layout, object.block, sizeof(ObjectBlock), "object");
                if (!group) return tl::unexpected(group.error());
                encoder.setBindGroup(3, *group);
            }
            encoder.setVertexBuffer(0, object.geometry->vertices);
            const bool sorted = shader.state.blend == materials::Blend::Premultiplied && object.sortedIndices;
            encoder.setIndexBuffer(sorted ? object.sortedIndices : object.geometry->indices, rhi::IndexFormat::Uint32);
            if (geometry.topology == Topology::Lines) {
                encoder.setLineWidth(shadow ? object.lineWidthShadow : object.lineWidthMain);
                frame.segments += geometry.indices.size() / 2;
            } else {
                frame.triangles += geometry.indices.size() / 3;
            }
            encoder.drawIndexed(static_cast<std::uint32_t>(geometry.indices.size()));
            ++context.draws;
            encoder.popDebugGroup();
        }
    }
    return {};
}

}  // namespace pelage::hair
