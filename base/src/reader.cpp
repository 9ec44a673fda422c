// SPDX-License-Identifier: MIT
// rapidjson decides what is JSON; this file keeps the places. rapidjson does not tell where a token began, but it calls
// the handler right after each token, so the next one begins at the first byte after it that is not a blank, comment,
// comma or colon.
#include "syntax.hpp"

#include <pelage/base/json.hpp>

#include <rapidjson/error/en.h>
#include <rapidjson/memorystream.h>
#include <rapidjson/reader.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <system_error>
#include <unordered_map>

namespace pelage::json {
namespace {

constexpr std::size_t deepest = 64;
constexpr std::size_t largestFile = std::size_t{4} << 20U;

class Handler {
public:
    Handler(std::string_view text, const Lines& lines, const rapidjson::MemoryStream& stream, Value& root)
        : text_(text), lines_(lines), stream_(stream), root_(root) {}

    bool Null() {
        begin();
        return scalar(Kind::Null) != nullptr;
    }
    bool Bool(bool value) {
        begin();
        Value* target = scalar(Kind::Bool);
        if (target) target->boolean = value;
        return target != nullptr;
    }
    bool RawNumber(const char* /*digits*/, rapidjson::SizeType /*length*/, bool /*copy*/) {
        begin();
        const std::string_view digits = text_.substr(progress_.lastStart, progress_.lastEnd - progress_.lastStart);
        double number = 0.0;
        const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), number);
        if (result.ec != std::errc() || !std::isfinite(number))
            return refuse(progress_.lastStart, "J006",
                          "the number " + std::string(digits.substr(0, 40)) + " does not fit in double precision",
                          "write a number between 1e-300 and 1e300");
        progress_.lastIsNumber = true;
        Value* target = scalar(Kind::Number);
        if (!target) return false;
        target->number = number;
        target->isInteger = digits.find_first_of(".eE") == std::string_view::npos;
        return true;
    }
    bool String(const char* characters, rapidjson::SizeType length, bool /*copy*/) {
        begin();
        if (!noNul(characters, length)) return false;
        Value* target = scalar(Kind::String);
        if (target) target->string.assign(characters, length);
        return target != nullptr;
    }
    bool Key(const char* characters, rapidjson::SizeType length, bool /*copy*/) {
        begin();
        if (!noNul(characters, length)) return false;
        const Place place = lines_.at(progress_.lastStart);
        std::string key(characters, length);
        const auto [first, isNew] = frames_.back().keys.emplace(key, place);
        if (!isNew)
            return refuse(
                progress_.lastStart, "J004", "key \"" + key + "\" given twice in one object",
                "first at " + std::to_string(first->second.line) + ":" + std::to_string(first->second.column));
        frames_.back().value->members.push_back({std::move(key), place, {}});
        progress_.after = Progress::After::Key;
        return true;
    }
    bool StartObject() { return open(Kind::Object); }
    bool EndObject(rapidjson::SizeType /*count*/) { return closeContainer(); }
    bool StartArray() { return open(Kind::Array); }
    bool EndArray(rapidjson::SizeType /*count*/) { return closeContainer(); }

    // The other numeric callbacks of rapidjson's handler concept; numbers arrive as text.
    bool Int(int) { return false; }
    bool Uint(unsigned) { return false; }
    bool Int64(std::int64_t) { return false; }
    bool Uint64(std::uint64_t) { return false; }
    bool Double(double) { return false; }

    const Progress& progress() const { return progress_; }
    const std::optional<Diagnostic>& refusal() const { return refusal_; }

private:
    struct Frame {
        Value* value = nullptr;  // stays where it is: its parent grows only after it is closed
        std::unordered_map<std::string, Place> keys = {};
    };

    void begin() {
        std::size_t at = skipBlank(text_, progress_.lastEnd);
        if (at < text_.size() && (text_[at] == ',' || text_[at] == ':')) at = skipBlank(text_, at + 1);
        progress_.lastStart = at;
        progress_.lastEnd = stream_.Tell();
        progress_.lastIsNumber = false;
    }

    void beginBracket() {
        begin();
        progress_.lastEnd = progress_.lastStart + 1;  // rapidjson calls before it takes the bracket
    }

    bool refuse(std::size_t at, Code code, std::string text, std::string hint) {
        const Place place = lines_.at(at);
        refusal_ = Diagnostic{Severity::Error, code, {}, place.line, place.column, std::move(text), std::move(hint)};
        return false;
    }

    bool noNul(const char* characters, std::size_t length) {
        if (std::string_view(characters, length).find('\0') == std::string_view::npos) return true;
        return refuse(progress_.lastStart, "J002", "the string holds a NUL character", "remove \\u0000");
    }

    Value* scalar(Kind kind) {
        Value* target = &root_;
        if (!frames_.empty()) {
            Value* parent = frames_.back().value;
            if (parent->kind == Kind::Array) {
                target = &parent->elements.emplace_back();
            } else {
                target = &parent->members.back().value;
            }
        }
        target->kind = kind;
        target->place = lines_.at(progress_.lastStart);
        progress_.after = frames_.empty() ? Progress::After::Document : Progress::After::Value;
        return target;
    }

    bool open(Kind kind) {
        beginBracket();
        if (frames_.size() == deepest)
            return refuse(progress_.lastStart, "J007", "nested deeper than " + std::to_string(deepest) + " levels",
                          "flatten the text");
        Value* target = scalar(kind);
        frames_.push_back({target, {}});
        progress_.open.push_back({kind == Kind::Object, progress_.lastStart});
        progress_.after = Progress::After::Open;
        return true;
    }

    bool closeContainer() {
        beginBracket();
        frames_.pop_back();
        progress_.open.pop_back();
        progress_.after = frames_.empty() ? Progress::After::Document : Progress::After::Value;
        return true;
    }

    std::string_view text_;
    const Lines& lines_;
    const rapidjson::MemoryStream& stream_;
    Value& root_;
    std::vector<Frame> frames_ = {};
    Progress progress_ = {};
    std::optional<Diagnostic> refusal_ = {};
};

// A line break inside a string comes out of rapidjson as a bad escape; nearly always a closing quote is missing.
std::string_view stringProblem(rapidjson::ParseErrorCode code, std::string_view text, std::size_t offset) {
    if (code == rapidjson::kParseErrorStringEscapeInvalid && offset < text.size() && text[offset] != '\\') {
        const auto byte = static_cast<unsigned char>(text[offset]);
        if (byte == '\n' || byte == '\r')
            code = rapidjson::kParseErrorStringMissQuotationMark;
        else if (byte < 0x20)
            return "a control character inside it";
    }
    switch (code) {
        case rapidjson::kParseErrorStringMissQuotationMark:
            return "it has no closing quotation mark on its line";
        case rapidjson::kParseErrorStringEscapeInvalid:
            return "unknown escape after a backslash";
        case rapidjson::kParseErrorStringUnicodeEscapeInvalidHex:
            return "\\u needs four hexadecimal digits";
        case rapidjson::kParseErrorStringUnicodeSurrogateInvalid:
            return "half of a \\u surrogate pair";
        default:
            return {};
    }
}

tl::unexpected<Diagnostics> fail(Diagnostic diagnostic) {
    Diagnostics out;
    out.add(std::move(diagnostic));
    return tl::unexpected<Diagnostics>(std::move(out));
}

}  // namespace

Result<Document> parse(std::string_view text, std::string_view file) {
    constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";
    if (text.substr(0, byteOrderMark.size()) == byteOrderMark) text.remove_prefix(byteOrderMark.size());
    const Lines lines(text);
    if (const std::size_t bad = firstBadByte(text); bad != std::string_view::npos) {
        const Place place = lines.at(bad);
        const bool nul = text[bad] == '\0';
        return fail({Severity::Error, "J002", std::string(file), place.line, place.column,
                     nul ? "the text holds a NUL byte" : "the text is not UTF-8 here",
                     nul ? "is this a text file?" : "save the file as UTF-8"});
    }

    Document document{std::string(file), {}};
    rapidjson::MemoryStream stream(text.data(), text.size());
    rapidjson::Reader reader;
    Handler handler(text, lines, stream, document.root);
    constexpr unsigned flags =
        rapidjson::kParseIterativeFlag | rapidjson::kParseCommentsFlag | rapidjson::kParseNumbersAsStringsFlag;
    const rapidjson::ParseResult result = reader.Parse<flags>(stream, handler);
    if (result) return document;
    Diagnostic why = handler.refusal() ? *handler.refusal()
                                       : explainSyntax(text, lines, handler.progress(),
                                                       stringProblem(result.Code(), text, result.Offset()),
                                                       result.Code() == rapidjson::kParseErrorNumberTooBig);
    why.file = std::string(file);
    return fail(std::move(why));
}

Result<Document> parseFile(const std::string& path) {
    struct Closer {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    const std::unique_ptr<std::FILE, Closer> file(std::fopen(path.c_str(), "rb"));
    if (!file) return fail({Severity::Error, "F001", path, 0, 0, "cannot open the file", "check the path"});
    std::string text(largestFile + 1, '\0');
    const std::size_t read = std::fread(text.data(), 1, text.size(), file.get());
    if (std::ferror(file.get()) != 0)
        return fail({Severity::Error, "F001", path, 0, 0, "cannot read the file", "is it a directory?"});
    if (read > largestFile)
        return fail({Severity::Error, "F002", path, 0, 0, "the file is larger than 4 MiB", "is this the right file?"});
    text.resize(read);
    return parse(text, path);
}

}  // namespace pelage::json
