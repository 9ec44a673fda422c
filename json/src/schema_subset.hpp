// SPDX-License-Identifier: MIT
// The subset of JSON Schema 2020-12 that Pelage reads, and the check that a schema stays inside it.
#pragma once

#include <pelage/json/value.hpp>

namespace pelage::json {

/// The subschema that `reference` ("#", "#/$defs/name") points at; null when there is none.
const Value* resolveReference(const Value& root, std::string_view reference);

/// Faults of a schema itself: keywords outside the subset, wrong kinds, dead references, bad patterns (code J030).
Diagnostics checkSchema(const Document& schema);

}  // namespace pelage::json
