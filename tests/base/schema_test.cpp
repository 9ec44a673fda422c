// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <pelage/base/json.hpp>

#include <array>
#include <fstream>
#include <sstream>

using namespace pelage;

namespace {

constexpr std::string_view schemaText = R"({
    "type": "object",
    "required": ["name"],
    "additionalProperties": false,
    "properties": {
        "format": { "const": "thing/1", "x-code": "J020" },
        "name": { "type": "string", "pattern": "^[a-z]+$" },
        "count": { "type": "integer", "minimum": 1, "maximum": 8, "multipleOf": 2 },
        "size": { "type": "number", "exclusiveMinimum": 0 },
        "mode": { "enum": ["opaque", "blend", 4] },
        "on": { "type": "boolean" },
        "list": { "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 3, "uniqueItems": true },
        "pair": { "type": "array", "prefixItems": [{ "type": "string" }, { "type": "number" }], "items": false },
        "either": { "type": ["number", "string"] },
        "shape": { "oneOf": [{ "const": "*", "type": "string" }, { "type": "array", "items": { "$ref": "#/$defs/word" } }] },
        "action": { "oneOf": [{ "$ref": "#/$defs/rename" }, { "$ref": "#/$defs/set" }] },
        "both": { "type": "object", "oneOf": [{ "required": ["a"] }, { "required": ["b"] }],
                  "x-error": ["M006", "needs exactly one of \"a\" and \"b\""] },
        "groups": { "type": "array", "items": { "$ref": "#/$defs/group" } },
        "map": { "type": "object", "propertyNames": { "type": "string", "pattern": "^k" }, "maxProperties": 2,
                 "additionalProperties": { "type": "number" } },
        "coded": { "type": "array", "items": { "type": "number" }, "x-code": "M004", "x-hint": "say numbers" },
        "two": { "oneOf": [{ "type": "integer" }, { "type": "number" }] },
        "free": true
    },
    "$defs": {
        "word": { "type": "string" },
        "rename": { "type": "object", "required": ["op", "from"], "additionalProperties": false,
                    "properties": { "op": { "const": "rename" }, "from": { "type": "string" } } },
        "set": { "type": "object", "required": ["op", "value"], "additionalProperties": false,
                 "properties": { "op": { "const": "set" }, "value": { "type": "number" } } },
        "group": { "type": "object", "properties": { "name": { "type": "string" }, "default": { "type": "number" },
                                                      "type": { "enum": ["a", "b"] }, "extra": { "type": "number" } },
                   "if": { "properties": { "type": { "const": "a" } }, "required": ["type"] },
                   "then": { "required": ["extra"] },
                   "else": { "properties": { "extra": { "not": {}, "x-code": "M003" } } } }
    }
})";

struct Row {
    std::string_view document;
    std::string_view line;
};

std::string readFile(const std::string& path) {
    std::stringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

}  // namespace

TEST(Schema, EveryKeywordReportsItsOwnWay) {
    const auto schema = json::Schema::parse(schemaText, "schema");
    ASSERT_TRUE(schema) << schema.error().text();
    const Row rows[] = {
        {R"({"name":"a","cuont":2})",
         "T:1:13: error J010: unknown key \"cuont\" in the document; hint: did you mean 'count'?"},
        {R"({"name":"a","Count":2})",
         "T:1:13: error J010: unknown key \"Count\" in the document; hint: did you mean 'count'?"},
        {R"({})", "T:1:1: error J011: the document has no \"name\"; hint: add it"},
        {R"([])", "T:1:1: error J012: the document must be an object, found a list"},
        {R"({"name":1})", "T:1:9: error J012: name must be a string, found a number; hint: add quotes"},
        {R"({"name":"a","count":"4"})",
         "T:1:21: error J012: count must be a whole number, found a string; hint: remove the quotes"},
        {R"({"name":"a","count":2.5})", "T:1:21: error J012: count must be a whole number, found 2.5"},
        {R"({"name":"a","on":"true"})",
         "T:1:18: error J012: on must be true or false, found a string; hint: remove the quotes"},
        {R"({"name":"a","list":4})",
         "T:1:20: error J012: list must be a list, found a number; hint: put [ ] around it"},
        {R"({"name":"a","either":true})",
         "T:1:22: error J012: either must be a number or a string, found true or false; hint: add quotes"},
        {R"({"name":"a","mode":"opague"})",
         "T:1:20: error J013: \"opague\" is not a value of mode; hint: did you mean 'opaque'?"},
        {R"({"name":"a","mode":"xyz"})",
         "T:1:20: error J013: \"xyz\" is not a value of mode; hint: known: 4, blend, opaque"},
        {R"({"name":"a","count":12})", "T:1:21: error J014: count is 12, must be at most 8"},
        {R"({"name":"a","count":3})", "T:1:21: error J014: count is 3, must be a multiple of 2"},
        {R"({"name":"a","size":0})", "T:1:20: error J014: size is 0, must be more than 0"},
        {R"({"name":"A"})", "T:1:9: error J015: \"A\" is not of the right form for name; hint: must match ^[a-z]+$"},
        {R"({"name":"a","list":[1]})", "T:1:20: error J016: list needs at least 2 elements, found 1"},
        {R"({"name":"a","list":[1,2,3,4]})", "T:1:20: error J016: list needs at most 3 elements, found 4"},
        {R"({"name":"a","list":[1,2,1]})", "T:1:25: error J017: 1 stands twice in list; hint: first at 1:21"},
        {R"({"name":"a","pair":["x",1,2]})", "T:1:27: error J019: pair[2] is not allowed here; hint: remove it"},
        {R"({"name":"a","format":"thing/9"})",
         "T:1:22: error J020: format is \"thing/9\"; this build reads \"thing/1\""},
        {R"({"name":"a","shape":4})", "T:1:21: error J012: shape must be \"*\" or a list, found 4"},
        {R"({"name":"a","shape":"all"})", "T:1:21: error J018: shape must be \"*\", found \"all\""},
        {R"({"name":"a","shape":["x",1]})",
         "T:1:26: error J012: shape[1] must be a string, found a number; hint: add quotes"},
        {R"({"name":"a","action":{"op":"set","valeu":1}})",
         "T:1:34: error J010: unknown key \"valeu\" in action; hint: did you mean 'value'?"},
        {R"({"name":"a","action":{"op":"set"}})", "T:1:22: error J011: action has no \"value\"; hint: add it"},
        {R"({"name":"a","both":{"a":1,"b":2}})", "T:1:20: error M006: both needs exactly one of \"a\" and \"b\""},
        {R"({"name":"a","groups":[{"name":"g","default":"7"}]})",
         "T:1:45: error J012: groups['g'].default must be a number, found a string; hint: remove the quotes"},
        {R"({"name":"a","groups":[{"type":"a"}]})", "T:1:23: error J011: groups[0] has no \"extra\"; hint: add it"},
        {R"({"name":"a","groups":[{"type":"b","extra":1}]})",
         "T:1:43: error M003: groups[0].extra is not allowed here; hint: remove it"},
        {R"({"name":"a","map":{"x":1}})",
         "T:1:20: error J015: \"x\" is not of the right form for map.x; hint: must match ^k"},
        {R"({"name":"a","map":{"k.1":"x"}})", "T:1:26: error J012: map['k.1'] must be a number, found a string"},
        {R"({"name":"a","map":{"k1":1,"k2":1,"k3":1}})", "T:1:19: error J016: map needs at most 2 members, found 3"},
        {R"({"name":"a","two":1})", "T:1:19: error J021: two fits more than one of its forms"},
        {R"({"name":"a","coded":[true]})",
         "T:1:22: error M004: coded[0] must be a number, found true or false; hint: say numbers"},
    };
    for (const Row& row : rows) {
        const auto document = json::parse(row.document, "T");
        ASSERT_TRUE(document) << row.document;
        const Diagnostics found = schema->validate(*document);
        ASSERT_FALSE(found.empty()) << row.document;
        EXPECT_EQ(toString(found.items()[0]), row.line);
    }
}

TEST(Schema, RightDocumentsPassSilently) {
    const auto schema = json::Schema::parse(schemaText, "schema");
    ASSERT_TRUE(schema);
    const std::string_view good[] = {
        R"({"name":"a"})",
        R"({"name":"a","count":4,"size":0.5,"mode":4,"on":false,"list":[1,2],"pair":["x",1],"either":"s","shape":"*"})",
        R"({"name":"a","shape":["x"],"action":{"op":"rename","from":"x"},"both":{"b":1},"map":{"k":1},"free":{"x":[]}})",
        R"({"name":"a","groups":[{"type":"a","extra":1},{"type":"b"},{}],"format":"thing/1"})"};
    for (const std::string_view text : good) {
        const auto document = json::parse(text, "T");
        ASSERT_TRUE(document);
        EXPECT_EQ(schema->validate(*document).text(), "") << text;
    }
}

TEST(Schema, AllFaultsComeAtOnceInOrder) {
    const auto schema = json::Schema::parse(schemaText, "schema");
    const auto document = json::parse("{\"mode\":\"x\",\n\"cuont\":1,\n\"name\":\"A\"}", "T");
    ASSERT_TRUE(schema && document);
    const Diagnostics found = schema->validate(*document);
    ASSERT_EQ(found.items().size(), 3U);
    EXPECT_EQ(found.items()[0].line, 1U);
    EXPECT_EQ(found.items()[1].line, 2U);
    EXPECT_EQ(found.items()[2].line, 3U);
}

TEST(Schema, KeywordsOutsideTheSubsetAreRefused) {
    const Row rows[] = {
        {R"({"patternProperties":{}})",
         "S:1:2: error J030: schema: keyword \"patternProperties\" is not in the subset of JSON Schema read here"},
        {R"({"properties":{"a":{"tpye":"string"}}})",
         "S:1:21: error J030: schema: keyword \"tpye\" is not in the subset of JSON Schema read here"},
        {R"({"$ref":"#/$defs/none"})", "S:1:9: error J030: schema: nothing at \"#/$defs/none\""},
        {R"({"type":"text"})", "S:1:9: error J030: schema: \"text\" is not a type"},
        {R"({"pattern":"("})", "S:1:12: error J030: schema: the pattern is not a regular expression"},
        {R"({"required":[1]})", "S:1:13: error J030: schema: \"required\" must be a list of words"},
        {R"({"x-error":["M006"]})", "S:1:12: error J030: schema: \"x-error\" must be [code, text]"},
        {R"(1)", "S:1:1: error J030: schema: a schema must be an object, true or false"},
    };
    for (const Row& row : rows) {
        const auto schema = json::Schema::parse(row.document, "S");
        ASSERT_FALSE(schema) << row.document;
        EXPECT_EQ(toString(schema.error().items()[0]), row.line);
    }
}

TEST(Schema, HostileDocumentsAndSchemasEnd) {
    const auto loop = json::Schema::parse(R"({"$ref":"#"})", "S");
    ASSERT_TRUE(loop);
    const auto document = json::parse("{}", "T");
    EXPECT_TRUE(loop->validate(*document).empty());

    const auto pattern = json::Schema::parse(R"({"type":"string","pattern":"^(a|b)*$"})", "S");
    const auto longText = json::parse("\"" + std::string(1000000, 'a') + "\"", "T");
    ASSERT_TRUE(pattern && longText);
    EXPECT_EQ(pattern->validate(*longText).items().size(), 1U);
}

TEST(Schema, ShippedSchemasAreInsideTheSubset) {
    for (const char* name : {"/materials/data/materialtype.schema.json", "/materials/data/material.schema.json",
                             "/passes/data/passtree.schema.json", "/hair/data/schemas/scene.schema.json"}) {
        const std::string text = readFile(std::string(PELAGE_SOURCE_DIR) + name);
        ASSERT_FALSE(text.empty());
        const auto schema = json::Schema::parse(text, name);
        EXPECT_TRUE(schema) << schema.error().text();
    }
}
