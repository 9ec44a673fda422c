// SPDX-License-Identifier: MIT
#include "versions.hpp"

namespace pelage::materials {
namespace {

void remap(json::Value& value, const VersionAction& action) {
    if (value.isNumber()) {
        value.number = value.number * action.scale + action.offset;
        value.isInteger = false;
    }
    for (json::Value& element : value.elements) remap(element, action);
}

}  // namespace

Followed follow(const std::vector<VersionStep>& steps, std::string name, json::Value value, int version) {
    Followed out{std::move(name), std::move(value), 0, false};
    for (const VersionStep& step : steps) {
        for (const VersionAction& action : step.actions) {
            if (action.property != out.name) continue;
            switch (action.kind) {
                case VersionAction::Kind::Rename:
                    out.name = action.to;
                    break;
                case VersionAction::Kind::Remap:
                    if (version >= step.to) break;
                    remap(out.value, action);
                    out.remapped = true;
                    break;
                case VersionAction::Kind::RenameWords:
                    if (const auto word = action.words.find(out.value.string);
                        version < step.to && out.value.isString() && word != action.words.end()) {
                        out.value.string = word->second;
                        out.remapped = true;
                    }
                    break;
                case VersionAction::Kind::Remove:
                    out.removedIn = step.to;
                    return out;
                case VersionAction::Kind::SetValue:
                    break;
            }
        }
    }
    return out;
}

}  // namespace pelage::materials
