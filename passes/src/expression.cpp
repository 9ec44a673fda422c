// SPDX-License-Identifier: MIT
#include "expression.hpp"

#include "description.hpp"

#include <algorithm>
#include <charconv>

namespace pelage::passes {

struct Expression::Node {
    enum class Op : std::uint8_t {
        Or,
        And,
        Not,
        Equal,
        NotEqual,
        Less,
        LessEqual,
        Greater,
        GreaterEqual,
        In,
        Number,
        Word,
        Setting,
        HostHas
    } op = Op::Number;
    enum class Type : std::uint8_t { Bool, Number, Word } type = Type::Bool;
    double number = 0;
    std::string word = {};
    const SettingInfo* setting = nullptr;  // only while parsing
    std::uint32_t offset = 0;
    std::vector<std::shared_ptr<const Node>> children = {};
};

namespace {

using Node = Expression::Node;
using Op = Node::Op;
using Type = Node::Type;
using NodePointer = std::shared_ptr<const Node>;

constexpr std::uint32_t deepest = 32;  // nesting of brackets and negations; keeps the parser's own stack small
constexpr std::size_t longest = 512;   // and the tree of a long chain of && or || shallow enough to walk

struct Token {
    enum class Kind : std::uint8_t { End, Name, Number, Word, Symbol, Bad } kind = Kind::End;
    std::string text = {};
    double number = 0;
    std::uint32_t offset = 0;
};

bool isLetter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

class Lexer {
public:
    explicit Lexer(std::string_view text) : text_(text) {}

    Token next() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
        Token token{.offset = static_cast<std::uint32_t>(at_)};
        if (at_ >= text_.size()) return token;
        const char c = text_[at_];
        if (isLetter(c)) {
            std::size_t end = at_;
            while (end < text_.size() && (isLetter(text_[end]) || isDigit(text_[end]) || text_[end] == '.')) ++end;
            return take(token, Token::Kind::Name, end);
        }
        if (isDigit(c)) {
            const char* const begin = text_.data() + at_;
            const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), token.number);
            const std::size_t stop = error == std::errc() ? at_ + static_cast<std::size_t>(end - begin) : at_ + 1;
            return take(token, error == std::errc() ? Token::Kind::Number : Token::Kind::Bad, stop);
        }
        if (c == '\'') {
            const std::size_t end = text_.find('\'', at_ + 1);
            if (end == std::string_view::npos) return take(token, Token::Kind::Bad, text_.size());
            token.kind = Token::Kind::Word;
            token.text = std::string(text_.substr(at_ + 1, end - at_ - 1));
            at_ = end + 1;
            return token;
        }
        for (const std::string_view symbol :
             {"||", "&&", "==", "!=", "<=", ">=", "<", ">", "!", "(", ")", "[", "]", ","}) {
            if (text_.substr(at_, symbol.size()) == symbol)
                return take(token, Token::Kind::Symbol, at_ + symbol.size());
        }
        return take(token, Token::Kind::Bad, at_ + 1);
    }

private:
    Token take(Token token, Token::Kind kind, std::size_t end) {
        token.kind = kind;
        token.text = std::string(text_.substr(at_, end - at_));
        at_ = end;
        return token;
    }
    std::string_view text_;
    std::size_t at_ = 0;
};

class Parser {
public:
    Parser(const std::string& text, Place place, const Vocabulary& vocabulary, const std::string& about,
           Reporter& reporter)
        : lexer_(text), place_(place), vocabulary_(vocabulary), about_(about), reporter_(reporter) {
        token_ = lexer_.next();
    }

    NodePointer whole() {
        NodePointer node = either();
        if (node && token_.kind != Token::Kind::End) return syntax("an operator or the end");
        return condition(node);
    }
    std::vector<std::string> settings = {};

private:
    NodePointer fail(std::uint32_t offset, const char* code, std::string text, std::string hint = {}) {
        // +1: the quote that opens the string.
        reporter_.error({place_.line, place_.column + 1 + offset}, code, about_ + ": " + std::move(text),
                        std::move(hint));
        return nullptr;
    }
    NodePointer syntax(const std::string& expected) {
        const std::string found = token_.kind == Token::Kind::End ? "the end" : "'" + token_.text + "'";
        return fail(token_.offset, "E001", "expected " + expected + ", found " + found);
    }
    bool accept(std::string_view symbol) {
        if (token_.kind != Token::Kind::Symbol || token_.text != symbol) return false;
        token_ = lexer_.next();
        return true;
    }
    static NodePointer make(Op op, Type type, std::uint32_t offset, std::vector<NodePointer> children) {
        auto node = std::make_shared<Node>();
        node->op = op, node->type = type, node->offset = offset, node->children = std::move(children);
        return node;
    }
    NodePointer condition(NodePointer node) {
        if (node && node->type != Type::Bool) {
            return fail(node->offset, "E004", "a condition must be true or false, this is a " + name(*node),
                        "compare it, for example with ==");
        }
        return node;
    }
    static std::string name(const Node& node) {
        return node.type == Type::Bool ? "bool" : node.type == Type::Number ? "number" : "word";
    }

    NodePointer either() {
        return chain("||", Op::Or, [this] { return all(); });
    }
    NodePointer all() {
        return chain("&&", Op::And, [this] { return comparison(); });
    }

    template <class Next>
    NodePointer chain(std::string_view symbol, Op op, Next next) {
        NodePointer left = next();
        while (left && token_.kind == Token::Kind::Symbol && token_.text == symbol) {
            const std::uint32_t offset = token_.offset;
            token_ = lexer_.next();
            left = condition(left);
            NodePointer right = left ? condition(next()) : nullptr;
            if (!right) return nullptr;
            left = make(op, Type::Bool, offset, {left, right});
        }
        return left;
    }

    NodePointer comparison() {
        NodePointer left = primary();
        if (!left) return nullptr;
        const std::uint32_t offset = token_.offset;
        if (token_.kind == Token::Kind::Name && token_.text == "in") {
            token_ = lexer_.next();
            return membership(left, offset);
        }
        static constexpr std::pair<std::string_view, Op> ops[] = {
            {"==", Op::Equal},        {"!=", Op::NotEqual}, {"<=", Op::LessEqual},
            {">=", Op::GreaterEqual}, {"<", Op::Less},      {">", Op::Greater},
        };
        for (const auto& [symbol, op] : ops) {
            if (!accept(symbol)) continue;
            NodePointer right = primary();
            if (!right) return nullptr;
            const bool ordered = op != Op::Equal && op != Op::NotEqual;
            if (left->type != right->type || (ordered && left->type != Type::Number)) {
                return fail(
                    offset, "E004",
                    "cannot compare a " + name(*left) + " with a " + name(*right) + " by " + std::string(symbol));
            }
            if (!knowsWord(left, right) || !knowsWord(right, left)) return nullptr;
            return make(op, Type::Bool, offset, {left, right});
        }
        return left;
    }

    NodePointer membership(const NodePointer& left, std::uint32_t offset) {
        if (!accept("[")) return syntax("'['");
        std::vector<NodePointer> children{left};
        do {
            NodePointer item = primary();
            if (!item) return nullptr;
            if (item->type != left->type)
                return fail(item->offset, "E004", "a " + name(*item) + " is never in a list for a " + name(*left));
            if (!knowsWord(left, item)) return nullptr;
            children.push_back(item);
        } while (accept(","));
        if (!accept("]")) return syntax("',' or ']'");
        return make(Op::In, Type::Bool, offset, std::move(children));
    }

    bool knowsWord(const NodePointer& setting, const NodePointer& word) {
        if (!setting->setting || word->op != Op::Word) return true;
        const std::vector<std::string>& words = setting->setting->words;
        if (std::find(words.begin(), words.end(), word->word) != words.end()) return true;
        std::string known = "known:";
        for (const std::string& each : words) known += " " + each;
        fail(word->offset, "E003", "'" + word->word + "' is not a value of '" + setting->setting->name + "'",
             didYouMean(word->word, words, known));
        return false;
    }

    NodePointer primary() {
        if (++depth_ > deepest) return fail(token_.offset, "E001", "the condition is nested too deeply");
        NodePointer node = primaryInside();
        --depth_;
        return node;
    }

    NodePointer primaryInside() {
        const Token token = token_;
        if (accept("!")) {
            NodePointer inner = condition(primary());
            return inner ? make(Op::Not, Type::Bool, token.offset, {inner}) : nullptr;
        }
        if (accept("(")) {
            NodePointer inner = either();
            if (inner && !accept(")")) return syntax("')'");
            return inner;
        }
        auto node = std::make_shared<Node>();
        node->offset = token.offset;
        if (token.kind == Token::Kind::Number) {
            node->op = Op::Number, node->type = Type::Number, node->number = token.number;
        } else if (token.kind == Token::Kind::Word) {
            node->op = Op::Word, node->type = Type::Word, node->word = token.text;
        } else if (token.kind == Token::Kind::Name) {
            return named(token, std::move(node));
        } else {
            return syntax("a setting, host.has('Import'), a number or a 'word'");
        }
        token_ = lexer_.next();
        return node;
    }

    NodePointer named(const Token& token, std::shared_ptr<Node> node) {
        token_ = lexer_.next();
        if (token.text == "true" || token.text == "false") {
            node->op = Op::Number, node->type = Type::Bool, node->number = token.text == "true" ? 1 : 0;
            return node;
        }
        if (token.text == "host.has") {
            if (!accept("(")) return syntax("'('");
            const Token import = token_;
            if (import.kind != Token::Kind::Word) return syntax("an import in single quotes");
            const auto& known = vocabulary_.imports;
            if (std::find(known.begin(), known.end(), import.text) == known.end())
                return fail(import.offset, "E002", "unknown import '" + import.text + "'",
                            didYouMean(import.text, known));
            token_ = lexer_.next();
            if (!accept(")")) return syntax("')'");
            node->op = Op::HostHas, node->type = Type::Bool, node->word = import.text;
            return node;
        }
        std::vector<std::string> known{"host.has"};
        for (const SettingInfo* setting : vocabulary_.settings) {
            known.push_back(setting->name);
            if (setting->name != token.text) continue;
            using Kind = SettingValue::Type;
            node->op = Op::Setting, node->word = token.text, node->setting = setting;
            node->type = setting->type == Kind::Bool   ? Type::Bool
                         : setting->type == Kind::Uint ? Type::Number
                                                       : Type::Word;
            settings.push_back(token.text);
            return node;
        }
        return fail(token.offset, "E002", "unknown setting '" + token.text + "'", didYouMean(token.text, known));
    }

    Lexer lexer_;
    Token token_ = {};
    Place place_;
    const Vocabulary& vocabulary_;
    const std::string& about_;
    Reporter& reporter_;
    std::uint32_t depth_ = 0;
};

struct Result {
    double number = 0;
    std::string_view word = {};
    bool operator==(const Result&) const = default;
};

Result run(const Node& node, const Conditions& conditions) {
    const auto child = [&](std::size_t i) { return run(*node.children[i], conditions); };
    const auto truth = [](bool value) { return Result{value ? 1.0 : 0.0, {}}; };
    switch (node.op) {
        case Op::Or:
            return truth(child(0).number != 0 || child(1).number != 0);
        case Op::And:
            return truth(child(0).number != 0 && child(1).number != 0);
        case Op::Not:
            return truth(child(0).number == 0);
        case Op::Equal:
            return truth(child(0) == child(1));
        case Op::NotEqual:
            return truth(!(child(0) == child(1)));
        case Op::Less:
            return truth(child(0).number < child(1).number);
        case Op::LessEqual:
            return truth(child(0).number <= child(1).number);
        case Op::Greater:
            return truth(child(0).number > child(1).number);
        case Op::GreaterEqual:
            return truth(child(0).number >= child(1).number);
        case Op::In:
            for (std::size_t i = 1; i < node.children.size(); ++i)
                if (child(0) == child(i)) return truth(true);
            return truth(false);
        case Op::Number:
            return {node.number, {}};
        case Op::Word:
            return {0, node.word};
        case Op::Setting: {
            const auto found = conditions.settings.find(node.word);
            if (found == conditions.settings.end()) return {};
            if (found->second.type == SettingValue::Type::Enum) return {0, found->second.word};
            return {static_cast<double>(found->second.number), {}};
        }
        case Op::HostHas: {
            const auto found = conditions.imports.find(node.word);
            return truth(found != conditions.imports.end() && found->second);
        }
    }
    return {};
}

}  // namespace

std::optional<Expression> Expression::parse(const std::string& text, json::Place place, const Vocabulary& vocabulary,
                                            const std::string& about, Reporter& reporter) {
    if (text.size() > longest) {
        reporter.error(place, "E001", about + ": a condition has at most " + std::to_string(longest) + " characters");
        return std::nullopt;
    }
    Parser parser(text, place, vocabulary, about, reporter);
    Expression expression;
    expression.text_ = text;
    expression.root_ = parser.whole();
    expression.settings_ = std::move(parser.settings);
    if (!expression.root_) return std::nullopt;
    return expression;
}

bool Expression::evaluate(const Conditions& conditions) const {
    return run(*root_, conditions).number != 0;
}

}  // namespace pelage::passes
