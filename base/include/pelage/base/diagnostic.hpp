// SPDX-License-Identifier: MIT
// The one error of Pelage. A diagnostic is one line: what is wrong, where, what was expected, what to do. Readers of
// outside bytes, pass trees, materials, the renderer and the device all fail with it, so that people and editors read
// one format and a fault keeps its code and its place on the way up.
#pragma once

#include <pelage/base/code.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace pelage {

enum class Severity : std::uint8_t { Note, Warning, Error };

/// What a device's fault asks of the caller; `None` for faults that are not a device's.
enum class ErrorKind : std::uint8_t {
    None,
    Validation,   // the program asked for something that is not allowed
    OutOfMemory,  // less may succeed
    DeviceLost,   // nothing more will succeed on this device
    Unsupported,  // this device or driver cannot
    Internal      // the driver failed in another way
};

struct Diagnostic {
    Severity severity = Severity::Error;
    Code code = {};
    std::string file = {};     // as the user named it; empty when the text came from memory
    std::uint32_t line = 0;    // 1-based; 0 when the place is not a line of text (binary files give the byte in `text`)
    std::uint32_t column = 0;  // 1-based, in bytes
    std::string text = {};     // what is wrong, with the value found and what was expected
    std::string hint = {};     // what to do; may be empty
    std::vector<std::string> context = {};  // what was being done, innermost first: "RenderPass \"forward\" > draw #3"
    ErrorKind kind = ErrorKind::None;
};

/// "file:line:column: error J010: text; while recording ...; hint: hint", never a line break.
std::string toString(const Diagnostic& diagnostic);

/// The same for programs: one line of JSON without a line break,
/// {"file","line","column","severity","code","text","hint","related":[{"file","line","column"}]}. Line and column are 0
/// when there is no place. `related` are the places that the text and the hint name ("first at 12:5"). Bytes that are
/// not UTF-8 become U+FFFD.
std::string toJson(const Diagnostic& diagnostic);

/// Everything found wrong with one piece of input, in the order of the text.
class Diagnostics {
public:
    Diagnostics() = default;
    Diagnostics(Diagnostic one);  // NOLINT(google-explicit-constructor): a function that finds one fault returns it

    void add(Diagnostic diagnostic);
    void append(const Diagnostics& other);
    bool hasErrors() const;
    bool empty() const { return items_.empty(); }
    const std::vector<Diagnostic>& items() const& { return items_; }
    std::vector<Diagnostic> items() && { return std::move(items_); }  // a loop over a temporary's items owns them
    /// The first that is an error; the first of all when none is; an empty one when there is nothing.
    const Diagnostic& first() const;
    /// The same faults, each with `context` as the outermost thing that was being done.
    Diagnostics within(const std::string& context) const;
    void sortByPlace();
    /// All lines, each ending in a line feed.
    std::string text() const;
    /// The same in JSON: an object a line.
    std::string jsonLines() const;

private:
    std::vector<Diagnostic> items_;
};

/// The value, or all the reasons why there is none.
template <class T>
using Result = tl::expected<T, Diagnostics>;

/// The name among `known` that a person most likely meant by `word` (small edit distance, case differences are free),
/// or an empty view.
std::string_view nearestName(std::string_view word, const std::vector<std::string>& known);
/// "did you mean 'x'?", or the list of what is known when that is short, or nothing.
std::string nameHint(std::string_view word, const std::vector<std::string>& known);

}  // namespace pelage
