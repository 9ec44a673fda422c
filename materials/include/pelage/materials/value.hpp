// SPDX-License-Identifier: MIT
// The value of a material property, shader input or functor port.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace pelage::materials {

enum class ValueType : std::uint8_t {
    Bool,
    Int,
    Uint,
    Float,
    Float2,
    Float3,
    Float4,
    Color,  // scene-linear RGB once inside the program; files state their space
    Enum,   // `integer` is the index among the property's words, `text` the word
    Texture2D,
    TextureCube,  // `text` is a path or "builtin.white|grey|black|asset"
};
std::string_view name(ValueType type);
/// "float3" and so on; false for an unknown word.
bool valueTypeFromName(std::string_view word, ValueType& type);

struct Value {
    ValueType type = ValueType::Float;
    std::array<float, 4> number = {};  // Float.., Color
    std::int64_t integer = 0;          // Bool (0 or 1), Int, Uint, Enum
    std::string text = {};             // Enum, Texture2D, TextureCube
    bool operator==(const Value&) const = default;

    static Value boolean(bool value) { return {ValueType::Bool, {}, value ? 1 : 0, {}}; }
    static Value int32(std::int32_t value) { return {ValueType::Int, {}, value, {}}; }
    static Value scalar(float value) { return {ValueType::Float, {value, 0, 0, 0}, 0, {}}; }
    static Value float3(float x, float y, float z) { return {ValueType::Float3, {x, y, z, 0}, 0, {}}; }
    static Value color(float r, float g, float b) { return {ValueType::Color, {r, g, b, 1}, 0, {}}; }
    static Value texture(std::string path) { return {ValueType::Texture2D, {}, 0, std::move(path)}; }
};

/// The sRGB transfer function of IEC 61966-2-1, for colours written in files. In 0..1; larger values pass on the curve.
float srgbToLinear(float encoded);
float linearToSrgb(float linear);

}  // namespace pelage::materials
