// SPDX-License-Identifier: MIT
// versionUpdates and presets: what a type says about values.
#include "convert.hpp"
#include "linker.hpp"

#include <algorithm>

namespace pelage::materials {

std::optional<Value> Linker::value(const json::Value& written, std::size_t property) {
    Diagnostics clamped;
    const Result<Value> converted = convert(out_.properties[property], written, clamped);
    if (!converted) {
        const Diagnostic& why = converted.error().first();
        error(why.code, written.place, why.text, why.hint);
        return {};
    }
    // A clamped number in a type is the author's mistake, unlike in a material, where the range may have moved.
    for (const Diagnostic& each : clamped.items())
        error(each.code, written.place, each.text, "write a number inside the range");
    return *converted;
}

void Linker::linkVersions() {
    std::int64_t last = 1;
    std::map<std::string, json::Place> retired;
    for (const VersionDescription& description : description_.versions) {
        if (description.to <= last || description.to > description_.version)
            error("M040", description.place,
                  "version update to " + std::to_string(description.to) +
                      (description.to <= last ? " does not rise"
                                              : " is beyond version " + std::to_string(description_.version)),
                  "updates go from 2 to the type's \"version\", each once");
        last = std::max(last, description.to);
        VersionStep step;
        step.to = static_cast<int>(description.to);
        for (const VersionDescription::Action& described : description.actions) {
            retire(described, retired);
            step.actions.push_back(described.action);
        }
        out_.versionSteps.push_back(std::move(step));
    }
    // Where a name leads is known only when all steps are.
    for (std::size_t i = 0; i < description_.versions.size(); ++i) {
        for (const VersionDescription::Action& described : description_.versions[i].actions)
            linkAction(described, out_.versionSteps[i]);
    }
}

void Linker::retire(const VersionDescription::Action& described, std::map<std::string, json::Place>& retired) {
    using Kind = VersionAction::Kind;
    const VersionAction& action = described.action;
    if (action.kind != Kind::Rename && action.kind != Kind::Remove) return;
    const std::string what = quoted(action.property) + (action.kind == Kind::Rename ? " is renamed" : " is removed");
    if (out_.indexOf(action.property))
        error("M042", described.property, what + " but still exists", "old names never return");
    const auto [first, isNew] = retired.emplace(action.property, described.property);
    // A name may be given up once: what it stood for afterwards would depend on who reads the file.
    if (!isNew)
        error("M042", described.property,
              what + (action.kind == Kind::Rename ? " twice" : ", but its name was given up before"),
              "first at " + text(first->second));
}

void Linker::linkAction(const VersionDescription::Action& described, VersionStep& step) {
    using Kind = VersionAction::Kind;
    const VersionAction& action = described.action;
    if (action.kind == Kind::Remove) return;
    const std::string& name = action.kind == Kind::Rename ? action.to : action.property;
    const Followed now = follow(out_.versionSteps, name, action.value, step.to);
    const auto opName = [&] {
        return std::string(action.kind == Kind::Remap         ? "remap"
                           : action.kind == Kind::RenameWords ? "renameWords"
                                                              : "setValue");
    };
    const auto property = out_.indexOf(now.name);
    const bool removedLater = now.removedIn > step.to;
    if (!property && !removedLater) {
        const std::string hint = nameHint(name, propertyIds(out_.properties));
        if (action.kind == Kind::Rename) {
            error("M041", described.to, "rename leads to " + quoted(name) + ", which does not exist", hint);
        } else {
            error("M043", described.property, opName() + " names unknown property " + quoted(name), hint);
        }
        return;
    }
    if (action.kind == Kind::Remap) {
        const bool idle = action.scale == 1 && action.offset == 0;
        if (action.scale == 0 || idle)
            error("M044", described.whole,
                  "remap of " + quoted(name) + (idle ? " changes nothing" : " makes all values equal"),
                  "write a \"scale\" or an \"offset\"");
        if (property) {
            const ValueType type = out_.properties[*property].type;
            if (type < ValueType::Float || type > ValueType::Float4)
                error("M044", described.property,
                      "remap of " + quoted(name) + ", which is " + std::string(materials::name(type)),
                      "only float to float4 can be remapped");
        }
    } else if (action.kind == Kind::RenameWords && property) {
        const Property& renamed = out_.properties[*property];
        for (const auto& [from, to] : action.words) {
            json::Value word = action.value;
            word.kind = json::Kind::String;
            word.string = to;
            const std::string last = follow(out_.versionSteps, name, std::move(word), step.to).value.string;
            if (std::find(renamed.words.begin(), renamed.words.end(), last) == renamed.words.end())
                error("M044", described.value, "renameWords: " + quoted(last) + " is not a value of " + quoted(name),
                      nameHint(last, renamed.words));
        }
    } else if (action.kind == Kind::SetValue && property && !removedLater) {
        if (const std::optional<Value> value = this->value(now.value, *property))
            step.values.push_back({*property, *value, now.value});
    }
}

void Linker::linkPresets() {
    for (const PresetDescription& description : description_.presets) {
        Preset preset{description.name.text, {}};
        for (const ValueDescription& set : description.values) {
            const auto property = out_.indexOf(set.property.text);
            if (!property) {
                error("V002", set.property.place,
                      "preset " + quoted(preset.name) + ": the type has no property " + quoted(set.property.text),
                      nameHint(set.property.text, propertyIds(out_.properties)));
            } else if (const std::optional<Value> value = this->value(*set.value, *property)) {
                preset.values.emplace_back(*property, *value);
            }
        }
        out_.presetNames.push_back(preset.name);
        out_.presets.push_back(std::move(preset));
    }
}

}  // namespace pelage::materials
