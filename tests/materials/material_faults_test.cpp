// SPDX-License-Identifier: MIT
// Malformed materials, one per row; '@' marks where the diagnostic must point.
#include "support.hpp"

using namespace pelage;
using namespace pelage::materials;
using namespace pelage::materials::test;

namespace {

struct Row {
    std::string_view values, line;
    int typeVersion = 3;
};

std::string materialText(std::string_view values, int version) {
    return "{\n\"format\": \"pelage.material/1\",\n\"type\": \"hair.materialtype.json\",\n\"typeVersion\": " +
           std::to_string(version) + ",\n\"values\": {\n" + std::string(values) + "\n}}";
}

}  // namespace

TEST(MaterialFaults, EveryCodePointsAtTheMistake) {
    const Row rows[] = {
        {R"("scattering.longitudinalRougness": 0.2)",
         "I:6:1: error V002: material type has no property 'scattering.longitudinalRougness'; hint: did you mean "
         "'scattering.longitudinalRoughness'?"},
        {R"("scattering.longitudinalRoughness": "0.2")",
         "I:6:37: error V003: 'scattering.longitudinalRoughness' must be a number, found a string; hint: remove the "
         "quotes"},
        {R"("surface.baseColor": [1, 0])",
         "I:6:22: error V003: 'surface.baseColor' must be a colour of three numbers, found a list of 2"},
        {R"("surface.baseColor": [1, 0, "x"])",
         "I:6:22: error V003: 'surface.baseColor' must be a colour of three numbers, found a list with something that "
         "is no number"},
        {R"("surface.baseColor": 1)",
         "I:6:22: error V003: 'surface.baseColor' must be a colour of three numbers, found a number; hint: write [ ] "
         "around the numbers"},
        {R"("blending.doubleSided": "true")",
         "I:6:25: error V003: 'blending.doubleSided' must be true or false, found a string; hint: remove the quotes"},
        {R"("shadowing.pcfRadius": 1.5)",
         "I:6:24: error V003: 'shadowing.pcfRadius' must be a whole number, found 1.5"},
        {R"("blending.mode": 3)",
         "I:6:18: error V003: 'blending.mode' must be one of its words, found a number; hint: known: alphaBlend, "
         "alphaTest, alphaToCoverage, hashedAlpha, opaque"},
        {R"("surface.colorMap": "")",
         "I:6:21: error V003: 'surface.colorMap' must be a texture path, found an empty path; hint: for no texture "
         "write builtin.white"},
        {R"("surface.colorMap": "builtin.whit")",
         "I:6:21: error V004: 'builtin.whit' is not a built-in texture; hint: did you mean 'builtin.white'?"},
        {R"("blending.mode": "cutout")",
         "I:6:18: error V004: 'cutout' is not a value of 'blending.mode'; hint: known: alphaBlend, alphaTest, "
         "alphaToCoverage, hashedAlpha, opaque"},
        {R"("blending.mode": "hashed")",
         "I:6:18: error V004: 'hashed' is not a value of 'blending.mode'; hint: did you mean 'hashedAlpha'?"},
        {R"("scattering.longitudinalRoughness": 3.0)",
         "I:6:37: warning V005: 3 is outside 0.02..1 of 'scattering.longitudinalRoughness'; hint: clamped to 1"},
        {R"("surface.baseColor": [2, 0, 0])",
         "I:6:22: warning V005: 2 is outside 0..1 of 'surface.baseColor'; hint: clamped to 1"},
        {R"("scattering.roughness": 0.3)",
         "I:6:1: note V007: 'scattering.roughness' is now 'scattering.longitudinalRoughness'; hint: save the material "
         "to make this permanent"},
        {"\"scattering.roughness\": 0.3,\n\"scattering.longitudinalRoughness\": 0.2",
         "I:7:1: error V009: 'scattering.longitudinalRoughness' is given twice, once by an older name; hint: first at "
         "6:1"},
        {"",
         "I:4:16: error V001: material was saved with type version 5, this type is version 3; hint: update the "
         "library, or save again",
         5},
        {R"("scattering": 1)",
         "I:6:1: error J015: \"scattering\" is not of the right form for values.scattering; hint: write "
         "group.property"},
        {R"("scattering.ior": null)",
         "I:6:19: error J012: values['scattering.ior'] must be true or false, a number, a string or a list, found "
         "null"},
    };
    for (const Row& row : rows) {
        const auto parsed = Material::parse(materialText(row.values, row.typeVersion), "I", shippedSource());
        const Diagnostics& found = parsed ? parsed->warnings : parsed.error();
        ASSERT_FALSE(found.empty()) << row.values;
        std::string all;
        for (const Diagnostic& each : found.items()) all += toString(each) + '\n';
        EXPECT_NE(all.find(row.line), std::string::npos) << "wanted " << row.line << "\nfound " << all;
        EXPECT_EQ(parsed.has_value(), !found.hasErrors());
    }
}

TEST(MaterialFaults, TheTypeMustBeThere) {
    const std::string text =
        "{\"format\": \"pelage.material/1\", \"type\": \"none.json\", \"typeVersion\": 1, \"values\": {}}";
    const auto missing = Material::parse(text, "I", shippedSource());
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().items()[0].code, Code("V006"));
    EXPECT_EQ(missing.error().items()[0].column, 41U);
    EXPECT_EQ(missing.error().items()[1].code, Code("F001"));
    EXPECT_FALSE(Material::parse(text, "I", {}));
    EXPECT_FALSE(Material::parse(
        text, "I", [](const std::string&) { return Result<std::shared_ptr<const MaterialType>>(nullptr); }));
    EXPECT_FALSE(Material::load("no/such.material.json", shippedSource()));
    EXPECT_FALSE(Material::parse("{\"format\": \"pelage.material/2\"}", "I", shippedSource()));
}

TEST(MaterialFaults, OlderVersionsKeepWhatTheyReliedOn) {
    const auto old = Material::parse(materialText(R"("scattering.roughness": 0.3)", 1), "I", shippedSource());
    ASSERT_TRUE(old) << old.error().text();
    EXPECT_EQ(old->material.get("scattering.longitudinalRoughness")->number[0], 0.3F);
    EXPECT_EQ(old->material.get("shadowing.mode")->text, "pcf") << "setValue of version 2";
    EXPECT_EQ(old->material.get("scattering.model")->text, "thesis") << "setValue of version 3";
    const auto stated = Material::parse(materialText(R"("shadowing.mode": "hard")", 1), "I", shippedSource());
    ASSERT_TRUE(stated);
    EXPECT_EQ(stated->material.get("shadowing.mode")->text, "hard");
    const auto current = Material::parse(materialText("", 3), "I", shippedSource());
    ASSERT_TRUE(current);
    EXPECT_EQ(current->material.get("shadowing.mode")->text, "exponential");
}
