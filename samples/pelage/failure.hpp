// SPDX-License-Identifier: MIT
// Every command ends in one of two ways: 0, or one line on stderr and 2. This is that line.
#pragma once

#include <pelage/base/diagnostic.hpp>

#include <string>
#include <vector>

namespace pelage::app {

inline constexpr int exitOk = 0;
inline constexpr int exitFailed = 2;

/// A fault of the app's own.
Diagnostic failure(Code code, std::string text);

/// The first error without its severity, "CODE: place: text; hint", and how many more there are.
std::string lineOf(const Diagnostics& faults);
/// The files that the errors are in, as far as they name them.
std::vector<std::string> filesOf(const Diagnostics& faults);

/// Prints "pelage: error …" as exactly one line; gives exitFailed.
int report(const Diagnostics& faults);
/// "pelage: warning …", one line each.
void warn(const Diagnostics& notes);
/// Notes as well: "pelage: note …".
void tell(const Diagnostics& notes);
/// "pelage: warning …" of a text that others made, such as the validation layer.
void warn(const std::string& text);

}  // namespace pelage::app
