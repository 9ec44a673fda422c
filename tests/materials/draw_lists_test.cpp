// SPDX-License-Identifier: MIT
#include "support.hpp"

using namespace pelage;
using namespace pelage::materials;
using namespace pelage::materials::test;

TEST(DrawLists, ThoseTheTreeLacksAreNamedWithTheNearest) {
    const auto type = shipped("hair");
    EXPECT_TRUE(type->unknownDrawLists({"blend", "depth", "forward", "shadow", "other"}).empty());
    const Diagnostics found = type->unknownDrawLists({"blend", "depth", "forward", "shadows"});
    ASSERT_EQ(found.items().size(), 1U);
    const Diagnostic& only = found.items()[0];
    EXPECT_EQ(only.severity, Severity::Warning);
    EXPECT_EQ(only.code, Code("M017"));
    EXPECT_EQ(only.text, "shader 'shadow': the pass tree has no draw list 'shadow'; nothing draws it");
    EXPECT_EQ(only.hint, "did you mean 'shadows'?");
    // The place is that of the word in the file.
    std::istringstream lines(readFile(type->file()));
    std::string line;
    for (std::uint32_t i = 0; i < only.line; ++i) std::getline(lines, line);
    EXPECT_EQ(line.substr(only.column - 1, 8), "\"shadow\"");
    EXPECT_EQ(type->unknownDrawLists({}).items().size(), type->shaders().size());
}

constexpr std::string_view computing = R"({
"format": "pelage.materialtype/1", "version": 1, "name": "Computing",
"groups": [{ "name": "g", "properties": [
  { "name": "on", "type": "bool", "default": true, "connect": { "shader": "shade" } },
  { "name": "gain", "type": "float", "default": 2, "connect": { "input": "gain" } },
  { "name": "fast", "type": "bool", "default": true, "connect": { "option": "fast" } }
] }],
"inputs": { "gain": "float" }, "options": { "fast": { "type": "bool", "default": true } },
"shaders": { "shade": { "drawList": "shade", "compute": "shade.comp", "options": "*" },
             "forward": { "drawList": "forward", "vertex": "a.vert", "fragment": "a.frag" } }
})";

TEST(ComputeShaders, AreCarriedWithTheirOptions) {
    const auto type = MaterialType::parse(computing, "T", FunctorRegistry::standard());
    ASSERT_TRUE(type) << type.error().text();
    EXPECT_EQ((*type)->warnings().text(), "");
    Material material(*type);
    const CompiledMaterial& compiled = material.compile();
    ASSERT_EQ(compiled.shaders.size(), 2U);
    const CompiledMaterial::Shader& shade = compiled.shaders[0];
    EXPECT_TRUE(shade.use.isCompute());
    EXPECT_EQ(shade.use.files(), std::vector<std::string>{"shade.comp"});
    EXPECT_EQ(shade.use.drawList, "shade");
    EXPECT_TRUE(shade.enabled);
    EXPECT_EQ(shade.constants, (std::vector<rhi::ConstantEntry>{{"fast", 1}}));
    EXPECT_FALSE(compiled.shaders[1].use.isCompute());
    EXPECT_EQ(compiled.shaders[1].use.files(), (std::vector<std::string>{"a.vert", "a.frag"}));
    material.set("g.on", Value::boolean(false));
    EXPECT_FALSE(material.compile().shaders[0].enabled);
    EXPECT_TRUE(material.compile().shaders[1].enabled);
    const Diagnostics found = (*type)->unknownDrawLists({"forward"});
    ASSERT_EQ(found.items().size(), 1U);
    EXPECT_EQ(found.items()[0].text, "shader 'shade': the pass tree has no draw list 'shade'; nothing dispatches it");
}
