// SPDX-License-Identifier: MIT
// Settings of a pass tree as people write them, in scene files and on command lines.
#pragma once

#include <pelage/base/diagnostic.hpp>
#include <pelage/passes/tree.hpp>

#include <algorithm>
#include <charconv>
#include <string>
#include <vector>

namespace pelage::hair {

namespace detail {

inline Diagnostic wrongValue(const passes::SettingInfo& info, const std::string& text, const std::string& expected) {
    return {.code = "S011",
            .text = "the setting \"" + info.name + "\" is \"" + text + "\", expected " + expected,
            .hint = info.description};
}

inline std::string joinedWords(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

inline Result<passes::SettingValue> parseUint(const passes::SettingInfo& info, const std::string& text) {
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    if (!whole || number < info.min || number > info.max || (info.multipleOf > 1 && number % info.multipleOf != 0)) {
        std::string expected = "a whole number from " + std::to_string(info.min) + " to " + std::to_string(info.max);
        if (info.multipleOf > 1) expected += ", a multiple of " + std::to_string(info.multipleOf);
        return tl::unexpected(wrongValue(info, text, expected));
    }
    return passes::SettingValue{.type = passes::SettingValue::Type::Uint, .number = number};
}

}  // namespace detail

/// "true", "1024" or a word, judged by what the tree says of the setting (codes S010 unknown name, S011 wrong value).
inline Result<passes::SettingValue> parseSetting(const passes::PassTree& tree, const std::string& name,
                                                 const std::string& text) {
    const auto& all = tree.settings();
    const auto info = std::find_if(all.begin(), all.end(), [&](const auto& each) { return each.name == name; });
    if (info == all.end()) {
        std::vector<std::string> known;
        for (const auto& each : all) known.push_back(each.name);
        const std::string_view nearest = nearestName(name, known);
        return tl::unexpected(
            Diagnostic{.code = "S010",
                       .text = "the pass tree \"" + tree.name() + "\" has no setting \"" + name + "\"",
                       .hint = nearest.empty() ? "it has " + detail::joinedWords(known)
                                               : "did you mean \"" + std::string(nearest) + "\"?"});
    }
    using Type = passes::SettingValue::Type;
    if (info->type == Type::Uint) return detail::parseUint(*info, text);
    if (info->type == Type::Bool) {
        if (text == "true" || text == "1") return passes::SettingValue{.type = Type::Bool, .number = 1};
        if (text == "false" || text == "0") return passes::SettingValue{.type = Type::Bool, .number = 0};
        return tl::unexpected(detail::wrongValue(*info, text, "true or false"));
    }
    const auto word = std::find(info->words.begin(), info->words.end(), text);
    if (word == info->words.end())
        return tl::unexpected(detail::wrongValue(*info, text, "one of " + detail::joinedWords(info->words)));
    return passes::SettingValue{
        .type = Type::Enum, .number = static_cast<std::uint32_t>(word - info->words.begin()), .word = text};
}

}  // namespace pelage::hair
