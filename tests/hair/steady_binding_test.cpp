// SPDX-License-Identifier: MIT
// A material that has not changed: what joining it to a shader asks of the heap. On the driver that does nothing.
#include "material/binding.hpp"
#include "support/counting_new.hpp"
#include "support/null_driver.hpp"

#include <pelage/hair/generate.hpp>
#include <pelage/hair/library.hpp>
#include <pelage/hair/renderer.hpp>
#include <pelage/rhi/vulkan.hpp>

#include <gtest/gtest.h>

namespace pelage::test {
namespace {

class SteadyBinding : public ::testing::Test {
protected:
    NullDriver driver;
    rhi::Device device;
    hair::Library library = hair::Library(PELAGE_DATA_DIR);

    void SetUp() override {
        driver.keepCommands = false;
        const auto instance = *rhi::vulkan::createInstance({}, NullDriver::entry());
        const auto adapter = *instance.requestAdapter();
        device = *adapter.requestDevice({.optionalFeatures = adapter.info().features});
    }
    rhi::ShaderModule shader(const std::string& name) const {
        const auto code = hair::Renderer::shaderCode(name);
        return *device.createShaderModule({.label = name, .code = {code.begin(), code.end()}});
    }
};

TEST_F(SteadyBinding, AnUnchangedMaterialAsksNothingOfTheHeapAndMakesNoObject) {
    auto material = library.material("brown")->material;
    hair::Uploads uploads(device);
    hair::MaterialBindings bindings(device, *device.createSampler({}));
    const hair::MaterialBindings::Modules modules{shader("hair.vert"), shader("hair_forward.frag"), {}};
    rhi::RenderPipelineDescriptor descriptor{.vertex = {.module = modules.vertex}};
    descriptor.vertexBuffers = {{.arrayStride = 60,
                                 .attributes = {{rhi::VertexFormat::Float32x3, 0, 0},
                                                {rhi::VertexFormat::Float32x3, 12, 1},
                                                {rhi::VertexFormat::Float32x3, 24, 2},
                                                {rhi::VertexFormat::Float32x2, 36, 3},
                                                {rhi::VertexFormat::Float32x3, 44, 4}}}};
    descriptor.fragment = {.module = modules.fragment};
    descriptor.targets = {{.format = rhi::TextureFormat::RGBA16Float}};
    const auto pipeline = device.createRenderPipeline(descriptor);
    ASSERT_TRUE(pipeline) << pipeline.error().text();
    const rhi::BindGroupLayout layout = pipeline->bindGroupLayout(2);
    const hair::GpuGeometry geometry{};
    const auto bind = [&] {
        const materials::CompiledMaterial& compiled = material.compile();
        auto group = bindings.bindGroup({0, layout.get(), 0}, layout, material.sharedType(), compiled, geometry,
                                        uploads, [&] { return modules; });
        EXPECT_TRUE(group) << group.error().text();
        return group ? *group : rhi::BindGroup();
    };
    const rhi::BindGroup first = bind();
    const std::uint64_t before = allocations;
    bool same = true;
    for (int i = 0; i < 100; ++i) same = bind() == first && same;
    EXPECT_EQ(allocations - before, 0U) << "in 100 frames";
    EXPECT_TRUE(same);

    // A number is written into the block that is there; another texture is another group.
    ASSERT_TRUE(material.setFromText("shadowing.depthBias", "0.01").empty());
    EXPECT_EQ(bind(), first);
    ASSERT_TRUE(material.setFromText("surface.colorMap", "builtin.black").empty());
    ASSERT_TRUE(material.setFromText("surface.useColorMap", "true").empty());
    const rhi::BindGroup other = bind();
    EXPECT_NE(other, first);
    EXPECT_EQ(bind(), other);
}

// Two grooms, one of which moves, skin, three lights with shadows; camera, colours of lights and points differ in each
// frame.
TEST_F(SteadyBinding, AHairFrameAsksNothingOfTheHeapAndMakesNoObject) {
    auto tree = library.passTree("hair_frame");
    ASSERT_TRUE(tree) << tree.error().text();
    auto renderer = hair::Renderer::create({.device = device, .tree = *tree});
    ASSERT_TRUE(renderer) << renderer.error().text();
    const auto groom = std::make_shared<const hair::Strands>(
        hair::makeGroom({.style = hair::Style::Wavy, .strands = 40, .pointsPerStrand = 6}));
    hair::Scene scene;
    const auto add = [&](const char* name, hair::Geometry geometry, const char* preset) {
        scene.objects.push_back(
            {.name = name, .geometry = std::move(geometry), .material = library.material(preset)->material});
    };
    add("strands", groom, "brown");
    add("more", groom, "blond");
    add("head", std::make_shared<const hair::Mesh>(hair::makeHead()), "skin");
    scene.lights = {{}, {.direction = {1, -1, 0}}, {.direction = {-1, -1, 0}}};
    std::vector<glm::vec3> points = groom->points;
    scene.objects[1].moved.points = points;
    hair::FrameSettings settings = {.width = 64, .height = 64};
    const auto frame = [&](int i) {
        const float t = 0.01F * static_cast<float>(i);
        scene.camera.eye.x = t;
        scene.lights[1].intensity = 1 + t;
        for (std::size_t p = 0; p < points.size(); ++p) points[p] = groom->points[p] + glm::vec3(t, 0, 0);
        settings.frameIndex = static_cast<std::uint32_t>(i);
        auto encoder = device.createCommandEncoder("frame");
        const std::uint64_t before = allocations;
        const auto encoded = renderer->encode(scene, settings, encoder);
        const std::uint64_t asked = allocations - before;
        EXPECT_TRUE(encoded) << encoded.error().text();
        const auto commands = encoder.finish();
        EXPECT_TRUE(commands) << commands.error().text();
        const auto sent = device.queue().submit(*commands);
        EXPECT_TRUE(sent) << sent.error().text();
        EXPECT_TRUE(device.queue().wait(*sent));
        return asked;
    };
    for (int i = 0; i < 8; ++i) frame(i);
    const std::size_t alive = driver.alive().size();
    const std::uint64_t pipelines = driver.pipelinesCreated;
    std::uint64_t asked = 0;
    for (int i = 8; i < 58; ++i) asked += frame(i);
    EXPECT_EQ(asked, 0U) << "in 50 frames of Renderer::encode";
    EXPECT_EQ(driver.alive().size(), alive);
    EXPECT_EQ(driver.pipelinesCreated, pipelines);
}

}  // namespace
}  // namespace pelage::test
