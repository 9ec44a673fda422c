// SPDX-License-Identifier: MIT
#include "schema_words.hpp"

#include <algorithm>
#include <charconv>

namespace pelage::json {

std::string quoted(std::string_view text) {
    return "\"" + std::string(text) + "\"";
}

std::string shown(double number) {
    char digits[64];
    const auto result = std::to_chars(digits, digits + sizeof digits, number);
    return {digits, result.ptr};
}

std::string shown(const Value& value) {
    switch (value.kind) {
        case Kind::Null:
            return "null";
        case Kind::Bool:
            return value.boolean ? "true" : "false";
        case Kind::Number:
            return shown(value.number);
        case Kind::String:
            return quoted(value.string);
        case Kind::Array:
            return "a list";
        case Kind::Object:
            return "an object";
    }
    return {};
}

std::string_view describe(Kind kind) {
    switch (kind) {
        case Kind::Null:
            return "null";
        case Kind::Bool:
            return "true or false";
        case Kind::Number:
            return "a number";
        case Kind::String:
            return "a string";
        case Kind::Array:
            return "a list";
        case Kind::Object:
            return "an object";
    }
    return {};
}

std::string_view describe(std::string_view type) {
    if (type == "object") return "an object";
    if (type == "array") return "a list";
    if (type == "string") return "a string";
    if (type == "number") return "a number";
    if (type == "integer") return "a whole number";
    if (type == "boolean") return "true or false";
    return "null";
}

bool isOfType(const Value& value, std::string_view type) {
    switch (value.kind) {
        case Kind::Null:
            return type == "null";
        case Kind::Bool:
            return type == "boolean";
        case Kind::Number:
            return type == "number" || (type == "integer" && value.isInteger);
        case Kind::String:
            return type == "string";
        case Kind::Array:
            return type == "array";
        case Kind::Object:
            return type == "object";
    }
    return false;
}

bool equal(const Value& a, const Value& b) {
    if (a.kind != b.kind) return false;
    switch (a.kind) {
        case Kind::Null:
            return true;
        case Kind::Bool:
            return a.boolean == b.boolean;
        case Kind::Number:
            return a.number == b.number;
        case Kind::String:
            return a.string == b.string;
        case Kind::Array:
            return std::equal(a.elements.begin(), a.elements.end(), b.elements.begin(), b.elements.end(), equal);
        case Kind::Object:
            return a.members.size() == b.members.size() &&
                   std::all_of(a.members.begin(), a.members.end(), [&](const Member& member) {
                       const Value* other = b.find(member.key);
                       return other && equal(member.value, *other);
                   });
    }
    return false;
}

std::string nameHint(std::string_view word, const std::vector<std::string>& known) {
    if (const std::string_view near = nearestName(word, known); !near.empty())
        return "did you mean '" + std::string(near) + "'?";
    if (known.empty() || known.size() > 12) return {};
    std::string hint = "known: ";
    std::vector<std::string> sorted = known;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 0; i < sorted.size(); ++i) hint += (i ? ", " : "") + sorted[i];
    return hint;
}

std::string typeHint(const Value& value, const std::vector<std::string_view>& wanted) {
    for (const std::string_view word : wanted) {
        if (value.isString() && (word == "number" || word == "integer")) {
            double number = 0;
            const char* end = value.string.data() + value.string.size();
            const auto parsed = std::from_chars(value.string.data(), end, number);
            if (parsed.ec == std::errc() && parsed.ptr == end) return "remove the quotes";
        }
        if (value.isString() && word == "boolean" && (value.string == "true" || value.string == "false"))
            return "remove the quotes";
        if (word == "string" && (value.isNumber() || value.isBool())) return "add quotes";
        if (word == "array" && !value.isArray() && !value.isObject()) return "put [ ] around it";
    }
    return {};
}

std::string formOf(const Value& branch) {
    if (const Value* only = branch.find("const")) return shown(*only);
    if (const Value* words = branch.find("enum")) {
        std::string out = "one of ";
        for (std::size_t i = 0; i < words->elements.size(); ++i) out += (i ? ", " : "") + shown(words->elements[i]);
        return out;
    }
    const Value* type = branch.find("type");
    return type && type->isString() ? std::string(describe(type->string)) : "of another form";
}

}  // namespace pelage::json
