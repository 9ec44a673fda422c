// SPDX-License-Identifier: MIT
#include "link.hpp"

namespace pelage::passes {
namespace {

// The value in force, or nothing with P082 reported.
std::optional<SettingValue> checkedSetting(const SettingDeclaration& declared, const SettingValue& given,
                                           Reporter& reporter) {
    const SettingInfo& info = declared.info;
    SettingValue value = given;
    std::string expected;
    if (given.type != info.type) {
        expected = info.type == SettingValue::Type::Bool   ? "a bool"
                   : info.type == SettingValue::Type::Uint ? "a uint"
                                                           : "a word";
    } else if (info.type == SettingValue::Type::Bool) {
        if (given.number > 1) expected = "0 or 1";
    } else if (info.type == SettingValue::Type::Uint) {
        if (given.number < info.min || given.number > info.max || given.number % info.multipleOf != 0) {
            expected = std::to_string(info.min) + ".." + std::to_string(info.max);
            if (info.multipleOf > 1) expected += ", a multiple of " + std::to_string(info.multipleOf);
        }
    } else {
        // A word counts; without one, its index does.
        if (value.word.empty() && value.number < info.words.size()) value.word = info.words[value.number];
        const auto found = std::find(info.words.begin(), info.words.end(), value.word);
        if (found == info.words.end()) {
            for (const std::string& word : info.words) expected += (expected.empty() ? "one of " : ", ") + word;
        } else {
            value.number = static_cast<std::uint32_t>(found - info.words.begin());
        }
    }
    if (expected.empty()) return value;
    const std::string shown =
        given.type == SettingValue::Type::Enum ? "'" + given.word + "'" : std::to_string(given.number);
    reporter.error(declared.place, "P082", "setting '" + info.name + "' cannot be " + shown + ": expected " + expected);
    return std::nullopt;
}

}  // namespace

double Linker::number(const NumberOrSetting& value) const {
    if (value.setting.empty()) return value.number;
    const auto found = conditions.settings.find(value.setting);
    if (found == conditions.settings.end()) return 0;
    if (found->second.type == SettingValue::Type::Enum) return numberOfWord(found->second.word).value_or(0);
    return found->second.number;
}

double Linker::constant(const NumberOrSetting& value) const {
    if (value.setting.empty()) return value.number;
    const auto found = conditions.settings.find(value.setting);
    return found == conditions.settings.end() ? 0.0 : found->second.number;
}

void Linker::evaluateConditions() {
    if (host.extent.width == 0 || host.extent.height == 0) {
        reporter.error({}, "P083",
                       "the frame is " + std::to_string(host.extent.width) + " x " + std::to_string(host.extent.height),
                       "build no plan while there is nothing to draw on");
    }
    for (const SettingDeclaration& declared : tree.settings) {
        conditions.settings[declared.info.name] = declared.info.defaultValue;
        const auto given = host.settings.find(declared.info.name);
        if (given == host.settings.end()) continue;
        if (const auto value = checkedSetting(declared, given->second, reporter))
            conditions.settings[declared.info.name] = *value;
    }
    for (const auto& [name, value] : host.settings) {
        if (!tree.setting(name)) {
            reporter.error({}, "P082", "the tree '" + tree.name + "' has no setting '" + name + "'",
                           didYouMean(name, namesOf(tree.settingInfos)));
        }
    }
    for (const ImportDeclaration& import : tree.imports) {
        const auto lent = host.imports.find(import.name);
        conditions.imports[import.name] = lent != host.imports.end() && lent->second.present;
    }
    for (const auto& [name, lent] : host.imports) {
        if (!tree.import(name)) {
            reporter.warning({}, "P084", "the tree '" + tree.name + "' takes no import '" + name + "'",
                             didYouMean(name, namesOf(tree.imports)));
        }
    }
    for (const std::string& name : host.unwantedExports) {
        if (has(namesOf(tree.exports), name)) continue;
        reporter.warning({}, "P084", "the tree '" + tree.name + "' has no export '" + name + "' to leave out",
                         didYouMean(name, namesOf(tree.exports)));
    }
    for (const ViewDeclaration& view : tree.views) {
        viewCounts.push_back(wholeNumber(number(view.count)));
        plan.viewCounts[view.name] = viewCounts.back();
    }
    plan.depth = host.depth;
    plan.extent = host.extent;

    passes.reserve(tree.passes.size());
    for (const PassDeclaration& says : tree.passes) {
        ++visits;
        LinkedPass pass{.says = &says, .kind = says.kind};
        pass.firstSlot = static_cast<std::uint32_t>(slots.size());
        pass.slotCount = static_cast<std::uint32_t>(says.slots.size());
        for (const SlotDeclaration& slot : says.slots) slots.push_back({.says = &slot});
        pass.enabled = says.enabled && (!says.enabledWhen || says.enabledWhen->evaluate(conditions)) &&
                       !(says.forEachLayer && says.viewIndex != none && viewCounts[says.viewIndex] == 0);
        passes.push_back(pass);
    }
}

std::string Linker::whyOff(const LinkedPass& pass) const {
    const PassDeclaration& says = *pass.says;
    if (!says.enabled) return "\"enabled\" is false";
    if (says.enabledWhen && !says.enabledWhen->evaluate(conditions)) return "not (" + says.enabledWhen->text() + ")";
    return "there is no view '" + says.view + "'";
}

}  // namespace pelage::passes
