// SPDX-License-Identifier: MIT
// Misuse is an error with a stable code and one complete sentence; Vulkan never sees it, so the layer stays silent.
#include <pelage/rhi/vulkan.hpp>

#include <functional>
#include <map>

#include "common.hpp"
#include "surface_object.hpp"

namespace pelage::test {
namespace {

class Errors : public RhiTest {
protected:
    template <class T>
    Diagnostic error(const Result<T>& result) {
        EXPECT_FALSE(result) << "no error came";
        return result ? Diagnostic{} : result.error().first();
    }
    /// The error of an encoder that `record` misuses.
    Diagnostic encoding(const std::function<void(CommandEncoder&)>& record) {
        auto encoder = device.createCommandEncoder("frame");
        record(encoder);
        return error(encoder.finish());
    }
    Diagnostic inRenderPass(const std::function<void(RenderPassEncoder&)>& record) {
        return encoding([&](CommandEncoder& encoder) {
            auto pass =
                encoder.beginRenderPass({.label = "forward", .colorAttachments = {{.view = view(target(8, 8))}}});
            record(pass);
            pass.end();
        });
    }
    void contains(const Diagnostic& e, std::initializer_list<std::string_view> parts) {
        const auto text = toString(e);
        for (const auto part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " is not in:\n" << text;
        EXPECT_EQ(e.text.back(), '.') << text;
    }
    BindGroupLayout uniformLayout() {
        return value(device.createBindGroupLayout(
            {.label = "frame layout",
             .entries = {{.binding = 0, .name = "frame", .type = BindingType::UniformBuffer, .minBindingSize = 64}}}));
    }
};

struct Variable {  // an environment variable for the length of a scope
    Variable(const char* name, const char* text) : name_(name) { setenv(name, text, 1); }
    ~Variable() { unsetenv(name_); }
    const char* name_;
};

TEST_F(Errors, EveryCodeIsProvoked) {
    device.pushErrorScope();
    std::map<Code, Diagnostic> seen;
    const auto note = [&](const Diagnostics& e) { seen[e.first().code] = e.first(); };
    note(error(gpu.adapter.requestDevice({.toggles = {{"noSuchToggle"}}})));
    {
        const Variable hidden("VK_LAYER_PATH", "/nonexistent");
        note(error(Instance::create({.validation = true})));
    }
    note(error(Instance::create({.surfaceExtensions = {"VK_KHR_no_such_extension"}})));
    note(error(gpu.instance.requestAdapter({.nameContains = "no such device"})));
    // What only a driver can refuse goes through the one function that makes such errors.
    note(detail::vulkanError(VK_ERROR_INITIALIZATION_FAILED, "vkCreateX", "[X]"));
    note(detail::vulkanError(VK_ERROR_OUT_OF_DEVICE_MEMORY, "vkCreateX", "[X]"));
    note(detail::vulkanError(VK_ERROR_DEVICE_LOST, "vkCreateX", "[X]"));
    note(error(device.createBindGroup({.label = "no layout"})));
    note(error(device.createBuffer({.label = "empty", .usage = BufferUsage::Storage})));
    note(error(device.createBuffer({.label = "useless", .size = 4})));
    note(error(device.createTexture(
        {.label = "srgb", .format = TextureFormat::RGBA8UnormSrgb, .usage = TextureUsage::StorageBinding})));
    note(error(device.createTexture({.label = "three", .sampleCount = 3, .usage = TextureUsage::RenderAttachment})));
    note(error(device.createShaderModule({.label = "noise", .code = {1, 2, 3}})));
    auto d = pipelineDescriptor("full.vert", "color.frag");
    d.fragment->constants = {{"PURPLE", 1}};
    note(error(device.createRenderPipeline(d)));
    note(error(device.createBindGroup({.label = "incomplete", .layout = uniformLayout()})));
    note(error(device.createRenderPipeline(pipelineDescriptor("mesh.vert", "mesh.frag"))));
    d = pipelineDescriptor("full.vert", "color.frag");
    d.targets.push_back({.format = TextureFormat::RGBA8Unorm});
    note(error(device.createRenderPipeline(d)));
    note(inRenderPass([](RenderPassEncoder& pass) { pass.draw(3); }));
    const auto both = buffer("both", 64, BufferUsage::CopySrc | BufferUsage::CopyDst);
    note(encoding([&](CommandEncoder& e) { e.copyBufferToBuffer(both, 0, both, 32, 16); }));
    note(encoding([&](CommandEncoder& e) { e.clearBuffer(both, 0, 128); }));
    note(encoding([](CommandEncoder& e) { e.popDebugGroup(); }));
    auto encoder = device.createCommandEncoder("twice");
    note(error(device.queue().submit(std::vector<CommandBuffer>(2, value(encoder.finish())))));
    const auto times = value(device.createQuerySet({.label = "times", .count = 2}));
    note(encoding([&](CommandEncoder& e) { e.writeTimestamp(times, 2); }));
    note(inRenderPass([](RenderPassEncoder& pass) { pass.setPushConstants(0, std::vector<std::byte>(4096)); }));
    auto surface = std::make_shared<detail::SurfaceObject>();
    surface->instance = gpu.instance.shared();
    note(error(Surface(surface).getCurrentTexture()));
    const auto other = value(gpu.adapter.requestDevice({.label = "other", .optionalFeatures = Feature::None}));
    const auto foreign = value(other.createBuffer({.label = "foreign", .size = 64, .usage = BufferUsage::CopyDst}));
    note(encoding([&](CommandEncoder& e) { e.clearBuffer(foreign); }));
    note(error(device.createBuffer(
        {.label = "unmapped", .size = 4, .usage = BufferUsage::Storage, .mappedAtCreation = true})));
    device.popErrorScope();
#define PELAGE_RHI_CODE(code, name, meaning)                                           \
    if (ErrorCode::name != ErrorCode::NoLoader) { /* needs a machine without Vulkan */ \
        EXPECT_TRUE(seen.contains(ErrorCode::name)) << #name " was not provoked";      \
        EXPECT_TRUE(seen[ErrorCode::name].text.ends_with('.')) << #name;               \
    }
#include <pelage/base/codes.def>
}

TEST_F(Errors, ADriverFailureNamesTheCallAndTheObject) {
    auto plain = value(Instance::create({.label = "no layer"}));
    auto adapter = value(plain.requestAdapter({.nameContains = gpu.adapter.info().name}));
    auto other = value(adapter.requestDevice({.label = "small", .onUncapturedError = [](const Diagnostic&) {}}));
    // Virtual memory is cheap: take the largest buffers until the driver says no.
    std::vector<Buffer> all;
    Diagnostic refused;
    const std::uint64_t size = std::min<std::uint64_t>(other.limits().maxBufferSize, 4ULL << 40);
    for (int i = 0; i < 64 && refused.text.empty(); ++i) {
        auto b = other.createBuffer({.label = "huge", .size = size, .usage = BufferUsage::Storage});
        if (b)
            all.push_back(*b);
        else
            refused = b.error().first();
    }
    if (refused.text.empty()) GTEST_SKIP() << "this machine gave " << all.size() << " buffers of " << size << " bytes";
    contains(refused, {"[Buffer \"huge\"]", "VK_ERROR_"});
    EXPECT_EQ(refused.kind, ErrorKind::OutOfMemory);
}

TEST_F(Errors, BindGroupsAreCheckedAgainstTheirLayout) {
    device.pushErrorScope();
    const auto layout = uniformLayout();
    const auto storage = buffer("lights", 256, BufferUsage::Storage), small = buffer("small", 32, BufferUsage::Uniform);
    const auto good = buffer("good", 512, BufferUsage::Uniform);
    const auto make = [&](std::vector<BindGroupEntry> entries) {
        return error(device.createBindGroup({.label = "frame", .layout = layout, .entries = std::move(entries)}));
    };
    contains(make({{0, BufferBinding{storage}}}),
             {"R012",
              "[Buffer \"lights\"] was created without BufferUsage::Uniform, which binding 0 \"frame\" of "
              "[BindGroup \"frame\"] needs."});
    contains(make({{0, BufferBinding{small}}}), {"R013", "32 bytes", "needs 64"});
    contains(make({{0, BufferBinding{good, 4, 64}}}), {"R013", "offset 4", "multiple of"});
    contains(make({{0, BufferBinding{good, 256, 512}}}), {"R013", "256 … 768", "512 bytes"});
    contains(make({{0, BufferBinding{good}}, {3, BufferBinding{good}}}), {"R018", "binding 3"});
    contains(make({{0, BufferBinding{good}}, {0, BufferBinding{good}}}), {"R018", "two entries"});
    contains(make({{0, value(device.createSampler({.label = "s"}))}}), {"R018", "a sampler", "UniformBuffer"});
    contains(make({{0, BufferBinding{}}}), {"R010", "\"frame\""});
    const auto images =
        value(device.createBindGroupLayout({.label = "images",
                                            .entries = {{.binding = 0,
                                                         .name = "sky",
                                                         .type = BindingType::SampledTexture,
                                                         .viewDimension = TextureViewDimension::Cube}}}));
    const auto flat = target(4, 4, TextureFormat::RGBA8Unorm, 1, TextureUsage::TextureBinding);
    contains(error(device.createBindGroup({.label = "g", .layout = images, .entries = {{0, view(flat)}}})),
             {"R018", "2D view", "cube view"});
    const auto many = target(4, 4, TextureFormat::RGBA8Unorm, 4, TextureUsage::TextureBinding);
    const auto single = value(device.createBindGroupLayout(
        {.label = "single", .entries = {{.binding = 0, .name = "image", .type = BindingType::SampledTexture}}}));
    contains(error(device.createBindGroup({.label = "g", .layout = single, .entries = {{0, view(many)}}})),
             {"R015", "4 samples"});
    EXPECT_TRUE(device.popErrorScope());
}

TEST_F(Errors, AUsageConflictNamesTheObjectAndBothUses) {
    device.pushErrorScope();
    const auto t = target(8, 8, TextureFormat::RGBA8Unorm, 1, TextureUsage::TextureBinding);
    const auto p = pipeline("full.vert", "sample.frag");
    const auto g = group(p.bindGroupLayout(0), {{0, view(t)}, {1, value(device.createSampler({.label = "s"}))}});
    contains(encoding([&](CommandEncoder& encoder) {
                 auto pass = encoder.beginRenderPass({.label = "forward", .colorAttachments = {{.view = view(t)}}});
                 pass.setPipeline(p);
                 pass.setBindGroup(0, g);
                 pass.draw(3);
                 pass.draw(3);
                 pass.end();
             }),
             {"R022: [Texture \"target\"] is used as a colour attachment and as a sampled texture (group 0 binding 0) "
              "in one scope; "
              "while validating CommandEncoder \"frame\" > RenderPass \"forward\" > draw #0"});
    const auto b = buffer("numbers", 256, BufferUsage::Storage);
    const auto c = compute("copy.comp");
    const auto h = group(c.bindGroupLayout(0), {{0, BufferBinding{b}}, {1, BufferBinding{b}}});
    contains(encoding([&](CommandEncoder& encoder) {
                 auto pass = encoder.beginComputePass({.label = "sim"});
                 pass.setPipeline(c);
                 pass.setBindGroup(0, h);
                 pass.dispatchWorkgroups(1);
                 pass.end();
             }),
             {"R022", "[Buffer \"numbers\"]", "read-only storage buffer (group 0 binding 0)", "writable storage buffer",
              "ComputePass \"sim\" > dispatch #0"});
    device.popErrorScope();
}

TEST_F(Errors, TheFirstErrorOfAnEncoderIsKept) {
    device.pushErrorScope();
    const auto e = inRenderPass([&](RenderPassEncoder& pass) {
        pass.setViewport(0, 0, 0, 8);
        pass.draw(3);
        pass.popDebugGroup();
    });
    contains(e, {"R013", "The viewport", "RenderPass \"forward\""});
    ASSERT_EQ(e.context.size(), 2U);
    EXPECT_EQ(e.context[0], "RenderPass \"forward\"");
    EXPECT_EQ(e.context[1], "CommandEncoder \"frame\"");
    EXPECT_TRUE(device.popErrorScope());
}

TEST_F(Errors, PipelinesMustFitThePass) {
    device.pushErrorScope();
    const auto plain = pipeline("full.vert", "color.frag");
    auto d = pipelineDescriptor("full.vert", "color.frag");
    d.multisample.count = 4;
    const auto many = value(device.createRenderPipeline(d));
    d.multisample.count = 1;
    d.depthStencil = DepthStencilState{TextureFormat::Depth32Float, true, CompareFunction::Less};
    const auto deep = value(device.createRenderPipeline(d));
    const auto half = target(8, 8, TextureFormat::RGBA16Float);
    contains(inRenderPass([&](RenderPassEncoder& pass) { pass.setPipeline(many); }), {"R015", "4 samples"});
    contains(inRenderPass([&](RenderPassEncoder& pass) { pass.setPipeline(deep); }),
             {"R020", "Depth32Float", "Undefined"});
    contains(encoding([&](CommandEncoder& encoder) {
                 auto pass = encoder.beginRenderPass({.label = "hdr", .colorAttachments = {{.view = view(half)}}});
                 pass.setPipeline(plain);
                 pass.end();
             }),
             {"R020", "target 0 is RGBA8Unorm", "RGBA16Float"});
    contains(inRenderPass([&](RenderPassEncoder& pass) {
                 pass.setPipeline(pipeline("full.vert", "sample.frag"));
                 pass.draw(3);
             }),
             {"R021", "bind group at index 0"});
    device.popErrorScope();
}

TEST_F(Errors, AnUnknownConstantNamesTheKnownOnes) {
    device.pushErrorScope();
    auto d = pipelineDescriptor("full.vert", "color.frag");
    d.fragment->constants = {{"GREN", 1}};
    contains(error(device.createRenderPipeline(d)),
             {"R017", "\"GREN\"", "[ShaderModule \"color.frag\"]", "RED, GREEN, BLUE, ALPHA"});
    d.fragment->constants = {{"BLUE", 0.5}};
    contains(error(device.createRenderPipeline(d)), {"R013", "\"BLUE\"", "0.5", "no int"});
    device.popErrorScope();
}

TEST_F(Errors, ScopesNestAndCatchTheFirst) {
    gpu.messages.takeOwn();
    const auto bad = [&](const char* label) {
        (void)device.createBuffer({.label = label, .usage = BufferUsage::Storage});
    };
    device.pushErrorScope();
    bad("outer");
    device.pushErrorScope();
    bad("inner");
    bad("inner again");
    const auto inner = device.popErrorScope();
    ASSERT_TRUE(inner);
    contains(*inner, {"[Buffer \"inner\"]"});
    contains(*device.popErrorScope(), {"[Buffer \"outer\"]"});
    EXPECT_FALSE(device.popErrorScope()) << "no scope is open";
    EXPECT_TRUE(gpu.messages.takeOwn().empty());
    bad("uncaught");
    const auto own = gpu.messages.takeOwn();
    ASSERT_EQ(own.size(), 1U);
    EXPECT_EQ(own[0].id, "R011");
    EXPECT_EQ(own[0].level, LogLevel::Error);
}

TEST_F(Errors, MissingFeaturesAreNamedAll) {
    const auto two = static_cast<Feature>(1U << 20 | 1U << 21);
    const auto e = error(gpu.adapter.requestDevice({.label = "greedy", .requiredFeatures = two}));
    contains(e, {"R003", "feature bit 1048576, feature bit 2097152", "[Adapter \""});
    EXPECT_EQ(e.kind, ErrorKind::Unsupported);
    std::vector<Diagnostic> caught;
    const auto bare = value(gpu.adapter.requestDevice(
        {.label = "bare", .optionalFeatures = Feature::None, .onUncapturedError = [&](const Diagnostic& x) {
             caught.push_back(x);
         }}));
    contains(error(bare.createQuerySet({.label = "times", .count = 1})), {"R003", "Feature::Timestamps"});
    const auto code = embeddedShader("stores.frag");
    contains(error(bare.createShaderModule({.label = "stores", .code = {code.begin(), code.end()}})),
             {"R003", "Feature::FragmentStores"});
    EXPECT_EQ(caught.size(), 2U);
    EXPECT_EQ(bare.limits().maxLineWidth, 1);
}

TEST_F(Errors, ALostDeviceSaysSoAndNothingCrashes) {
    std::vector<Diagnostic> caught;
    auto other = value(gpu.adapter.requestDevice(
        {.label = "doomed", .onUncapturedError = [&](const Diagnostic& e) { caught.push_back(e); }}));
    auto b = value(other.createBuffer({.label = "b", .size = 64, .usage = BufferUsage::CopyDst}));
    other.get()->lost = true;
    auto encoder = other.createCommandEncoder("late");
    encoder.clearBuffer(b);
    const auto e = error(other.queue().submit(value(encoder.finish())));
    EXPECT_EQ(e.kind, ErrorKind::DeviceLost);
    contains(e, {"R007", "[Device \"doomed\"]"});
    EXPECT_EQ(caught.size(), 1U);
}

TEST_F(Errors, TheCpuDeviceIsAnnounced) {
    if (gpu.adapter.info().type != AdapterType::CPU) GTEST_SKIP() << "a GPU is there";
    std::vector<Message> said;
    auto instance =
        value(Instance::create({.label = "quiet", .onMessage = [&](const Message& m) { said.push_back(m); }}));
    value(instance.requestAdapter());
    ASSERT_EQ(said.size(), 1U);
    EXPECT_EQ(said[0].id, "adapter");
    EXPECT_EQ(said[0].level, LogLevel::Info);
    EXPECT_NE(said[0].text.find("pictures are right, times are not"), std::string::npos);
    EXPECT_EQ(instance.requestAdapter({.allowCPU = false}).error().first().code, ErrorCode::NoAdapter);
}

}  // namespace
}  // namespace pelage::test
