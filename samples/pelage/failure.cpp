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
    std::string line =
        std::string(diagnostic.code.text()) + ": " + (place.empty() ? "" : place + ": ") + diagnostic.text;
    for (const std::string& each : diagnostic.context) line += "; in " + each;
    if (!diagnostic.hint.empty()) line += "; " + diagnostic.hint;
    return line;
}

void print(const char* severity, const std::string& line) {
    std::fprintf(stderr, "pelage: %s %s\n", severity, oneLine(line).c_str());
}

}  // namespace

Diagnostic failure(Code code, std::string text) {
    return {.code = code, .text = std::move(text)};
}

std::string lineOf(const Diagnostics& faults) {
    const auto isError = [](const Diagnostic& each) { return each.severity == Severity::Error; };
    const auto errors = std::count_if(faults.items().begin(), faults.items().end(), isError);
    std::string line = withoutSeverity(faults.first());
    if (errors > 1) line += " (and " + std::to_string(errors - 1) + " more: see pelage check)";
    return line;
}

std::vector<std::string> filesOf(const Diagnostics& faults) {
    std::vector<std::string> files;
    for (const Diagnostic& each : faults.items()) {
        if (each.severity == Severity::Error && !each.file.empty()) files.push_back(each.file);
    }
    return files;
}

int report(const Diagnostics& faults) {
    print("error", lineOf(faults));
    return exitFailed;
}

void warn(const Diagnostics& notes) {
    for (const Diagnostic& note : notes.items()) {
        if (note.severity == Severity::Warning) print("warning", withoutSeverity(note));
    }
}

void warn(const std::string& text) {
    print("warning", text);
}

void tell(const Diagnostics& notes) {
    warn(notes);
    for (const Diagnostic& note : notes.items()) {
        if (note.severity == Severity::Note) print("note", withoutSeverity(note));
    }
}

}  // namespace pelage::app
