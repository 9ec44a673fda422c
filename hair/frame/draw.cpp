// SPDX-License-Identifier: MIT
// Draw lists to draws and dispatches: the bind groups of the four sets of a material in a pass, then the call.
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

Result<rhi::BindGroup> Renderer::State::materialGroup(std::size_t index, const ObjectPipelines& set,
                                                       std::uint32_t shader, const rhi::BindGroupLayout& layout) {
    const ObjectState& object = objects[index];
    const materials::ShaderUse& use = set.shaders[shader].use;
    // All were made when the pipeline was asked for.
    const auto made = [&](const std::string& file) {
        const auto found = modules.find(file);
        return found == modules.end() ? rhi::ShaderModule() : found->second;
    };
    return bindings.bindGroup({index, layout.get(), shader}, layout, set.type, *object.material, *object.geometry,
                              uploads, [&]() -> MaterialBindings::Modules {
                                  return {made(use.vertex), made(use.fragment), made(use.compute)};
                              });
}

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
        auto made = groupFor(object.groups, layouts[3], object.block, sizeof(ObjectBlock), "object");
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
            const Geometry& geometry = *object.geometry->source;
            if (geometry.indices.empty() || !object.shown) continue;
            for (const ObjectPipelines::Use& wanted : object.shown->uses) {
                if (wanted.pass != pass || wanted.pipeline->state() != Pipelines::Entry::State::Ready) continue;
                const rhi::RenderPipeline& made = wanted.pipeline->render();
                auto groups = state->groupsOf(i, wanted.shader, view, context, layoutsOf(made));
                if (!groups) return tl::unexpected(groups.error());
                encoder.pushDebugGroup(state->recorded->objects[i].name);
                encoder.setPipeline(made);
                setGroups(encoder, *groups);
                encoder.setVertexBuffer(0, object.geometry->vertices);
                const bool blends = object.shown->shaders[wanted.shader].state.blend == materials::Blend::Premultiplied;
                encoder.setIndexBuffer(blends && object.sortedIndices ? object.sortedIndices : object.geometry->indices,
                                       rhi::IndexFormat::Uint32);
                if (geometry.topology == Topology::Lines) {
                    encoder.setLineWidth(shadow ? object.lineWidthShadow : object.lineWidthMain);
                    state->frame.segments += geometry.indices.size() / 2;
                } else {
                    state->frame.triangles += geometry.indices.size() / 3;
                }
                encoder.drawIndexed(static_cast<std::uint32_t>(geometry.indices.size()));
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
