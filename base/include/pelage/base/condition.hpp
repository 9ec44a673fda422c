// SPDX-License-Identifier: MIT
// Conditions in authored files (visibleWhen, enabledWhen): || && ! == != < <= > >= in ['a', 'b'], numbers, words in
// single quotes, true, false, names, and at most one function of one word: host.has('SceneDepth'). A condition is
// parsed and typed once; evaluating it cannot fail.
#pragma once

#include <pelage/base/diagnostic.hpp>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace pelage::json {

/// What a condition may talk about.
struct ConditionNames {
    enum class Type : std::uint8_t { Bool, Number, Word, Other };  // Other: exists, but cannot be compared
    struct Name {
        std::string name = {};
        Type type = Type::Bool;
        std::vector<std::string> words = {};  // Word: those it can be
        bool isSingle = false;                // Number in single precision: 0.1 in a condition equals a float of 0.1
    };
    std::string kind = "property";  // what messages call a name
    std::vector<Name> names = {};
    /// name('word') is true or false; without a name there is no function.
    struct Function {
        std::string name = {}, kind = {};     // "host.has", "import"
        std::vector<std::string> words = {};  // those it knows
    } function = {};
};

class Condition {
public:
    /// A fault (E001 syntax or size, E002 unknown name, E003 unknown word, E004 kinds that do not fit) has in `column`
    /// the 1-based byte of the text; file and line are the caller's to fill. At most 1024 bytes, 32 levels deep.
    static Result<Condition> parse(std::string_view text, const ConditionNames& names);

    /// `value` gives a name's value by its index in `names` (a bool as 0 or 1, a word as its index), and, counted on
    /// from there, 0 or 1 for each word of the function. A condition that was never parsed is true.
    bool evaluate(const std::function<double(std::size_t)>& value) const;
    /// The indices `evaluate` may ask for, in the order of the text.
    std::vector<std::size_t> reads() const;

    struct Node;

private:
    double evaluate(std::size_t node, const std::function<double(std::size_t)>& value) const;

    enum class Operation : std::uint8_t {
        Literal,
        Read,
        Not,
        And,
        Or,
        Equal,
        NotEqual,
        Less,
        LessEqual,
        Greater,
        GreaterEqual,
        In
    };
    friend class ConditionParser;
    std::vector<Node> nodes_;  // children before parents; the last is the root
};

struct Condition::Node {
    Operation operation = Operation::Literal;
    double number = 0;             // Literal; a bool as 0 or 1, a word as its index
    std::size_t name = 0;          // Read
    std::vector<double> set = {};  // In
    std::size_t left = 0, right = 0;
};

}  // namespace pelage::json
