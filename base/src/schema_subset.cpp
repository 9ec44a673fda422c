// SPDX-License-Identifier: MIT
#include "schema_subset.hpp"

namespace pelage::json {
namespace {

enum class Shape { Text, Anything, Boolean, Number, Types, Words, Values, Schema, Schemas, SchemaMap, Error };

struct Keyword {
    std::string_view name;
    Shape shape;
};

constexpr Keyword keywords[] = {
    {"$schema", Shape::Text},
    {"$id", Shape::Text},
    {"$comment", Shape::Text},
    {"title", Shape::Text},
    {"description", Shape::Text},
    {"default", Shape::Anything},
    {"examples", Shape::Anything},
    {"$ref", Shape::Text},
    {"$defs", Shape::SchemaMap},
    {"type", Shape::Types},
    {"const", Shape::Anything},
    {"enum", Shape::Values},
    {"properties", Shape::SchemaMap},
    {"required", Shape::Words},
    {"additionalProperties", Shape::Schema},
    {"propertyNames", Shape::Schema},
    {"minProperties", Shape::Number},
    {"maxProperties", Shape::Number},
    {"pattern", Shape::Text},
    {"minLength", Shape::Number},
    {"maxLength", Shape::Number},
    {"items", Shape::Schema},
    {"prefixItems", Shape::Schemas},
    {"minItems", Shape::Number},
    {"maxItems", Shape::Number},
    {"uniqueItems", Shape::Boolean},
    {"minimum", Shape::Number},
    {"maximum", Shape::Number},
    {"exclusiveMinimum", Shape::Number},
    {"multipleOf", Shape::Number},
    {"oneOf", Shape::Schemas},
    {"anyOf", Shape::Schemas},
    {"allOf", Shape::Schemas},
    {"not", Shape::Schema},
    {"if", Shape::Schema},
    {"then", Shape::Schema},
    {"else", Shape::Schema},
    {"x-error", Shape::Error},
};

class Checker {
public:
    Checker(const Document& document, Patterns& patterns) : document_(document), patterns_(patterns) {}

    void schema(const Value& value) {
        if (value.isBool()) return;
        if (!value.isObject()) return fault(value.place, "a schema must be an object, true or false");
        for (const Member& member : value.members) {
            if (member.key == "x-code" || member.key == "x-hint") {
                if (!member.value.isString()) fault(member.value.place, member.key + " must be a string");
                if (member.key == "x-code") codeWord(member.value);
                continue;
            }
            const Keyword* known = nullptr;
            for (const Keyword& keyword : keywords) {
                if (keyword.name == member.key) known = &keyword;
            }
            if (!known) {
                fault(member.place, "keyword \"" + member.key + "\" is not in the subset of JSON Schema read here");
            } else {
                keyword(*known, member.value);
            }
        }
    }

    Diagnostics take() { return std::move(out_); }

private:
    void fault(Place place, std::string text) {
        out_.add({Severity::Error, "J030", document_.file, place.line, place.column, "schema: " + std::move(text), {}});
    }
    void expect(bool right, const Keyword& keyword, const Value& value, std::string_view kind) {
        if (!right) fault(value.place, "\"" + std::string(keyword.name) + "\" must be " + std::string(kind));
    }
    static bool isWords(const Value& value) {
        if (!value.isArray()) return false;
        for (const Value& element : value.elements) {
            if (!element.isString()) return false;
        }
        return true;
    }

    void keyword(const Keyword& keyword, const Value& value) {
        switch (keyword.shape) {
            case Shape::Anything:
                break;
            case Shape::Text:
                expect(value.isString(), keyword, value, "a string");
                if (value.isString() && keyword.name == "$ref" && !resolveReference(document_.root, value.string))
                    fault(value.place, "nothing at \"" + value.string + "\"");
                if (value.isString() && keyword.name == "pattern") pattern(value);
                break;
            case Shape::Boolean:
                expect(value.isBool(), keyword, value, "true or false");
                break;
            case Shape::Number:
                expect(value.isNumber(), keyword, value, "a number");
                break;
            case Shape::Types:
                expect(value.isString() || isWords(value), keyword, value, "a word or a list of words");
                typeWord(value);
                for (const Value& element : value.elements) typeWord(element);
                break;
            case Shape::Words:
                expect(isWords(value), keyword, value, "a list of words");
                break;
            case Shape::Error:
                expect(isWords(value) && value.elements.size() == 2, keyword, value, "[code, text]");
                if (!value.elements.empty()) codeWord(value.elements.front());
                break;
            case Shape::Values:
                expect(value.isArray(), keyword, value, "a list");
                break;
            case Shape::Schema:
                schema(value);
                break;
            case Shape::Schemas:
                expect(value.isArray(), keyword, value, "a list of schemas");
                for (const Value& element : value.elements) schema(element);
                break;
            case Shape::SchemaMap:
                expect(value.isObject(), keyword, value, "an object of schemas");
                for (const Member& member : value.members) schema(member.value);
                break;
        }
    }

    void codeWord(const Value& value) {
        if (value.isString() && !Code::find(value.string)) {
            fault(value.place, "\"" + value.string + "\" is no code of codes.def");
        }
    }

    void typeWord(const Value& value) {
        if (!value.isString()) return;
        for (const std::string_view word : {"object", "array", "string", "number", "integer", "boolean", "null"}) {
            if (value.string == word) return;
        }
        fault(value.place, "\"" + value.string + "\" is not a type");
    }

    void pattern(const Value& value) {
        try {
            if (patterns_.count(value.string) == 0)
                patterns_.emplace(value.string,
                                  std::regex(value.string, std::regex::ECMAScript | std::regex::optimize));
        } catch (const std::regex_error&) {
            fault(value.place, "the pattern is not a regular expression");
        }
    }

    const Document& document_;
    Patterns& patterns_;
    Diagnostics out_ = {};
};

}  // namespace

const Value* resolveReference(const Value& root, std::string_view reference) {
    if (reference == "#") return &root;
    constexpr std::string_view prefix = "#/$defs/";
    if (reference.substr(0, prefix.size()) != prefix) return nullptr;
    const Value* definitions = root.find("$defs");
    return definitions ? definitions->find(reference.substr(prefix.size())) : nullptr;
}

Diagnostics checkSchema(const Document& schema, Patterns& patterns) {
    Checker checker(schema, patterns);
    checker.schema(schema.root);
    return checker.take();
}

}  // namespace pelage::json
