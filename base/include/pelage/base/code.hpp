// SPDX-License-Identifier: MIT
// The code of a diagnostic: one of the list in codes.def. A word that is not in the list does not compile.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace pelage {

namespace codes {

struct CodeEntry {
    std::string_view text, meaning;
};

inline constexpr CodeEntry codeList[] = {
    {"", "No code was given."},
#define PELAGE_CODE(code, meaning) {#code, meaning},
#include <pelage/base/codes.def>
};

constexpr std::size_t codeIndex(std::string_view text) {
    for (std::size_t i = 0; i < std::size(codeList); ++i) {
        if (codeList[i].text == text) return i;
    }
    return std::size(codeList);
}

}  // namespace codes

class Code {
public:
    constexpr Code() = default;
    /// `Code code = "J010";` is checked when it is compiled: an error here means that codes.def lacks the word.
    consteval Code(const char* text) : index_(checked(text)) {}  // NOLINT(google-explicit-constructor)

    /// "J010"; empty when no code was given.
    constexpr std::string_view text() const { return codes::codeList[index_].text; }
    /// What the code stands for: one sentence.
    constexpr std::string_view meaning() const { return codes::codeList[index_].meaning; }
    constexpr bool empty() const { return index_ == 0; }
    constexpr bool operator==(const Code&) const = default;
    constexpr auto operator<=>(const Code&) const = default;

    /// The code that is written so, for texts that name one; nothing when it is not in the list.
    static std::optional<Code> find(std::string_view text);
    /// All of the list, in its order.
    static std::span<const Code> all();

private:
    static consteval std::uint16_t checked(std::string_view text) {
        const std::size_t index = codes::codeIndex(text);
        if (index == std::size(codes::codeList)) throw "this code is not in codes.def";
        return static_cast<std::uint16_t>(index);
    }
    static constexpr Code at(std::size_t index) {
        Code code;
        code.index_ = static_cast<std::uint16_t>(index);
        return code;
    }

    std::uint16_t index_ = 0;
};

/// Writes the text of the code.
std::ostream& operator<<(std::ostream& out, const Code& code);

}  // namespace pelage
