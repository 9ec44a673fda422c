// SPDX-License-Identifier: MIT
#include "failure.hpp"

#include <algorithm>
#include <cstdio>

namespace pelage::app {

namespace {

/// Messages quote outside bytes; a line break or a control character in them must not break the line.
std::string oneLine(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
    return text;
}

std::string withoutSeverity(const Diagnostic& diagnostic) {
    std::string place = diagnostic.file;
    if (diagnostic.line != 0) {
        place += ":" + std::to_string(diagnostic.line) + ":" + std::to_string(diagnostic.column);
    }
    std::string line = diagnostic.code + ": " + (place.empty() ? "" : place + ": ") + diagnostic.text;
    if (!diagnostic.hint.empty()) line += "; " + diagnostic.hint;
    return line;
}

}  // namespace

Failure::Failure(const Diagnostic& diagnostic) : line(withoutSeverity(diagnostic)) {
    if (!diagnostic.file.empty()) files.push_back(diagnostic.file);
}

Failure::Failure(const Diagnostics& diagnostics) {
    std::size_t errors = 0;
    for (const Diagnostic& diagnostic : diagnostics.items()) {
        if (diagnostic.severity != Severity::Error) continue;
        if (errors++ == 0) line = withoutSeverity(diagnostic);
        if (!diagnostic.file.empty()) files.push_back(diagnostic.file);
    }
    if (errors > 1) line += " (and " + std::to_string(errors - 1) + " more: see pelage check)";
}

Failure::Failure(const Diagnostic& error) : line(rhi::toString(error)) {}

int report(const Failure& failure) {
    std::fprintf(stderr, "pelage: error %s\n", oneLine(failure.line).c_str());
    return exitFailed;
}

void warn(const std::string& text) {
    std::fprintf(stderr, "pelage: warning %s\n", oneLine(text).c_str());
}

void warn(const Diagnostics& notes) {
    for (const Diagnostic& note : notes.items()) {
        if (note.severity == Severity::Warning) warn(withoutSeverity(note));
    }
}

void tell(const Diagnostics& notes) {
    warn(notes);
    for (const Diagnostic& note : notes.items()) {
        if (note.severity == Severity::Note)
            std::fprintf(stderr, "pelage: note %s\n", oneLine(withoutSeverity(note)).c_str());
    }
}

}  // namespace pelage::app
