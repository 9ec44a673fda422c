// SPDX-License-Identifier: MIT
#include "syntax.hpp"

#include <algorithm>
#include <array>

namespace pelage::json {
namespace {

bool isBlank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}
bool isWordCharacter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' ||
           c == '+' || c == '-';
}

std::string text(Place place) {
    return std::to_string(place.line) + ':' + std::to_string(place.column);
}

std::string_view wordAt(std::string_view all, std::size_t at) {
    std::size_t end = at;
    while (end < all.size() && isWordCharacter(all[end]) && end - at < 40) ++end;
    return all.substr(at, end - at);
}

// What stands at `at`, in quotes, cut to one word or one character (a whole UTF-8 sequence).
std::string foundAt(std::string_view all, std::size_t at) {
    if (at >= all.size()) return "the end of the text";
    std::string_view word = wordAt(all, at);
    if (word.empty()) {
        std::size_t end = at + 1;
        while (end < all.size() && (static_cast<unsigned char>(all[end]) & 0xC0U) == 0x80U) ++end;
        word = all.substr(at, end - at);
    }
    std::string out = "'";
    out.append(word).push_back('\'');
    return out;
}

bool looksLikeNumber(std::string_view word) {
    if (word.empty()) return false;
    const std::string_view digits = word.front() == '-' || word.front() == '+' ? word.substr(1) : word;
    if (digits.empty()) return true;
    const char c = digits.front();
    return (c >= '0' && c <= '9') || c == '.' || digits == "NaN" || digits == "Infinity" || digits == "inf" ||
           digits == "nan" || digits == "Inf";
}

std::string numberHint(std::string_view word) {
    std::string sign = !word.empty() && word.front() == '-' ? "-" : "";
    std::string_view digits = word;
    if (!digits.empty() && (digits.front() == '-' || digits.front() == '+')) digits.remove_prefix(1);
    const auto allDigits = [](std::string_view part) {
        return !part.empty() && std::all_of(part.begin(), part.end(), [](char c) { return c >= '0' && c <= '9'; });
    };
    if (digits.empty()) return "write digits after the sign";
    if (digits.front() == '.' && allDigits(digits.substr(1))) return "write " + sign + "0" + std::string(digits);
    if (digits.back() == '.' && allDigits(digits.substr(0, digits.size() - 1)))
        return "write " + sign + std::string(digits) + "0";
    if (digits.front() == '0' && digits.size() > 1 && digits[1] >= '0' && digits[1] <= '9') {
        const std::size_t first = digits.find_first_not_of('0');
        const std::string_view rest = first == std::string_view::npos ? "0" : digits.substr(first);
        return "write " + sign + (rest.front() == '.' ? "0" : "") + std::string(rest);
    }
    if (word.front() == '+' && digits.front() != '.') return "write " + std::string(digits);
    if (digits.size() > 1 && (digits.back() == 'f' || digits.back() == 'F') && digits[1] != 'x')
        return "remove the '" + std::string(1, digits.back()) + "'";
    if (!(digits.front() >= '0' && digits.front() <= '9') && digits.front() != '.') return "numbers must be finite";
    return "use plain decimal digits, such as 0.35 or 1.5e-3";
}

std::string valueHint(std::string_view word, char found) {
    if (found == '\'') return "use \" instead of '";
    constexpr std::array<std::pair<std::string_view, std::string_view>, 10> spellings{{{"True", "true"},
                                                                                       {"TRUE", "true"},
                                                                                       {"yes", "true"},
                                                                                       {"on", "true"},
                                                                                       {"False", "false"},
                                                                                       {"FALSE", "false"},
                                                                                       {"no", "false"},
                                                                                       {"off", "false"},
                                                                                       {"None", "null"},
                                                                                       {"NULL", "null"}}};
    for (const auto& [wrong, right] : spellings) {
        if (word == wrong) return "write " + std::string(right);
    }
    return word.empty() ? "" : "put \" around the word";
}

}  // namespace

Lines::Lines(std::string_view text) : starts_{0} {
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\n') starts_.push_back(i + 1);
    }
}

Place Lines::at(std::size_t offset) const {
    const auto after = std::upper_bound(starts_.begin(), starts_.end(), offset);
    const auto line = static_cast<std::size_t>(after - starts_.begin());
    return {static_cast<std::uint32_t>(line), static_cast<std::uint32_t>(offset - starts_[line - 1] + 1)};
}

std::size_t skipBlank(std::string_view text, std::size_t from, std::size_t* openComment) {
    std::size_t at = from;
    while (at < text.size()) {
        if (isBlank(text[at])) {
            ++at;
        } else if (text.substr(at, 2) == "//") {
            at = std::min(text.find('\n', at), text.size());
        } else if (text.substr(at, 2) == "/*") {
            const std::size_t end = text.find("*/", at + 2);
            if (end == std::string_view::npos) {
                if (openComment) *openComment = at;
                return text.size();
            }
            at = end + 2;
        } else {
            break;
        }
    }
    return at;
}

std::size_t firstBadByte(std::string_view text) {
    const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
    std::size_t i = 0;
    while (i < text.size()) {
        const unsigned c = byte(i);
        if (c == 0) return i;
        if (c < 0x80) {
            ++i;
            continue;
        }
        const std::size_t extra = c >= 0xC2 && c <= 0xDF   ? 1
                                  : c >= 0xE0 && c <= 0xEF ? 2
                                  : c >= 0xF0 && c <= 0xF4 ? 3
                                                           : 0;
        if (extra == 0) return i;
        for (std::size_t k = 1; k <= extra; ++k) {
            if ((byte(i + k) & 0xC0U) != 0x80U) return i;
        }
        const unsigned second = byte(i + 1);
        // Overlong forms, surrogates, and what lies past U+10FFFF.
        if ((c == 0xE0 && second < 0xA0) || (c == 0xED && second > 0x9F) || (c == 0xF0 && second < 0x90) ||
            (c == 0xF4 && second > 0x8F))
            return i;
        i += extra + 1;
    }
    return std::string_view::npos;
}

Diagnostic explainSyntax(std::string_view all, const Lines& lines, const Progress& progress,
                         std::string_view stringProblem, bool numberTooBig) {
    using After = Progress::After;
    Diagnostic out;
    const auto report = [&](std::size_t at, Code code, std::string text, std::string hint) {
        const Place place = lines.at(std::min(at, all.size()));
        out.code = code;
        out.line = place.line;
        out.column = place.column;
        out.text = std::move(text);
        out.hint = std::move(hint);
        return out;
    };

    std::size_t openComment = std::string_view::npos;
    std::size_t at = skipBlank(all, progress.lastEnd, &openComment);
    if (openComment != std::string_view::npos)
        return report(openComment, "J001", "this comment is never closed", "add */");

    // "01", "1.0f", "0x10": the reader took the first digits as the number.
    if (progress.lastIsNumber && at == progress.lastEnd && at < all.size() && isWordCharacter(all[at])) {
        const std::string_view word = wordAt(all, progress.lastStart);
        return report(progress.lastStart, "J005", "'" + std::string(word) + "' is not a JSON number", numberHint(word));
    }

    const bool inObject = !progress.open.empty() && progress.open.back().isObject;
    const char close = inObject ? '}' : ']';
    std::size_t comma = std::string_view::npos;
    std::string expected;
    bool wantsValue = false;
    const auto take = [&](char c) {
        if (at >= all.size() || all[at] != c) return false;
        comma = at;
        at = skipBlank(all, at + 1, &openComment);
        return true;
    };
    std::string commaHint;
    switch (progress.after) {
        case After::Nothing:
            expected = "a value";
            wantsValue = true;
            break;
        case After::Document:
            expected = "the end of the text";
            break;
        case After::Open:
            expected = inObject ? "a key in double quotes or '}'" : "a value or ']'";
            wantsValue = !inObject;
            break;
        case After::Key:
            if (take(':')) {
                expected = "a value";
                wantsValue = true;
            } else {
                expected = "':' after the key";
                commaHint = "add ':' at " + text(lines.at(progress.lastEnd));
            }
            comma = std::string_view::npos;
            break;
        case After::Value:
            if (take(',')) {
                expected = inObject ? "a key in double quotes" : "a value";
                wantsValue = !inObject;
            } else {
                expected = std::string("',' or '") + close + "' here";
                commaHint = "add ',' at " + text(lines.at(progress.lastEnd));
            }
            break;
    }
    if (openComment != std::string_view::npos)
        return report(openComment, "J001", "this comment is never closed", "add */");

    const char found = at < all.size() ? all[at] : '\0';
    const std::string_view word = at < all.size() ? wordAt(all, at) : std::string_view();
    const bool wantsString = wantsValue || expected.substr(0, 5) == "a key";
    if (found == '"' && wantsString && !stringProblem.empty())
        return report(at, "J008", "faulty string: " + std::string(stringProblem),
                      stringProblem.find("closing") != std::string_view::npos   ? "add \" at the end of the string"
                      : stringProblem.find("control") != std::string_view::npos ? "write \\t for a tab"
                                                                                : "write \\\\ for one backslash");
    if (wantsValue && numberTooBig)
        return report(at, "J006", "the number " + std::string(word) + " does not fit in double precision",
                      "write a number below 1e308");
    if (wantsValue && looksLikeNumber(word))
        return report(at, "J005", "'" + std::string(word) + "' is not a JSON number", numberHint(word));

    std::string hint;
    if (at >= all.size() && !progress.open.empty()) {
        hint = std::string("add '") + close + "' for the '" + (inObject ? '{' : '[') + "' at " +
               text(lines.at(progress.open.back().start));
    } else if (comma != std::string_view::npos && (found == '}' || found == ']' || found == ',')) {
        hint = "remove the ',' at " + text(lines.at(comma));
    } else if (wantsString) {
        hint = valueHint(word, found);
    } else if ((found == '}' || found == ']') && !progress.open.empty()) {
        hint = std::string("the '") + (inObject ? '{' : '[') + "' at " + text(lines.at(progress.open.back().start)) +
               " is closed by '" + close + "'";
    } else {
        hint = commaHint;
    }
    if (progress.after == After::Nothing && at >= all.size())
        return report(at, "J003", "the text is empty", "start with {");
    return report(at, "J001", "expected " + expected + ", found " + foundAt(all, at), std::move(hint));
}

}  // namespace pelage::json
