// SPDX-License-Identifier: MIT
// One malformed type per row. A row edits a sound text; the '@' in it marks where the diagnostic must point.
#include "support.hpp"

#include <algorithm>

using namespace pelage;
using namespace pelage::materials;

namespace {

constexpr std::string_view soundText = R"({
  "format": "pelage.materialtype/1", "version": 3, "name": "Test",
  "versionUpdates": [
    { "to": 2, "actions": [{ "op": "rename", "from": "look.rough", "to": "look.roughness" }] },
    { "to": 3, "actions": [{ "op": "setValue", "property": "look.mode", "value": "hard" }] }
  ],
  "groups": [
    { "name": "look", "properties": [
      { "name": "roughness", "type": "float", "default": 0.5, "min": 0, "max": 1, "connect": { "input": "rough" } },
      { "name": "color", "type": "color", "space": "srgb", "default": [1, 0, 0], "connect": { "input": "color" } },
      { "name": "map", "type": "texture2d", "space": "srgb", "default": "builtin.white", "connect": { "input": "map" } },
      { "name": "mode", "type": "enum", "values": ["off", "hard"], "default": "off", "connect": { "option": "mode" } },
      { "name": "steps", "type": "int", "default": 2, "min": 1, "max": 4, "connect": { "option": "steps" } },
      { "name": "draw", "type": "bool", "default": true, "visibleWhen": "look.mode == 'hard'", "connect": { "shader": "main" } }
    ] },
    { "name": "glass", "properties": [
      { "name": "ior", "type": "float", "default": 1.5, "min": 1, "max": 3 },
      { "name": "kind", "type": "enum", "values": ["a", "b"], "default": "a" }
    ] }
  ],
  "inputs": { "rough": "float", "color": "color", "map": { "type": "texture2d", "space": "srgb" }, "f0": "float" },
  "options": { "mode": { "values": ["off", "hard"], "default": "off" }, "steps": { "type": "int", "min": 1, "max": 4, "default": 2 },
               "kind": { "values": ["a", "b"], "default": "a" } },
  "shaders": { "main": { "drawList": "forward", "vertex": "a.vert", "fragment": "a.frag", "options": ["mode", "steps", "kind"] },
               "other": { "drawList": "shadow", "vertex": "a.vert" } },
  "functors": [
    { "id": "fresnel", "type": "FresnelFromIor", "in": { "ior": "glass.ior" }, "out": { "f0": "input.f0" } },
    { "id": "kind", "type": "Kind", "in": { "kind": "glass.kind" }, "out": { "kind": "option.kind" } }
  ],
  "presets": { "shiny": { "look.roughness": 0.1 } }
})";

FunctorRegistry registry() {
    FunctorRegistry out = FunctorRegistry::standard();
    FunctorType kind;
    kind.name = "Kind";
    kind.in = {{"kind", Port::Kind::Value, ValueType::Enum, {"a", "b"}, false}};
    kind.out = {{"kind", Port::Kind::Value, ValueType::Enum, {"a", "b"}, false},
                {"state", Port::Kind::State, ValueType::Float, {}, true},
                {"on", Port::Kind::Enabled, ValueType::Bool, {}, true}};
    kind.run = [](std::span<const Value> in, FunctorOutputs& outputs) {
        outputs.set(0, in[0]);
        outputs.setState(1, {});
        outputs.setEnabled(2, true);
    };
    out.add(kind);
    FunctorType silent = kind;
    silent.name = "Silent";
    silent.run = [](std::span<const Value>, FunctorOutputs&) {};
    out.add(silent);
    return out;
}

struct Row {
    std::string_view from, to, code, words, hint;
};

const Row rows[] = {
    {R"("name": "Test",)", R"("name": "Test" @"x",)", "J001", "expected ',' or '}' here, found '\"'",
     "add ',' at 2:66"},
    {R"("version": 3,)", R"(@"verison": 3,)", "J010", "unknown key \"verison\"", "did you mean 'version'?"},
    {R"({ "name": "glass", "pro)", R"(@{ "pro)", "J011", "groups[1] has no \"name\"", "add it"},
    {R"("version": 3,)", R"("version": @"3",)", "J012", "version must be a whole number, found a string",
     "remove the quotes"},
    {R"("name": "ior", "type": "float")", R"("name": "ior", "type": @"flaot")", "J013",
     "\"flaot\" is not a value of groups['glass'].properties['ior'].type", "did you mean 'float'?"},
    {R"("version": 3,)", R"("version": @0,)", "J014", "version is 0", ""},
    {R"("name": "ior")", R"("name": @"IOR x")", "J015", "\"IOR x\" is not of the right form", ""},
    {R"("pelage.materialtype/1")", R"(@"pelage.materialtype/9")", "J020",
     "format is \"pelage.materialtype/9\"; this build reads \"pelage.materialtype/1\"", ""},
    {R"("name": "glass")", R"("name": @"look")", "M001", "second group named 'look'", "first at 8:15"},
    {R"("name": "kind", "type")", R"("name": @"ior", "type")", "M001", "second property named 'glass.ior'",
     "first at 17:17"},
    {R"("id": "kind")", R"("id": @"fresnel")", "M002", "second functor named 'fresnel'", "first at 27:13"},
    {R"("default": "a" })", R"("default": "a", "min": @1 })", "M003", "min is not allowed here",
     "only numbers and colours have it"},
    {R"("default": 1.5, "min": 1)", R"("default": 1.5, "values": @["a", "b"], "min": 1)", "M003",
     "values is not allowed here", "only enums have it"},
    {R"("default": 1.5, "min": 1)", R"("default": 1.5, "space": @"srgb", "min": 1)", "M003",
     "space is not allowed here", "only colours and textures have it"},
    {R"("drawList": "shadow", "vertex": "a.vert")",
     R"("drawList": "shadow", "compute": "a.comp", "fragment": @"a.frag")", "M003", "fragment is not allowed here",
     "a compute shader has none"},
    {R"("drawList": "shadow", "vertex": "a.vert")", R"("drawList": "shadow", "compute": "a.comp", "state": @{})",
     "M003", "state is not allowed here", "a compute shader has none"},
    {R"("vertex": "a.vert" } },
  "functors": [
    { "id": "fresnel", "type": "FresnelFromIor", "in": { "ior": "glass.ior" }, "out": { "f0": "input.f0" } },
    { "id": "kind", "type": "Kind", "in": { "kind": "glass.kind" }, "out": { "kind": "option.kind" } })",
     R"("compute": "a.comp" } },
  "functors": [
    { "id": "fresnel", "type": "FresnelFromIor", "in": { "ior": "glass.ior" }, "out": { "f0": "input.f0" } },
    { "id": "kind", "type": "Kind", "in": { "kind": "glass.kind" }, "out": { "kind": "option.kind", "state": @"shader.other.state" } })",
     "M003", "'other' is a compute shader, which has no state", "delete the connection, or drive its \"enabled\""},
    {R"("other": { "drawList": "shadow", "vertex": "a.vert" })",
     R"("other": @{ "drawList": "shadow", "vertex": "a.vert", "compute": "a.comp" })", "M033",
     "needs exactly one of \"vertex\" and \"compute\"", ""},
    {R"("other": { "drawList": "shadow", "vertex": "a.vert" })", R"("other": @{ "drawList": "shadow" })", "M033",
     "needs exactly one of \"vertex\" and \"compute\"", ""},
    {R"("default": 1.5)", R"("default": @"1.5")", "M004",
     "groups['glass'].properties['ior'].default must be a number, found a string", "remove the quotes"},
    {R"("default": [1, 0, 0])", R"("default": @[1, 0])", "M004", "default needs exactly 3 elements, found 2", ""},
    {R"("default": 2, "min": 1)", R"("default": @2.5, "min": 1)", "M004", "must be a whole number, found 2.5", ""},
    {R"("default": 1.5)", R"("default": @7.0)", "M005", "default 7 of 'glass.ior' is outside 1..3", ""},
    {R"("max": 4, "default": 2)", R"("max": 4, "default": @9)", "M005", "default 9 of option 'steps' is outside 1..4",
     ""},
    {R"("kind": { "values": ["a", "b"], "default": "a" })", R"("kind": @{ "default": "a" })", "M006",
     "needs exactly one of \"type\" and \"values\"", ""},
    {R"("min": 1, "max": 3)", R"("min": @4, "max": 3)", "M007", "the range of 'glass.ior' is empty",
     "needs min <= softMin < softMax <= max"},
    {R"("min": 1, "max": 3)", R"("min": @1, "max": 3, "softMax": 5)", "M007", "its soft range leaves it", ""},
    {R"("steps": { "type": "int", "min": 1)", R"(@"steps": { "type": "int", "min": 7)", "M007",
     "the range of option 'steps' is empty", ""},
    {R"("default": "off", "connect")", R"("default": @"of", "connect")", "M008", "'of' is not a value of 'look.mode'",
     "did you mean 'off'?"},
    {R"("hard"], "default": "off" })", R"("hard"], "default": @"harb" })", "M008",
     "'harb' is not a value of option 'mode'", "did you mean 'hard'?"},
    {R"("max": 4, "connect": { "option": "steps" })", R"("max": 9, "connect": { "option": @"steps" })", "M009",
     "range 1..9 of 'look.steps' exceeds 1..4 of option 'steps'", ""},
    {R"({ "input": "rough" })", R"({ "input": @"ruogh" })", "M010", "property 'look.roughness': unknown input 'ruogh'",
     "did you mean 'rough'?"},
    {R"("input.f0")", R"(@"input.fO")", "M010", "functor 'fresnel': unknown input 'fO'", "did you mean 'f0'?"},
    {R"({ "option": "steps" })", R"({ "option": @"step" })", "M011", "property 'look.steps': unknown option 'step'",
     "did you mean 'steps'?"},
    {R"("option.kind")", R"(@"option.kidn")", "M011", "functor 'kind': unknown option 'kidn'", "did you mean 'kind'?"},
    {R"(["mode", "steps", "kind"])", R"(["mode", "steps", "kind", @"knd"])", "M011",
     "shader 'main': unknown option 'knd'", "did you mean 'kind'?"},
    {R"("max": 3 })", R"("max": 3, "connect": { "input": @"rough" } })", "M012",
     "'input.rough' is driven twice: by property 'look.roughness' and by property 'glass.ior'", "first at 9:105"},
    {R"("f0": "input.f0")", R"("f0": @"input.rough")", "M012", "by property 'look.roughness' and by functor 'fresnel'",
     ""},
    {R"("rough": "float")", R"("rough": "float3")", "M013",
     "property 'look.roughness' is float, input 'rough' is float3", "change one type, or use a functor"},
    {R"("map": { "type": "texture2d", "space": "srgb" })", R"("map": "texture2d")", "M013",
     "property 'look.map' is srgb, input 'map' is linear", "give both the same \"space\""},
    {R"({ "option": "steps" })", R"({ "shader": @"other" })", "M013",
     "property 'look.steps' is int, enabling a shader needs bool", ""},
    {R"("type": "int", "default": 2, "min": 1, "max": 4, "connect": { "option": )",
     R"("type": "bool", "default": true, "connect": { "option": @)", "M013",
     "property 'look.steps' is bool, option 'steps' is int", ""},
    {R"("mode": { "values": ["off", "hard"])", R"("mode": { "values": ["hard", "off"])", "M014",
     "values of 'look.mode' and option 'mode' are in different order", ""},
    {R"("mode": { "values": ["off", "hard"])", R"("mode": { "values": ["off", "soft"])", "M014",
     "values of 'look.mode' and option 'mode' differ", ""},
    {R"("kind": { "values": ["a", "b"])", R"("kind": { "values": ["a", "c"])", "M014",
     "values of option 'kind' differ from those of output 'kind' of functor 'kind'",
     "they must be, in this order: a, b"},
    {R"({ "shader": "main" })", R"({ "shader": @"mian" })", "M015", "property 'look.draw': unknown shader 'mian'",
     "did you mean 'main'?"},
    {R"("kind": "option.kind" })", R"("kind": "option.kind", "on": @"shader.othr.enabled" })", "M015",
     "functor 'kind': unknown shader 'othr'", "did you mean 'other'?"},
    {R"({ "name": "ior", "type")", R"({ "name": @"spare", "type": "float", "default": 1 }, { "name": "ior", "type")",
     "M016", "property 'glass.spare' has no effect", "connect it, feed it to a functor, or delete it"},
    {R"("f0": "float" })", R"("f0": "float", @"f1": "float" })", "M018", "nothing drives input 'f1'", ""},
    {R"("options": { "mode")", R"("options": { @"extra": { "type": "bool", "default": true }, "mode")", "M019",
     "nothing drives option 'extra'; it keeps its default", ""},
    {R"("type": "FresnelFromIor")", R"("type": @"FresnelFromIro")", "M020",
     "functor 'fresnel': type 'FresnelFromIro' is not registered", "did you mean 'FresnelFromIor'?"},
    {R"("in": { "ior":)", R"("in": { @"iro":)", "M021", "functor 'fresnel': FresnelFromIor has no input 'iro'",
     "did you mean 'ior'?"},
    {R"("out": { "f0":)", R"("out": { @"f1":)", "M021", "functor 'fresnel': FresnelFromIor has no output 'f1'",
     "did you mean 'f0'?"},
    {R"("ior": "glass.ior")", R"("ior": @"glas.ior")", "M022", "functor 'fresnel' reads unknown property 'glas.ior'",
     "did you mean 'glass.ior'?"},
    {R"("ior": "glass.ior")", R"("ior": @"look.mode")", "M023",
     "input 'ior' of FresnelFromIor needs float, 'look.mode' is enum", ""},
    {R"("f0": "float" })", R"("f0": "float2" })", "M023",
     "output 'f0' of functor 'fresnel' is float, 'input.f0' is float2", ""},
    {R"("in": { "ior": "glass.ior" })", R"("in": @{ })", "M024",
     "functor 'fresnel': input 'ior' of FresnelFromIor is not connected", "name a property of type float"},
    {R"("out": { "kind": "option.kind" })", R"("out": @{ "on": "shader.other.enabled" })", "M025",
     "functor 'kind': output 'kind' of Kind is not connected", "name what it drives"},
    {R"("kind": "option.kind" })", R"("kind": "option.kind", "on": @"input.f0" })", "M026",
     "functor 'kind': output 'on' cannot drive 'input.f0'", "write shader.name.enabled"},
    {R"("kind": "option.kind" })", R"("kind": "option.kind", "state": @"shader.main.enabled" })", "M026",
     "output 'state' cannot drive 'shader.main.enabled'", "write shader.name.state"},
    {R"("f0": "input.f0")", R"("f0": @"shader.other.enabled")", "M026", "output 'f0' cannot drive",
     "write input.name or option.name"},
    {R"("type": "enum", "values": ["a", "b"])", R"("type": "enum", "values": @"Kidn.kind")", "M020",
     "values: functor type 'Kidn' is not registered", "did you mean 'Kind'?"},
    {R"("type": "enum", "values": ["a", "b"])", R"("type": "enum", "values": @"Kind.knd")", "M021",
     "values: Kind has no port 'knd' with words", "did you mean 'kind'?"},
    {R"("kind": { "values": ["a", "b"])", R"("kind": { "values": @"FresnelFromIor.ior")", "M021",
     "values: FresnelFromIor has no port 'ior' with words", ""},
    {R"("type": "enum", "values": ["a", "b"])", R"("type": "enum", "values": @"a, b")", "J015", "not of the right form",
     "write a list of words, or Functor.port"},
    {R"("out": { "f0": "input.f0" })", R"("out": { "f0": "input.f0", "*": @"option.f0" })", "M026",
     "\"*\" cannot drive 'option.f0'", "write input.*"},
    {R"("name": "kind", "type": "enum", "values": ["a", "b"])",
     R"("name": "kind", "type": "enum", "values": ["b", "a"])", "M027",
     "values of 'glass.kind' differ from those of input 'kind' of Kind", "they must be, in this order: a, b"},
    {R"("type": "Kind")", R"("type": @"Silent")", "M028", "functor type 'Silent' does not set its output 'kind'", ""},
    {R"(["off", "hard"], "default": "off" })", R"(["off", "hard"], "default": @"hard" })", "M029",
     "default of option 'mode' is 'hard', but property 'look.mode' makes it 'off'", "write the same value"},
    {R"("kind": { "values": ["a", "b"], "default": "a" })", R"("kind": { "values": ["a", "b"], "default": @"b" })",
     "M029", "default of option 'kind' is 'b', but functor 'kind' makes it 'a'", ""},
    {R"(["mode", "steps", "kind"])", R"(["mode", "steps"])", "M032", "no shader reads option 'kind'", ""},
    {R"({ "to": 3,)", R"({ "to": @2,)", "M040", "version update to 2 does not rise", ""},
    {R"({ "to": 3,)", R"({ "to": @4,)", "M040", "version update to 4 is beyond version 3", ""},
    {R"("to": "look.roughness")", R"("to": @"look.roughnes")", "M041",
     "rename leads to 'look.roughnes', which does not exist", "did you mean 'look.roughness'?"},
    {R"("from": "look.rough")", R"("from": @"look.mode")", "M042", "'look.mode' is renamed but still exists",
     "old names never return"},
    {R"({ "op": "setValue",)", R"({ "op": "rename", "from": @"look.rough", "to": "look.color" }, { "op": "setValue",)",
     "M042", "'look.rough' is renamed twice", "first at 4:54"},
    {R"("property": "look.mode")", R"("property": @"look.mdoe")", "M043", "setValue names unknown property 'look.mdoe'",
     "did you mean 'look.mode'?"},
    {R"("value": "hard" })", R"("value": @"hrad" })", "V004", "'hrad' is not a value of 'look.mode'",
     "did you mean 'hard'?"},
    {R"("look.roughness": 0.1)", R"(@"look.roughnes": 0.1)", "V002",
     "preset 'shiny': the type has no property 'look.roughnes'", "did you mean 'look.roughness'?"},
    {R"("look.roughness": 0.1)", R"("look.roughness": @"0.1")", "V003",
     "'look.roughness' must be a number, found a string", "remove the quotes"},
    {R"("look.roughness": 0.1)", R"("look.roughness": @3)", "V005", "3 is outside 0..1 of 'look.roughness'",
     "write a number inside the range"},
    {R"("look.mode == 'hard'")", R"("look.mode == @'hrad'")", "E003",
     "'hrad' is not a value of 'look.mode', in visibleWhen of 'look.draw'", "did you mean 'hard'?"},
    {R"("look.mode == 'hard'")", R"("@look.mdoe == 'hard'")", "E002", "unknown property 'look.mdoe'",
     "did you mean 'look.mode'?"},
    {R"("look.mode == 'hard'")", R"("look.mode == @")", "E001",
     "expected a property, a number or a word in quotes, found the end", ""},
    {R"("look.mode == 'hard'")", R"("look.mode == @1")", "E004", "compares a word with a number", ""},
    {R"({ "name": "glass",)", R"({ "name": "glass", "visibleWhen": "@look.steps",)", "E004",
     "needs true or false here, found a number, in visibleWhen of its group of 'glass.ior'", ""},
};

}  // namespace

TEST(TypeFaults, TheSoundTextIsSilent) {
    const auto type = MaterialType::parse(soundText, "T", registry());
    ASSERT_TRUE(type) << type.error().text();
    EXPECT_EQ((*type)->warnings().text(), "");
}

// What a functor knows need not be written again: the words of its ports, and inputs of the names of its outputs.
TEST(TypeFaults, AFunctorGivesItsWordsAndItsOutputs) {
    std::string text(soundText);
    for (const auto& [from, to] :
         {std::pair<std::string_view, std::string_view>{R"("type": "enum", "values": ["a", "b"])",
                                                        R"("type": "enum", "values": "Kind.kind")"},
          {R"("kind": { "values": ["a", "b"])", R"("kind": { "values": "Kind.kind")"},
          {R"("out": { "f0": "input.f0" })", R"("out": { "f0": "input.f0", "*": "input.*" })"}})
        text.replace(text.find(from), from.size(), to);
    const auto type = MaterialType::parse(text, "T", registry());
    ASSERT_TRUE(type) << type.error().text();
    EXPECT_EQ((*type)->warnings().text(), "");
    const std::vector<std::string> words{"a", "b"};
    EXPECT_EQ((*type)->properties().back().words, words);
    EXPECT_EQ((*type)->options().back().words, words);
    EXPECT_EQ((*type)->options().back().max, 1);
    EXPECT_EQ((*type)->inputs().back().name, "eta") << "f0 is named, eta is the other output of FresnelFromIor";
    Material material(*type);
    EXPECT_EQ(test::number(material.compile(), "eta"), 1.5F);
    EXPECT_EQ(test::number(material.compile(), "rough"), 0.5F);
}

TEST(TypeFaults, EveryCodePointsAtTheMistake) {
    for (const Row& row : rows) {
        SCOPED_TRACE(std::string(row.code) + ": " + std::string(row.to));
        std::string text(soundText);
        const std::size_t from = text.find(row.from);
        ASSERT_NE(from, std::string::npos) << row.from;
        text.replace(from, row.from.size(), row.to);
        std::uint32_t line = 0, column = 0;
        if (const std::size_t mark = text.find('@'); mark != std::string::npos) {
            text.erase(mark, 1);
            line = 1 + static_cast<std::uint32_t>(
                           std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(mark), '\n'));
            const std::size_t start = mark == 0 ? std::string::npos : text.rfind('\n', mark - 1);
            column = static_cast<std::uint32_t>(start == std::string::npos ? mark + 1 : mark - start);
        }
        const auto type = MaterialType::parse(text, "T", registry());
        const Diagnostics& found = type ? (*type)->warnings() : type.error();
        ASSERT_FALSE(found.empty());
        const Diagnostic& first = found.items()[0];
        EXPECT_EQ(first.code.text(), row.code) << found.text();
        EXPECT_NE(first.text.find(row.words), std::string::npos) << found.text();
        if (!row.hint.empty()) {
            EXPECT_EQ(first.hint, row.hint) << found.text();
        }
        EXPECT_EQ(first.file, "T");
        EXPECT_GT(first.line, 0U);
        if (line != 0) {
            EXPECT_EQ(first.line, line) << found.text();
            EXPECT_EQ(first.column, column) << found.text();
        }
        EXPECT_LE(found.items().size(), 2U) << "one mistake, one line:\n" << found.text();
    }
}

TEST(TypeFaults, IndependentMistakesAreAllReported) {
    std::string text(soundText);
    for (const auto& [from, to] :
         {std::pair<std::string_view, std::string_view>{R"({ "input": "rough" })", R"({ "input": "ruogh" })"},
          {R"("ior": "glass.ior")", R"("ior": "glas.ior")"},
          {R"("look.roughness": 0.1)", R"("look.shine": 0.1)"}})
        text.replace(text.find(from), from.size(), to);
    const auto type = MaterialType::parse(text, "T", registry());
    ASSERT_FALSE(type);
    std::string codes;
    for (const Diagnostic& each : type.error().items())
        codes += each.severity == Severity::Error ? std::string(each.code.text()) + " " : "";
    EXPECT_EQ(codes, "M010 M022 V002 ");
}
