// SPDX-License-Identifier: MIT
#include "support.hpp"

#include <cmath>
#include <limits>

using namespace pelage;
using namespace pelage::materials;
using namespace pelage::materials::test;

TEST(Material, FunctorsRunOnlyWhenAnInputChanged) {
    Material material(shipped("hair"));
    EXPECT_EQ(material.compile().functorRuns, 8U) << "each once";
    EXPECT_EQ(material.compile().functorRuns, 8U) << "nothing changed";
    material.set("scattering.ior", Value::scalar(1.6F));
    EXPECT_EQ(material.compile().functorRuns, 9U) << "shape alone";
    material.set("scattering.ior", Value::scalar(1.6F));
    EXPECT_EQ(material.compile().functorRuns, 9U) << "the same value is no change";
    material.set("scattering.azimuthalRoughness", Value::scalar(0.4F));
    EXPECT_EQ(material.compile().functorRuns, 11U) << "shape and colour";
    material.set("shadowing.depthBias", Value::scalar(0.01F));
    EXPECT_EQ(material.compile().functorRuns, 11U) << "connected without a functor";
    material.set("scattering.ior", Value::scalar(9.0F));
    material.compile();
    material.set("scattering.ior", Value::scalar(10.0F));
    EXPECT_EQ(material.compile().functorRuns, 12U) << "both clamp to the same value";
}

TEST(Material, VersionsGrowOnlyOnRealChange) {
    Material material(shipped("hair"));
    const auto versions = [&] {
        const CompiledMaterial& compiled = material.compile();
        return std::pair(compiled.inputsVersion, compiled.pipelineVersion);
    };
    EXPECT_EQ(versions(), std::pair(std::uint64_t{1}, std::uint64_t{1}));
    EXPECT_EQ(versions(), std::pair(std::uint64_t{1}, std::uint64_t{1}));
    material.set("shadowing.falloffDistance", Value::scalar(0.05F));
    EXPECT_EQ(versions(), std::pair(std::uint64_t{2}, std::uint64_t{1}));
    material.set("scattering.attenuation", {ValueType::Enum, {}, 0, "karisH"});
    EXPECT_EQ(versions(), std::pair(std::uint64_t{2}, std::uint64_t{2}));
    material.set("scattering.enableTT", Value::boolean(false));
    EXPECT_EQ(versions(), std::pair(std::uint64_t{3}, std::uint64_t{3}));
    material.set("scattering.weightTT", Value::scalar(0.3F));
    EXPECT_EQ(versions(), std::pair(std::uint64_t{3}, std::uint64_t{3})) << "weight of a lobe that is off";
    material.set("surface.colorMap", Value::texture("a.png"));
    EXPECT_EQ(versions(), std::pair(std::uint64_t{4}, std::uint64_t{3})) << "a texture that is not used yet";
    material.set("surface.useColorMap", Value::boolean(true));
    EXPECT_EQ(versions(), std::pair(std::uint64_t{4}, std::uint64_t{4}));
    material.set("blending.doubleSided", Value::boolean(false));
    EXPECT_EQ(versions(), std::pair(std::uint64_t{4}, std::uint64_t{5})) << "cull mode";
    material.set("absorption.eumelanin", Value::scalar(2));
    EXPECT_EQ(versions(), std::pair(std::uint64_t{4}, std::uint64_t{5})) << "pigments are not what gives the colour";
}

TEST(Material, WhatIsNotUsedIsOff) {
    Material material(shipped("hair"));
    material.compile();
    for (const auto& [property, optionName] :
         {std::pair{"scattering.weightR", "lobeR"}, std::pair{"scattering.weightTT", "lobeTT"},
          std::pair{"scattering.weightTRT", "lobeTRT"}, std::pair{"environment.intensity", "envOn"},
          std::pair{"globalScattering.factor", "ambientOn"}}) {
        EXPECT_EQ(option(material.compile(), optionName), 1.0) << optionName;
        material.setFromText(property, "0");
        EXPECT_EQ(option(material.compile(), optionName), 0.0) << optionName;
        const auto& constants = shader(material.compile(), "forward").constants;
        for (const auto& constant : constants) {
            if (constant.name == optionName) {
                EXPECT_EQ(constant.value, 0.0);
            }
        }
    }
}

TEST(Material, RangesHoldAndNonsenseIsRefused) {
    Material material(shipped("hair"));
    const std::string roughness = "scattering.longitudinalRoughness";
    const auto warning = material.set(roughness, Value::scalar(3));
    ASSERT_TRUE(warning);
    EXPECT_EQ(warning->severity, Severity::Warning);
    EXPECT_EQ(warning->code, Code("V005"));
    EXPECT_EQ(material.get(roughness)->number[0], 1.0F);
    EXPECT_EQ(codeOf(material.set(roughness, Value::scalar(0.001F))), "V005");
    EXPECT_EQ(material.get(roughness)->number[0], 0.02F);
    EXPECT_EQ(codeOf(material.set(roughness, Value::scalar(0.02F))), "none") << "the bound itself is inside";
    const Value before = *material.get(roughness);
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity()}) {
        EXPECT_EQ(codeOf(material.set(roughness, Value::scalar(bad))), "V013");
        EXPECT_EQ(codeOf(material.set("surface.baseColor", Value::color(0, bad, 0))), "V013");
    }
    EXPECT_EQ(codeOf(material.set(roughness, Value::boolean(true))), "V003");
    EXPECT_EQ(codeOf(material.set(roughness, Value::float3(1, 1, 1))), "V003");
    EXPECT_EQ(codeOf(material.set("scattering.nothing", Value::scalar(1))), "V002");
    EXPECT_EQ(codeOf(material.set("blending.mode", {ValueType::Enum, {}, 0, "cutout"})), "V004");
    EXPECT_EQ(codeOf(material.set("blending.mode", {ValueType::Enum, {}, 99, ""})), "V004");
    EXPECT_EQ(codeOf(material.set("blending.mode", {ValueType::Enum, {}, -1, ""})), "V004");
    EXPECT_EQ(*material.get(roughness), before);
    EXPECT_EQ(codeOf(material.set("blending.mode", {ValueType::Enum, {}, 4, ""})), "none");
    EXPECT_EQ(material.get("blending.mode")->text, "alphaBlend");
    EXPECT_EQ(codeOf(material.set("shadowing.pcfRadius", Value::int32(99))), "V005");
    EXPECT_EQ(material.get("shadowing.pcfRadius")->integer, 3);
    EXPECT_EQ(codeOf(material.set("surface.baseColor", Value::float3(0.1F, 0.2F, 0.3F))), "none");
    EXPECT_EQ(material.get("surface.baseColor")->type, ValueType::Color);
    EXPECT_EQ(material.get("nothing"), nullptr);
}

TEST(Material, TextIsReadAsPeopleWriteIt) {
    Material material(shipped("hair"));
    const std::pair<std::string_view, std::string_view> good[] = {{"scattering.longitudinalRoughness", " 0.3 "},
                                                                  {"environment.enable", "false"},
                                                                  {"environment.enable", "on"},
                                                                  {"blending.mode", "hashedAlpha"},
                                                                  {"surface.baseColor", "0.8, 0.5,0.2"},
                                                                  {"surface.baseColor", "#805030"},
                                                                  {"surface.colorMap", "hair/color.png"},
                                                                  {"shadowing.pcfRadius", "2"},
                                                                  {"scattering.cuticleTilt", "-3e0"}};
    for (const auto& [id, text] : good) EXPECT_EQ(codeOf(material.setFromText(id, text)), "none") << id << " " << text;
    EXPECT_EQ(material.get("scattering.longitudinalRoughness")->number[0], 0.3F);
    EXPECT_EQ(material.get("environment.enable")->integer, 1);
    EXPECT_NEAR(material.get("surface.baseColor")->number[0], srgbToLinear(128.0F / 255.0F), 1e-6F);
    EXPECT_NEAR(material.get("surface.baseColor")->number[1], 0.0802F, 1e-3F);
    EXPECT_EQ(material.get("surface.colorMap")->text, "hair/color.png");
    EXPECT_EQ(material.get("shadowing.pcfRadius")->integer, 2);
    const std::tuple<std::string_view, std::string_view, std::string_view> bad[] = {
        {"scattering.longitudinalRoughness", "wide", "V003"},
        {"scattering.longitudinalRoughness", "", "V003"},
        {"scattering.longitudinalRoughness", "0.1,0.2", "V003"},
        {"scattering.longitudinalRoughness", "nan", "V013"},
        {"scattering.longitudinalRoughness", "inf", "V013"},
        {"scattering.longitudinalRoughness", "0,3", "V003"},
        {"shadowing.pcfRadius", "1.5", "V003"},
        {"shadowing.pcfRadius", "7", "V005"},
        {"blending.mode", "Opaque", "V004"},
        {"environment.enable", "maybe", "V003"},
        {"surface.baseColor", "#80503", "V003"},
        {"surface.baseColor", "#80503g", "V003"},
        {"surface.baseColor", "1,2", "V003"},
        {"surface.baseColor", "1e300,0,0", "V005"},
        {"surface.colorMap", "", "V003"},
        {"none.such", "1", "V002"}};
    for (const auto& [id, text, code] : bad)
        EXPECT_EQ(codeOf(material.setFromText(id, text)), code) << id << " " << text;
}

TEST(Material, PresetsResetAndVisibility) {
    Material material(shipped("hair"));
    EXPECT_EQ(codeOf(material.applyPreset("opaqueTest")), "none");
    EXPECT_EQ(material.get("blending.mode")->text, "opaque");
    const auto unknown = material.applyPreset("opaqeTest");
    ASSERT_TRUE(unknown);
    EXPECT_EQ(unknown->hint, "did you mean 'opaqueTest'?");
    EXPECT_FALSE(material.isVisible("blending.threshold"));
    EXPECT_FALSE(material.isVisible("shadowing.falloffDistance"));
    EXPECT_FALSE(material.isEnabled("environment.intensity"));
    material.reset();
    EXPECT_TRUE(material.isVisible("blending.threshold"));
    EXPECT_FALSE(material.isVisible("blending.hashScale"));
    EXPECT_TRUE(material.isEnabled("environment.intensity"));
    EXPECT_TRUE(material.isVisible("no.such"));
    EXPECT_EQ(*material.get("blending.mode"), material.type().find("blending.mode")->defaultValue);
}

TEST(Material, ColorsInFilesBecomeLinear) {
    Material material(shipped("hair"));
    const CompiledMaterial& compiled = material.compile();
    EXPECT_NEAR(number(compiled, "baseColor", 0), 0.1005F, 1e-3F);
    EXPECT_NEAR(number(compiled, "baseColor", 2), 0.0072F, 1e-3F);
    for (float value = 0; value <= 2.0F; value += 0.01F) EXPECT_NEAR(linearToSrgb(srgbToLinear(value)), value, 2e-5F);
    EXPECT_EQ(srgbToLinear(1.0F), 1.0F);
    EXPECT_NEAR(srgbToLinear(0.5F), 0.21404F, 1e-5F);
}

TEST(Material, CopiesAreIndependent) {
    Material one(shipped("hair"));
    one.compile();
    Material two = one;
    two.set("scattering.ior", Value::scalar(2.0F));
    EXPECT_NE(number(two.compile(), "fiber0"), number(one.compile(), "fiber0"));
    EXPECT_EQ(one.compile().functorRuns, 8U);
}

TEST(ValueTypes, NamesGoBothWays) {
    for (int i = 0; i <= static_cast<int>(ValueType::TextureCube); ++i) {
        ValueType type = ValueType::Bool;
        EXPECT_TRUE(valueTypeFromName(name(static_cast<ValueType>(i)), type));
        EXPECT_EQ(static_cast<int>(type), i);
    }
    ValueType type = ValueType::Enum;
    EXPECT_FALSE(valueTypeFromName("float5", type));
    EXPECT_EQ(type, ValueType::Enum);
}
