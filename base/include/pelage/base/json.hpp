// SPDX-License-Identifier: MIT
// A JSON document that remembers where everything stood. Strict JSON plus // and /* */ comments; a key given twice, a
// trailing comma, a number that is not finite and nesting deeper than 64 are errors. Order of members is kept.
#pragma once

#include <pelage/base/diagnostic.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pelage::json {

struct Place {
    std::uint32_t line = 0, column = 0;  // 1-based
};

enum class Kind : std::uint8_t { Null, Bool, Number, String, Array, Object };

struct Member;

struct Value {
    Kind kind = Kind::Null;
    Place place = {};
    bool boolean = false;
    double number = 0.0;
    bool isInteger = false;  // written without fraction or exponent
    std::string string = {};
    std::vector<Value> elements = {};  // Array
    std::vector<Member> members;       // Object, in the order of the text; no "= {}", for Member is incomplete here

    /// The member called `key`, or null (also when this is not an object).
    const Value* find(std::string_view key) const;
    const Member* member(std::string_view key) const;
    bool isObject() const { return kind == Kind::Object; }
    bool isArray() const { return kind == Kind::Array; }
    bool isString() const { return kind == Kind::String; }
    bool isNumber() const { return kind == Kind::Number; }
    bool isBool() const { return kind == Kind::Bool; }
};

struct Member {
    std::string key = {};
    Place place = {};  // of the key
    Value value = {};
};

struct Document {
    std::string file = {};
    Value root = {};
};

/// Reads a text. `file` is the name used in diagnostics. Never throws; one error (the first) per text, codes
/// J001..J009.
Result<Document> parse(std::string_view text, std::string_view file);

/// Reads a file of at most 4 MiB (codes F001 cannot open, F002 too large, then as parse()).
Result<Document> parseFile(const std::string& path);

/// A schema in the subset of JSON Schema 2020-12 that the shipped schemas use, with "x-code" to name the diagnostic.
class Schema {
public:
    /// Reads a schema. A schema that uses a keyword outside the subset is refused.
    static Result<Schema> parse(std::string_view text, std::string_view file);
    /// Everything in `document` that breaks the schema: wrong kinds, unknown and missing keys, words outside an enum,
    /// numbers outside a range, with places and the nearest known name (codes J010..J019).
    Diagnostics validate(const Document& document) const;

private:
    struct Compiled;
    std::shared_ptr<const Compiled> compiled_;
};

}  // namespace pelage::json
