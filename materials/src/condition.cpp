// SPDX-License-Identifier: MIT
#include "condition.hpp"

#include "convert.hpp"

#include <algorithm>
#include <charconv>

namespace pelage::materials {
namespace {

using Operation = Condition::Operation;

enum class Type { Bool, Number, Word };

std::string_view name(Type type) {
    return type == Type::Bool ? "true or false" : type == Type::Number ? "a number" : "a word";
}

// Properties are single precision: 0.1 in a condition must equal 0.1 in a file.
double rounded(double number) {
    return static_cast<double>(static_cast<float>(number));
}

struct Token {
    enum class Kind { End, Name, Number, Word, Symbol, Bad } kind = Kind::End;
    std::string_view text = {};
    std::size_t at = 0;
    double number = 0;
};

class Lexer {
public:
    explicit Lexer(std::string_view text) : text_(text) { advance(); }
    const Token& token() const { return token_; }

    void advance() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
        token_ = {Token::Kind::End, {}, at_, 0};
        if (at_ >= text_.size()) return;
        const std::size_t start = at_;
        const char c = text_[at_];
        if (isLetter(c)) {
            while (at_ < text_.size() && (isLetter(text_[at_]) || isDigit(text_[at_]) || text_[at_] == '.')) ++at_;
            token_.kind = Token::Kind::Name;
        } else if (isDigit(c) || (c == '-' && at_ + 1 < text_.size() && isDigit(text_[at_ + 1]))) {
            const auto parsed = std::from_chars(text_.data() + at_, text_.data() + text_.size(), token_.number);
            token_.kind = parsed.ec == std::errc() ? Token::Kind::Number : Token::Kind::Bad;
            at_ = static_cast<std::size_t>(parsed.ptr - text_.data());
        } else if (c == '\'') {
            const std::size_t end = text_.find('\'', at_ + 1);
            token_.kind = end == std::string_view::npos ? Token::Kind::Bad : Token::Kind::Word;
            at_ = end == std::string_view::npos ? text_.size() : end + 1;
            token_.text = text_.substr(start + 1, at_ - start - 2);
            if (token_.kind == Token::Kind::Word) return;
        } else {
            token_.kind = Token::Kind::Bad;
            ++at_;
            for (const std::string_view symbol :
                 {"||", "&&", "==", "!=", "<=", ">=", "<", ">", "!", "(", ")", "[", "]", ","}) {
                if (text_.substr(start, symbol.size()) != symbol) continue;
                token_.kind = Token::Kind::Symbol;
                at_ = start + symbol.size();
                break;
            }
        }
        token_.text = text_.substr(start, at_ - start);
    }

private:
    static bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
    static bool isDigit(char c) { return c >= '0' && c <= '9'; }

    std::string_view text_;
    std::size_t at_ = 0;
    Token token_ = {};
};

struct Term {
    std::size_t node = 0;
    Type type = Type::Bool;
    std::size_t at = 0;
    const Property* property = nullptr;  // a bare enum property: gives words their meaning
    std::string_view word = {};          // a bare word, still without a number
};

// Recursive descent; the first fault ends it, and depth is bounded.
class Parser {
public:
    Parser(std::string_view text, const std::vector<Property>& properties, std::vector<Condition::Node>& nodes)
        : lexer_(text), properties_(properties), nodes_(nodes) {}

    std::optional<Diagnostic> run() {
        const std::optional<Term> whole = either();
        if (whole && token().kind != Token::Kind::End)
            fail("E001", token().at, "expected an operator, found " + found());
        if (whole && !fault_) needs(*whole, Type::Bool);
        return fault_;
    }

private:
    const Token& token() const { return lexer_.token(); }
    std::string found() const {
        return token().kind == Token::Kind::End ? "the end" : "'" + std::string(token().text) + "'";
    }
    bool at(std::string_view symbol) const { return token().kind == Token::Kind::Symbol && token().text == symbol; }
    bool take(std::string_view symbol) {
        if (!at(symbol)) return false;
        lexer_.advance();
        return true;
    }
    std::optional<Term> fail(std::string code, std::size_t where, std::string text, std::string hint = {}) {
        if (!fault_)
            fault_ = Diagnostic{Severity::Error, std::move(code), {}, 1, static_cast<std::uint32_t>(where + 1),
                                std::move(text), std::move(hint)};
        return {};
    }
    bool needs(const Term& term, Type type) {
        if (term.type == type) return true;
        fail("E004", term.at, "needs " + std::string(name(type)) + " here, found " + std::string(name(term.type)),
             term.property && term.type == Type::Word ? "compare it: == 'word'" : "");
        return false;
    }
    std::size_t add(Condition::Node node) {
        nodes_.push_back(std::move(node));
        return nodes_.size() - 1;
    }

    std::optional<Term> either() { return chain("||", Operation::Or, &Parser::both); }
    std::optional<Term> both() { return chain("&&", Operation::And, &Parser::comparison); }

    std::optional<Term> chain(std::string_view symbol, Operation operation, std::optional<Term> (Parser::*part)()) {
        std::optional<Term> left = (this->*part)();
        while (left && at(symbol)) {
            lexer_.advance();
            const std::optional<Term> right = (this->*part)();
            if (!right || !needs(*left, Type::Bool) || !needs(*right, Type::Bool)) return {};
            Condition::Node node;
            node.operation = operation;
            node.left = left->node;
            node.right = right->node;
            left = Term{add(std::move(node)), Type::Bool, left->at, nullptr, {}};
        }
        return left;
    }

    std::optional<Term> comparison() {
        std::optional<Term> left = unary();
        if (!left) return {};
        if (token().kind == Token::Kind::Name && token().text == "in") return membership(*left);
        constexpr std::pair<std::string_view, Operation> operations[] = {
            {"==", Operation::Equal},        {"!=", Operation::NotEqual}, {"<=", Operation::LessEqual},
            {">=", Operation::GreaterEqual}, {"<", Operation::Less},      {">", Operation::Greater}};
        for (const auto& [symbol, operation] : operations) {
            if (!take(symbol)) continue;
            const std::optional<Term> right = unary();
            if (!right) return {};
            return compare(*left, operation, *right);
        }
        return left;
    }

    std::optional<Term> compare(const Term& left, Operation operation, const Term& right) {
        if (left.type != right.type)
            return fail("E004", right.at,
                        "compares " + std::string(name(left.type)) + " with " + std::string(name(right.type)));
        if (left.type != Type::Number && operation != Operation::Equal && operation != Operation::NotEqual)
            return fail("E004", left.at, "only numbers have an order", "use == or !=");
        if (left.type == Type::Word) {
            const Property* property = left.property ? left.property : right.property;
            if (!property || (left.property && right.property))
                return fail("E004", left.at, "compare one property with one word");
            const Term& literal = left.property ? right : left;
            const std::optional<double> index = wordIndex(*property, literal);
            if (!index) return {};
            nodes_[literal.node].number = *index;
            nodes_[literal.node].operation = Operation::Literal;
        }
        Condition::Node node;
        node.operation = operation;
        node.left = left.node;
        node.right = right.node;
        return Term{add(std::move(node)), Type::Bool, left.at, nullptr, {}};
    }

    std::optional<double> wordIndex(const Property& property, const Term& literal) {
        const auto found = std::find(property.words.begin(), property.words.end(), literal.word);
        if (found != property.words.end()) return static_cast<double>(found - property.words.begin());
        fail("E003", literal.at, "'" + std::string(literal.word) + "' is not a value of '" + property.id + "'",
             nameHint(literal.word, property.words));
        return {};
    }

    std::optional<Term> membership(const Term& left) {
        lexer_.advance();
        if (left.type == Type::Bool) return fail("E004", left.at, "'in' needs a property with words or numbers");
        if (left.type == Type::Word && !left.property)
            return fail("E004", left.at, "'in' needs a property on its left");
        if (!take("[")) return fail("E001", token().at, "expected '[' after in, found " + found());
        Condition::Node node;
        node.operation = Operation::In;
        node.left = left.node;
        do {
            const Token element = token();
            if (element.kind != Token::Kind::Word && element.kind != Token::Kind::Number)
                return fail("E001", element.at, "expected a word in quotes or a number, found " + found());
            if ((element.kind == Token::Kind::Word) != (left.type == Type::Word))
                return fail("E004", element.at, "the list holds another kind than what is compared");
            if (element.kind == Token::Kind::Word) {
                const std::optional<double> index =
                    wordIndex(*left.property, {0, Type::Word, element.at, nullptr, element.text});
                if (!index) return {};
                node.set.push_back(*index);
            } else {
                node.set.push_back(rounded(element.number));
            }
            lexer_.advance();
        } while (take(","));
        if (!take("]")) return fail("E001", token().at, "expected ',' or ']', found " + found());
        return Term{add(std::move(node)), Type::Bool, left.at, nullptr, {}};
    }

    std::optional<Term> unary() {
        if (depth_ >= 32) return fail("E001", token().at, "nested too deeply");
        ++depth_;
        std::optional<Term> result = take("!") ? negation() : primary();
        --depth_;
        return result;
    }

    std::optional<Term> negation() {
        const std::optional<Term> inner = unary();
        if (!inner || !needs(*inner, Type::Bool)) return {};
        Condition::Node node;
        node.operation = Operation::Not;
        node.left = inner->node;
        return Term{add(std::move(node)), Type::Bool, inner->at, nullptr, {}};
    }

    std::optional<Term> primary() {
        const Token here = token();
        if (take("(")) {
            const std::optional<Term> inner = either();
            if (!inner) return {};
            if (!take(")")) return fail("E001", token().at, "expected ')', found " + found());
            return inner;
        }
        Condition::Node node;
        Term term{0, Type::Number, here.at, nullptr, {}};
        if (here.kind == Token::Kind::Number) {
            node.number = rounded(here.number);
        } else if (here.kind == Token::Kind::Word) {
            node.operation = Operation::Word;
            term.type = Type::Word;
            term.word = here.text;
        } else if (here.kind == Token::Kind::Name && (here.text == "true" || here.text == "false")) {
            node.number = here.text == "true" ? 1 : 0;
            term.type = Type::Bool;
        } else if (here.kind == Token::Kind::Name) {
            const auto property = std::find_if(properties_.begin(), properties_.end(),
                                               [&](const Property& candidate) { return candidate.id == here.text; });
            if (property == properties_.end()) {
                std::vector<std::string> known;
                for (const Property& candidate : properties_) known.push_back(candidate.id);
                return fail("E002", here.at, "unknown property '" + std::string(here.text) + "'",
                            nameHint(here.text, known));
            }
            const bool isNumber = componentCount(property->type) == 1;
            if (!isNumber && property->type != ValueType::Bool && property->type != ValueType::Enum)
                return fail("E004", here.at,
                            "'" + property->id + "' is " + std::string(materials::name(property->type)),
                            "only bool, enum and single numbers can be compared");
            node.operation = Operation::Read;
            node.property = static_cast<std::size_t>(property - properties_.begin());
            term.type = isNumber ? Type::Number : property->type == ValueType::Bool ? Type::Bool : Type::Word;
            if (term.type == Type::Word) term.property = &*property;
        } else {
            return fail("E001", here.at, "expected a property, a number or a word in quotes, found " + found());
        }
        lexer_.advance();
        term.node = add(std::move(node));
        return term;
    }

    Lexer lexer_;
    const std::vector<Property>& properties_;
    std::vector<Condition::Node>& nodes_;
    std::optional<Diagnostic> fault_ = {};
    int depth_ = 0;
};

double numberOf(const Value& value) {
    return value.type == ValueType::Float ? static_cast<double>(value.number[0]) : static_cast<double>(value.integer);
}

}  // namespace

Outcome<Condition> Condition::parse(std::string_view text, const std::vector<Property>& properties) {
    Condition condition;
    if (text.size() > 1024) {
        return tl::unexpected<Diagnostic>(
            Diagnostic{Severity::Error, "E001", {}, 1, 1, "the condition is longer than 1024 bytes", {}});
    }
    if (std::optional<Diagnostic> fault = Parser(text, properties, condition.nodes_).run())
        return tl::unexpected<Diagnostic>(std::move(*fault));
    return condition;
}

bool Condition::evaluate(const std::vector<Value>& values) const {
    return nodes_.empty() || evaluate(nodes_.size() - 1, values) != 0;
}

double Condition::evaluate(std::size_t index, const std::vector<Value>& values) const {
    const Node& node = nodes_[index];
    const auto left = [&] { return evaluate(node.left, values); };
    const auto right = [&] { return evaluate(node.right, values); };
    switch (node.operation) {
        case Operation::Literal:
        case Operation::Word:
            return node.number;
        case Operation::Read:
            return numberOf(values[node.property]);
        case Operation::Not:
            return left() == 0 ? 1 : 0;
        case Operation::And:
            return left() != 0 && right() != 0 ? 1 : 0;
        case Operation::Or:
            return left() != 0 || right() != 0 ? 1 : 0;
        case Operation::Equal:
            return left() == right() ? 1 : 0;
        case Operation::NotEqual:
            return left() != right() ? 1 : 0;
        case Operation::Less:
            return left() < right() ? 1 : 0;
        case Operation::LessEqual:
            return left() <= right() ? 1 : 0;
        case Operation::Greater:
            return left() > right() ? 1 : 0;
        case Operation::GreaterEqual:
            return left() >= right() ? 1 : 0;
        case Operation::In:
            return std::find(node.set.begin(), node.set.end(), left()) != node.set.end() ? 1 : 0;
    }
    return 0;
}

std::vector<std::size_t> Condition::reads() const {
    std::vector<std::size_t> out;
    for (const Node& node : nodes_) {
        if (node.operation == Operation::Read) out.push_back(node.property);
    }
    return out;
}

}  // namespace pelage::materials
