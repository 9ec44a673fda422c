// SPDX-License-Identifier: MIT
// One diagnostic is one line: what is wrong, where, what was expected, what to do. Every reader of outside bytes in
// Pelage (JSON, glTF, .tfx, .hair, images) reports through this type, so that people and editors read one format.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace pelage {

enum class Severity : std::uint8_t { Note, Warning, Error };

struct Diagnostic {
    Severity severity = Severity::Error;
    std::string code = {};     // stable, for example "J010"; documented in docs/diagnostics.md
    std::string file = {};     // as the user named it; empty when the text came from memory
    std::uint32_t line = 0;    // 1-based; 0 when the place is not a line of text (binary files give the byte in `text`)
    std::uint32_t column = 0;  // 1-based, in bytes
    std::string text = {};     // what is wrong, with the value found and what was expected
    std::string hint = {};     // what to do; may be empty
};

/// "file:line:column: error J010: text; hint: hint", never a line break.
std::string toString(const Diagnostic& diagnostic);

/// The same for programs: one line of JSON without a line break,
/// {"file","line","column","severity","code","text","hint","related":[{"file","line","column"}]}. Line and column are 0
/// when there is no place. `related` are the places that the text and the hint name ("first at 12:5"). Bytes that are
/// not UTF-8 become U+FFFD.
std::string toJson(const Diagnostic& diagnostic);

/// Everything found wrong with one piece of input, in the order of the text.
class Diagnostics {
public:
    void add(Diagnostic diagnostic);
    void append(const Diagnostics& other);
    bool hasErrors() const;
    bool empty() const { return items_.empty(); }
    const std::vector<Diagnostic>& items() const { return items_; }
    void sortByPlace();
    /// All lines, each ending in a line feed.
    std::string text() const;
    /// The same in JSON: an object a line.
    std::string jsonLines() const;

private:
    std::vector<Diagnostic> items_;
};

/// The result of reading something: the value, or the one line that says why not.
template <class T>
using Outcome = tl::expected<T, Diagnostic>;

/// The result of reading a text where all faults are reported at once.
template <class T>
using Checked = tl::expected<T, Diagnostics>;

/// The name among `known` that a person most likely meant by `word` (small edit distance, case differences are free),
/// or an empty view.
std::string_view nearestName(std::string_view word, const std::vector<std::string>& known);
/// "did you mean 'x'?", or the list of what is known when that is short, or nothing.
std::string nameHint(std::string_view word, const std::vector<std::string>& known);

}  // namespace pelage
