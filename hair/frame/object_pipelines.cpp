// SPDX-License-Identifier: MIT
// Materials to pipelines: what an object needs for every pass of the plan, asked for when the material or the plan has
// changed and not otherwise.
#include "material/check.hpp"
#include "state.hpp"

#include <algorithm>
#include <cstddef>

namespace pelage::hair {

namespace {

// The vertex buffer of a mesh: struct Vertex.
const rhi::VertexBufferLayout vertexLayout = {
    .arrayStride = sizeof(Vertex),
    .attributes = {{rhi::VertexFormat::Float32x3, offsetof(Vertex, position), 0},
                   {rhi::VertexFormat::Float32x3, offsetof(Vertex, normal), 1},
                   {rhi::VertexFormat::Float32x3, offsetof(Vertex, tangent), 2},
                   {rhi::VertexFormat::Float32x2, offsetof(Vertex, uv), 3},
                   {rhi::VertexFormat::Float32x2, offsetof(Vertex, strandId), 4}}};

std::uint32_t subdivisionsOf(const GpuGeometry& geometry) {
    const Strands* strands = strandsOf(geometry.source);
    return strands != nullptr ? std::clamp(strands->subdivisions, 1U, kMaxSubdivisions) : 1U;
}

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

bool sameStates(const materials::CompiledMaterial::Shader& a, const materials::CompiledMaterial::Shader& b) {
    if (a.enabled != b.enabled || !(a.state == b.state) || a.constants.size() != b.constants.size()) return false;
    for (std::size_t i = 0; i < a.constants.size(); ++i) {
        if (a.constants[i].value != b.constants[i].value) return false;
    }
    return true;
}

}  // namespace

const std::string& ObjectPipelines::vertexFile(const materials::ShaderUse& use) const {
    static const std::string ofMeshes = "hair.vert", ofStrands = "strands.vert";
    return strands && use.vertex == ofMeshes ? ofStrands : use.vertex;
}

bool ObjectPipelines::isReady() const {
    return std::all_of(uses.begin(), uses.end(),
                       [](const Use& use) { return use.pipeline->state() == Pipelines::Entry::State::Ready; });
}

const Diagnostics* ObjectPipelines::failure() const {
    for (const Use& use : uses) {
        if (use.pipeline->state() == Pipelines::Entry::State::Failed) return &use.pipeline->error();
    }
    return nullptr;
}

bool Renderer::State::isFor(const ObjectPipelines& set, const ObjectState& object,
                            const materials::CompiledMaterial& material) const {
    return set.lights == lights && set.environmentOff == environmentOff && set.isEmpty == object.geometry->empty() &&
           set.subdivisions == subdivisionsOf(*object.geometry) &&
           std::equal(set.shaders.begin(), set.shaders.end(), material.shaders.begin(), material.shaders.end(),
                      sameStates);
}

Result<void> Renderer::State::updatePipelines(ObjectState& object, const Object& from) {
    if (auto checked = checkType(from.material.sharedType()); !checked) return checked;
    const bool strands = object.geometry->strands.has_value();
    // What was drawn with another type or topology cannot be bound to this one's values.
    for (std::optional<ObjectPipelines>* set : {&object.shown, &object.next}) {
        if (*set && ((*set)->type != from.material.sharedType() || (*set)->strands != strands)) set->reset();
    }
    const std::optional<ObjectPipelines>& newest = object.next ? object.next : object.shown;
    if (!newest || !isFor(*newest, object, *object.material)) {
        object.next = ObjectPipelines{.type = from.material.sharedType(),
                                      .strands = strands,
                                      .isEmpty = object.geometry->empty(),
                                      .subdivisions = subdivisionsOf(*object.geometry),
                                      .environmentOff = environmentOff,
                                      .lights = lights,
                                      .shaders = object.material->shaders};
    }
    for (std::optional<ObjectPipelines>* set : {&object.shown, &object.next}) {
        if (!*set || (*set)->graph == graphBuilds) continue;
        if (auto asked = requestPipelines(**set, nameOf(object.geometry->source)); !asked)
            return tl::unexpected(asked.error());
    }
    if (!object.next) return {};
    if (const Diagnostics* failure = object.next->failure()) {
        Diagnostics problem = *failure;
        if (mode == PipelineMode::Synchronous || !object.shown) {
            object.next.reset();
            return tl::unexpected(std::move(problem));
        }
        // The last good pipelines stay; the fault is noted once.
        if (!object.next->failureSaid) frame.notes.append(problem);
        object.next->failureSaid = true;
    } else if (object.next->isReady()) {
        object.shown = std::move(object.next);
        object.next.reset();
    }
    return {};
}

Result<void> Renderer::State::checkType(const std::shared_ptr<const materials::MaterialType>& type) {
    if (std::find(checkedTypes.begin(), checkedTypes.end(), type) != checkedTypes.end()) return {};
    Diagnostics found = type->unknownDrawLists(tree->drawLists());
    found.append(checkShaders(*type, [&](const std::string& file) {
        auto made = module(file);
        return made ? *made : rhi::ShaderModule();
    }));
    for (const Diagnostic& each : found.items()) {
        if (each.severity == Severity::Error) return tl::unexpected(each);
    }
    frame.notes.append(found);
    checkedTypes.push_back(type);
    return {};
}

Result<void> Renderer::State::requestPipelines(ObjectPipelines& set, const std::string& label) {
    set.uses.clear();
    set.failureSaid = false;
    for (std::uint32_t at = 0; at < graph.plan().passes.size(); ++at) {
        const passes::PlanPass& pass = graph.plan().passes[at];
        if (pass.drawList.empty() || set.isEmpty) continue;
        for (std::uint32_t i = 0; i < set.shaders.size(); ++i) {
            const materials::CompiledMaterial::Shader& shader = set.shaders[i];
            const bool dispatched = pass.kind == passes::PassKind::Compute;
            if (!shader.enabled || shader.use.drawList != pass.drawList || shader.use.isCompute() != dispatched)
                continue;
            const auto request = [&](auto descriptor) -> Result<void> {
                if (!descriptor) return tl::unexpected(descriptor.error());
                descriptor->label = label + " " + shader.use.name;
                set.uses.push_back({at, i, pipelines.request(std::move(*descriptor))});
                return {};
            };
            auto asked =
                dispatched ? request(describeCompute(set, shader, pass)) : request(describePipeline(set, shader, pass));
            if (!asked) return asked;
        }
    }
    set.graph = graphBuilds;
    return {};
}

std::vector<rhi::ConstantEntry> Renderer::State::constantsOf(const ObjectPipelines& set,
                                                             const materials::CompiledMaterial::Shader& shader,
                                                             const passes::PlanPass& pass,
                                                             std::uint32_t samples) const {
    std::vector<rhi::ConstantEntry> constants = shader.constants;
    for (rhi::ConstantEntry& constant : constants) {
        if (constant.name == "shadowMode" && set.lights.shadows == 0) constant.value = 0;
        if (constant.name == "envOn" && set.environmentOff) constant.value = 0;
        // A strand thinner than a pixel has no edge to test: its coverage is stochastic in every cut-out mode.
        const bool isCutOut = constant.value == 1 || constant.value == 2;
        if (constant.name == "alphaMode" && set.strands && isCutOut) constant.value = 3;
    }
    constants.push_back({"isStrand", set.strands ? 1.0 : 0.0});
    constants.push_back({"sampleCount", static_cast<double>(samples)});
    constants.push_back({"subdivisions", static_cast<double>(set.subdivisions)});
    constants.push_back({"isLightView", pass.view == "shadow" ? 1.0 : 0.0});
    for (rhi::ConstantEntry& constant : set.lights.constants()) constants.push_back(std::move(constant));
    // What the pass says goes before what the material says.
    for (const auto& [name, value] : pass.constants) {
        std::erase_if(constants, [&](const rhi::ConstantEntry& each) { return each.name == name; });
        constants.push_back({name, value});
    }
    return constants;
}

Result<rhi::ComputePipelineDescriptor> Renderer::State::describeCompute(
    const ObjectPipelines& set, const materials::CompiledMaterial::Shader& shader, const passes::PlanPass& pass) {
    auto compute = module(shader.use.compute);
    if (!compute) return tl::unexpected(compute.error());
    return rhi::ComputePipelineDescriptor{
        .compute = {*compute, declaredConstants(*compute, constantsOf(set, shader, pass, 1))}};
}

Result<rhi::RenderPipelineDescriptor> Renderer::State::describePipeline(
    const ObjectPipelines& set, const materials::CompiledMaterial::Shader& shader, const passes::PlanPass& pass) {
    const passes::Targets targets = passes::targetsOf(graph.plan(), pass);
    const std::vector<rhi::ConstantEntry> constants = constantsOf(set, shader, pass, targets.samples);
    materials::RenderState state = shader.state;
    if (set.strands) state.alphaToCoverage = false;

    auto vertex = module(set.vertexFile(shader.use));
    if (!vertex) return tl::unexpected(vertex.error());
    rhi::RenderPipelineDescriptor descriptor;
    descriptor.vertex = {*vertex, declaredConstants(*vertex, constants)};
    if (!set.strands) descriptor.vertexBuffers = {vertexLayout};
    // Ribbons turn towards the camera: which side of one is seen says nothing.
    descriptor.primitive = {
        .topology = set.strands ? rhi::PrimitiveTopology::TriangleStrip : rhi::PrimitiveTopology::TriangleList,
        .cullMode = set.strands ? rhi::CullMode::None : state.cull};
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
    return descriptor;
}

}  // namespace pelage::hair
