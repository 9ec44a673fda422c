// SPDX-License-Identifier: MIT
// Conditions of a pass tree: json::Condition over settings and host.has('Import').
#pragma once

#include <pelage/base/condition.hpp>
#include <pelage/base/json.hpp>
#include <pelage/passes/tree.hpp>

namespace pelage::passes {

class Reporter;

/// What names an expression may use.
struct Vocabulary {
    std::vector<const SettingInfo*> settings = {};
    std::vector<std::string> imports = {};
};

/// What an expression is evaluated against.
struct Conditions {
    std::map<std::string, SettingValue> settings = {};  // all of them
    std::map<std::string, bool> imports = {};           // lent or not
};

class Expression {
public:
    /// Reports E001 (syntax), E002 (unknown name), E003 (not a word of the setting), E004 (types do not fit). `place`
    /// is where the string begins in the file; `about` names the condition in messages.
    static std::optional<Expression> parse(const std::string& text, json::Place place, const Vocabulary& vocabulary,
                                           const std::string& about, Reporter& reporter);
    bool evaluate(const Conditions& conditions) const;
    const std::string& text() const { return text_; }
    /// Settings it looks at, for the warning about settings without effect.
    const std::vector<std::string>& settings() const { return settings_; }

private:
    struct Read {
        bool isImport = false;
        std::string name = {};
        std::vector<std::string> words = {};  // of an enum setting
    };
    std::string text_ = {};
    json::Condition condition_ = {};
    std::map<std::size_t, Read> reads_ = {};  // what each index of the condition stands for
    std::vector<std::string> settings_ = {};
};

}  // namespace pelage::passes
