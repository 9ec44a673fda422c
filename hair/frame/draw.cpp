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

Result<rhi::BindGroup> Renderer::State::objectGroup(ObjectState& object, const rhi::BindGroupLayout& layout,
                                                         const rhi::Buffer& pieces) {
    const bool strands = object.geometry->strands.has_value();
    const StrandBuffers& b = object.moving.buffers();
    const ObjectState::Group wanted = strands ? ObjectState::Group{layout.get(), b.points, b.starts, pieces, {}}
                                              : ObjectState::Group{layout.get(), {}, {}, {}, {}};
    for (const ObjectState::Group& each : object.groups) {
        if (each.layout == wanted.layout && each.points == wanted.points && each.starts == wanted.starts &&
            each.pieces == wanted.pieces)
            return each.group;
    }
    rhi::BindGroupDescriptor descriptor = {.label = "object", .layout = layout};
    const rhi::Buffer buffers[] = {object.block, b.points, b.starts, b.first, b.widths, b.colors, b.ids, pieces};
    for (const rhi::BindGroupLayoutEntry& entry : layout.entries()) {
        // What else a host's shader declares in this set is told by the error of createBindGroup().
        if (entry.binding >= std::size(buffers) || !buffers[entry.binding]) continue;
        const std::uint64_t size = entry.binding == 0 ? sizeof(ObjectBlock) : 0;
        descriptor.entries.push_back({entry.binding, rhi::BufferBinding{buffers[entry.binding], 0, size}});
    }
    auto made = device.createBindGroup(descriptor);
    if (!made) return made;
    // Two sets of points times two sets of pieces, for each layout; buffers that are gone make room.
    constexpr std::size_t most = 32;
    if (object.groups.size() >= most) object.groups.erase(object.groups.begin());
    object.groups.push_back(wanted);
    object.groups.back().group = *made;
    return made;
}

Result<rhi::BindGroup> Renderer::State::materialGroup(std::size_t index, const Look& look, std::uint32_t shader,
                                                       const rhi::BindGroupLayout& layout) {
    const ObjectState& object = objects[index];
    const materials::ShaderUse& use = look.shaders[shader].use;
    return bindings.bindGroup({index, layout.get(), shader}, layout, look.type, *object.material, *object.geometry,
                              uploads, [&]() -> MaterialBindings::Modules {
                                  // Both were made when the pipeline was asked for.
                                  const auto vertex = modules.find(look.vertexFile(use)), fragment = modules.find(use.fragment);
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
        if (object.geometry->empty() || !object.shown) continue;
        const GpuGeometry& geometry = *object.geometry;
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
            const bool sorted = shader.state.blend == materials::Blend::Premultiplied && object.sorted;
            if (const auto layout = made.bindGroupLayout(3)) {
                const rhi::Buffer& pieces = !geometry.strands || sorted ? object.sorted : geometry.strands->pieces;
                auto group = objectGroup(object, layout, pieces);
                if (!group) return tl::unexpected(group.error());
                encoder.setBindGroup(3, *group);
            }
            if (geometry.strands) {
                // Two vertices at each place of the curve, both ends of the piece included.
                const std::uint32_t segments = sorted ? 1 : geometry.strands->pieceSegments;
                encoder.draw(2 * (segments * object.shown->subdivisions + 1),
                             sorted ? object.sortedCount : geometry.strands->pieceCount);
                frame.segments += geometry.strands->segments;
            } else {
                encoder.setVertexBuffer(0, geometry.vertices);
                encoder.setIndexBuffer(sorted ? object.sorted : geometry.indices, rhi::IndexFormat::Uint32);
                encoder.drawIndexed(geometry.indexCount);
                frame.triangles += geometry.indexCount / 3;
            }
            ++context.draws;
            encoder.popDebugGroup();
        }
    }
    return {};
}

}  // namespace pelage::hair
