// SPDX-License-Identifier: MIT
// The glue: scene -> views, uploads and material bindings; pass tree -> graph; draw lists -> draws.
#include "names.hpp"
#include "state.hpp"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cstring>

namespace pelage::hair {

namespace detail {
std::span<const std::uint32_t> embeddedShader(std::string_view name);
std::span<const std::string_view> embeddedShaderNames();
}  // namespace detail

std::span<const std::uint32_t> Renderer::shaderCode(const std::string& file) {
    return detail::embeddedShader(file);
}

std::vector<std::string> Renderer::shaderNames() {
    const auto names = detail::embeddedShaderNames();
    return {names.begin(), names.end()};
}

Result<rhi::ShaderModule> Renderer::State::module(const std::string& file) {
    if (const auto found = modules.find(file); found != modules.end()) return found->second;
    std::span<const std::uint32_t> code;
    if (hostShaders) code = hostShaders(file);
    if (code.empty()) code = detail::embeddedShader(file);
    if (code.empty()) {
        std::string known;
        for (const std::string_view name : detail::embeddedShaderNames())
            known += (known.empty() ? "" : ", ") + std::string(name);
        return tl::unexpected<Diagnostics>(
            Diagnostic{.code = rhi::ErrorCode::ShaderInvalid,
                       .text = "There is no shader \"" + file + "\"; this build has " + known + ".",
                       .kind = ErrorKind::Validation});
    }
    auto made = device.createShaderModule({.label = file, .code = {code.begin(), code.end()}});
    if (made) modules.emplace(file, *made);
    return made;
}

Result<Renderer> Renderer::create(Descriptor descriptor) {
    if (!descriptor.device || !descriptor.tree) {
        return tl::unexpected(Diagnostic{.code = "N001",
                                         .text = "a renderer needs a device and a pass tree",
                                         .hint = "fill Renderer::Descriptor::device and ::tree"});
    }
    auto sampler = descriptor.device.createSampler({.label = "material",
                                                    .addressModeU = rhi::AddressMode::Repeat,
                                                    .addressModeV = rhi::AddressMode::Repeat,
                                                    .magFilter = rhi::FilterMode::Linear,
                                                    .minFilter = rhi::FilterMode::Linear,
                                                    .mipmapFilter = rhi::FilterMode::Linear});
    if (!sampler) return tl::unexpected(sampler.error());
    Renderer renderer;
    renderer.state_ = std::make_shared<State>(descriptor, *sampler);
    State& state = *renderer.state_;
    state.tree = descriptor.tree;
    State* raw = renderer.state_.get();
    // A host that draws lists itself has its own class of that name.
    descriptor.classes.add(raw->drawListClass());
    for (MaterialPass& pass : descriptor.materialPasses) {
        const std::string name = pass.info.name;
        if (pass.dispatch && descriptor.classes.add(raw->dispatchClass(std::move(pass)))) continue;
        return tl::unexpected(Diagnostic{.code = "N004",
                                         .text = "the material pass '" + name + "' cannot be registered",
                                         .hint = "give it a name that no other class has, and a dispatch function"});
    }
    state.graph = passes::Graph({.device = descriptor.device,
                                 .shaders = [raw](const std::string& file) { return raw->module(file); },
                                 .measure = descriptor.measure,
                                 .classes = std::move(descriptor.classes)});
    auto block = descriptor.device.createBuffer(
        {.label = "display constants", .size = 16, .usage = rhi::BufferUsage::Uniform | rhi::BufferUsage::CopyDst});
    if (!block) return tl::unexpected(block.error());
    state.displayBlock = *block;
    return renderer;
}

Result<void> Renderer::setTree(std::shared_ptr<const passes::PassTree> tree) {
    State& state = *state_;
    if (state.built) {
        auto built = state.graph.build(*tree, state.host);
        if (!built) return tl::unexpected(firstError(built.error()));
        ++state.graphBuilds;
    }
    state.tree = std::move(tree);
    state.inputs.reset();
    state.checkedTypes.clear();
    return {};
}

Result<void> Renderer::encode(Scene& scene, const FrameSettings& settings, rhi::CommandEncoder& encoder) {
    State& state = *state_;
    state.frame = {};
    if (scene.objects.empty()) {
        return tl::unexpected(Diagnostic{.code = "N002", .text = "the scene has no objects", .hint = "add hair to it"});
    }
    if (scene.lights.size() > maxLights) {
        return tl::unexpected(Diagnostic{.code = "N003",
                                         .text = "the scene has " + std::to_string(scene.lights.size()) +
                                                 " lights, the most is " + std::to_string(maxLights),
                                         .hint = "merge or delete lights"});
    }
    std::uint32_t shadowSize = 1, shadowLights = 0;
    if (auto built = state.buildGraph(scene, settings, shadowSize, shadowLights); !built) return built;
    makeViews(state.viewBlocks, scene, settings, shadowSize, shadowLights);
    const FrameViews& views = state.viewBlocks;
    state.lights = views.lights;
    state.environmentOff = !scene.environment.enabled();
    if (auto prepared = state.prepareObjects(scene, views, encoder); !prepared) return prepared;
    if (auto written = state.writeView(0, views.main); !written) return written;
    for (std::size_t i = 0; i < views.shadows.size(); ++i) {
        if (auto written = state.writeView(i + 1, views.shadows[i]); !written) return written;
    }
    const glm::vec4 display(scene.background, scene.exposure);
    auto shown = state.device.queue().writeBuffer(state.displayBlock, 0, std::as_bytes(std::span(&display, 1)));
    if (!shown) return tl::unexpected(shown.error());
    auto irradiance = state.uploads.irradiance(scene.environment);
    if (!irradiance) return tl::unexpected(irradiance.error());

    passes::FrameImports& imports = state.imports;
    imports.textures[names::environmentIrradiance] = *irradiance;
    imports.buffers[names::displayConstants] = state.displayBlock;
    imports.buffers[names::frameConstants] = state.views[0].block;
    for (const auto& [name, texture] : settings.imports) imports.textures[name] = texture;
    for (const auto& [name, buffer] : settings.buffers) imports.buffers[name] = buffer;
    state.recorded = &scene;
    auto recorded = state.graph.record(encoder, imports);
    state.recorded = nullptr;
    // What was lent goes back; the names stay for the next frame.
    for (auto& [name, texture] : imports.textures) texture = {};
    for (auto& [name, buffer] : imports.buffers) buffer = {};
    if (!recorded) return tl::unexpected(recorded.error());
    return {};
}

rhi::Texture Renderer::displayTexture() const {
    return exported(names::display);
}
rhi::Texture Renderer::colorTexture() const {
    return exported(names::color);
}
rhi::Texture Renderer::exported(const std::string& name) const {
    return state_->graph.exported(name);
}
rhi::Buffer Renderer::exportedBuffer(const std::string& name) const {
    return state_->graph.exportedBuffer(name);
}
const passes::Plan& Renderer::plan() const {
    return state_->graph.plan();
}

const StrandBuffers* Renderer::strandBuffers(std::size_t object) const {
    const auto& objects = state_->objects;
    if (object >= objects.size() || !objects[object].geometry || !objects[object].geometry->strands) return nullptr;
    return &objects[object].moving.buffers();
}

namespace {

// A texture's first level and layer, as a tightly packed buffer to map.
Result<rhi::Buffer> copyOut(const rhi::Device& device, rhi::CommandEncoder& encoder, const rhi::Texture& texture) {
    const rhi::Extent3D size = texture.size();
    const std::uint64_t bytes = std::uint64_t{size.width} * size.height * rhi::bytesPerTexel(texture.format());
    auto buffer = device.createBuffer({.label = texture.label() + " readback",
                                       .size = bytes,
                                       .usage = rhi::BufferUsage::MapRead | rhi::BufferUsage::CopyDst});
    if (buffer) encoder.copyTextureToBuffer({.texture = texture}, {.buffer = *buffer}, {size.width, size.height, 1});
    return buffer;
}

}  // namespace

Result<Picture> Renderer::render(Scene& scene, const FrameSettings& settings) {
    State& state = *state_;
    rhi::CommandEncoder encoder = state.device.createCommandEncoder("frame");
    if (auto encoded = encode(scene, settings, encoder); !encoded) return tl::unexpected(encoded.error());
    Picture picture = {.width = settings.width, .height = settings.height};
    rhi::Buffer linear, display;
    for (auto [texture, buffer] : {std::pair{colorTexture(), &linear}, std::pair{displayTexture(), &display}}) {
        if (!texture) continue;
        auto made = copyOut(state.device, encoder, texture);
        if (!made) return tl::unexpected(made.error());
        *buffer = *made;
    }
    auto commands = encoder.finish();
    if (!commands) return tl::unexpected(commands.error());
    auto submission = state.device.queue().submit(*commands);
    if (!submission) return tl::unexpected(submission.error());
    auto waited = state.device.queue().wait(*submission);
    if (!waited) return tl::unexpected(waited.error());
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

void Renderer::waitForPipelines() {
    state_->pipelines.wait();
}

FrameReport Renderer::report() const {
    const State& state = *state_;
    FrameReport report = state.frame;
    report.pipelinesPending = state.pipelines.pending();
    report.pipelinesMade = state.pipelines.made();
    report.passes = state.graph.reports();
    report.gpuMilliseconds = state.graph.frameMilliseconds();
    for (const passes::PlanResource& resource : state.graph.plan().resources) {
        if (resource.kind != passes::PlanResource::Kind::Transient || resource.isBuffer) continue;
        report.attachments.push_back({resource.name,
                                      std::string(rhi::name(resource.format)),
                                      {resource.extent.width, resource.extent.height, resource.layers},
                                      resource.samples,
                                      resource.bytes});
    }
    report.culled = state.graph.plan().culled;
    return report;
}

}  // namespace pelage::hair
