// SPDX-License-Identifier: MIT
// The subset of JSON Schema 2020-12 that Pelage reads, and the check that a schema stays inside it.
#pragma once

#include <pelage/base/json.hpp>

#include <map>
#include <regex>

namespace pelage::json {

/// The subschema that `reference` ("#", "#/$defs/name") points at; null when there is none.
const Value* resolveReference(const Value& root, std::string_view reference);

/// The regular expression of each "pattern" in a schema.
using Patterns = std::map<std::string, std::regex, std::less<>>;

/// Faults of a schema itself: keywords outside the subset, wrong kinds, dead references, bad patterns (code J030).
/// `patterns` gets what it compiles on the way.
Diagnostics checkSchema(const Document& schema, Patterns& patterns);

}  // namespace pelage::json
