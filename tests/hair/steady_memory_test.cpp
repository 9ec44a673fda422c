// SPDX-License-Identifier: MIT
// Frames that draw hair do not grow. Drivers may keep a variant of a shader for each value it branches on (lavapipe
// does for uniform-buffer values), so cameras, lights and materials move here while the frames are counted.
#include "gpu.hpp"
#include "pictures.hpp"

#include <pelage/hair/generate.hpp>

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>

namespace pelage::test {
namespace {

constexpr std::uint32_t size = 32;

/// Resident memory of this process, MB (10^6 bytes).
double residentMegabytes() {
    std::ifstream statm("/proc/self/statm");
    double total = 0, resident = 0;
    statm >> total >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) * 1e-6;
}

std::shared_ptr<const hair::Strands> groom(std::uint32_t seed) {
    return std::make_shared<const hair::Strands>(hair::makeGroom(
        {.style = hair::Style::Wavy, .strands = 20, .pointsPerStrand = 5, .width = 2e-3F, .seed = seed}));
}

/// Three grooms, one of each material type, under three lights, two of which cast shadows.
hair::Scene smallScene() {
    hair::Scene scene;
    scene.objects = {{.name = "hair", .geometry = groom(1), .material = material("brown")},
                     {.name = "kajiya", .geometry = groom(2), .material = material("kajiya_blond")},
                     {.name = "pbr", .geometry = groom(3), .material = material("pbr_brown")}};
    glm::vec3 low, high;
    hair::bounds(scene, true, low, high);
    scene.camera = hair::frameBox(low, high, {0.45F, 0.12F, 1.0F}, 1.0F);
    scene.lights = {{.direction = {-0.3F, -0.8F, -0.5F}},
                    {.kind = hair::Light::Kind::Point, .position = {0.5F, 2.2F, 0.6F}, .intensity = 1.0F},
                    {.direction = {0.6F, -0.2F, 0.7F}, .castsShadow = false}};
    return scene;
}

/// Values that change every frame without another pipeline: a camera that turns, lights that move and fade, materials.
void move(hair::Scene& scene, std::uint32_t frame) {
    const float t = 0.01F * static_cast<float>(frame + 1);
    const glm::vec3 away = scene.camera.eye - scene.camera.target;
    scene.camera.eye = scene.camera.target + glm::length(away) * glm::vec3(std::sin(t), 0.2F, std::cos(t));
    scene.lights[0].direction = {std::sin(t), -0.8F, std::cos(t)};
    scene.lights[0].intensity = 2.0F + std::sin(t);
    scene.lights[1].position = {0.5F * std::cos(t), 2.2F, 0.6F + 0.1F * std::sin(t)};
    scene.lights[2].color = {0.5F, 0.5F + 0.4F * std::sin(3 * t), 0.7F};
    EXPECT_TRUE(
        scene.objects[0]
            .material.setFromText("shadowing.falloffDistance", std::to_string(0.02 + 0.01 * std::sin(double(t))))
            .empty());
    EXPECT_TRUE(scene.objects[1]
                    .material.setFromText("specular.exponent", std::to_string(30 + 10 * std::sin(double(t))))
                    .empty());
}

constexpr std::uint32_t frameCount = 1000;  // still, and as many moving

constexpr double allowed = 20;  // MB that may come over these

/// Draws `frame(i)` often enough to warm up, then so many times still and so many times moving.
template <class Frame>
void expectSteady(hair::Scene& scene, const Frame& frame) {
    double before = 0;
    const auto frames = [&](std::uint32_t count, bool moving, const char* what) {
        for (std::uint32_t i = 0; i < count && !::testing::Test::HasFailure(); ++i) {
            if (moving) move(scene, i);
            frame(i);
            if (before > 0 && i % 50 == 49) {  // said at once: frames that grow are slow, too
                EXPECT_LT(residentMegabytes() - before, allowed) << "MB over " << i + 1 << ' ' << what << " frames";
            }
        }
        return residentMegabytes();
    };
    before = frames(50, true, "first");
    const double still = frames(frameCount, false, "still"), moved = frames(frameCount, true, "moving");
    std::printf("resident: %.1f MB, after %u still frames %.1f MB, after %u moving ones %.1f MB\n", before, frameCount,
                still, frameCount, moved);
}

const std::map<std::string, passes::SettingValue> smallMap = {
    {"shadowSize", {passes::SettingValue::Type::Uint, 256, {}}}};

TEST(SteadyMemory, HairFramesDoNotGrow) {
    hair::Renderer renderer = makeRenderer();
    hair::Scene scene = smallScene();
    expectSteady(scene, [&](std::uint32_t i) {
        auto picture = renderer.render(scene, {.width = size, .height = size, .settings = smallMap, .frameIndex = i});
        ASSERT_TRUE(picture) << picture.error().text();
    });
}

// The same in a host's frame, which shades the shadow on the host's picture with a loop over the lights.
TEST(SteadyMemory, HostFramesDoNotGrow) {
    const rhi::Device device = Gpu::get().device;
    hair::Renderer renderer = makeRenderer("hair_host");
    hair::Scene scene = smallScene();
    const auto image = [&](rhi::TextureFormat format, const char* label) {
        return value(
            device.createTexture({.label = label,
                                  .size = {size, size, 1},
                                  .format = format,
                                  .usage = rhi::TextureUsage::RenderAttachment | rhi::TextureUsage::TextureBinding}));
    };
    hair::FrameSettings settings = {.width = size, .height = size, .settings = smallMap};
    const rhi::Texture color = image(rhi::TextureFormat::RGBA16Float, "scene color");
    const rhi::Texture depth = image(rhi::TextureFormat::Depth32Float, "scene depth");
    const rhi::TextureView colorView = value(color.createView()), depthView = value(depth.createView());
    settings.imports = {{"SceneColor", color}, {"SceneDepth", depth}};
    expectSteady(scene, [&](std::uint32_t i) {
        settings.frameIndex = i;
        auto encoder = device.createCommandEncoder("frame");
        encoder
            .beginRenderPass({.label = "host",
                              .colorAttachments = {{.view = colorView}},
                              .depthStencilAttachment = {{.view = depthView, .depthClearValue = 0.01F}}})
            .end();
        auto encoded = renderer.encode(scene, settings, encoder);
        ASSERT_TRUE(encoded) << encoded.error().text();
        const auto done = value(device.queue().submit(value(encoder.finish())));
        EXPECT_TRUE(value(device.queue().wait(done)));
        Gpu::get().device.collect();
    });
}

}  // namespace
}  // namespace pelage::test
