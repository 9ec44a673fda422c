// SPDX-License-Identifier: MIT
// A new scattering model is a file and a row: even.glsl and row.def beside this test. Everything else here is the
// product's own source, compiled with the longer list.
#include <gtest/gtest.h>
#include <pelage/hair/functors.hpp>
#include <pelage/hair/scattering.hpp>
#include <pelage/materials/material.hpp>

#include <algorithm>
#include <numbers>

namespace pelage::test {
namespace shaders {
std::span<const std::uint32_t> embeddedShader(std::string_view name);
}
namespace {

using hair::ScatteringModel;

TEST(EleventhModel, StandsInTheCatalogue) {
    ASSERT_EQ(hair::scatteringModels().size(), 11U);
    const hair::ModelInfo* even = hair::findScatteringModel("even");
    ASSERT_NE(even, nullptr);
    EXPECT_EQ(even->model, ScatteringModel::Even);
    EXPECT_EQ(even->title, "the same in all directions");
    EXPECT_TRUE(even->reciprocal);
    EXPECT_FALSE(even->usesTable || even->usesOffset || even->nearField || even->corrected || even->controls);
}

TEST(EleventhModel, Scatters) {
    const hair::FiberProperties fiber{.color = {0.2, 0.5, 1}};
    const hair::FiberDirections directions{.sinThetaI = 0.6, .cosThetaI = 0.8, .phi = 2};
    const hair::ScatteredLobes s = hair::scatterDouble(ScatteringModel::Even, false, fiber, directions);
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_DOUBLE_EQ(s.lobe[3][c], fiber.color[c] / (std::numbers::pi * std::numbers::pi));
        EXPECT_EQ(s.lobe[0][c] + s.lobe[1][c] + s.lobe[2][c], 0);
    }
}

// The shipped material type as it is: its words and those of the shader option are the list's.
TEST(EleventhModel, IsAWordOfMaterialFiles) {
    const auto type = materials::MaterialType::load(std::string(PELAGE_MATERIALS) + "/types/hair.materialtype.json",
                                                    hair::functorRegistry());
    ASSERT_TRUE(type) << type.error().text();
    EXPECT_EQ((*type)->warnings().text(), "");
    materials::Material material(*type);
    EXPECT_TRUE(material.setFromText("scattering.model", "even").empty());
    const materials::CompiledMaterial& compiled = material.compile();
    const auto option = std::find_if(compiled.options.begin(), compiled.options.end(),
                                     [](const auto& each) { return each.name == "scatteringModel"; });
    ASSERT_NE(option, compiled.options.end());
    EXPECT_EQ(option->value, 10);
    const auto table = std::find_if(compiled.textures.begin(), compiled.textures.end(),
                                    [](const auto& each) { return each.name == "momentTable"; });
    ASSERT_NE(table, compiled.textures.end());
    EXPECT_EQ(table->value.text, hair::momentTableNone);
}

// That they compile is the test: the dispatch of each holds every model of the list.
TEST(EleventhModel, IsInTheShaders) {
    EXPECT_FALSE(shaders::embeddedShader("hair_forward.frag").empty());
    EXPECT_FALSE(shaders::embeddedShader("rows.comp").empty());
}

}  // namespace
}  // namespace pelage::test
