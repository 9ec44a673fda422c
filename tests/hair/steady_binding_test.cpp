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

}  // namespace
}  // namespace pelage::test
