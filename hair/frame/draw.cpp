// SPDX-License-Identifier: MIT
// Draw lists to draws: the bind groups of the four sets of a material in a pass, the draw.
#include "state.hpp"

namespace pelage::hair {

Result<rhi::BindGroup> Renderer::State::groupFor(std::map<const void*, rhi::BindGroup>& cache,
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

Result<rhi::BindGroup> Renderer::State::materialGroup(std::size_t index, const Look& look, std::uint32_t shader,
                                                       const rhi::BindGroupLayout& layout) {
    const ObjectState& object = objects[index];
    const materials::ShaderUse& use = look.shaders[shader].use;
    return bindings.bindGroup({index, layout.get(), shader}, layout, look.type, *object.material, *object.geometry,
                              uploads, [&]() -> MaterialBindings::Modules {
                                  // Both were made when the pipeline was asked for.
                                  const auto vertex = modules.find(use.vertex), fragment = modules.find(use.fragment);
                                  return {vertex == modules.end() ? rhi::ShaderModule() : vertex->second,
                                          fragment == modules.end() ? rhi::ShaderModule() : fragment->second};
                              });
}

Result<void> Renderer::State::draw(Scene& scene, passes::RasterContext& context) {
    const bool shadow = context.pass.view == "shadow";
    const std::size_t viewIndex = shadow ? 1 + context.viewIndex : 0;
    if (viewIndex >= views.size()) return {};
    rhi::RenderPassEncoder& encoder = context.encoder;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        ObjectState& object = objects[i];
        const Geometry& geometry = *object.geometry->source;
        if (geometry.indices.empty()) continue;
        if (!object.shown) continue;
        for (const Look::Draw& wanted : object.shown->draws) {
            if (wanted.pass != context.pass.name || wanted.pipeline->state() != Pipelines::Entry::State::Ready)
                continue;
            const materials::CompiledMaterial::Shader& shader = object.shown->shaders[wanted.shader];
            const rhi::RenderPipeline& made = wanted.pipeline->pipeline();
            encoder.pushDebugGroup(scene.objects[i].name);
            encoder.setPipeline(made);
            if (const auto layout = made.bindGroupLayout(0)) {
                auto group =
                    groupFor(views[viewIndex].groups, layout, views[viewIndex].block, sizeof(FrameBlock), "frame");
                if (!group) return tl::unexpected(group.error());
                encoder.setBindGroup(0, *group);
            }
            if (const auto layout = made.bindGroupLayout(1)) {
                auto group = context.bindGroup(layout);
                if (!group) return tl::unexpected(group.error());
                encoder.setBindGroup(1, *group);
            }
            if (const auto layout = made.bindGroupLayout(2)) {
                auto group = materialGroup(i, *object.shown, wanted.shader, layout);
                if (!group) {
                    return tl::unexpected(Diagnostic{
                        ErrorKind::Validation, rhi::ErrorCode::BindingMismatch, toString(group.error()), {}});
                }
                encoder.setBindGroup(2, *group);
            }
            if (const auto layout = made.bindGroupLayout(3)) {
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
