// SPDX-License-Identifier: MIT
#include "support.hpp"

#include <pelage/hair/scattering.hpp>
#include <pelage/materials/migrate.hpp>

#include <algorithm>
#include <filesystem>

using namespace pelage;
using namespace pelage::materials;
using namespace pelage::materials::test;

namespace {

const std::vector<std::string> typeNames{"hair", "kajiya_kay", "standard_pbr"};

}  // namespace

TEST(Shipped, TypesReadWithoutAWord) {
    for (const std::string& name : typeNames) {
        const auto type = MaterialType::load(typePath(name), hair::functorRegistry());
        ASSERT_TRUE(type) << type.error().text();
        EXPECT_EQ((*type)->warnings().text(), "") << name;
        Material material(*type);
        for (const Property& property : (*type)->properties()) {
            EXPECT_FALSE(property.label.empty()) << property.id;
            EXPECT_TRUE(property.type != ValueType::Float || property.step) << property.id << " has no step";
            material.isVisible(property.id);
            material.isEnabled(property.id);
        }
        for (const std::string& preset : (*type)->presets()) {
            EXPECT_EQ(codeOf(material.applyPreset(preset)), "none") << preset;
            EXPECT_FALSE(material.compile().inputs.empty());
        }
    }
}

TEST(Shipped, MaterialsReadWithoutAWord) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(std::string(PELAGE_MATERIALS) + "/presets")) {
        auto parsed = Material::load(entry.path().string(), shippedSource());
        ASSERT_TRUE(parsed) << parsed.error().text();
        EXPECT_EQ(parsed->warnings.text(), "");
        EXPECT_FALSE(parsed->material.compile().inputs.empty());
        ++count;
    }
    EXPECT_GE(count, 9);
}

// One list of models: the words of files, the shader option and the catalogue agree; files of version 3 had others.
TEST(Shipped, ModelsHaveOneSpelling) {
    const auto type = shipped("hair");
    const auto model = std::find_if(type->properties().begin(), type->properties().end(),
                                    [](const Property& property) { return property.id == "scattering.model"; });
    const auto option = std::find_if(type->options().begin(), type->options().end(),
                                     [](const Option& each) { return each.name == "scatteringModel"; });
    std::vector<std::string> ids;
    for (const hair::ModelInfo& info : hair::scatteringModels()) {
        EXPECT_EQ(static_cast<std::size_t>(info.model), ids.size()) << info.id;
        EXPECT_EQ(hair::findScatteringModel(info.id), &info);
        EXPECT_EQ(hair::findScatteringModel(info.model), &info);
        ids.emplace_back(info.id);
    }
    EXPECT_EQ(hair::findScatteringModel("momentLut"), nullptr);
    EXPECT_EQ(hair::findScatteringModel(static_cast<hair::ScatteringModel>(ids.size())), nullptr);
    EXPECT_EQ(hair::findScatteringModel(static_cast<hair::ScatteringModel>(-1)), nullptr);
    EXPECT_EQ(model->words, ids);
    EXPECT_EQ(option->words, ids);
    EXPECT_EQ(option->max, static_cast<std::int64_t>(ids.size()) - 1);
    for (const auto& [then, now] : {std::pair{"momentLut", "moment_lut"},
                                    {"kajiyaKay", "kajiya_kay"},
                                    {"segmentCdf", "segment_cdf"},
                                    {"pxr", "pxr"}}) {
        const std::string old = R"({ "format": "pelage.material/1", "type": "hair.materialtype.json", "typeVersion": 3,
                                     "values": { "scattering.model": ")" +
                                std::string(then) + "\" } }";
        const auto read = Material::parse(old, "old", shippedSource());
        ASSERT_TRUE(read) << read.error().text();
        EXPECT_EQ(read->material.get("scattering.model")->text, now);
        const auto migrated = migrate(old, "old", shippedSource());
        ASSERT_TRUE(migrated) << migrated.error().text();
        EXPECT_NE(migrated->text.find("\"" + std::string(now) + "\""), std::string::npos) << migrated->text;
    }
}

// The shaders are written against these names; changing one here means changing them there.
TEST(Shipped, InputsAndOptionsAreTheShadersNames) {
    const std::vector<std::string> inputs{"baseColor",  "alphaThreshold", "alphaHashScale", "shadowDensity",
                                          "shadowBias", "envScale",       "ambientScatter", "strandIdAmp",
                                          "colorMap",   "opacityMap",     "strandIdMap"};
    const std::vector<std::string> options{"alphaMode", "shadowMode",  "pcfRadius",  "envOn",
                                           "ambientOn", "useColorMap", "useStrandId"};
    std::vector<std::vector<std::string>> ownInputs{
        {"sigmaA", "colorFit", "gainR", "gainTT", "gainTRT", "gainRES", "momentTable"},
        {"specularColor", "specularExponent", "specularNorm", "specularWeight", "diffuseWeight"},
        {"metallic", "roughness", "fresnelF0", "specularScale"}};
#define FIBER_PARAMETER(type, name) ownInputs[0].emplace_back(#name);
#define FIBER_WIDTH(type, name) ownInputs[0].insert(ownInputs[0].end(), {#name, #name "Wide"});
#define FIBER_POINT(type, name)
#include "scattering/fiber_parameters.def"
    const std::vector<std::vector<std::string>> ownOptions{
        {"lobeR", "lobeTT", "lobeTRT", "lobeRES", "attenuationModel", "scatteringModel", "asPublished", "chiangColor"},
        {},
        {}};
    const std::vector<std::string> fragments{"hair_forward.frag", "kajiya_forward.frag", "pbr_forward.frag"};
    for (std::size_t i = 0; i < typeNames.size(); ++i) {
        const auto type = shipped(typeNames[i]);
        ASSERT_TRUE(type);
        std::vector<std::string> wanted = inputs, found;
        wanted.insert(wanted.end(), ownInputs[i].begin(), ownInputs[i].end());
        for (const Input& input : type->inputs()) found.push_back(input.name);
        std::sort(wanted.begin(), wanted.end());
        std::sort(found.begin(), found.end());
        EXPECT_EQ(found, wanted) << typeNames[i];
        wanted = options;
        wanted.insert(wanted.end(), ownOptions[i].begin(), ownOptions[i].end());
        found.clear();
        for (const Option& option : type->options()) found.push_back(option.name);
        std::sort(wanted.begin(), wanted.end());
        std::sort(found.begin(), found.end());
        EXPECT_EQ(found, wanted) << typeNames[i];

        Material material(type);
        const CompiledMaterial& compiled = material.compile();
        ASSERT_EQ(compiled.shaders.size(), 4U);
        EXPECT_EQ(shader(compiled, "shadow").use.fragment, "alpha.frag");
        EXPECT_EQ(shader(compiled, "depth").use.drawList, "depth");
        EXPECT_EQ(shader(compiled, "forward").use.fragment, fragments[i]);
        EXPECT_EQ(shader(compiled, "blend").use.fragment, fragments[i]);
        EXPECT_EQ(shader(compiled, "forward").constants.size(), compiled.options.size());
        EXPECT_EQ(shader(compiled, "depth").constants.size(), 1U);
        EXPECT_EQ(compiled.textures.size(), i == 0 ? 4U : 3U);
    }
}

TEST(Shipped, EveryBlendModeOfEveryTypeGivesOneWayToDraw) {
    for (const std::string& name : typeNames) {
        Material material(shipped(name));
        for (const char* mode : {"opaque", "alphaTest", "alphaToCoverage", "hashedAlpha", "alphaBlend"}) {
            ASSERT_EQ(codeOf(material.setFromText("blending.mode", mode)), "none");
            const CompiledMaterial& compiled = material.compile();
            const bool isBlend = std::string_view(mode) == "alphaBlend";
            EXPECT_EQ(shader(compiled, "blend").enabled, isBlend);
            EXPECT_EQ(shader(compiled, "forward").enabled, !isBlend);
            EXPECT_EQ(shader(compiled, "depth").enabled, !isBlend);
            EXPECT_TRUE(shader(compiled, "shadow").enabled);
            EXPECT_EQ(shader(compiled, "depth").state.alphaToCoverage, std::string_view(mode) == "alphaToCoverage");
            EXPECT_FALSE(shader(compiled, "forward").state.alphaToCoverage);
            EXPECT_EQ(shader(compiled, "forward").state.depthTest, DepthTest::Equal);
            EXPECT_EQ(shader(compiled, "blend").state.depthTest, DepthTest::NearerEqual);
            EXPECT_FALSE(shader(compiled, "blend").state.depthWrite);
        }
        material.setFromText("shadowing.castShadows", "false");
        EXPECT_FALSE(shader(material.compile(), "shadow").enabled);
    }
}
