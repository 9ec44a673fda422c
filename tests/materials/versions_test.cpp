// SPDX-License-Identifier: MIT
// versionUpdates: what older files come to mean, and the files rewritten.
#include "support.hpp"

#include <pelage/materials/migrate.hpp>

using namespace pelage;
using namespace pelage::materials;
using namespace pelage::materials::test;

namespace {

// Version 2 turned degrees into radians and gave the tint a wider range; 3 renamed; 4 removed.
std::string typeText(std::string_view updates) {
    return R"({ "format": "pelage.materialtype/1", "version": 5, "name": "Test",
"versionUpdates": [
)" + std::string(updates) +
           R"(
],
"groups": [{ "name": "look", "properties": [
  { "name": "angle", "type": "float", "default": 0.5, "min": -10, "max": 10, "connect": { "input": "angle" } },
  { "name": "pair", "type": "float2", "default": [0, 0], "connect": { "input": "pair" } },
  { "name": "steps", "type": "int", "default": 2, "min": 1, "max": 8, "connect": { "input": "steps" } },
  { "name": "model", "type": "enum", "values": ["fine", "rough_one"], "default": "fine", "connect": { "option": "model" } },
  { "name": "on", "type": "bool", "default": true, "connect": { "shader": "main" } }
] }],
"inputs": { "angle": "float", "pair": "float2", "steps": "int" },
"options": { "model": { "values": ["fine", "rough_one"], "default": "fine" } },
"shaders": { "main": { "drawList": "forward", "vertex": "a.vert", "options": "*" } } })";
}

constexpr std::string_view history = R"(
{ "to": 2, "actions": [
  { "op": "remap", "property": "look.tilt", "scale": 0.5, "offset": 1 },
  { "op": "remap", "property": "look.pair", "scale": 2 },
  { "op": "setValue", "property": "look.tilt", "value": 4 },
  { "op": "setValue", "property": "look.glow", "value": 1 } ] },
{ "to": 3, "actions": [
  { "op": "rename", "from": "look.tilt", "to": "look.angle" },
  { "op": "renameWords", "property": "look.model", "words": { "coarse": "rough" } },
  { "op": "remap", "property": "look.angle", "scale": -1 } ] },
{ "to": 4, "actions": [
  { "op": "renameWords", "property": "look.model", "words": { "rough": "rough_one" } } ] },
{ "to": 5, "actions": [
  { "op": "remove", "property": "look.glow" },
  { "op": "setValue", "property": "look.steps", "value": 7 } ] })";

Material::TypeSource source(std::string_view updates = history) {
    return [text = typeText(updates)](const std::string&) {
        return MaterialType::parse(text, "T", FunctorRegistry::standard());
    };
}

std::string file(int version, std::string_view values) {
    return "{ \"format\": \"pelage.material/1\", \"type\": \"T\", \"typeVersion\": " + std::to_string(version) +
           ", \"values\": {" + std::string(values) + "} }";
}

Material::Parsed parsed(int version, std::string_view values) {
    auto out = Material::parse(file(version, values), "I", source());
    EXPECT_TRUE(out) << (out ? "" : out.error().text());
    return std::move(*out);
}

std::string codesOf(const Diagnostics& found) {
    std::string out;
    for (const Diagnostic& each : found.items()) out += (out.empty() ? "" : " ") + std::string(each.code.text());
    return out;
}

}  // namespace

TEST(Versions, NumbersAreRemappedOncePerVersionPassed) {
    const auto angle = [](const Material::Parsed& of) { return of.material.get("look.angle")->number[0]; };
    EXPECT_EQ(angle(parsed(1, R"("look.tilt": 6)")), -4.0F) << "6 * 0.5 + 1, then times -1";
    EXPECT_EQ(angle(parsed(2, R"("look.tilt": 6)")), -6.0F);
    EXPECT_EQ(angle(parsed(3, R"("look.angle": 6)")), 6.0F);
    EXPECT_EQ(angle(parsed(5, R"("look.tilt": 6)")), 6.0F) << "a new file with the old name has today's numbers";
    const auto pair = parsed(1, R"("look.pair": [1, -3])");
    EXPECT_EQ(pair.material.get("look.pair")->number[0], 2.0F);
    EXPECT_EQ(pair.material.get("look.pair")->number[1], -6.0F);
    const auto beyond = parsed(1, R"("look.tilt": 100)");
    EXPECT_EQ(codesOf(beyond.warnings), "V007 V005");
    EXPECT_EQ(angle(beyond), -10.0F) << "clamped after it was remapped";
}

TEST(Versions, WhatOlderFilesReliedOnIsRemappedToo) {
    EXPECT_EQ(parsed(1, "").material.get("look.angle")->number[0], -4.0F) << "set to 4 in version 2, negated in 3";
    EXPECT_EQ(parsed(2, "").material.get("look.angle")->number[0], 0.5F);
    EXPECT_EQ(parsed(4, "").material.get("look.steps")->integer, 7);
    EXPECT_EQ(parsed(5, "").material.get("look.steps")->integer, 2);
}

TEST(Versions, WordsOfOlderFilesAreRenamed) {
    const auto model = [](int version, std::string_view word) {
        return parsed(version, "\"look.model\": \"" + std::string(word) + "\"").material.get("look.model")->text;
    };
    EXPECT_EQ(model(2, "coarse"), "rough_one") << "renamed in version 3 and again in 4";
    EXPECT_EQ(model(3, "rough"), "rough_one");
    EXPECT_EQ(model(1, "fine"), "fine");
    const auto now = Material::parse(file(4, R"("look.model": "rough")"), "I", source());
    ASSERT_FALSE(now) << "a new file has today's words";
    EXPECT_EQ(codesOf(now.error()), "V004");
    const auto migrated = migrate(file(2, R"("look.model": "coarse")"), "I", source());
    ASSERT_TRUE(migrated);
    EXPECT_NE(migrated->text.find(R"("look.model": "rough_one")"), std::string::npos) << migrated->text;
}

TEST(Versions, RemovedPropertiesAreDroppedFromOldFilesAndRefusedInNewOnes) {
    const auto old = parsed(4, R"("look.glow": 0.5)");
    EXPECT_EQ(codesOf(old.warnings), "V014");
    EXPECT_EQ(old.warnings.items()[0].severity, Severity::Note);
    const auto now = Material::parse(file(5, R"("look.glow": 0.5)"), "I", source());
    ASSERT_FALSE(now);
    EXPECT_EQ(codesOf(now.error()), "V002");
    EXPECT_EQ(now.error().items()[0].hint, "it was removed in version 5");
}

TEST(Versions, EveryFaultOfAnUpdateHasItsCodeAndPlace) {
    struct Row {
        std::string_view updates, line;
    };
    const Row rows[] = {
        {R"({ "to": 3, "actions": [{ "op": "remap", "property": "look.angle", "scale": 2 }] }, { "to": 3, "actions": [{ "op": "remap", "property": "look.angle", "scale": 2 }] })",
         "T:3:92: error M040: version update to 3 does not rise"},
        {R"({ "to": 6, "actions": [{ "op": "remap", "property": "look.angle", "scale": 2 }] })",
         "T:3:9: error M040: version update to 6 is beyond version 5"},
        {R"({ "to": 2, "actions": [{ "op": "rename", "from": "look.a", "to": "look.b" }] })",
         "T:3:66: error M041: rename leads to 'look.b', which does not exist"},
        {R"({ "to": 2, "actions": [{ "op": "remove", "property": "look.angle" }] })",
         "T:3:54: error M042: 'look.angle' is removed but still exists; hint: old names never return"},
        {R"({ "to": 2, "actions": [{ "op": "remove", "property": "look.a" }, { "op": "remove", "property": "look.a" }] })",
         "T:3:96: error M042: 'look.a' is removed, but its name was given up before; hint: first at 3:54"},
        {R"({ "to": 2, "actions": [{ "op": "rename", "from": "look.a", "to": "look.angle" }] }, { "to": 3, "actions": [{ "op": "remove", "property": "look.a" }] })",
         "error M042: 'look.a' is removed, but its name was given up before; hint: first at 3:50"},
        {R"({ "to": 2, "actions": [{ "op": "remove", "property": "look.a" }] }, { "to": 3, "actions": [{ "op": "rename", "from": "look.c", "to": "look.a" }] })",
         "error M041: rename leads to 'look.a', which does not exist"},
        {R"({ "to": 2, "actions": [{ "op": "setValue", "property": "look.angel", "value": 2 }] })",
         "T:3:56: error M043: setValue names unknown property 'look.angel'; hint: did you mean 'look.angle'?"},
        {R"({ "to": 2, "actions": [{ "op": "remap", "property": "look.angel", "scale": 2 }] })",
         "T:3:53: error M043: remap names unknown property 'look.angel'; hint: did you mean 'look.angle'?"},
        {R"({ "to": 2, "actions": [{ "op": "remap", "property": "look.angle", "scale": 0, "offset": 1 }] })",
         "T:3:24: error M044: remap of 'look.angle' makes all values equal"},
        {R"({ "to": 2, "actions": [{ "op": "remap", "property": "look.angle" }] })",
         "T:3:24: error M044: remap of 'look.angle' changes nothing"},
        {R"({ "to": 2, "actions": [{ "op": "remap", "property": "look.on", "scale": 2 }] })",
         "T:3:53: error M044: remap of 'look.on', which is bool; hint: only float to float4 can be remapped"},
        {R"({ "to": 2, "actions": [{ "op": "remap", "property": "look.steps", "scale": 2 }] })",
         "T:3:53: error M044: remap of 'look.steps', which is int"},
        {R"({ "to": 2, "actions": [{ "op": "setValue", "property": "look.angle", "value": 20 }] })",
         "T:3:79: error V005: 20 is outside -10..10 of 'look.angle'; hint: write a number inside the range"},
        {R"({ "to": 2, "actions": [{ "op": "renameWords", "property": "look.model", "words": { "a": "fin" } }] })",
         "T:3:82: error M044: renameWords: 'fin' is not a value of 'look.model'; hint: did you mean 'fine'?"},
        {R"({ "to": 2, "actions": [{ "op": "renameWords", "property": "look.steps", "words": { "a": "fine" } }] })",
         "T:3:82: error M044: renameWords: 'fine' is not a value of 'look.steps'"},
        {R"({ "to": 2, "actions": [{ "op": "renameWords", "property": "look.modle", "words": { "a": "fine" } }] })",
         "T:3:59: error M043: renameWords names unknown property 'look.modle'; hint: did you mean 'look.model'?"},
        {R"({ "to": 2, "actions": [{ "op": "halve", "property": "look.angle" }] })", "T:3:24: error J0"},
        {R"({ "to": 2, "actions": [{ "op": "remap", "property": "look.angle", "scale": 1e9 }] })", "error J0"},
    };
    for (const Row& row : rows) {
        const auto type = MaterialType::parse(typeText(row.updates), "T", FunctorRegistry::standard());
        ASSERT_FALSE(type) << row.updates;
        EXPECT_NE(type.error().text().find(row.line), std::string::npos)
            << "wanted " << row.line << "\nfound  " << type.error().text();
        EXPECT_EQ(type.error().items().size(), 1U) << type.error().text();
    }
}

TEST(Versions, ARenameMayLeadToWhatIsRemovedLater) {
    const auto type =
        MaterialType::parse(typeText(R"({ "to": 2, "actions": [{ "op": "rename", "from": "look.a", "to": "look.b" }] },
                    { "to": 3, "actions": [{ "op": "setValue", "property": "look.b", "value": 1 }] },
                    { "to": 4, "actions": [{ "op": "remove", "property": "look.b" }] })"),
                            "T", FunctorRegistry::standard());
    ASSERT_TRUE(type) << type.error().text();
    EXPECT_EQ((*type)->warnings().text(), "");
}

TEST(Migrate, TheRewrittenFileMeansTheSameAndNeedsNoNotes) {
    for (int version = 1; version <= 5; ++version) {
        const std::string values = version < 3 ? R"("look.tilt": 1.5, "look.on": false)" : R"("look.angle": 1.5)";
        for (const std::string& all : {values, std::string(), values + R"(, "look.pair": [0.1, 3])"}) {
            const std::string text = file(version, all);
            const auto migrated = migrate(text, "I", source());
            ASSERT_TRUE(migrated) << migrated.error().text();
            EXPECT_EQ(migrated->isNeeded, version < 5);
            EXPECT_EQ(migrated->from, version);
            EXPECT_EQ(migrated->to, 5);
            if (version == 5) {
                EXPECT_EQ(migrated->text, text);
            }
            const auto before = Material::parse(text, "I", source());
            const auto after = Material::parse(migrated->text, "I", source());
            ASSERT_TRUE(after) << after.error().text() << migrated->text;
            EXPECT_EQ(after->warnings.text(), "");
            for (const Property& property : after->material.type().properties())
                EXPECT_EQ(*before->material.get(property.id), *after->material.get(property.id)) << property.id;
        }
    }
}

TEST(Migrate, MembersStayInTheirOrder) {
    const std::string old =
        "{ // a comment\n\"$schema\": \"x.json\", \"format\": \"pelage.material/1\", \"type\": \"T\", \"typeVersion\": "
        "1,"
        "\"description\": \"Says \\\"so\\\"\\n\", \"values\": { \"look.glow\": 1, \"look.tilt\": 6, \"look.on\": true "
        "} }";
    const auto migrated = migrate(old, "I", source());
    ASSERT_TRUE(migrated) << migrated.error().text();
    EXPECT_EQ(migrated->text, R"({
    "$schema": "x.json",
    "format": "pelage.material/1",
    "type": "T",
    "typeVersion": 5,
    "description": "Says \"so\"\u000a",
    "values": {
        "look.angle": -4,
        "look.on": true,
        "look.steps": 7
    }
}
)");
}

TEST(Migrate, WholeNumbersKeepAllTheirDigits) {
    const auto type = R"({ "format": "pelage.materialtype/1", "version": 2, "name": "Test",
"groups": [{ "name": "look", "properties": [
  { "name": "seed", "type": "int", "default": 0, "connect": { "input": "seed" } } ] }],
"inputs": { "seed": "int" }, "shaders": { "main": { "drawList": "forward", "vertex": "a.vert" } } })";
    const auto types = [&](const std::string&) { return MaterialType::parse(type, "T", FunctorRegistry::standard()); };
    const auto migrated = migrate(file(1, R"("look.seed": 2147483647)"), "I", types);
    ASSERT_TRUE(migrated) << migrated.error().text();
    EXPECT_TRUE(migrated->isNeeded);
    EXPECT_NE(migrated->text.find("2147483647"), std::string::npos) << migrated->text;
}

TEST(Migrate, AnOldNameInANewFileIsRewritten) {
    const auto migrated = migrate(file(5, R"("look.tilt": 6)"), "I", source());
    ASSERT_TRUE(migrated);
    EXPECT_TRUE(migrated->isNeeded);
    EXPECT_NE(migrated->text.find("\"look.angle\": 6"), std::string::npos) << migrated->text;
    EXPECT_FALSE(migrate(file(6, ""), "I", source())) << "newer than the type";
}
