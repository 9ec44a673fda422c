// SPDX-License-Identifier: MIT
// Material types and shaders of a host's own: they are drawn, and what does not fit together is said.
#include "gpu.hpp"
#include "material/check.hpp"
#include "pictures.hpp"

#include <pelage/hair/functors.hpp>

#include <gtest/gtest.h>

namespace pelage::test {

namespace shaders {
std::span<const std::uint32_t> embeddedShader(std::string_view name);
}

namespace {

constexpr std::string_view soundType = R"({
"format": "pelage.materialtype/1", "version": 1, "name": "Probe",
"groups": [{ "name": "g", "properties": [
  { "name": "tint", "type": "color", "space": "linear", "default": [0.2, 0.4, 0.6], "connect": { "input": "tint" } },
  { "name": "gain", "type": "float", "default": 1, "connect": { "input": "gain" } },
  { "name": "pair", "type": "float2", "default": [0.5, 0.5], "connect": { "input": "pair" } },
  { "name": "steps", "type": "int", "default": 40, "connect": { "input": "steps" } },
  { "name": "mask", "type": "uint", "default": 1, "connect": { "input": "mask" } },
  { "name": "map", "type": "texture2d", "space": "linear", "default": "builtin.black", "connect": { "input": "noiseMap" } },
  { "name": "stripes", "type": "bool", "default": false, "connect": { "option": "stripes" } },
  { "name": "rings", "type": "int", "default": 1, "min": 1, "max": 9, "connect": { "option": "rings" } },
  { "name": "also", "type": "bool", "default": false, "connect": { "shader": "also" } }
] }],
"inputs": { "tint": "color", "gain": "float", "pair": "float2", "steps": "int", "mask": "uint", "noiseMap": "texture2d" },
"options": { "stripes": { "type": "bool", "default": false }, "rings": { "type": "int", "min": 1, "max": 9, "default": 1 } },
"shaders": {
  "main": { "drawList": "forward", "vertex": "hair.vert", "fragment": "probe.frag", "options": "*",
            "state": { "depthTest": "always" } },
  "also": { "drawList": "blend", "vertex": "hair.vert", "fragment": "probe.frag", "options": "*", "enabled": false } } })";

std::string edited(std::string_view from, std::string_view to) {
    std::string text(soundType);
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

hair::Scene sceneOf(const std::string& type) {
    auto read = materials::MaterialType::parse(type, "probe.materialtype.json", hair::functorRegistry());
    EXPECT_TRUE(read) << read.error().text();
    hair::Scene scene;
    scene.objects.push_back({.name = "card", .geometry = card(), .material = materials::Material(*read)});
    scene.camera = {.eye = {0, 0, 3}, .target = {0, 0, 0}};
    return scene;
}

class HostMaterial : public ::testing::Test {
protected:
    hair::Renderer renderer(hair::PipelineMode mode = hair::PipelineMode::Synchronous) const {
        auto tree = dataLibrary().passTree("hair_frame");
        auto made = hair::Renderer::create(
            {.device = Gpu::get().device, .tree = *tree, .pipelines = mode, .shaders = shaders::embeddedShader});
        EXPECT_TRUE(made);
        return *made;
    }
    static std::string codes(const Diagnostics& found) {
        std::string out;
        for (const Diagnostic& each : found.items()) out += (out.empty() ? "" : " ") + std::string(each.code.text());
        return out;
    }
    // The error of a first frame, or its notes.
    std::string said(const std::string& type) const {
        hair::Scene scene = sceneOf(type);
        hair::Renderer drawing = renderer();
        const auto picture = drawing.render(scene, {.width = 32, .height = 32});
        return picture ? picture->report.notes.text() : toString(picture.error().first());
    }
    static glm::vec3 middle(const hair::Picture& picture) {
        const std::size_t at = 4 * (picture.height / 2 * std::size_t{picture.width} + picture.width / 2);
        return {picture.linear[at], picture.linear[at + 1], picture.linear[at + 2]};
    }

    ValidationGuard guard;
};

TEST_F(HostMaterial, ItsInputsAndOptionsReachTheShader) {
    hair::Scene scene = sceneOf(std::string(soundType));
    hair::Renderer drawing = renderer();
    const hair::Picture plain = render(drawing, scene, 64);
    EXPECT_EQ(plain.report.notes.text(), "");
    EXPECT_NEAR(middle(plain).x, 0.2F, 1e-3F);
    EXPECT_NEAR(middle(plain).z, 0.6F, 1e-3F);
    scene.objects[0].material.set("g.gain", materials::Value::scalar(2));
    scene.objects[0].material.set("g.map", materials::Value::texture("builtin.white"));
    EXPECT_NEAR(middle(render(drawing, scene, 64)).x, 1.4F, 2e-3F);
    scene.objects[0].material.set("g.mask", materials::Value::int32(0));
    EXPECT_EQ(middle(render(drawing, scene, 64)).x, 0.0F);
    scene.objects[0].material.reset();
    scene.objects[0].material.set("g.stripes", materials::Value::boolean(true));
    const hair::Picture striped = render(drawing, scene, 64);
    EXPECT_GT(compare(plain.display, striped.display).mean, 1.0);
    scene.objects[0].material.set("g.rings", materials::Value::int32(3));
    EXPECT_GT(compare(striped.display, render(drawing, scene, 64).display).mean, 1.0);
}

// Two shaders whose bindings are equal but for the name of a texture share one layout, which has the name of the first.
TEST_F(HostMaterial, NamesAreThoseOfTheShaderNotOfASharedLayout) {
    std::string twin(soundType);
    for (const auto& [from, to] : {std::pair{"probe.frag", "twin.frag"}, std::pair{"noiseMap", "grainMap"}}) {
        for (auto at = twin.find(from); at != std::string::npos; at = twin.find(from))
            twin.replace(at, std::string_view(from).size(), to);
    }
    hair::Scene scene = sceneOf(twin);
    scene.objects[0].transform[3] = glm::vec4(0, 50, 0, 1);
    scene.objects.push_back(sceneOf(std::string(soundType)).objects[0]);
    scene.objects[1].material.set("g.map", materials::Value::texture("builtin.white"));
    hair::Renderer drawing = renderer();
    EXPECT_NEAR(middle(render(drawing, scene, 64)).x, 1.2F, 2e-3F);
}

TEST_F(HostMaterial, WhatTheShaderReadsMustBeGivenAsDeclared) {
    std::string text = edited("\"gain\": \"float\",", "\"gains\": \"float\",");
    text.replace(text.find("\"input\": \"gain\""), 15, "\"input\": \"gains\"");
    EXPECT_EQ(said(text),
              "probe.frag: error M051: the uniform block has 'gain', which no input of the material type fills (type "
              "'Probe'); hint: did you mean 'gains'?");
    text = edited("\"noiseMap\": \"texture2d\"", "\"noisyMap\": \"texture2d\"");
    text.replace(text.find("\"input\": \"noiseMap\""), 19, "\"input\": \"noisyMap\"");
    EXPECT_EQ(
        said(text),
        "probe.frag: error M051: the shader samples 'noiseMap', which no texture input of the material type fills "
        "(type 'Probe'); hint: did you mean 'noisyMap'?");

    text = edited("\"gain\": \"float\",", "\"gain\": \"float3\",");
    text.replace(text.find(R"("type": "float", "default": 1)"), 29, R"("type": "float3", "default": [1, 1, 1])");
    EXPECT_EQ(
        said(text),
        "probe.frag: error M051: member 'gain' of the uniform block is float, the input is float3 (type 'Probe'); "
        "hint: write vec3");
    text = edited("\"steps\": \"int\",", "\"steps\": \"float\",");
    text.replace(text.find(R"("type": "int", "default": 40)"), 28, R"("type": "float", "default": 40)");
    EXPECT_EQ(said(text),
              "probe.frag: error M051: member 'steps' of the uniform block is int, the input is float (type 'Probe'); "
              "hint: write float");
}

TEST_F(HostMaterial, WhatNoMaterialFillsIsRefused) {
    auto read = materials::MaterialType::parse(edited("probe.frag", "greedy.frag"), "t", hair::functorRegistry());
    ASSERT_TRUE(read) << read.error().text();
    std::size_t asked = 0;
    const Diagnostics found = hair::checkShaders(**read, [&](const std::string& file) {
        ++asked;
        const auto own = shaders::embeddedShader(file);
        const auto code = own.empty() ? hair::Renderer::shaderCode(file) : own;
        auto made = Gpu::get().device.createShaderModule({.label = file, .code = {code.begin(), code.end()}});
        return made ? *made : rhi::ShaderModule();
    });
    EXPECT_EQ(asked, 3U) << "hair.vert once, greedy.frag, and probe.frag of the second use";
    const char* const wanted[] = {
        "greedy.frag: error M051: the uniform block has 'table', which no input of the material type fills",
        "greedy.frag: error M051: set 2 has a second uniform block, 'second'",
        "greedy.frag: error M051: 'Rows' in set 2 is none of what a material fills",
        "greedy.frag: error M051: the shader samples 'noiseMap' as another kind of texture than the input, which is "
        "texture2d"};
    for (const char* line : wanted)
        EXPECT_NE(found.text().find(line), std::string::npos) << line << "\n" << found.text();
    EXPECT_EQ(found.items().size(), std::size(wanted)) << found.text();
}

TEST_F(HostMaterial, WhatNoShaderReadsIsNoted) {
    std::string text = edited("\"gain\": \"float\",", "\"gain\": \"float\", \"idle\": \"float\",");
    text = text.replace(text.find("{ \"name\": \"pair\""), 0,
                        R"({ "name": "idle", "type": "float", "default": 1, "connect": { "input": "idle" } }, )");
    EXPECT_EQ(said(text),
              "probe.materialtype.json: warning M052: input 'idle' is read by no shader of the material type; hint: "
              "declare it in the uniform block of set 2, or delete the input\n");
    text = edited("\"stripes\": { \"type\"", "\"strips\": { \"type\"");
    text.replace(text.find("\"option\": \"stripes\""), 19, "\"option\": \"strips\"");
    EXPECT_EQ(said(text),
              "probe.materialtype.json: warning M050: option 'strips' is a specialization constant of no shader of the "
              "material type; hint: the shaders have 'stripes'\n");
}

TEST_F(HostMaterial, ADrawListTheTreeLacksIsNotedAtTheFirstUse) {
    hair::Scene scene = sceneOf(edited("\"blend\"", "\"blends\""));
    hair::Renderer drawing = renderer();
    const hair::Picture first = render(drawing, scene, 32);
    ASSERT_EQ(codes(first.report.notes), "M017");
    EXPECT_EQ(first.report.notes.items()[0].hint, "did you mean 'blend'?");
    EXPECT_GT(first.report.notes.items()[0].line, 1U);
    EXPECT_EQ(codes(render(drawing, scene, 32).report.notes), "");
}

TEST_F(HostMaterial, ShippedTypesGiveNothingToNote) {
    for (const char* preset : {"brown", "kajiya_brown", "pbr_brown", "skin"}) {
        hair::Scene scene;
        scene.objects.push_back({.name = "card", .geometry = card(), .material = material(preset)});
        hair::Renderer drawing = renderer();
        EXPECT_EQ(render(drawing, scene, 32).report.notes.text(), "") << preset;
    }
}

TEST_F(HostMaterial, AnUnknownShaderIsAnError) {
    const std::string text = said(edited("\"fragment\": \"probe.frag\"", "\"fragment\": \"prob.frag\""));
    EXPECT_NE(text.find("There is no shader \"prob.frag\""), std::string::npos) << text;
}

// In the background a pipeline that cannot be made leaves the picture as it was.
TEST_F(HostMaterial, AFailureInTheBackgroundKeepsWhatIsShown) {
    std::string text(soundType);
    text.replace(text.rfind("probe.frag"), 10, "hair.vert");  // no fragment shader
    hair::Scene scene = sceneOf(text);
    hair::Renderer drawing = renderer(hair::PipelineMode::Background);
    render(drawing, scene, 64);
    drawing.waitForPipelines();
    const hair::Picture good = render(drawing, scene, 64);
    EXPECT_GT(coveredFraction(good), 0.2);
    scene.objects[0].material.set("g.also", materials::Value::boolean(true));
    // The first of these frames says it if the pipeline fails before it is recorded, otherwise the second.
    Diagnostics notes = render(drawing, scene, 64).report.notes;
    drawing.waitForPipelines();
    const hair::Picture kept = render(drawing, scene, 64);
    notes.append(kept.report.notes);
    EXPECT_EQ(kept.display, good.display);
    ASSERT_EQ(notes.items().size(), 1U) << notes.text();
    EXPECT_EQ(notes.items()[0].severity, Severity::Error);
    EXPECT_TRUE(render(drawing, scene, 64).report.notes.empty()) << "said once";
}

}  // namespace
}  // namespace pelage::test
