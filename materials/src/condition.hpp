// SPDX-License-Identifier: MIT
// The small typed expressions of visibleWhen and enabledWhen: || && ! == != < <= > >= in ['a', 'b'], numbers, words in
// single quotes, true, false, and property names. They are parsed once; names and words are checked then.
#pragma once

#include <pelage/materials/material.hpp>

namespace pelage::materials {

class Condition {
public:
    /// A fault (E001 syntax, E002 unknown name, E003 unknown word, E004 kinds that do not fit) has in `column` the
    /// 1-based byte of the expression.
    static Outcome<Condition> parse(std::string_view text, const std::vector<Property>& properties);
    /// `values` by property index. A condition that was never parsed is true.
    bool evaluate(const std::vector<Value>& values) const;
    /// Indices of the properties it reads.
    std::vector<std::size_t> reads() const;

    enum class Operation : std::uint8_t {
        Literal,
        Word,
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
    struct Node {
        Operation operation = Operation::Literal;
        double number = 0;             // Literal; bool as 0 or 1
        std::size_t property = 0;      // Read
        std::vector<double> set = {};  // In: words as their index
        std::size_t left = 0, right = 0;
    };

private:
    double evaluate(std::size_t node, const std::vector<Value>& values) const;

    std::vector<Node> nodes_ = {};  // children before parents; the last is the root
};

}  // namespace pelage::materials
