// SPDX-License-Identifier: MIT
#include <pelage/base/condition.hpp>

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

namespace pelage::json {
namespace {

using Type = ConditionNames::Type;

constexpr std::size_t longest = 1024;  // bytes
constexpr int deepest = 32;            // brackets and negations; keeps the parser's own stack small

std::string_view name(Type type) {
    return type == Type::Bool ? "true or false" : type == Type::Number ? "a number" : "a word";
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
    const ConditionNames::Name* read = nullptr;  // a bare name: gives words their meaning and numbers their precision
    std::string_view word = {};                  // a bare word, still without a number
};

}  // namespace

// Recursive descent; the first fault ends it, and depth is bounded.
class ConditionParser {
public:
    ConditionParser(std::string_view text, const ConditionNames& names, std::vector<Condition::Node>& nodes)
        : lexer_(text), names_(names), nodes_(nodes) {}

    std::optional<Diagnostic> run() {
        const std::optional<Term> whole = either();
        if (whole && token().kind != Token::Kind::End)
            fail("E001", token().at, "expected an operator, found " + found());
        if (whole && !fault_) needs(*whole, Type::Bool);
        return fault_;
    }

private:
    using Operation = Condition::Operation;

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
    std::optional<Term> fail(Code code, std::size_t where, std::string text, std::string hint = {}) {
        if (!fault_)
            fault_ = Diagnostic{Severity::Error, code,           {}, 1, static_cast<std::uint32_t>(where + 1),
                                std::move(text), std::move(hint)};
        return {};
    }
    bool needs(const Term& term, Type type) {
        if (term.type == type) return true;
        fail("E004", term.at, "needs " + std::string(name(type)) + " here, found " + std::string(name(term.type)),
             term.read && term.type == Type::Word ? "compare it: == 'word'" : "");
        return false;
    }
    std::size_t add(Condition::Node node) {
        nodes_.push_back(std::move(node));
        return nodes_.size() - 1;
    }

    std::optional<Term> either() { return chain("||", Operation::Or, &ConditionParser::both); }
    std::optional<Term> both() { return chain("&&", Operation::And, &ConditionParser::comparison); }

    std::optional<Term> chain(std::string_view symbol, Operation operation,
                              std::optional<Term> (ConditionParser::*part)()) {
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
            if ((left.read == nullptr) == (right.read == nullptr))
                return fail("E004", left.at, "compare one " + names_.kind + " with one word");
            const Term& literal = left.read ? right : left;
            const std::optional<double> index = wordIndex(left.read ? *left.read : *right.read, literal);
            if (!index) return {};
            nodes_[literal.node].number = *index;
        } else if ((left.read && left.read->isSingle) || (right.read && right.read->isSingle)) {
            for (const Term* term : {&left, &right}) {
                double& number = nodes_[term->node].number;
                number = static_cast<double>(static_cast<float>(number));
            }
        }
        Condition::Node node;
        node.operation = operation;
        node.left = left.node;
        node.right = right.node;
        return Term{add(std::move(node)), Type::Bool, left.at, nullptr, {}};
    }

    std::optional<double> wordIndex(const ConditionNames::Name& of, const Term& literal) {
        const auto found = std::find(of.words.begin(), of.words.end(), literal.word);
        if (found != of.words.end()) return static_cast<double>(found - of.words.begin());
        fail("E003", literal.at, "'" + std::string(literal.word) + "' is not a value of '" + of.name + "'",
             nameHint(literal.word, of.words));
        return {};
    }

    std::optional<Term> membership(const Term& left) {
        lexer_.advance();
        if (left.type == Type::Bool)
            return fail("E004", left.at, "'in' needs a " + names_.kind + " with words or numbers");
        if (left.type == Type::Word && !left.read)
            return fail("E004", left.at, "'in' needs a " + names_.kind + " on its left");
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
                    wordIndex(*left.read, {0, Type::Word, element.at, nullptr, element.text});
                if (!index) return {};
                node.set.push_back(*index);
            } else {
                const bool isSingle = left.read && left.read->isSingle;
                node.set.push_back(isSingle ? static_cast<double>(static_cast<float>(element.number)) : element.number);
            }
            lexer_.advance();
        } while (take(","));
        if (!take("]")) return fail("E001", token().at, "expected ',' or ']', found " + found());
        return Term{add(std::move(node)), Type::Bool, left.at, nullptr, {}};
    }

    std::optional<Term> unary() {
        if (depth_ >= deepest) return fail("E001", token().at, "nested too deeply");
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
            node.number = here.number;
        } else if (here.kind == Token::Kind::Word) {
            term.type = Type::Word;
            term.word = here.text;
        } else if (here.kind == Token::Kind::Name && (here.text == "true" || here.text == "false")) {
            node.number = here.text == "true" ? 1 : 0;
            term.type = Type::Bool;
        } else if (here.kind == Token::Kind::Name && here.text == names_.function.name) {
            return call(here);
        } else if (here.kind == Token::Kind::Name) {
            const auto found = std::find_if(names_.names.begin(), names_.names.end(),
                                            [&](const auto& candidate) { return candidate.name == here.text; });
            if (found == names_.names.end()) return unknown(here);
            if (found->type == Type::Other)
                return fail("E004", here.at, "'" + found->name + "' cannot be compared",
                            "only bool, enum and single numbers can be compared");
            node.operation = Operation::Read;
            node.name = static_cast<std::size_t>(found - names_.names.begin());
            term.type = found->type;
            term.read = &*found;
        } else {
            return fail("E001", here.at,
                        "expected a " + names_.kind + ", a number or a word in quotes, found " + found());
        }
        lexer_.advance();
        term.node = add(std::move(node));
        return term;
    }

    std::optional<Term> unknown(const Token& here) {
        std::vector<std::string> known;
        for (const ConditionNames::Name& each : names_.names) known.push_back(each.name);
        if (!names_.function.name.empty()) known.push_back(names_.function.name);
        return fail("E002", here.at, "unknown " + names_.kind + " '" + std::string(here.text) + "'",
                    nameHint(here.text, known));
    }

    std::optional<Term> call(const Token& here) {
        const ConditionNames::Function& function = names_.function;
        lexer_.advance();
        if (!take("(")) return fail("E001", token().at, "expected '(', found " + found());
        const Token argument = token();
        if (argument.kind != Token::Kind::Word)
            return fail("E001", argument.at, "expected an " + function.kind + " in single quotes, found " + found());
        const auto known = std::find(function.words.begin(), function.words.end(), argument.text);
        if (known == function.words.end())
            return fail("E002", argument.at, "unknown " + function.kind + " '" + std::string(argument.text) + "'",
                        nameHint(argument.text, function.words));
        lexer_.advance();
        if (!take(")")) return fail("E001", token().at, "expected ')', found " + found());
        Condition::Node node;
        node.operation = Operation::Read;
        node.name = names_.names.size() + static_cast<std::size_t>(known - function.words.begin());
        return Term{add(std::move(node)), Type::Bool, here.at, nullptr, {}};
    }

    Lexer lexer_;
    const ConditionNames& names_;
    std::vector<Condition::Node>& nodes_;
    std::optional<Diagnostic> fault_ = {};
    int depth_ = 0;
};

Result<Condition> Condition::parse(std::string_view text, const ConditionNames& names) {
    Condition condition;
    if (text.size() > longest) {
        return tl::unexpected<Diagnostic>(
            Diagnostic{.code = "E001", .line = 1, .column = 1, .text = "the condition is longer than 1024 bytes"});
    }
    if (std::optional<Diagnostic> fault = ConditionParser(text, names, condition.nodes_).run())
        return tl::unexpected<Diagnostic>(std::move(*fault));
    return condition;
}

bool Condition::evaluate(const std::function<double(std::size_t)>& value) const {
    return nodes_.empty() || evaluate(nodes_.size() - 1, value) != 0;
}

double Condition::evaluate(std::size_t index, const std::function<double(std::size_t)>& value) const {
    const Node& node = nodes_[index];
    const auto left = [&] { return evaluate(node.left, value); };
    const auto right = [&] { return evaluate(node.right, value); };
    switch (node.operation) {
        case Operation::Literal:
            return node.number;
        case Operation::Read:
            return value(node.name);
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
        if (node.operation == Operation::Read) out.push_back(node.name);
    }
    return out;
}

}  // namespace pelage::json
