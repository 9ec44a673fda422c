// SPDX-License-Identifier: MIT
// From what a file, a person or a program gives to the value of a property: one set of rules and codes (V003..V013).
#pragma once

#include <pelage/base/json.hpp>
#include <pelage/materials/material.hpp>

namespace pelage::materials {

/// The value, or why there is none (without file and place). A number outside the property's range is clamped and
/// `warnings` gets V005.
Result<Value> convert(const Property& property, const json::Value& value, Diagnostics& warnings);
Result<Value> convert(const Property& property, std::string_view text, Diagnostics& warnings);
/// From a program: the type must be the property's (Int and Uint, Color and Float3 may stand for each other).
Result<Value> convert(const Property& property, const Value& value, Diagnostics& warnings);

/// Components of a number type (0 for others).
std::size_t componentCount(ValueType type);
bool isTexture(ValueType type);

/// Shortest digits that give the same float back: 0.1, not 0.10000000149.
std::string shown(double number);

/// The limits that hold at run time, from the file or from the type.
struct Range {
    double min = 0, max = 0;
};
Range rangeOf(const Property& property);

}  // namespace pelage::materials
