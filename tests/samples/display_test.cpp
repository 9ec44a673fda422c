// SPDX-License-Identifier: MIT
// The GLSL that the build generates computes what OpenColorIO's CPU processor computes, and the sRGB curve of the
// materials is the one of the config.
#include <pelage/materials/value.hpp>
#include <pelage/rhi/rhi.hpp>

#include <OpenColorIO/OpenColorIO.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace pelage::test {

namespace shaders {
std::span<const std::uint32_t> embeddedShader(std::string_view name);
}

namespace {

namespace ocio = OCIO_NAMESPACE;
using Color = std::array<float, 4>;

ocio::ConstConfigRcPtr config() {
    return ocio::Config::CreateFromFile(PELAGE_OCIO);
}

/// Greys over twelve stops, saturated and mixed colours, dark and bright; neutral ones are where the GLSL is fragile.
std::vector<Color> colors() {
    std::vector<Color> all{{0, 0, 0, 1}};
    for (int stop = -10; stop <= 4; ++stop) {
        const float level = 0.18F * std::exp2(static_cast<float>(stop));
        all.push_back({level, level, level, 1});
        for (const Color& tint : {Color{1, 0, 0, 1}, Color{0, 1, 0, 1}, Color{0, 0, 1, 1}, Color{0.9F, 0.5F, 0.2F, 1},
                                  Color{0.2F, 0.35F, 0.9F, 1}, Color{0.35F, 0.18F, 0.08F, 1}}) {
            all.push_back({level * tint[0], level * tint[1], level * tint[2], 1});
        }
    }
    return all;
}

std::vector<Color> onCpu(const char* view) {
    auto transform = ocio::DisplayViewTransform::Create();
    transform->setSrc(ocio::ROLE_SCENE_LINEAR);
    transform->setDisplay("sRGB");
    transform->setView(view);
    const auto processor = config()->getProcessor(transform)->getDefaultCPUProcessor();
    std::vector<Color> all = colors();
    for (Color& color : all) processor->applyRGBA(color.data());
    return all;
}

class Display : public ::testing::Test {
protected:
    void SetUp() override {
        auto instance = rhi::Instance::create();
        ASSERT_TRUE(instance) << instance.error().text();
        auto adapter = instance->requestAdapter();
        ASSERT_TRUE(adapter) << adapter.error().text();
        auto device = adapter->requestDevice();
        ASSERT_TRUE(device) << device.error().text();
        instance_ = *instance;
        device_ = *device;
    }

    Result<std::vector<Color>> onGpu(bool plain) const {
        std::vector<Color> all = colors();
        const std::uint64_t size = all.size() * sizeof(Color);
        using rhi::BufferUsage;
        auto source = device_.createBuffer(
            {.label = "source", .size = size, .usage = BufferUsage::Storage | BufferUsage::CopyDst});
        if (!source) return tl::unexpected(source.error());
        auto target = device_.createBuffer(
            {.label = "target", .size = size, .usage = BufferUsage::Storage | BufferUsage::CopySrc});
        if (!target) return tl::unexpected(target.error());
        auto back = device_.createBuffer(
            {.label = "read back", .size = size, .usage = BufferUsage::MapRead | BufferUsage::CopyDst});
        if (!back) return tl::unexpected(back.error());
        if (auto done = device_.queue().writeBuffer(*source, 0, std::as_bytes(std::span(all))); !done) {
            return tl::unexpected(done.error());
        }
        const auto code = shaders::embeddedShader("display_probe.comp");
        auto module = device_.createShaderModule({.label = "display_probe", .code = {code.begin(), code.end()}});
        if (!module) return tl::unexpected(module.error());
        auto pipeline = device_.createComputePipeline(
            {.label = "display_probe",
             .compute = {.module = *module, .constants = {{.name = "plain", .value = plain ? 1.0 : 0.0}}}});
        if (!pipeline) return tl::unexpected(pipeline.error());
        auto group =
            device_.createBindGroup({.label = "display_probe",
                                     .layout = pipeline->bindGroupLayout(0),
                                     .entries = {{.binding = 0, .resource = rhi::BufferBinding{.buffer = *source}},
                                                 {.binding = 1, .resource = rhi::BufferBinding{.buffer = *target}}}});
        if (!group) return tl::unexpected(group.error());

        auto encoder = device_.createCommandEncoder("display");
        auto pass = encoder.beginComputePass({.label = "display"});
        pass.setPipeline(*pipeline);
        pass.setBindGroup(0, *group);
        pass.dispatchWorkgroups(static_cast<std::uint32_t>(all.size() + 31) / 32);
        pass.end();
        encoder.copyBufferToBuffer(*target, 0, *back, 0, size);
        auto commands = encoder.finish();
        if (!commands) return tl::unexpected(commands.error());
        auto submission = device_.queue().submit(*commands);
        if (!submission) return tl::unexpected(submission.error());
        if (auto done = device_.queue().wait(*submission); !done) return tl::unexpected(done.error());
        std::memcpy(all.data(), back->mapped().data(), size);
        return all;
    }

    void expectAgreement(const char* view, bool plain) const {
        const auto expected = onCpu(view);
        const auto found = onGpu(plain);
        ASSERT_TRUE(found) << found.error().text();
        for (std::size_t i = 0; i < expected.size(); ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                const float want = std::clamp(expected[i][c], 0.0F, 1.0F);
                const float got = std::clamp((*found)[i][c], 0.0F, 1.0F);
                EXPECT_TRUE(std::isfinite((*found)[i][c])) << "colour " << i << " channel " << c;
                EXPECT_NEAR(want, got, 2.0F / 255.0F) << "colour " << i << " channel " << c;
            }
        }
    }

    rhi::Instance instance_;
    rhi::Device device_;
};

TEST_F(Display, AcesOnTheGpuIsOpenColorIO) {
    expectAgreement("ACES 1.0 SDR", false);
}
TEST_F(Display, PlainOnTheGpuIsOpenColorIO) {
    expectAgreement("Un-tone-mapped", true);
}

TEST(Srgb, MaterialsDecodeLikeTheConfig) {
    const auto processor =
        config()->getProcessor(ocio::ROLE_TEXTURE_PAINT, ocio::ROLE_SCENE_LINEAR)->getDefaultCPUProcessor();
    for (int i = 0; i <= 255; ++i) {
        const float encoded = static_cast<float>(i) / 255.0F;
        Color color{encoded, encoded, encoded, 1};
        processor->applyRGBA(color.data());
        EXPECT_NEAR(materials::srgbToLinear(encoded), color[0], 1e-5F) << i;
        EXPECT_NEAR(materials::linearToSrgb(materials::srgbToLinear(encoded)), encoded, 1e-5F) << i;
    }
}

}  // namespace

}  // namespace pelage::test
