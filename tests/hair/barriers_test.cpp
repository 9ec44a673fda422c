// SPDX-License-Identifier: MIT
// The shipped frames before the hazard oracle, on a driver that does nothing: no barrier is missing, each that is there
// is needed, and how many there are is written down.
#include "support/null_driver.hpp"

#include <pelage/hair/generate.hpp>
#include <pelage/hair/library.hpp>
#include <pelage/hair/renderer.hpp>
#include <pelage/rhi/vulkan.hpp>

#include <gtest/gtest.h>

namespace pelage::test {
namespace {

template <class T>
auto good(T result) {
    if constexpr (std::is_same_v<typename T::error_type, Diagnostic>) {
        EXPECT_TRUE(result.has_value()) << result.error().text();
    } else {
        EXPECT_TRUE(result.has_value());
    }
    if constexpr (!std::is_void_v<typename T::value_type>) return std::move(*result);
}

struct Outcome {
    std::vector<std::string> hazards;
    std::uint64_t barriers = 0;           // calls, of all frames
    std::vector<std::uint32_t> perFrame;  // counted by the library
};

/// Three frames of cards and strands, in a tree of the library; without barrier call `drop`.
Outcome frames(const std::string& treeName, std::optional<std::uint64_t> drop = {}) {
    NullDriver driver;
    HazardOracle oracle;
    driver.oracle = &oracle;
    driver.dropBarrier = drop;
    Outcome outcome;
    {
        const auto instance = good(rhi::vulkan::createInstance({}, NullDriver::entry()));
        const auto adapter = good(instance.requestAdapter());
        const auto device = good(adapter.requestDevice({.optionalFeatures = adapter.info().features}));
        hair::Library library(PELAGE_DATA_DIR);
        auto renderer = good(hair::Renderer::create({.device = device, .tree = good(library.passTree(treeName))}));
        auto groom = hair::makeGroom({.style = hair::Style::Wavy, .strands = 40, .pointsPerStrand = 6});
        hair::Scene scene;
        const auto add = [&](const char* name, hair::Geometry geometry, const char* preset) {
            scene.objects.push_back(
                {.name = name, .geometry = std::move(geometry), .material = good(library.material(preset)).material});
        };
        add("strands", std::make_shared<hair::Strands>(groom), "brown");
        add("more", std::make_shared<hair::Strands>(groom), "blond");
        scene.lights = {{}, {.direction = {1, -1, 0}}};
        hair::FrameSettings settings = {.width = 64, .height = 64};
        const auto image = [&](rhi::TextureFormat format, const char* label) {
            return good(device.createTexture(
                {.label = label,
                 .size = {64, 64, 1},
                 .format = format,
                 .usage = rhi::TextureUsage::RenderAttachment | rhi::TextureUsage::TextureBinding}));
        };
        if (treeName == "hair_host") {
            settings.imports["SceneColor"] = image(rhi::TextureFormat::RGBA16Float, "scene color");
            settings.imports["SceneDepth"] = image(rhi::TextureFormat::Depth32Float, "scene depth");
        }
        for (std::uint32_t frame = 0; frame < 3; ++frame) {
            settings.frameIndex = frame;
            auto encoder = device.createCommandEncoder("frame");
            if (treeName == "hair_host") {  // what the host draws
                auto pass = encoder.beginRenderPass(
                    {.label = "host",
                     .colorAttachments = {{.view = good(settings.imports["SceneColor"].createView())}},
                     .depthStencilAttachment = {{.view = good(settings.imports["SceneDepth"].createView())}}});
                pass.end();
            }
            good(renderer.encode(scene, settings, encoder));
            const auto commands = good(encoder.finish());
            good(device.queue().submit(commands));
            outcome.perFrame.push_back(commands.counters().barriers);
        }
        outcome.hazards = oracle.hazards();
        outcome.barriers = driver.barrierCalls;
    }
    EXPECT_TRUE(driver.alive().empty()) << "leaked " << driver.alive().front();
    EXPECT_TRUE(driver.misuse().empty()) << driver.misuse().front();
    return outcome;
}

class ShippedFrames : public ::testing::TestWithParam<const char*> {};

TEST_P(ShippedFrames, MissNoBarrierAndNeedEachOfTheirs) {
    const auto whole = frames(GetParam());
    ASSERT_TRUE(whole.hazards.empty()) << whole.hazards.front();
    for (std::uint64_t i = 0; i < whole.barriers; ++i)
        EXPECT_FALSE(frames(GetParam(), i).hazards.empty())
            << "barrier " << i << " of " << whole.barriers << " may be deleted and nobody sees it";
}

TEST_P(ShippedFrames, HaveAsManyBarriersAsTheyHadWhenThisWasWritten) {
    const auto whole = frames(GetParam());
    const std::uint32_t expected = std::string(GetParam()) == "hair_host" ? 8 : 7;
    ASSERT_EQ(whole.perFrame.size(), 3U);
    EXPECT_EQ(whole.perFrame[1], expected);
    EXPECT_EQ(whole.perFrame[2], expected) << "a frame like the one before it costs what that did";
}

INSTANTIATE_TEST_SUITE_P(Trees, ShippedFrames, ::testing::Values("hair_frame", "hair_host"),
                         [](const auto& of) { return std::string(of.param); });

}  // namespace
}  // namespace pelage::test
