// SPDX-License-Identifier: MIT
#include "expression.hpp"

#include "description.hpp"

#include <algorithm>

namespace pelage::passes {

std::optional<Expression> Expression::parse(const std::string& text, json::Place place, const Vocabulary& vocabulary,
                                            const std::string& about, Reporter& reporter) {
    using Type = json::ConditionNames::Type;
    using Kind = SettingValue::Type;
    json::ConditionNames names{.kind = "setting", .function = {"host.has", "import", vocabulary.imports}};
    for (const SettingInfo* setting : vocabulary.settings) {
        const Type type = setting->type == Kind::Bool   ? Type::Bool
                          : setting->type == Kind::Uint ? Type::Number
                                                        : Type::Word;
        names.names.push_back({setting->name, type, setting->words});
    }
    Result<json::Condition> parsed = json::Condition::parse(text, names);
    if (!parsed) {
        const Diagnostic& fault = parsed.error();
        // The quote that opens the string stands before the first byte of the text.
        reporter.error({place.line, place.column + fault.column}, fault.code, about + ": " + fault.text, fault.hint);
        return std::nullopt;
    }
    Expression expression;
    expression.text_ = text;
    for (const std::size_t index : parsed->reads()) {
        if (index >= names.names.size()) {
            expression.reads_[index] = {true, vocabulary.imports[index - names.names.size()], {}};
            continue;
        }
        const SettingInfo& setting = *vocabulary.settings[index];
        expression.reads_[index] = {false, setting.name, setting.words};
        expression.settings_.push_back(setting.name);
    }
    expression.condition_ = std::move(*parsed);
    return expression;
}

bool Expression::evaluate(const Conditions& conditions) const {
    return condition_.evaluate([&](std::size_t index) {
        const Read& read = reads_.at(index);
        if (read.isImport) {
            const auto lent = conditions.imports.find(read.name);
            return lent != conditions.imports.end() && lent->second ? 1.0 : 0.0;
        }
        const auto setting = conditions.settings.find(read.name);
        if (setting == conditions.settings.end()) return 0.0;
        if (setting->second.type != SettingValue::Type::Enum) return static_cast<double>(setting->second.number);
        const auto word = std::find(read.words.begin(), read.words.end(), setting->second.word);
        return static_cast<double>(word - read.words.begin());
    });
}

}  // namespace pelage::passes
