// SPDX-License-Identifier: MIT
// Diagnostics for editors. Texts quote outside bytes, so whatever they hold must still be one line of valid JSON.
#include "severity.hpp"

#include <charconv>

namespace pelage {
namespace {

// How many bytes the UTF-8 sequence at `at` has; 0 when there is none: cut short, overlong, a surrogate or too large.
std::size_t sequence(std::string_view text, std::size_t at) {
    const auto byte = [&](std::size_t i) {
        return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0U;
    };
    const unsigned first = byte(0);
    if (first < 0x80) return 1;
    const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4) return 0;
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xc0U) != 0x80) return 0;
    }
    const unsigned second = byte(1);
    const bool outside = (first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) ||
                         (first == 0xf0 && second < 0x90) || (first == 0xf4 && second > 0x8f);
    return outside ? 0 : length;
}

std::string quoted(std::string_view text) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string out = "\"";
    for (std::size_t i = 0; i < text.size();) {
        const auto byte = static_cast<unsigned char>(text[i]);
        const std::size_t length = sequence(text, i);
        if (byte == '"' || byte == '\\') {
            out += {'\\', text[i]};
        } else if (byte < 0x20 || byte == 0x7f) {
            out += "\\u00";
            out += {digits[byte >> 4U], digits[byte & 15U]};
        } else if (length == 0) {
            out += "\\ufffd";
        } else {
            out += text.substr(i, length);
        }
        i += length == 0 ? 1 : length;
    }
    return out + '"';
}

std::string place(std::string_view file, std::uint32_t line, std::uint32_t column) {
    return "\"file\":" + quoted(file) + ",\"line\":" + std::to_string(line) + ",\"column\":" + std::to_string(column);
}

// A number of decimal digits only, at the end or the beginning of which something else may stand.
bool takeNumber(std::string_view& text, std::uint32_t& value) {
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (read.ec != std::errc() || value == 0) return false;
    text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
    return true;
}

// Places in a sentence are written "at 12:5", or "at parts/kit.pass.json:12:5" when they are in another file.
std::string places(std::string_view sentence, std::string_view file) {
    std::string out;
    for (std::size_t at = sentence.find("at "); at != std::string_view::npos; at = sentence.find("at ", at + 3)) {
        if (at != 0 && sentence[at - 1] != ' ') continue;
        std::string_view rest = sentence.substr(at + 3);
        std::string_view where = file;
        if (!rest.empty() && (rest[0] < '0' || rest[0] > '9')) {
            const std::size_t end = rest.find(".json:");
            if (end == std::string_view::npos) continue;
            where = rest.substr(0, end + 5);
            if (where.find(" at ") != std::string_view::npos) continue;
            rest.remove_prefix(end + 6);
        }
        std::uint32_t line = 0, column = 0;
        if (!takeNumber(rest, line) || rest.empty() || rest[0] != ':') continue;
        rest.remove_prefix(1);
        if (!takeNumber(rest, column)) continue;
        out += (out.empty() ? "{" : ",{") + place(where, line, column) + "}";
    }
    return out;
}

}  // namespace

std::string toJson(const Diagnostic& diagnostic) {
    std::string related = places(diagnostic.text, diagnostic.file);
    const std::string hinted = places(diagnostic.hint, diagnostic.file);
    if (!related.empty() && !hinted.empty()) related += ",";
    related += hinted;
    std::string context;
    for (const std::string& each : diagnostic.context) context += (context.empty() ? "" : ",") + quoted(each);
    return "{" + place(diagnostic.file, diagnostic.line, diagnostic.column) + ",\"severity\":\"" +
           std::string(severityWord(diagnostic.severity)) +
           "\",\"code\":" + quoted(std::string(diagnostic.code.text())) + ",\"text\":" + quoted(diagnostic.text) +
           ",\"hint\":" + quoted(diagnostic.hint) + ",\"context\":[" + context + "],\"related\":[" + related + "]}";
}

std::string Diagnostics::jsonLines() const {
    std::string out;
    for (const Diagnostic& item : items_) out += toJson(item) + '\n';
    return out;
}

}  // namespace pelage
