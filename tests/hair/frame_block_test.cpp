// SPDX-License-Identifier: MIT
// What C++ and shaders must agree on about set 0, lights and shadows: block layout, words, numbers. And what it takes
// to add a kind of light or a shadow technique, done once with lists of this test's own (tests/hair/extra).
#include "frame/views.hpp"
#include "gpu.hpp"
#include "lighting/shadow.hpp"
#include "pictures.hpp"

#include <pelage/base/json.hpp>
#include <pelage/hair/functors.hpp>
#include <pelage/hair/scene_file.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>

namespace pelage::test {

namespace shaders {
std::span<const std::uint32_t> embeddedShader(std::string_view name);
}

namespace {

// std140, for the types the lists use: https://registry.khronos.org/OpenGL/specs/gl/glspec46.core.pdf, 7.6.2.2.
struct Layout {
    std::size_t at = 0;
    constexpr std::size_t place(std::size_t size, std::size_t alignment) {
        const std::size_t offset = (at + alignment - 1) / alignment * alignment;
        at = offset + size;
        return offset;
    }
};
template <class T>
struct Std140;
template <>
struct Std140<float> {
    static constexpr std::size_t size = 4, alignment = 4;
};
template <>
struct Std140<int> : Std140<float> {};
template <>
struct Std140<std::uint32_t> : Std140<float> {};
template <>
struct Std140<glm::vec2> {
    static constexpr std::size_t size = 8, alignment = 8;
};
template <>
struct Std140<glm::vec3> {
    static constexpr std::size_t size = 12, alignment = 16;
};
template <>
struct Std140<glm::mat4> {
    static constexpr std::size_t size = 64, alignment = 16;
};

constexpr bool lightIsStd140() {
    Layout layout;
    bool right = true;
#define PELAGE_LIGHT_MEMBER(type, name)                                                                      \
    right = right &&                                                                                         \
            offsetof(hair::LightBlock, name) == layout.place(Std140<decltype(hair::LightBlock::name)>::size, \
                                                             Std140<decltype(hair::LightBlock::name)>::alignment);
#include "lighting/light.def"
    return right && sizeof(hair::LightBlock) == (layout.at + 15) / 16 * 16;
}
static_assert(lightIsStd140());

constexpr bool frameIsStd140() {
    Layout layout;
    bool right = true;
#define PELAGE_FRAME_MEMBER(type, name)                                                                      \
    right = right &&                                                                                         \
            offsetof(hair::FrameBlock, name) == layout.place(Std140<decltype(hair::FrameBlock::name)>::size, \
                                                             Std140<decltype(hair::FrameBlock::name)>::alignment);
#include "shaders/frame.def"
    return right && offsetof(hair::FrameBlock, lights) == layout.place(sizeof(hair::LightBlock) * hair::maxLights, 16);
}
static_assert(frameIsStd140());

rhi::ShaderModule module(std::span<const std::uint32_t> code) {
    return value(Gpu::get().device.createShaderModule({.label = "shader", .code = {code.begin(), code.end()}}));
}

const rhi::ReflectedBinding* block(const rhi::ShaderModule& module, std::uint32_t group) {
    for (const rhi::ReflectedBinding& each : module.reflection().bindings)
        if (each.group == group && each.entry.type == rhi::BindingType::UniformBuffer) return &each;
    return nullptr;
}

void expectMember(const rhi::ReflectedBinding& block, std::string_view name, std::size_t offset, std::size_t size) {
    const auto found = std::find_if(block.members.begin(), block.members.end(),
                                    [&](const rhi::BlockMember& member) { return member.name == name; });
    ASSERT_NE(found, block.members.end()) << name;
    EXPECT_EQ(found->offset, offset) << name;
    EXPECT_EQ(found->size, size) << name;
}

TEST(FrameBlock, LiesInShadersAsInCpp) {
    for (const char* shader : {"hair.vert", "hair_forward.frag"}) {
        const rhi::ShaderModule made = module(hair::Renderer::shaderCode(shader));
        const rhi::ReflectedBinding* frame = block(made, 0);
        ASSERT_NE(frame, nullptr) << shader;
        EXPECT_EQ(frame->blockSize, sizeof(hair::FrameBlock)) << shader;
#define PELAGE_FRAME_MEMBER(type, name) \
    expectMember(*frame, #name, offsetof(hair::FrameBlock, name), sizeof(hair::FrameBlock::name));
#include "shaders/frame.def"
        expectMember(*frame, "lights", offsetof(hair::FrameBlock, lights), sizeof(hair::FrameBlock::lights));
    }
    // The members of one light, as a block of their own.
    const rhi::ShaderModule made = module(shaders::embeddedShader("light_block.frag"));
    const rhi::ReflectedBinding* light = block(made, 0);
    ASSERT_NE(light, nullptr);
#define PELAGE_LIGHT_MEMBER(type, name) \
    expectMember(*light, #name, offsetof(hair::LightBlock, name), sizeof(hair::LightBlock::name));
#include "lighting/light.def"
}

std::vector<std::string> stringsOf(const json::Value& list) {
    std::vector<std::string> words;
    for (const json::Value& word : list.elements) words.push_back(word.string);
    return words;
}

// Files that editors read name the words once more.
TEST(LightingLists, WordsInFilesAreThoseOfTheLists) {
    const std::string data = PELAGE_DATA_DIR;
    auto schema = json::parseFile(data + "/schemas/scene.schema.json");
    ASSERT_TRUE(schema);
    const json::Value* kind = &schema->root;
    for (const char* step : {"$defs", "light", "properties", "kind", "examples"}) {
        kind = kind->find(step);
        ASSERT_NE(kind, nullptr) << step;
    }
    std::vector<std::string> kinds;
    for (const hair::LightKindInfo& info : hair::lightKinds()) kinds.emplace_back(info.word);
    EXPECT_EQ(stringsOf(*kind), kinds);
    for (const char* type : {"hair", "kajiya_kay", "standard_pbr"}) {
        auto read = dataLibrary().material(type == std::string("hair")         ? "brown"
                                           : type == std::string("kajiya_kay") ? "kajiya_brown"
                                                                               : "pbr_brown");
        ASSERT_TRUE(read) << type;
        const auto& options = read->material.type().options();
        const auto option =
            std::find_if(options.begin(), options.end(), [](const auto& o) { return o.name == "shadowMode"; });
        ASSERT_NE(option, options.end()) << type;
        EXPECT_EQ(option->words, hair::shadowTechniqueWords()) << type;
    }
}

TEST(LightingLists, AnUnknownKindInASceneIsNamedWithTheNearest) {
    const std::string path = (std::filesystem::temp_directory_path() / "pelage_light_kind.scene.json").string();
    std::ofstream(path) << R"({ "format": "pelage.scene/1",
  "objects": [{ "name": "head", "generate": { "kind": "head" } }],
  "lights": [{ "kind": "piont", "position": [0, 1, 0] }] })";
    const auto scene = hair::loadScene(path, dataLibrary());
    std::filesystem::remove(path);
    ASSERT_FALSE(scene);
    const std::string said = scene.error().text();
    EXPECT_NE(said.find("piont"), std::string::npos) << said;
    EXPECT_NE(said.find("did you mean \"point\""), std::string::npos) << said;
    EXPECT_NE(said.find(":3:"), std::string::npos) << said;
}

TEST(LightingLists, OptionsSayWhichLightsThereAre) {
    hair::Scene scene;
    scene.lights = {{.castsShadow = false},
                    {.kind = hair::Light::Kind::Point},
                    {.kind = hair::Light::Kind::Point, .castsShadow = false},
                    {},
                    {}};
    EXPECT_EQ(hair::countShadowLights(scene), 3U);
    const hair::LightOptions options = hair::lightOptions(scene, 2);
    EXPECT_EQ(options.count, 5U);
    EXPECT_EQ(options.kinds, 0x00110U);
    EXPECT_EQ(options.shadows, 0b01010U) << "the third has no layer left";
    scene.lights.assign(hair::maxLights, {.kind = hair::Light::Kind::Point});
    EXPECT_EQ(hair::lightOptions(scene, 8), (hair::LightOptions{8, 0x11111111U, 0xFFU}));
}

constexpr std::string_view extraType = R"({
"format": "pelage.materialtype/1", "version": 1, "name": "Extra",
"groups": [{ "name": "g", "properties": [
  { "name": "density", "type": "float", "default": 0.25, "connect": { "input": "density" } },
  { "name": "technique", "type": "int", "default": 0, "min": 0, "max": 4, "connect": { "option": "shadowMode" } }
] }],
"inputs": { "density": "float" },
"options": { "shadowMode": { "type": "int", "min": 0, "max": 4, "default": 0 } },
"shaders": { "main": { "drawList": "forward", "vertex": "hair.vert", "fragment": "extra_lights.frag", "options": "*",
                       "state": { "depthTest": "always" } } } })";

// Hair's lighting compiled with lists that have one more row, and one more file, each (tests/hair/extra): kind 2, whose
// irradiance is its power times the height of the point, and technique 4, whose transmittance is the density itself.
TEST(LightingLists, ARowAndAFileAddAKindAndATechnique) {
    ValidationGuard guard;
    auto renderer = hair::Renderer::create({.device = Gpu::get().device,
                                            .tree = *dataLibrary().passTree("hair_frame"),
                                            .shaders = shaders::embeddedShader});
    ASSERT_TRUE(renderer);
    const auto irradiance = [&](hair::Light::Kind kind, int technique) {
        std::string type(extraType);
        const std::string_view none = R"("type": "int", "default": 0)";
        type.replace(type.find(none), none.size(), R"("type": "int", "default": )" + std::to_string(technique));
        auto read = materials::MaterialType::parse(type, "extra.materialtype.json", hair::functorRegistry());
        EXPECT_TRUE(read) << read.error().text();
        hair::Scene scene;
        scene.objects.push_back({.name = "card", .geometry = card(), .material = materials::Material(*read)});
        scene.lights = {{.kind = kind, .direction = {0, 0, -1}, .intensity = 2.0F}};
        scene.camera = {
            .eye = {0, 0.5F, 40}, .target = {0, 0.5F, 0}, .verticalFov = 0.01F, .nearPlane = 10, .farPlane = 100};
        return meanLuminance(render(*renderer, scene, 8));
    };
    EXPECT_NEAR(irradiance(hair::Light::Kind::Directional, 0), 2.0, 1e-3);
    EXPECT_NEAR(irradiance(static_cast<hair::Light::Kind>(2), 0), 1.0, 2e-3);
    EXPECT_NEAR(irradiance(hair::Light::Kind::Directional, 4), 0.5, 1e-3);
}

}  // namespace
}  // namespace pelage::test
