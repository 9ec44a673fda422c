// SPDX-License-Identifier: MIT
// Draw lists to draws and dispatches: the bind groups of the four sets of a material in a pass, then the call.
#include "state.hpp"

#include <functional>

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

Result<rhi::BindGroup> Renderer::State::materialGroup(std::size_t index, const ObjectPipelines& set,
                                                      std::uint32_t shader, const rhi::BindGroupLayout& layout) {
    const ObjectState& object = objects[index];
    const materials::ShaderUse& use = set.shaders[shader].use;
    // All were made when the pipeline was asked for.
    const auto made = [&](const std::string& file) {
        const auto found = modules.find(file);
        return found == modules.end() ? rhi::ShaderModule() : found->second;
    };
    const auto modulesOf = [&]() -> MaterialBindings::Modules {
        return {made(set.vertexFile(use)), made(use.fragment), made(use.compute)};
    };
    // By reference: the function object itself would be allocated anew for each draw.
    return bindings.bindGroup({index, layout.get(), shader}, layout, set.type, *object.material, *object.geometry,
                              uploads, std::cref(modulesOf));
}

namespace {

/// Whether a shader of the object draws back to front; then ObjectState::sorted is what is drawn.
bool isSorted(const ObjectState& object, std::uint32_t shader) {
    return object.sorted && object.shown->shaders[shader].state.blend == materials::Blend::Premultiplied;
}

}  // namespace

Result<ObjectGroups> Renderer::State::groupsOf(std::size_t index, std::uint32_t shader, std::size_t view,
                                               const passes::PassContext& context,
                                               const std::array<rhi::BindGroupLayout, 4>& layouts) {
    ObjectState& object = objects[index];
    ObjectGroups groups;
    if (layouts[0]) {
        auto made = groupFor(views[view].groups, layouts[0], views[view].block, sizeof(FrameBlock), "frame");
        if (!made) return tl::unexpected(made.error());
        groups[0] = *made;
    }
    if (layouts[1]) {
        auto made = context.bindGroup(layouts[1]);
        if (!made) return tl::unexpected(made.error());
        groups[1] = *made;
    }
    if (layouts[2]) {
        auto made = materialGroup(index, *object.shown, shader, layouts[2]);
        if (!made) return tl::unexpected(made.error());
        groups[2] = *made;
    }
    if (layouts[3]) {
        const GpuGeometry& geometry = *object.geometry;
        const rhi::Buffer& pieces =
            !geometry.strands || isSorted(object, shader) ? object.sorted : geometry.strands->pieces;
        auto made = objectGroup(object, layouts[3], pieces);
        if (!made) return tl::unexpected(made.error());
        groups[3] = *made;
    }
    return groups;
}

namespace {

template <class Encoder>
void setGroups(Encoder& encoder, const ObjectGroups& groups) {
    for (std::uint32_t set = 0; set < groups.size(); ++set) {
        if (groups[set]) encoder.setBindGroup(set, groups[set]);
    }
}

/// Records one raster pass. Small and trivially copied, so that a PassRecorder keeps it without memory of its own.
struct DrawList {
    Renderer::State* state;
    std::uint32_t pass;  // in the plan

    Result<void> operator()(passes::PassContext& context) const {
        const bool shadow = context.pass.view == "shadow";
        const std::size_t view = shadow ? 1 + context.viewIndex : 0;
        if (view >= state->views.size()) return {};
        rhi::RenderPassEncoder& encoder = *context.raster;
        for (std::size_t i = 0; i < state->recorded->objects.size(); ++i) {
            const ObjectState& object = state->objects[i];
            const GpuGeometry& geometry = *object.geometry;
            if (geometry.empty() || !object.shown) continue;
            for (const ObjectPipelines::Use& wanted : object.shown->uses) {
                if (wanted.pass != pass || wanted.pipeline->state() != Pipelines::Entry::State::Ready) continue;
                const rhi::RenderPipeline& made = wanted.pipeline->render();
                auto groups = state->groupsOf(i, wanted.shader, view, context, layoutsOf(made));
                if (!groups) return tl::unexpected(groups.error());
                encoder.pushDebugGroup(state->recorded->objects[i].name);
                encoder.setPipeline(made);
                setGroups(encoder, *groups);
                const bool sorted = isSorted(object, wanted.shader);
                if (geometry.strands) {
                    // Two vertices at each place of the curve, both ends of the piece included.
                    const std::uint32_t segments = sorted ? 1 : geometry.strands->pieceSegments;
                    encoder.draw(2 * (segments * object.shown->subdivisions + 1),
                                 sorted ? object.sortedCount : geometry.strands->pieceCount);
                    state->frame.segments += geometry.strands->segments;
                } else {
                    encoder.setVertexBuffer(0, geometry.vertices);
                    encoder.setIndexBuffer(sorted ? object.sorted : geometry.indices, rhi::IndexFormat::Uint32);
                    encoder.drawIndexed(geometry.indexCount);
                    state->frame.triangles += geometry.indexCount / 3;
                }
                ++context.draws;
                encoder.popDebugGroup();
            }
        }
        return {};
    }
};

/// Records one compute pass of a host's class.
struct DispatchList {
    Renderer::State* state;
    std::uint32_t pass;  // in the plan
    std::shared_ptr<const MaterialPass> host;

    Result<void> operator()(passes::PassContext& context) const {
        const Scene& scene = *state->recorded;
        for (std::size_t i = 0; i < scene.objects.size(); ++i) {
            const ObjectState& object = state->objects[i];
            if (!object.shown) continue;
            for (const ObjectPipelines::Use& wanted : object.shown->uses) {
                if (wanted.pass != pass || wanted.pipeline->state() != Pipelines::Entry::State::Ready) continue;
                const rhi::ComputePipeline& made = wanted.pipeline->compute();
                auto groups = state->groupsOf(i, wanted.shader, 0, context, layoutsOf(made));
                if (!groups) return tl::unexpected(groups.error());
                context.compute->pushDebugGroup(scene.objects[i].name);
                context.compute->setPipeline(made);
                setGroups(*context.compute, *groups);
                auto done = host->dispatch({i, scene.objects[i], made, context, *context.compute});
                if (!done) return done;
                context.compute->popDebugGroup();
            }
        }
        return {};
    }
};

}  // namespace

passes::PassClass Renderer::State::dispatchClass(MaterialPass pass) {
    passes::PassClass made{.info = pass.info};
    made.info.kind = passes::PassKind::Compute;
    made.create = [this, host = std::make_shared<const MaterialPass>(std::move(pass))](
                      const passes::PassSetup& setup) -> Result<passes::PassRecorder> {
        setup.constants();
        const auto index = static_cast<std::uint32_t>(&setup.pass - setup.plan.passes.data());
        return passes::PassRecorder(DispatchList{this, index, host});
    };
    return made;
}

passes::PassClass Renderer::State::drawListClass() {
    return {.info = {.name = std::string(passes::drawListClass)},
            .create = [this](const passes::PassSetup& setup) -> Result<passes::PassRecorder> {
                // They go into the pipelines of the materials (describePipeline).
                setup.constants();
                const auto pass = static_cast<std::uint32_t>(&setup.pass - setup.plan.passes.data());
                return passes::PassRecorder(DrawList{this, pass});
            }};
}

}  // namespace pelage::hair
