// SPDX-License-Identifier: MIT
// Classes that the host registered: whether those that the tree names are there, and whether their parameters fit.
#include "link.hpp"

#include <cmath>

namespace pelage::passes {
namespace {

std::string shown(double number) {
    if (number == std::floor(number) && std::abs(number) < 1e15) return std::to_string(static_cast<long long>(number));
    std::string text = std::to_string(number);
    text.erase(text.find_last_not_of('0') + 1);
    return text;
}

PassKind kindOfSlots(const PassDeclaration& pass) {
    for (const SlotDeclaration& slot : pass.slots) {
        if (slot.use == SlotUse::Copy) return PassKind::Copy;
        if (slot.use == SlotUse::Color || slot.use == SlotUse::Depth || slot.use == SlotUse::Vertex)
            return PassKind::Raster;
    }
    return PassKind::Compute;
}

std::string kindOf(const ParameterInfo& info) {
    if (info.type == ParameterInfo::Type::Bool) return "true or false";
    if (info.type == ParameterInfo::Type::Number) return "a number in " + shown(info.min) + ".." + shown(info.max);
    std::string words;
    for (const std::string& word : info.words) words += (words.empty() ? "one of " : ", ") + word;
    return words;
}

}  // namespace

void Linker::findClasses() {
    for (LinkedPass& pass : passes) {
        const PassDeclaration& says = *pass.says;
        if (says.passClass.empty()) continue;
        std::vector<std::string> known;
        for (const PassClassInfo& info : host.classes) {
            known.push_back(info.name);
            if (info.name == says.passClass) pass.info = &info;
        }
        const std::string title = "pass '" + says.name + "'";
        if (!pass.info) {
            // A pass that is off needs no class: a tree may have passes for hosts that know more.
            if (!pass.enabled) continue;
            if (host.trustClasses) {
                pass.kind = kindOfSlots(says);
                continue;
            }
            reporter.error(says.classPlace, "P053", title + ": unknown class '" + says.passClass + "'",
                           didYouMean(says.passClass, known,
                                      known.empty() ? "the host registers none; add it to Graph::Descriptor::classes"
                                                    : "register it in Graph::Descriptor::classes"));
            continue;
        }
        pass.kind = pass.info->kind;
        if (pass.kind != PassKind::Raster && says.forEachLayer) {
            reporter.error(
                says.place, "P024",
                title + " cannot repeat for each view: its class '" + says.passClass + "' records no render pass",
                "remove \"forEachView\"");
        }
        bool targets = false;
        for (const SlotDeclaration& slot : says.slots) {
            targets = targets || slot.use == SlotUse::Color || slot.use == SlotUse::Depth;
            if (fits(pass.kind, slot.use)) continue;
            reporter.error(slot.place, "P023",
                           "slot '" + says.name + "." + slot.name + "' is of a use that a " +
                               std::string(word(pass.kind)) + " pass, which the class '" + says.passClass +
                               "' records, cannot have");
        }
        if (pass.kind == PassKind::Raster && !targets && !says.slots.empty())
            reporter.error(says.place, "P052", title + " draws but has neither color nor depth slot");
    }
}

std::vector<PlanParameter> Linker::parametersOf(const LinkedPass& pass) {
    using Type = ParameterInfo::Type;
    const PassDeclaration& says = *pass.says;
    const auto& declared = pass.info->parameters;
    const std::string title = "class '" + says.passClass + "'";
    for (const ParameterDeclaration& given : says.parameters) {
        const auto same = [&](const ParameterInfo& info) { return info.name == given.name; };
        if (std::any_of(declared.begin(), declared.end(), same)) continue;
        reporter.error(given.namePlace, "P054", title + " has no parameter '" + given.name + "'",
                       didYouMean(given.name, namesOf(declared), "remove it"));
    }
    std::vector<PlanParameter> made;
    for (const ParameterInfo& info : declared) {
        PlanParameter value{.name = info.name, .number = info.defaultNumber};
        const auto given = std::find_if(says.parameters.begin(), says.parameters.end(),
                                        [&](const ParameterDeclaration& each) { return each.name == info.name; });
        bool fine = true;
        std::string found;
        if (given == says.parameters.end()) {
            if (info.required) {
                reporter.error(says.classPlace, "P054",
                               "pass '" + says.name + "' gives its " + title + " no '" + info.name + "'",
                               "expected " + kindOf(info));
            }
        } else {
            Type type = given->type;
            double number = given->value.number;
            std::string word = given->word;
            if (const auto setting = conditions.settings.find(given->value.setting);
                setting != conditions.settings.end()) {
                type = setting->second.type == SettingValue::Type::Bool   ? Type::Bool
                       : setting->second.type == SettingValue::Type::Enum ? Type::Word
                                                                          : Type::Number;
                number = setting->second.number;
                word = setting->second.word;
            }
            found = type == Type::Word   ? "'" + word + "'"
                    : type == Type::Bool ? (number > 0 ? "true" : "false")
                                         : shown(number);
            fine = type == info.type;
            if (fine && type == Type::Number) fine = number >= info.min && number <= info.max;
            if (fine && type == Type::Word) {
                const auto at = std::find(info.words.begin(), info.words.end(), word);
                fine = at != info.words.end();
                number = static_cast<double>(at - info.words.begin());
            }
            value.number = number;
            if (!fine) {
                reporter.error(
                    given->place, "P055",
                    "parameter '" + info.name + "' of " + title + " cannot be " + found + ": expected " + kindOf(info),
                    type == Type::Word ? didYouMean(word, info.words) : std::string{});
            }
        }
        const auto index = static_cast<std::size_t>(std::max(0.0, value.number));
        if (info.type == Type::Word && fine && index < info.words.size()) value.word = info.words[index];
        made.push_back(std::move(value));
    }
    return made;
}

}  // namespace pelage::passes
