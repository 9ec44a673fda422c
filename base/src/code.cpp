// SPDX-License-Identifier: MIT
#include <pelage/base/code.hpp>

#include <array>
#include <ostream>

namespace pelage {

std::optional<Code> Code::find(std::string_view text) {
    const std::size_t index = codes::codeIndex(text);
    if (text.empty() || index == std::size(codes::codeList)) return std::nullopt;
    return at(index);
}

std::ostream& operator<<(std::ostream& out, const Code& code) {
    return out << code.text();
}

std::span<const Code> Code::all() {
    static constexpr auto codes = [] {
        std::array<Code, std::size(codes::codeList) - 1> made;
        for (std::size_t i = 0; i < made.size(); ++i) made[i] = at(i + 1);
        return made;
    }();
    return codes;
}

}  // namespace pelage
