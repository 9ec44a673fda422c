// SPDX-License-Identifier: MIT
#pragma once

#include "reader.hpp"

#include <algorithm>

namespace pelage::passes {

/// What each slot is connected to: P016..P019, P022, P035, P036, P044, P045, P049.
void checkReferences(PassTree::Description& description, Reporter& reporter);
/// P047: declared and never used.
void warnUnused(PassTree::Description& description, Reporter& reporter);

/// "4" -> 4.
std::optional<std::uint32_t> numberOfWord(std::string_view word);
std::string_view word(SlotUse use);
std::string_view word(PassKind kind);
/// Whether a pass of this kind can have a slot of this use.
bool fits(PassKind kind, SlotUse use);
/// The mip level that a slot on an image uses: what it says, else the first where one use has one level; none: all.
std::uint32_t levelOf(const SlotDeclaration& slot);
/// Whether the slot takes a buffer, whatever is connected to it; storage and copy take either.
bool isBufferUse(SlotUse use);

inline bool has(const std::vector<std::string>& words, const std::string& one) {
    return std::find(words.begin(), words.end(), one) != words.end();
}
inline bool isDepthConstant(std::string_view name) {
    return name == "depthFar" || name == "depthFarArray";
}

}  // namespace pelage::passes
