// SPDX-License-Identifier: MIT
// The glue: scene -> views, uploads and material bindings; pass tree -> graph; draw lists -> draws.
#include <pelage/hair/renderer.hpp>

#include "material_binding.hpp"
#include "sorting.hpp"
#include "uploads.hpp"
#include "views.hpp"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cstring>

namespace pelage::hair {

namespace detail {
std::span<const std::uint32_t> embeddedShader(std::string_view name);
std::span<const std::string_view> embeddedShaderNames();
}  // namespace detail

Diagnostic toDiagnostic(const rhi::Error& error) {
    Diagnostic diagnostic;
    const std::string number = std::to_string(static_cast<unsigned>(error.code));
    diagnostic.code = "R" + std::string(number.size() < 3 ? 3 - number.size() : 0, '0') + number;
    diagnostic.text = error.message;
    for (const std::string& context : error.context) diagnostic.text += " While validating " + context + ".";
    return diagnostic;
}

std::span<const std::uint32_t> Renderer::shaderCode(const std::string& file) { return detail::embeddedShader(file); }

std::vector<std::string> Renderer::shaderNames() {
    const auto names = detail::embeddedShaderNames();
    return {names.begin(), names.end()};
}

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
        case materials::DepthTest::Never: return rhi::CompareFunction::Never;
        case materials::DepthTest::Nearer: return rhi::CompareFunction::Greater;
        case materials::DepthTest::NearerEqual: return rhi::CompareFunction::GreaterEqual;
        case materials::DepthTest::Equal: return rhi::CompareFunction::Equal;
        case materials::DepthTest::Always: return rhi::CompareFunction::Always;
    }
    return rhi::CompareFunction::Always;
}

std::optional<rhi::BlendState> blendFor(materials::Blend blend) {
    using enum rhi::BlendFactor;
    switch (blend) {
        case materials::Blend::Off: return {};
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
std::string pipelineKey(const materials::CompiledMaterial::Shader& shader, const passes::Targets& targets) {
    std::string key = shader.use.vertex + "|" + shader.use.fragment;
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

struct ObjectBlock {
    glm::mat4 model = glm::mat4(1.0F), normalMatrix = glm::mat4(1.0F);
    glm::vec4 lineWidth = {};
};

// What an object keeps from frame to frame; found by its index in the scene.
struct ObjectState {
    rhi::Buffer block = {};
    std::map<const void*, rhi::BindGroup> groups = {};  // by layout
    rhi::Buffer sortedIndices = {};
    std::map<std::string, rhi::RenderPipeline> pipelines = {};
    float lineWidthMain = 1, lineWidthShadow = 1;
    const GpuGeometry* geometry = nullptr;
    const materials::CompiledMaterial* material = nullptr;
};

struct ViewState {
    rhi::Buffer block = {};
    std::map<const void*, rhi::BindGroup> groups = {};
};

}  // namespace

struct Renderer::State {
    rhi::Device device;
    std::shared_ptr<const passes::PassTree> tree;
    passes::Graph graph;
    Uploads uploads;
    MaterialBindings bindings;
    std::map<std::string, rhi::ShaderModule> modules;
    std::vector<ObjectState> objects;
    std::vector<ViewState> views;  // 0: main, then shadow layers
    rhi::Buffer displayBlock;
    passes::HostDescription host;  // of the built graph
    bool built = false;
    FrameReport frame;
    // What the scene does not require is switched off for this frame whatever the material says.
    bool shadowsOff = false, environmentOff = false;

    explicit State(rhi::Device d, rhi::Sampler sampler) : device(d), uploads(d), bindings(d, sampler) {}

    rhi::Result<rhi::ShaderModule> module(const std::string& file);
    Outcome<void> buildGraph(const Scene& scene, const FrameSettings& settings, std::uint32_t& shadowSize,
                             std::uint32_t& shadowLights);
    Outcome<void> prepareObjects(Scene& scene, const FrameViews& frameViews);
    Outcome<void> writeView(std::size_t index, const FrameBlock& block);
    rhi::Result<rhi::RenderPipeline> pipeline(ObjectState& object, const materials::CompiledMaterial::Shader& shader,
                                              const passes::Targets& targets);
    rhi::Result<rhi::BindGroup> groupFor(std::map<const void*, rhi::BindGroup>& cache, const rhi::BindGroupLayout& layout,
                                         const rhi::Buffer& buffer, std::uint64_t size, const char* label);
    rhi::Result<void> draw(Scene& scene, passes::RasterContext& context);
};

rhi::Result<rhi::ShaderModule> Renderer::State::module(const std::string& file) {
    if (const auto found = modules.find(file); found != modules.end()) return found->second;
    const auto code = detail::embeddedShader(file);
    if (code.empty()) {
        std::string known;
        for (const std::string_view name : detail::embeddedShaderNames()) known += (known.empty() ? "" : ", ") + std::string(name);
        return tl::unexpected(rhi::Error{rhi::ErrorKind::Validation, rhi::ErrorCode::ShaderInvalid,
                                         "There is no shader \"" + file + "\"; this build has " + known + ".", {}});
    }
    auto made = device.createShaderModule({.label = file, .code = {code.begin(), code.end()}});
    if (made) modules.emplace(file, *made);
    return made;
}

Outcome<Renderer> Renderer::create(Descriptor descriptor) {
    if (!descriptor.device || !descriptor.tree) {
        return tl::unexpected(Diagnostic{.code = "H100", .text = "a renderer needs a device and a pass tree",
                                         .hint = "fill Renderer::Descriptor::device and ::tree"});
    }
    auto sampler = descriptor.device.createSampler({.label = "material",
                                                    .addressModeU = rhi::AddressMode::Repeat,
                                                    .addressModeV = rhi::AddressMode::Repeat,
                                                    .magFilter = rhi::FilterMode::Linear,
                                                    .minFilter = rhi::FilterMode::Linear,
                                                    .mipmapFilter = rhi::FilterMode::Linear});
    if (!sampler) return tl::unexpected(toDiagnostic(sampler.error()));
    Renderer renderer;
    renderer.state_ = std::make_shared<State>(descriptor.device, *sampler);
    State& state = *renderer.state_;
    state.tree = descriptor.tree;
    State* raw = renderer.state_.get();
    state.graph = passes::Graph({.device = descriptor.device,
                                 .shaders = [raw](const std::string& file) { return raw->module(file); },
                                 .measure = descriptor.measure});
    auto block = descriptor.device.createBuffer({.label = "display constants",
                                                 .size = 16,
                                                 .usage = rhi::BufferUsage::Uniform | rhi::BufferUsage::CopyDst});
    if (!block) return tl::unexpected(toDiagnostic(block.error()));
    state.displayBlock = *block;
    return renderer;
}

Outcome<void> Renderer::setTree(std::shared_ptr<const passes::PassTree> tree) {
    State& state = *state_;
    if (state.built) {
        auto built = state.graph.build(*tree, state.host);
        if (!built) return tl::unexpected(built.error().items().front());
    }
    state.tree = std::move(tree);
    return {};
}

Outcome<void> Renderer::State::buildGraph(const Scene& scene, const FrameSettings& settings, std::uint32_t& shadowSize,
                                          std::uint32_t& shadowLights) {
    passes::HostDescription wanted;
    wanted.extent = {settings.width, settings.height, 1};
    wanted.depth = passes::DepthConvention::Reversed;
    wanted.settings = settings.settings;
    wanted.imports["EnvIrradiance"] = {true, rhi::TextureFormat::RGBA16Float, {16, 16, 6}, 1};
    wanted.imports["DisplayConstants"] = {true, rhi::TextureFormat::Undefined, {}, 1};
    shadowSize = 1;
    shadowLights = 0;
    for (const passes::SettingInfo& info : tree->settings()) {
        const auto given = wanted.settings.find(info.name);
        const std::uint32_t number = given != wanted.settings.end() ? given->second.number : info.defaultValue.number;
        if (info.name == "shadowSize") shadowSize = number;
        if (info.name == "shadowLights") {
            // As many layers as there are lights that cast shadows, unless the caller wants fewer.
            shadowLights = std::min(countShadowLights(scene), given != wanted.settings.end() ? number : info.max);
            wanted.settings[info.name] = {passes::SettingValue::Type::Uint, shadowLights, {}};
        }
    }
    const auto same = [&] {
        if (!built || wanted.extent != host.extent || wanted.settings != host.settings) return false;
        return true;
    };
    if (same()) return {};
    auto result = graph.build(*tree, wanted);
    if (!result) return tl::unexpected(result.error().items().front());
    host = std::move(wanted);
    built = true;
    for (ObjectState& object : objects) object.pipelines.clear();
    return {};
}

Outcome<void> Renderer::State::writeView(std::size_t index, const FrameBlock& block) {
    if (views.size() <= index) views.resize(index + 1);
    ViewState& view = views[index];
    if (!view.block) {
        auto buffer = device.createBuffer({.label = index == 0 ? "frame" : "frame of shadow " + std::to_string(index - 1),
                                           .size = sizeof(FrameBlock),
                                           .usage = rhi::BufferUsage::Uniform | rhi::BufferUsage::CopyDst});
        if (!buffer) return tl::unexpected(toDiagnostic(buffer.error()));
        view.block = *buffer;
    }
    auto written = device.queue().writeBuffer(view.block, 0, std::as_bytes(std::span(&block, 1)));
    if (!written) return tl::unexpected(toDiagnostic(written.error()));
    return {};
}

Outcome<void> Renderer::State::prepareObjects(Scene& scene, const FrameViews& frameViews) {
    objects.resize(scene.objects.size());
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        Object& object = scene.objects[i];
        ObjectState& state = objects[i];
        auto geometry = uploads.geometry(object.geometry);
        if (!geometry) return tl::unexpected(geometry.error());
        if (state.geometry != *geometry) state.pipelines.clear();
        state.geometry = *geometry;
        state.material = &object.material.compile();
        if (!state.block) {
            auto buffer = device.createBuffer({.label = object.name + " object",
                                               .size = sizeof(ObjectBlock),
                                               .usage = rhi::BufferUsage::Uniform | rhi::BufferUsage::CopyDst});
            if (!buffer) return tl::unexpected(toDiagnostic(buffer.error()));
            state.block = *buffer;
        }
        ObjectBlock block;
        block.model = object.transform;
        block.normalMatrix = glm::mat4(glm::transpose(glm::inverse(glm::mat3(object.transform))));
        if (object.geometry->topology == Topology::Lines) {
            const glm::vec3 middle = glm::vec3(
                object.transform * glm::vec4(0.5F * (object.geometry->boundsMin + object.geometry->boundsMax), 1.0F));
            const auto width = [&](const FrameBlock& view) {
                const float distance =
                    std::max(glm::dot(middle - glm::vec3(view.eye), glm::vec3(view.viewForward)), 1e-4F);
                const float pixels = state.geometry->meanWidth / (view.pixel.x * distance + view.pixel.y);
                return std::clamp(pixels, 1.0F, device.has(rhi::Feature::WideLines) ? device.limits().maxLineWidth : 1.0F);
            };
            state.lineWidthMain = width(frameViews.main);
            state.lineWidthShadow = frameViews.shadows.empty() ? 1.0F : width(frameViews.shadows.front());
            block.lineWidth = {state.lineWidthMain, state.lineWidthShadow, 0, 0};
        }
        auto written = device.queue().writeBuffer(state.block, 0, std::as_bytes(std::span(&block, 1)));
        if (!written) return tl::unexpected(toDiagnostic(written.error()));
        // Alpha blending needs an order.
        const bool blends = std::any_of(state.material->shaders.begin(), state.material->shaders.end(), [](const auto& s) {
            return s.enabled && s.state.blend == materials::Blend::Premultiplied;
        });
        if (!blends) {
            state.sortedIndices = {};
            continue;
        }
        const auto sorted = backToFront(*object.geometry, object.transform, glm::vec3(frameViews.main.viewForward));
        const auto bytes = std::as_bytes(std::span(sorted));
        if (!state.sortedIndices || state.sortedIndices.size() != bytes.size()) {
            auto buffer = device.createBuffer({.label = object.name + " sorted indices",
                                               .size = bytes.size(),
                                               .usage = rhi::BufferUsage::Index | rhi::BufferUsage::CopyDst});
            if (!buffer) return tl::unexpected(toDiagnostic(buffer.error()));
            state.sortedIndices = *buffer;
        }
        written = device.queue().writeBuffer(state.sortedIndices, 0, bytes);
        if (!written) return tl::unexpected(toDiagnostic(written.error()));
    }
    return {};
}

rhi::Result<rhi::RenderPipeline> Renderer::State::pipeline(ObjectState& object,
                                                           const materials::CompiledMaterial::Shader& shader,
                                                           const passes::Targets& targets) {
    const std::string key = pipelineKey(shader, targets) + (shadowsOff ? "s" : "") + (environmentOff ? "e" : "");
    if (const auto found = object.pipelines.find(key); found != object.pipelines.end()) return found->second;

    const bool strands = object.geometry->source->topology == Topology::Lines;
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
    descriptor.primitive = {.topology = strands ? rhi::PrimitiveTopology::LineList : rhi::PrimitiveTopology::TriangleList,
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
                auto group = groupFor(views[viewIndex].groups, layout, views[viewIndex].block, sizeof(FrameBlock), "frame");
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
                    return tl::unexpected(rhi::Error{rhi::ErrorKind::Validation, rhi::ErrorCode::BindingMismatch,
                                                     toString(group.error()), {}});
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

Outcome<void> Renderer::encode(Scene& scene, const FrameSettings& settings, rhi::CommandEncoder& encoder) {
    State& state = *state_;
    state.frame = {};
    if (scene.objects.empty()) {
        return tl::unexpected(Diagnostic{.code = "H101", .text = "the scene has no objects", .hint = "add hair to it"});
    }
    if (scene.lights.size() > maxLights) {
        return tl::unexpected(Diagnostic{.code = "H102",
                                         .text = "the scene has " + std::to_string(scene.lights.size()) +
                                                 " lights, the most is " + std::to_string(maxLights),
                                         .hint = "merge or delete lights"});
    }
    std::uint32_t shadowSize = 1, shadowLights = 0;
    if (auto built = state.buildGraph(scene, settings, shadowSize, shadowLights); !built) return built;
    const FrameViews views = makeViews(scene, settings.width, settings.height, shadowSize, shadowLights, settings.frameIndex);
    state.shadowsOff = views.shadows.empty();
    state.environmentOff = !scene.environment.enabled();
    if (auto prepared = state.prepareObjects(scene, views); !prepared) return prepared;
    if (auto written = state.writeView(0, views.main); !written) return written;
    for (std::size_t i = 0; i < views.shadows.size(); ++i) {
        if (auto written = state.writeView(i + 1, views.shadows[i]); !written) return written;
    }
    const glm::vec4 display(scene.background, scene.exposure);
    auto shown = state.device.queue().writeBuffer(state.displayBlock, 0, std::as_bytes(std::span(&display, 1)));
    if (!shown) return tl::unexpected(toDiagnostic(shown.error()));
    auto irradiance = state.uploads.irradiance(scene.environment);
    if (!irradiance) return tl::unexpected(irradiance.error());

    passes::FrameImports imports;
    imports.textures["EnvIrradiance"] = *irradiance;
    imports.buffers["DisplayConstants"] = state.displayBlock;
    auto recorded = state.graph.record(encoder, imports,
                                       [&](passes::RasterContext& context) { return state.draw(scene, context); });
    if (!recorded) return tl::unexpected(toDiagnostic(recorded.error()));
    return {};
}

rhi::Texture Renderer::displayTexture() const { return state_->graph.exported("LdrColor"); }
rhi::Texture Renderer::colorTexture() const { return state_->graph.exported("HdrColor"); }
const passes::Plan& Renderer::plan() const { return state_->graph.plan(); }

namespace {

// A texture's first level and layer, as a tightly packed buffer to map.
rhi::Result<rhi::Buffer> copyOut(const rhi::Device& device, rhi::CommandEncoder& encoder, const rhi::Texture& texture) {
    const rhi::Extent3D size = texture.size();
    const std::uint64_t bytes = std::uint64_t{size.width} * size.height * rhi::bytesPerTexel(texture.format());
    auto buffer = device.createBuffer({.label = texture.label() + " readback",
                                       .size = bytes,
                                       .usage = rhi::BufferUsage::MapRead | rhi::BufferUsage::CopyDst});
    if (buffer) encoder.copyTextureToBuffer({.texture = texture}, {.buffer = *buffer}, {size.width, size.height, 1});
    return buffer;
}

}  // namespace

Outcome<Picture> Renderer::render(Scene& scene, const FrameSettings& settings) {
    State& state = *state_;
    rhi::CommandEncoder encoder = state.device.createCommandEncoder("frame");
    if (auto encoded = encode(scene, settings, encoder); !encoded) return tl::unexpected(encoded.error());
    Picture picture = {.width = settings.width, .height = settings.height};
    rhi::Buffer linear, display;
    for (auto [texture, buffer] : {std::pair{colorTexture(), &linear}, std::pair{displayTexture(), &display}}) {
        if (!texture) continue;
        auto made = copyOut(state.device, encoder, texture);
        if (!made) return tl::unexpected(toDiagnostic(made.error()));
        *buffer = *made;
    }
    auto commands = encoder.finish();
    if (!commands) return tl::unexpected(toDiagnostic(commands.error()));
    auto submission = state.device.queue().submit(*commands);
    if (!submission) return tl::unexpected(toDiagnostic(submission.error()));
    auto waited = state.device.queue().wait(*submission);
    if (!waited) return tl::unexpected(toDiagnostic(waited.error()));
    const std::size_t pixels = std::size_t{settings.width} * settings.height;
    if (linear) {
        picture.linear.resize(pixels * 4);
        const auto bytes = linear.mapped();
        for (std::size_t i = 0; i < picture.linear.size(); ++i) {
            std::uint16_t half = 0;
            std::memcpy(&half, bytes.data() + 2 * i, 2);
            picture.linear[i] = glm::unpackHalf1x16(half);
        }
    }
    if (display) {
        picture.display.resize(pixels * 4);
        std::memcpy(picture.display.data(), display.mapped().data(), picture.display.size());
    }
    state.frame.draws = commands->counters().draws;
    state.frame.barriers = commands->counters().barriers;
    picture.report = report();
    state.device.collect();
    return picture;
}

FrameReport Renderer::report() const {
    const State& state = *state_;
    FrameReport report = state.frame;
    report.passes = state.graph.reports();
    report.gpuMilliseconds = state.graph.frameMilliseconds();
    for (const passes::PlanResource& resource : state.graph.plan().resources) {
        if (resource.kind != passes::PlanResource::Kind::Transient || resource.isBuffer) continue;
        report.attachments.push_back({resource.name, std::string(rhi::name(resource.format)),
                                      {resource.extent.width, resource.extent.height, resource.layers}, resource.samples,
                                      resource.bytes});
    }
    report.culled = state.graph.plan().culled;
    return report;
}

}  // namespace pelage::hair
