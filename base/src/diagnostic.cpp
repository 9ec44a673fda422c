// SPDX-License-Identifier: MIT
#include "severity.hpp"

#include <algorithm>
#include <tuple>

namespace pelage {
namespace {

// One diagnostic stays one line whatever the offending text holds: control characters are written as escapes.
void appendOnOneLine(std::string& out, std::string_view text) {
    constexpr std::string_view digits = "0123456789abcdef";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '\n') {
            out += "\\n";
        } else if (c == '\t') {
            out += "\\t";
        } else if (byte < 0x20 || byte == 0x7f) {
            out += "\\x";
            out += digits[byte >> 4U];
            out += digits[byte & 15U];
        } else {
            out += c;
        }
    }
}

}  // namespace

std::string_view severityWord(Severity severity) {
    switch (severity) {
        case Severity::Note:
            return "note";
        case Severity::Warning:
            return "warning";
        case Severity::Error:
            return "error";
    }
    return "error";
}

std::string toString(const Diagnostic& diagnostic) {
    std::string out;
    if (!diagnostic.file.empty()) {
        appendOnOneLine(out, diagnostic.file);
        out += ':';
    }
    if (diagnostic.line != 0) {
        out += std::to_string(diagnostic.line) + ':' + std::to_string(diagnostic.column) + ':';
    }
    if (!out.empty()) out += ' ';
    out += severityWord(diagnostic.severity);
    if (!diagnostic.code.empty()) {
        out += ' ';
        out += diagnostic.code.text();
    }
    out += ": ";
    appendOnOneLine(out, diagnostic.text);
    // A sentence goes on with what follows.
    const bool goesOn = !diagnostic.context.empty() || !diagnostic.hint.empty();
    if (goesOn && out.ends_with('.')) out.pop_back();
    for (std::size_t i = diagnostic.context.size(); i-- > 0;) {
        out += i + 1 == diagnostic.context.size() ? "; while validating " : " > ";
        appendOnOneLine(out, diagnostic.context[i]);
    }
    if (!diagnostic.hint.empty()) {
        out += "; hint: ";
        appendOnOneLine(out, diagnostic.hint);
    }
    return out;
}

Diagnostics::Diagnostics(Diagnostic one) {
    items_.push_back(std::move(one));
}

const Diagnostic& Diagnostics::first() const {
    static const Diagnostic none = {};
    const auto found =
        std::find_if(items_.begin(), items_.end(), [](const Diagnostic& d) { return d.severity == Severity::Error; });
    if (found != items_.end()) return *found;
    return items_.empty() ? none : items_.front();
}

Diagnostics Diagnostics::within(const std::string& context) const {
    Diagnostics all = *this;
    for (Diagnostic& each : all.items_) each.context.push_back(context);
    return all;
}

void Diagnostics::add(Diagnostic diagnostic) {
    items_.push_back(std::move(diagnostic));
}

void Diagnostics::append(const Diagnostics& other) {
    const std::size_t count = other.items_.size();  // `other` may be this list
    items_.reserve(items_.size() + count);
    for (std::size_t i = 0; i < count; ++i) items_.push_back(other.items_[i]);
}

bool Diagnostics::hasErrors() const {
    return std::any_of(items_.begin(), items_.end(), [](const Diagnostic& d) { return d.severity == Severity::Error; });
}

void Diagnostics::sortByPlace() {
    std::stable_sort(items_.begin(), items_.end(), [](const Diagnostic& a, const Diagnostic& b) {
        return std::tie(a.file, a.line, a.column) < std::tie(b.file, b.line, b.column);
    });
}

std::string Diagnostics::text() const {
    std::string out;
    for (const Diagnostic& item : items_) out += toString(item) + '\n';
    return out;
}

}  // namespace pelage
