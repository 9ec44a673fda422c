// SPDX-License-Identifier: MIT
// What a person is told when a text is not JSON: rapidjson says where it stopped, this file what was expected there.
#pragma once

#include <pelage/base/json.hpp>

#include <cstddef>
#include <string_view>
#include <vector>

namespace pelage::json {

/// Line and column of any byte of a text.
class Lines {
public:
    explicit Lines(std::string_view text);
    Place at(std::size_t offset) const;

private:
    std::vector<std::size_t> starts_;
};

/// The first byte at or after `from` that is neither white space nor in a comment. `openComment` gets the offset of a
/// comment that never ends.
std::size_t skipBlank(std::string_view text, std::size_t from, std::size_t* openComment = nullptr);

/// The byte where `text` stops being UTF-8 or holds a NUL; npos when it is clean.
std::size_t firstBadByte(std::string_view text);

/// How far the reader had come.
struct Progress {
    enum class After : std::uint8_t { Nothing, Open, Key, Value, Document } after = After::Nothing;
    std::size_t lastStart = 0, lastEnd = 0;  // of the last whole token
    bool lastIsNumber = false;
    struct Container {
        bool isObject = false;
        std::size_t start = 0;
    };
    std::vector<Container> open = {};
};

/// Why `text` could not be read past `progress`. `stringProblem` is the reader's word on a faulty string, or empty;
/// `numberTooBig` says that the number there has the right form.
Diagnostic explainSyntax(std::string_view text, const Lines& lines, const Progress& progress,
                         std::string_view stringProblem, bool numberTooBig);

}  // namespace pelage::json
