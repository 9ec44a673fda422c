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

const std::string& Look::vertexFile(const materials::ShaderUse& use) const {
    static const std::string ofMeshes = "hair.vert", ofStrands = "strands.vert";
    return strands && use.vertex == ofMeshes ? ofStrands : use.vertex;
}

bool Look::isReady() const {
    return std::all_of(draws.begin(), draws.end(),
                       [](const Draw& draw) { return draw.pipeline->state() == Pipelines::Entry::State::Ready; });
}

const Diagnostic* Look::failure() const {
    for (const Draw& draw : draws) {
        if (draw.pipeline->state() == Pipelines::Entry::State::Failed) return &draw.pipeline->error();
    }
    return nullptr;
}

// By content, not by the material's versions: another material in the same place of the scene starts counting anew.
bool Renderer::State::looksLike(const Look& look, const ObjectState& object,
                                const materials::CompiledMaterial& material) const {
    return look.shadowsOff == shadowsOff && look.environmentOff == environmentOff &&
           look.isEmpty == object.geometry->empty() && look.subdivisions == subdivisionsOf(*object.geometry) &&
           std::equal(look.shaders.begin(), look.shaders.end(), material.shaders.begin(), material.shaders.end(),
                      sameStates);
}

Result<void> Renderer::State::updateLook(ObjectState& object, const Object& from) {
    if (auto checked = checkType(from.material.sharedType()); !checked) return checked;
    const bool strands = object.geometry->strands.has_value();
    // What was drawn with another type or topology cannot be bound to this one's values.
    for (std::optional<Look>* look : {&object.shown, &object.next}) {
        if (*look && ((*look)->type != from.material.sharedType() || (*look)->strands != strands)) look->reset();
    }
    const std::optional<Look>& newest = object.next ? object.next : object.shown;
    if (!newest || !looksLike(*newest, object, *object.material)) {
        object.next = Look{.type = from.material.sharedType(),
                           .strands = strands,
                           .isEmpty = object.geometry->empty(),
                           .subdivisions = subdivisionsOf(*object.geometry),
                           .shadowsOff = shadowsOff,
                           .environmentOff = environmentOff,
                           .shaders = object.material->shaders};
    }
    for (std::optional<Look>* look : {&object.shown, &object.next}) {
        if (!*look || (*look)->graph == graphBuilds) continue;
        if (auto asked = requestPipelines(**look, nameOf(object.geometry->source)); !asked)
            return tl::unexpected(asked.error());
    }
    if (!object.next) return {};
    if (const Diagnostic* failure = object.next->failure()) {
        Diagnostic problem = toDiagnostic(*failure);
        if (mode == PipelineMode::Synchronous || !object.shown) {
            object.next.reset();
            return tl::unexpected(std::move(problem));
        }
        // The last good one stays; it is said once.
        if (!object.next->failureSaid) frame.notes.add(std::move(problem));
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

Result<void> Renderer::State::requestPipelines(Look& look, const std::string& label) {
    look.draws.clear();
    look.failureSaid = false;
    for (const passes::PlanPass& pass : graph.plan().passes) {
        if (pass.kind != passes::PassKind::Raster || look.isEmpty) continue;
        const passes::Targets targets = passes::targetsOf(graph.plan(), pass);
        for (std::uint32_t i = 0; i < look.shaders.size(); ++i) {
            const materials::CompiledMaterial::Shader& shader = look.shaders[i];
            if (!shader.enabled || shader.use.drawList != pass.drawList) continue;
            auto descriptor = describePipeline(look, shader, targets);
            if (!descriptor) return tl::unexpected(descriptor.error());
            descriptor->label = label + " " + shader.use.name;
            look.draws.push_back({pass.name, i, pipelines.request(std::move(*descriptor))});
        }
    }
    look.graph = graphBuilds;
    return {};
}

Result<rhi::RenderPipelineDescriptor> Renderer::State::describePipeline(
    const Look& look, const materials::CompiledMaterial::Shader& shader, const passes::Targets& targets) {
    std::vector<rhi::ConstantEntry> constants = shader.constants;
    materials::RenderState state = shader.state;
    for (rhi::ConstantEntry& constant : constants) {
        if (constant.name == "shadowMode" && look.shadowsOff) constant.value = 0;
        if (constant.name == "envOn" && look.environmentOff) constant.value = 0;
        // A strand thinner than a pixel has no edge to test: its coverage is stochastic in every cut-out mode.
        const bool isCutOut = constant.value == 1 || constant.value == 2;
        if (constant.name == "alphaMode" && look.strands && isCutOut) constant.value = 3;
    }
    if (look.strands) state.alphaToCoverage = false;
    constants.push_back({"isStrand", look.strands ? 1.0 : 0.0});
    constants.push_back({"sampleCount", static_cast<double>(targets.samples)});
    constants.push_back({"subdivisions", static_cast<double>(look.subdivisions)});

    auto vertex = module(look.vertexFile(shader.use));
    if (!vertex) return tl::unexpected(vertex.error());
    rhi::RenderPipelineDescriptor descriptor;
    descriptor.vertex = {*vertex, declaredConstants(*vertex, constants)};
    if (!look.strands) descriptor.vertexBuffers = {vertexLayout};
    // Ribbons turn towards the camera: which side of one is seen says nothing.
    descriptor.primitive = {
        .topology = look.strands ? rhi::PrimitiveTopology::TriangleStrip : rhi::PrimitiveTopology::TriangleList,
        .cullMode = look.strands ? rhi::CullMode::None : state.cull};
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
