// SPDX-License-Identifier: MIT
#include <pelage/materials/value.hpp>

#include <array>
#include <cmath>
#include <utility>

namespace pelage::materials {
namespace {

constexpr std::array<std::pair<ValueType, std::string_view>, 11> typeNames{{
    {ValueType::Bool, "bool"},
    {ValueType::Int, "int"},
    {ValueType::Uint, "uint"},
    {ValueType::Float, "float"},
    {ValueType::Float2, "float2"},
    {ValueType::Float3, "float3"},
    {ValueType::Float4, "float4"},
    {ValueType::Color, "color"},
    {ValueType::Enum, "enum"},
    {ValueType::Texture2D, "texture2d"},
    {ValueType::TextureCube, "textureCube"},
}};

}  // namespace

std::string_view name(ValueType type) {
    for (const auto& [candidate, word] : typeNames) {
        if (candidate == type) return word;
    }
    return "unknown";
}

bool valueTypeFromName(std::string_view word, ValueType& type) {
    for (const auto& [candidate, known] : typeNames) {
        if (known != word) continue;
        type = candidate;
        return true;
    }
    return false;
}

float srgbToLinear(float encoded) {
    if (encoded <= 0.04045F) return encoded / 12.92F;
    return std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

float linearToSrgb(float linear) {
    if (linear <= 0.0031308F) return linear * 12.92F;
    return 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
}

}  // namespace pelage::materials
