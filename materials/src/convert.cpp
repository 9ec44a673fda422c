// SPDX-License-Identifier: MIT
#include "convert.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace pelage::materials {
namespace {

tl::unexpected<Diagnostics> refuse(Code code, std::string text, std::string hint = {}) {
    return tl::unexpected<Diagnostics>(Diagnostic{.code = code, .text = std::move(text), .hint = std::move(hint)});
}

std::string quoted(std::string_view text) {
    std::string out = "'";
    out.append(text).push_back('\'');
    return out;
}

bool isWhole(ValueType type) {
    return type == ValueType::Int || type == ValueType::Uint;
}

std::string_view wanted(const Property& property) {
    switch (property.type) {
        case ValueType::Bool:
            return "true or false";
        case ValueType::Int:
        case ValueType::Uint:
            return "a whole number";
        case ValueType::Float:
            return "a number";
        case ValueType::Float2:
            return "two numbers";
        case ValueType::Float3:
            return "three numbers";
        case ValueType::Color:
            return "a colour of three numbers";
        case ValueType::Float4:
            return "four numbers";
        case ValueType::Enum:
            return "one of its words";
        case ValueType::Texture2D:
        case ValueType::TextureCube:
            return "a texture path";
    }
    return "something else";
}

tl::unexpected<Diagnostics> refuseType(const Property& property, std::string_view found, std::string hint = {}) {
    return refuse("V003",
                  quoted(property.id) + " must be " + std::string(wanted(property)) + ", found " + std::string(found),
                  std::move(hint));
}

Result<Value> fromWord(const Property& property, std::string_view word) {
    const auto found = std::find(property.words.begin(), property.words.end(), word);
    if (found == property.words.end())
        return refuse("V004", quoted(word) + " is not a value of " + quoted(property.id),
                      nameHint(word, property.words));
    return Value{ValueType::Enum, {}, found - property.words.begin(), *found};
}

Result<Value> fromTexture(const Property& property, std::string_view path) {
    if (path.empty()) return refuseType(property, "an empty path", "for no texture write builtin.white");
    constexpr std::string_view prefix = "builtin.";
    if (path.substr(0, prefix.size()) == prefix) {
        const std::vector<std::string> builtins{"builtin.white", "builtin.grey", "builtin.black", "builtin.asset"};
        if (std::find(builtins.begin(), builtins.end(), path) == builtins.end())
            return refuse("V004", quoted(path) + " is not a built-in texture", nameHint(path, builtins));
    }
    return Value{property.type, {}, 0, std::string(path)};
}

double rounded(double number) {
    constexpr double largest = std::numeric_limits<float>::max();
    // Beyond float the conversion is undefined; such numbers are clamped by the range next.
    return std::abs(number) <= largest ? static_cast<double>(static_cast<float>(number)) : number;
}

// `numbers` are in the program's space already (colours linear); `written` is what the person wrote.
Result<Value> fromNumbers(const Property& property, const std::vector<double>& numbers,
                          const std::vector<double>& written, Diagnostics& warnings) {
    const Range range = rangeOf(property);
    // A range is reported in the space that the person wrote in, without the noise of the round trip.
    const bool isEncoded = property.type == ValueType::Color && property.srgb && &numbers != &written;
    const auto bound = [&](double linear) {
        if (!isEncoded || std::abs(linear) > 1e3) return shown(linear);
        return shown(std::round(static_cast<double>(linearToSrgb(static_cast<float>(linear))) * 1e5) / 1e5);
    };
    bool isClamped = false;
    Value value;
    value.type = property.type;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        // Compared as it will be stored, so that 0.1 is inside 0.1..1.
        const double number = isWhole(property.type) ? numbers[i] : rounded(numbers[i]);
        if (!std::isfinite(numbers[i])) return refuse("V013", "a number that is not finite for " + quoted(property.id));
        const double clamped = std::clamp(number, range.min, range.max);
        if (clamped != number && !isClamped) {
            isClamped = true;
            warnings.add({.severity = Severity::Warning,
                          .code = "V005",
                          .text = shown(written[i]) + " is outside " + bound(range.min) + ".." + bound(range.max) +
                                  " of " + quoted(property.id),
                          .hint = "clamped to " + bound(clamped)});
        }
        if (isWhole(property.type)) {
            value.integer = static_cast<std::int64_t>(clamped);
        } else {
            const auto single = static_cast<float>(clamped);
            value.number[i] = single == 0.0F ? 0.0F : single;  // one zero only
        }
    }
    if (property.type == ValueType::Color) value.number[3] = 1.0F;
    return value;
}

Result<Value> fromFileNumbers(const Property& property, const std::vector<double>& written, Diagnostics& warnings) {
    std::vector<double> numbers = written;
    if (property.type == ValueType::Color && property.srgb) {
        for (double& number : numbers) {
            // Beyond float the curve would overflow; the range clamps such numbers anyway.
            if (std::isfinite(number)) number = srgbToLinear(static_cast<float>(std::clamp(number, -1e3, 1e3)));
        }
    }
    return fromNumbers(property, numbers, written, warnings);
}

std::string_view trim(std::string_view text) {
    const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
    while (!text.empty() && blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && blank(text.back())) text.remove_suffix(1);
    return text;
}

std::optional<double> numberFromText(std::string_view text) {
    double number = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), number);
    if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size()) return {};
    return number;
}

std::optional<std::vector<double>> hexColor(std::string_view text) {
    if (text.size() != 7 || text.front() != '#') return {};
    std::vector<double> out;
    for (std::size_t i = 1; i < 7; i += 2) {
        unsigned byte = 0;
        const char* end = text.data() + i + 2;
        const auto parsed = std::from_chars(text.data() + i, end, byte, 16);
        if (parsed.ec != std::errc() || parsed.ptr != end) return {};
        out.push_back(srgbToLinear(static_cast<float>(byte) / 255.0F));
    }
    return out;
}

}  // namespace

std::size_t componentCount(ValueType type) {
    switch (type) {
        case ValueType::Int:
        case ValueType::Uint:
        case ValueType::Float:
            return 1;
        case ValueType::Float2:
            return 2;
        case ValueType::Float3:
        case ValueType::Color:
            return 3;
        case ValueType::Float4:
            return 4;
        default:
            return 0;
    }
}

bool isTexture(ValueType type) {
    return type == ValueType::Texture2D || type == ValueType::TextureCube;
}

std::string shown(double number) {
    char digits[64];
    const auto single = static_cast<float>(number);
    const bool isSingle =
        std::isfinite(single) && std::abs(static_cast<double>(single) - number) <= 1e-7 * std::abs(number);
    const auto result = isSingle ? std::to_chars(digits, digits + sizeof digits, single)
                                 : std::to_chars(digits, digits + sizeof digits, number);
    return {digits, result.ptr};
}

Range rangeOf(const Property& property) {
    Range range{-static_cast<double>(std::numeric_limits<float>::max()), std::numeric_limits<float>::max()};
    if (property.type == ValueType::Int)
        range = {std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max()};
    if (property.type == ValueType::Uint) range = {0, std::numeric_limits<std::uint32_t>::max()};
    if (property.type == ValueType::Color) range.min = 0;
    if (property.min) range.min = std::max(range.min, *property.min);
    if (property.max) range.max = std::min(range.max, *property.max);
    if (property.type != ValueType::Int && property.type != ValueType::Uint) {
        range.min = rounded(range.min);
        range.max = rounded(range.max);
    }
    if (range.max < range.min) range.max = range.min;  // such a type is refused (M007)
    return range;
}

Result<Value> convert(const Property& property, const json::Value& value, Diagnostics& warnings) {
    const auto found = [&]() -> std::string_view {
        switch (value.kind) {
            case json::Kind::Null:
                return "null";
            case json::Kind::Bool:
                return "true or false";
            case json::Kind::Number:
                return "a number";
            case json::Kind::String:
                return "a string";
            case json::Kind::Array:
                return "a list";
            case json::Kind::Object:
                return "an object";
        }
        return "something else";
    };
    switch (property.type) {
        case ValueType::Bool:
            if (value.isBool()) return Value::boolean(value.boolean);
            return refuseType(property, found(),
                              value.string == "true" || value.string == "false" ? "remove the quotes" : "");
        case ValueType::Enum:
            if (value.isString()) return fromWord(property, value.string);
            return refuseType(property, found(), nameHint({}, property.words));
        case ValueType::Texture2D:
        case ValueType::TextureCube:
            if (value.isString()) return fromTexture(property, value.string);
            return refuseType(property, found());
        case ValueType::Int:
        case ValueType::Uint:
        case ValueType::Float:
            if (value.isString())
                return refuseType(property, found(), numberFromText(value.string) ? "remove the quotes" : "");
            if (!value.isNumber()) return refuseType(property, found());
            if (isWhole(property.type) && !value.isInteger) return refuseType(property, shown(value.number));
            return fromFileNumbers(property, {value.number}, warnings);
        default:
            break;
    }
    std::vector<double> numbers;
    for (const json::Value& element : value.elements) {
        if (!element.isNumber()) return refuseType(property, "a list with something that is no number");
        numbers.push_back(element.number);
    }
    if (!value.isArray()) return refuseType(property, found(), "write [ ] around the numbers");
    if (numbers.size() != componentCount(property.type))
        return refuseType(property, "a list of " + std::to_string(numbers.size()));
    return fromFileNumbers(property, numbers, warnings);
}

Result<Value> convert(const Property& property, std::string_view given, Diagnostics& warnings) {
    const std::string_view text = trim(given);
    switch (property.type) {
        case ValueType::Bool:
            for (const std::string_view yes : {"true", "1", "on", "yes"}) {
                if (text == yes) return Value::boolean(true);
            }
            for (const std::string_view no : {"false", "0", "off", "no"}) {
                if (text == no) return Value::boolean(false);
            }
            return refuseType(property, quoted(text));
        case ValueType::Enum:
            return fromWord(property, text);
        case ValueType::Texture2D:
        case ValueType::TextureCube:
            return fromTexture(property, text);
        default:
            break;
    }
    if (property.type == ValueType::Color && !text.empty() && text.front() == '#') {
        const auto color = hexColor(text);
        if (!color) return refuseType(property, quoted(text), "write six hexadecimal digits, such as #805030");
        return fromNumbers(property, *color, *color, warnings);
    }
    std::vector<double> numbers;
    std::string_view rest = text;
    while (true) {
        const std::size_t comma = rest.find(',');
        const std::optional<double> number = numberFromText(trim(rest.substr(0, comma)));
        if (!number) return refuseType(property, quoted(text));
        if (isWhole(property.type) && *number != std::floor(*number)) return refuseType(property, quoted(text));
        numbers.push_back(*number);
        if (comma == std::string_view::npos) break;
        rest.remove_prefix(comma + 1);
    }
    if (numbers.size() != componentCount(property.type)) return refuseType(property, quoted(text));
    return fromFileNumbers(property, numbers, warnings);
}

Result<Value> convert(const Property& property, const Value& value, Diagnostics& warnings) {
    const bool isColor = property.type == ValueType::Color || property.type == ValueType::Float3;
    const bool givesColor = value.type == ValueType::Color || value.type == ValueType::Float3;
    if (value.type != property.type && !(isWhole(property.type) && isWhole(value.type)) && !(isColor && givesColor))
        return refuseType(property, name(value.type));
    switch (property.type) {
        case ValueType::Bool:
            return Value::boolean(value.integer != 0);
        case ValueType::Enum:
            if (!value.text.empty()) return fromWord(property, value.text);
            if (value.integer < 0 || static_cast<std::size_t>(value.integer) >= property.words.size())
                return refuse("V004",
                              std::to_string(value.integer) + " is not the index of a value of " + quoted(property.id));
            return fromWord(property, property.words[static_cast<std::size_t>(value.integer)]);
        case ValueType::Texture2D:
        case ValueType::TextureCube:
            return fromTexture(property, value.text);
        case ValueType::Int:
        case ValueType::Uint: {
            const std::vector<double> whole{static_cast<double>(value.integer)};
            return fromNumbers(property, whole, whole, warnings);
        }
        default:
            break;
    }
    std::vector<double> numbers;
    for (std::size_t i = 0; i < componentCount(property.type); ++i)
        numbers.push_back(static_cast<double>(value.number[i]));
    return fromNumbers(property, numbers, numbers, warnings);
}

}  // namespace pelage::materials
