// SPDX-License-Identifier: MIT
// A compute pass that shades with a material: what the sample's pass class writes is what the CPU says, for every
// model.
#include "gpu.hpp"
#include "shade_points.hpp"

#include <gtest/gtest.h>

#include <pelage/hair/functors.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace pelage::test {
namespace {

class ComputeShading : public GpuTest {
protected:
    void SetUp() override {
        GpuTest::SetUp();
        auto made = sample::shadingMaterial(library);
        ASSERT_TRUE(made) << made.error().text();
        material.emplace(std::move(*made));
        auto read = library.passTree(PELAGE_SOURCE_DIR "/samples/compute_shading/shading.pass.json");
        ASSERT_TRUE(read) << read.error().text();
        tree = *read;
    }
    std::vector<glm::vec4> shade(hair::Scene& scene, const std::vector<glm::vec4>& points) {
        auto made = sample::shadeOnDevice(gpu.device, tree, scene, points);
        EXPECT_TRUE(made) << made.error().text();
        return made ? *made : std::vector<glm::vec4>(points.size());
    }

    hair::Library library = hair::Library(PELAGE_DATA_DIR);
    std::optional<materials::Material> material;
    std::shared_ptr<const passes::PassTree> tree;
};

// Largest difference, as a share of the largest radiance along the strand.
double difference(const std::vector<glm::vec4>& made, const std::vector<glm::dvec3>& truth) {
    double largest = 0, off = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            largest = std::max(largest, truth[i][c]);
            off = std::max(off, std::abs(static_cast<double>(made[i][c]) - truth[i][c]));
        }
    }
    return off / largest;
}

TEST_F(ComputeShading, IsWhatTheModelSaysOnTheCpu) {
    const std::vector<glm::vec4> points = sample::strand(100);
    const materials::Property& property = *material->type().find("scattering.model");
    ASSERT_EQ(property.words.size(), hair::scatteringModels().size());
    for (std::size_t model = 0; model < property.words.size(); ++model) {
        ASSERT_TRUE(material->setFromText("scattering.model", property.words[model]).empty());
        hair::Scene scene = sample::shadingScene(*material);
        const auto made = shade(scene, points);
        const auto truth = sample::shadeOnCpu(scene, points);
        for (const glm::vec4& one : made) ASSERT_EQ(one.w, 1.0F) << "every point is written";
        const auto [least, most] =
            std::minmax_element(truth.begin(), truth.end(), [](const auto& a, const auto& b) { return a.g < b.g; });
        EXPECT_LT(least->g, 0.8 * most->g) << "a strand that is lit evenly would tell nothing";
        // Float against double: the most is 3.2e-5, of the model that has no table.
        EXPECT_LT(difference(made, truth), 1e-4) << property.words[model];
    }
}

// What the material says reaches the shader through set 2, and what the scene says through the others.
TEST_F(ComputeShading, FollowsMaterialObjectAndLights) {
    const std::vector<glm::vec4> points = sample::strand(70);  // two workgroups, the second not full
    hair::Scene scene = sample::shadingScene(*material);
    const auto before = shade(scene, points);
    const auto changed = [&](const char* what) {
        const auto now = shade(scene, points);
        EXPECT_LT(difference(now, sample::shadeOnCpu(scene, points)), 1e-4) << what;
        EXPECT_TRUE(now != before) << what;
    };
    scene.lights.pop_back();
    changed("a light");
    scene = sample::shadingScene(*material);
    scene.objects[0].transform[3] += glm::vec4(0.1F, 0, 0, 0);
    changed("the object's place");
    scene = sample::shadingScene(*material);
    ASSERT_TRUE(scene.objects[0].material.setFromText("scattering.azimuthalRoughness", "0.6").empty());
    changed("a number of the material");
    scene = sample::shadingScene(*material);
    ASSERT_TRUE(scene.objects[0].material.setFromText("scattering.weightTT", "0").empty());
    const auto without = shade(scene, points);
    EXPECT_TRUE(without != before) << "an option: TT is compiled out";
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LE(without[i].g, before[i].g * 1.00001F) << i;
}

TEST_F(ComputeShading, AnObjectWithoutTheShaderIsLeftOut) {
    const std::vector<glm::vec4> points = sample::strand(64);
    hair::Scene scene = sample::shadingScene(*material);
    const auto alone = shade(scene, points);
    auto skin = library.material("skin");
    ASSERT_TRUE(skin);
    scene.objects.push_back({.name = "head",
                             .geometry = scene.objects[0].geometry,
                             .material = skin->material,
                             .transform = glm::mat4(3.0F)});
    EXPECT_TRUE(shade(scene, points) == alone);
}

// The shader reads a fibre, and Kajiya and Kay's material describes none: said before anything is dispatched.
TEST_F(ComputeShading, AShaderThatWantsMoreThanTheTypeGivesIsRefused) {
    const std::string file = std::string(PELAGE_DATA_DIR) + "/types/kajiya_kay.materialtype.json";
    std::ifstream in(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::string shaders = "\"shaders\": {";
    ASSERT_NE(text.find(shaders), std::string::npos);
    text.insert(text.find(shaders) + shaders.size(), R"("points": { "drawList": "shade", "compute": "points.comp" },)");
    const auto type = materials::MaterialType::parse(text, file, hair::functorRegistry());
    ASSERT_TRUE(type) << type.error().text();
    hair::Scene scene = sample::shadingScene(materials::Material(*type));
    const auto made = sample::shadeOnDevice(gpu.device, tree, scene, sample::strand(4));
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().first().code, Code("M051")) << made.error().text();
    EXPECT_EQ(made.error().first().file, "points.comp") << made.error().text();
}

TEST_F(ComputeShading, APassThatCannotBeRegisteredIsRefused) {
    const auto named = [&](const char* name, bool dispatches) {
        hair::MaterialPass pass{.info = {.name = name}};
        if (dispatches) pass.dispatch = [](const hair::MaterialDispatch&) -> Result<void> { return {}; };
        auto made = hair::Renderer::create({.device = gpu.device, .tree = tree, .materialPasses = {pass}});
        return made ? std::string("made") : std::string(made.error().first().code.text());
    };
    EXPECT_EQ(named("ShadePoints", true), "made");
    EXPECT_EQ(named("ShadePoints", false), "N004");
    EXPECT_EQ(named("DrawList", true), "N004");
    EXPECT_EQ(named("", true), "N004");
}

}  // namespace
}  // namespace pelage::test
