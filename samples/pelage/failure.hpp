// SPDX-License-Identifier: MIT
// Every command ends in one of three ways: 0, or one line on stderr and 2. This is that line.
#pragma once

#include <pelage/base/diagnostic.hpp>
#include <pelage/rhi/error.hpp>

#include <string>
#include <vector>

namespace pelage::app {

inline constexpr int exitOk = 0;
inline constexpr int exitFailed = 2;

/// What stopped a command. Made from any error the libraries report.
struct Failure {
    std::string line = {};                // without "pelage: error "
    std::vector<std::string> files = {};  // those that the errors are in, as far as they name them

    Failure() = default;
    explicit Failure(std::string text) : line(std::move(text)) {}
    Failure(const Diagnostic& diagnostic);    // NOLINT(google-explicit-constructor): errors convert at every return
    Failure(const Diagnostics& diagnostics);  // NOLINT(google-explicit-constructor)
    Failure(const Diagnostic& error);         // NOLINT(google-explicit-constructor)
};

template <class T>
using Outcome = tl::expected<T, Failure>;

/// Prints "pelage: error …" as exactly one line; gives exitFailed.
int report(const Failure& failure);
/// "pelage: warning …", one line each.
void warn(const Diagnostics& notes);
/// Notes as well: "pelage: note …".
void tell(const Diagnostics& notes);
void warn(const std::string& text);

}  // namespace pelage::app
