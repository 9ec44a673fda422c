// SPDX-License-Identifier: MIT
// versionUpdates and presets: what a type says about values.
#include "convert.hpp"
#include "linker.hpp"

namespace pelage::materials {

std::optional<Value> Linker::value(const ValueDescription& description, std::size_t property) {
    Conversion converted = convert(out_.properties[property], *description.value);
    if (converted.problem) {
        // A clamped number in a type is the author's mistake, unlike in a material, where the range may have moved.
        error(converted.problem->code, description.value->place, converted.problem->text,
              converted.value ? "write a number inside the range" : converted.problem->hint);
    }
    return converted.value;
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
        for (const VersionDescription::Rename& rename : description.renames) {
            if (out_.indexOf(rename.from.text))
                error("M042", rename.from.place, quoted(rename.from.text) + " is renamed but still exists",
                      "old names never return");
            const auto [first, isNew] = retired.emplace(rename.from.text, rename.from.place);
            if (!isNew)
                error("M042", rename.from.place, quoted(rename.from.text) + " is renamed twice",
                      "first at " + text(first->second));
            step.renames.emplace_back(rename.from.text, rename.to.text);
        }
        out_.versionSteps.push_back(std::move(step));
    }
    // Where a name leads is known only when all renames are.
    for (std::size_t i = 0; i < description_.versions.size(); ++i) {
        for (const VersionDescription::Rename& rename : description_.versions[i].renames) {
            if (!out_.indexOf(out_.currentName(rename.to.text)))
                error("M041", rename.to.place, "rename leads to " + quoted(rename.to.text) + ", which does not exist",
                      nameHint(rename.to.text, propertyIds(out_.properties)));
        }
        for (const ValueDescription& set : description_.versions[i].values) {
            const auto property = out_.indexOf(out_.currentName(set.property.text));
            if (!property) {
                error("M043", set.property.place, "setValue names unknown property " + quoted(set.property.text),
                      nameHint(set.property.text, propertyIds(out_.properties)));
            } else if (const std::optional<Value> value = this->value(set, *property)) {
                out_.versionSteps[i].values.emplace_back(*property, *value);
            }
        }
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
            } else if (const std::optional<Value> value = this->value(set, *property)) {
                preset.values.emplace_back(*property, *value);
            }
        }
        out_.presetNames.push_back(preset.name);
        out_.presets.push_back(std::move(preset));
    }
}

}  // namespace pelage::materials
