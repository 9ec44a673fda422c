// SPDX-License-Identifier: MIT
// The words in which a schema's findings are told.
#pragma once

#include <pelage/base/json.hpp>

namespace pelage::json {

std::string quoted(std::string_view text);
/// A value as it may stand in a sentence: 0.5, "word", a list.
std::string shown(const Value& value);
std::string shown(double number);
/// "a number", of a value or of a type word of JSON Schema.
std::string_view describe(Kind kind);
std::string_view describe(std::string_view type);
bool isOfType(const Value& value, std::string_view type);
bool equal(const Value& a, const Value& b);
/// "did you mean 'x'?", or the list of what is known when that is short.
std::string nameHint(std::string_view word, const std::vector<std::string>& known);
/// What to do about a value that has none of the wanted types: "remove the quotes".
std::string typeHint(const Value& value, const std::vector<std::string_view>& wanted);
/// What a branch of a oneOf accepts.
std::string formOf(const Value& branch);

}  // namespace pelage::json
