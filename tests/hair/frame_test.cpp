// SPDX-License-Identifier: MIT
// The frame is data: editing the pass tree or a material changes the picture, and counters tell what was paid.
#include "gpu.hpp"
#include "pictures.hpp"

#include <pelage/hair/load.hpp>

#include <gtest/gtest.h>

#include <numeric>

namespace pelage::test {
namespace {

std::string shippedTree() {
    auto bytes = hair::readFile(std::string(PELAGE_SOURCE_DIR) + "/hair/data/frames/hair_frame.pass.json");
    EXPECT_TRUE(bytes);
    return {reinterpret_cast<const char*>(bytes->data()), bytes->size()};
}

// The text of the tree without the object of the pass called `name`.
std::string withoutPass(std::string text, const std::string& name) {
    const std::size_t named = text.find("\"name\": \"" + name + "\"");
    EXPECT_NE(named, std::string::npos) << name;
    const std::size_t begin = text.rfind('{', named);
    int depth = 0;
    std::size_t end = begin;
    for (; end < text.size(); ++end) {
        if (text[end] == '{') ++depth;
        if (text[end] == '}' && --depth == 0) break;
    }
    std::size_t comma = text.find_first_not_of(" \n\r\t", end + 1);
    if (text[comma] == ',') {
        text.erase(begin, comma + 1 - begin);
    } else {
        text.erase(begin, end + 1 - begin);
        comma = text.find_last_not_of(" \n\r\t", begin - 1);
        if (text[comma] == ',') text.erase(comma, 1);
    }
    return text;
}

hair::Renderer rendererFor(const std::string& text) {
    auto tree = passes::PassTree::parse(text, "edited.pass.json");
    EXPECT_TRUE(tree) << tree.error().text();
    auto renderer = hair::Renderer::create({.device = Gpu::get().device, .tree = *tree});
    EXPECT_TRUE(renderer);
    return *renderer;
}

class Frame : public ::testing::Test {
protected:
    ValidationGuard guard;
};

TEST_F(Frame, DeletingTheShadowPassTakesTheShadowsAway) {
    hair::Scene scene = portrait(strands(), material("brown"));
    hair::Renderer whole = rendererFor(shippedTree()), edited = rendererFor(withoutPass(shippedTree(), "Shadow"));
    const double lit = meanLuminance(render(edited, scene)), shadowed = meanLuminance(render(whole, scene));
    EXPECT_GT(lit, 1.05 * shadowed);
}

TEST_F(Frame, DeletingTheBlendPassTakesBlendedHairAway) {
    hair::Scene scene = portrait(cards(), material("brown", {{"blending.mode", "alphaBlend"}}));
    hair::Renderer whole = rendererFor(shippedTree()), edited = rendererFor(withoutPass(shippedTree(), "BlendHair"));
    EXPECT_GT(compare(render(whole, scene).display, render(edited, scene).display).mean, 1.0);
}

TEST_F(Frame, ABrokenTreeKeepsTheLastGoodPicture) {
    hair::Scene scene = portrait(cards(), material("brown"));
    hair::Renderer renderer = rendererFor(shippedTree());
    const hair::Picture before = render(renderer, scene);
    const std::string text = withoutPass(shippedTree(), "Depth");
    if (auto tree = passes::PassTree::parse(text, "edited.pass.json")) {
        const auto set = renderer.setTree(*tree);
        if (!set) {
            EXPECT_EQ(render(renderer, scene).display, before.display);
        }
    }
    const auto typo = passes::PassTree::parse("{ \"format\": \"pelage.passtree/1\", \"pases\": [] }", "typo.pass.json");
    ASSERT_FALSE(typo);
    EXPECT_NE(typo.error().text().find("passes"), std::string::npos) << typo.error().text();
    EXPECT_EQ(render(renderer, scene).display, before.display);
}

// No light casts a shadow: the shadow pass is not run, and the forward shader is specialised without it.
TEST_F(Frame, NoShadowLightNoShadowPass) {
    hair::Scene scene = portrait(strands(), material("brown"));
    hair::Renderer renderer = rendererFor(shippedTree());
    const auto ran = [](const hair::Picture& picture, const std::string& pass) {
        return std::any_of(picture.report.passes.begin(), picture.report.passes.end(),
                           [&](const auto& report) { return report.name == pass; });
    };
    EXPECT_TRUE(ran(render(renderer, scene), "Shadow"));
    for (hair::Light& light : scene.lights) light.castsShadow = false;
    EXPECT_FALSE(ran(render(renderer, scene), "Shadow"));
}

// The timestamps of the passes add up to the frame: what lavapipe bins is flushed (design: passes sum to the frame).
TEST_F(Frame, PassTimesSumToTheFrame) {
    if (!Gpu::get().device.has(rhi::Feature::Timestamps)) GTEST_SKIP() << "the device has no timestamps";
    hair::Scene scene = portrait(strands(), material("brown"));
    hair::Renderer renderer = rendererFor(shippedTree());
    render(renderer, scene, 256);  // compiles the shaders
    const hair::Picture picture = render(renderer, scene, 256);
    const double sum = std::accumulate(picture.report.passes.begin(), picture.report.passes.end(), 0.0,
                                       [](double total, const auto& pass) { return total + pass.gpuMilliseconds; });
    ASSERT_GT(picture.report.gpuMilliseconds, 0);
    EXPECT_NEAR(sum / picture.report.gpuMilliseconds, 1.0, 0.1);
}

// The same frame twice asks the driver for nothing new.
TEST_F(Frame, ASecondFrameCreatesNothing) {
    hair::Scene scene = portrait(cards(), material("brown"));
    hair::Renderer renderer = rendererFor(shippedTree());
    render(renderer, scene);
    render(renderer, scene);
    const auto before = Gpu::get().device.memoryStatistics();
    const hair::Picture first = render(renderer, scene), second = render(renderer, scene);
    const auto after = Gpu::get().device.memoryStatistics();
    EXPECT_EQ(before.livePipelines, after.livePipelines);
    EXPECT_EQ(before.liveTextures, after.liveTextures);
    EXPECT_EQ(first.display, second.display);
    EXPECT_EQ(first.report.barriers, second.report.barriers);
}

TEST_F(Frame, NoObjectsIsOneClearLine) {
    hair::Scene scene;
    hair::Renderer renderer = rendererFor(shippedTree());
    const auto picture = renderer.render(scene, {.width = 16, .height = 16});
    ASSERT_FALSE(picture);
    EXPECT_EQ(picture.error().first().code, Code("N002"));
}

TEST_F(Frame, MoreLightsThanThereMayBeIsOneClearLine) {
    hair::Scene scene;
    scene.objects.push_back({.name = "head",
                             .geometry = std::make_shared<const hair::Mesh>(hair::makeHead()),
                             .material = material("skin", {})});
    scene.lights.resize(hair::maxLights + 1);
    hair::Renderer renderer = rendererFor(shippedTree());
    const auto picture = renderer.render(scene, {.width = 16, .height = 16});
    ASSERT_FALSE(picture);
    EXPECT_EQ(picture.error().first().code, Code("N003"));
}

}  // namespace
}  // namespace pelage::test
