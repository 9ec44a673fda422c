// SPDX-License-Identifier: MIT
#include "description.hpp"

#include <algorithm>

namespace pelage::passes {
namespace {

template <class T>
const T* byName(const std::vector<T>& items, std::string_view word) {
    for (const T& item : items) {
        if (item.name == word) return &item;
    }
    return nullptr;
}

}  // namespace

std::string didYouMean(std::string_view word, const std::vector<std::string>& known, std::string otherwise) {
    const std::string_view near = nearestName(word, known);
    return near.empty() ? std::move(otherwise) : "did you mean '" + std::string(near) + "'?";
}

std::string Reporter::at(Place place) const {
    const std::size_t file = fileOf(place);
    return (file > 0 && file < files_.size() ? files_[file] + ":" : std::string{}) + std::to_string(lineOf(place)) +
           ":" + std::to_string(place.column);
}

void Reporter::add(Severity severity, Place place, Code code, std::string text, std::string hint) {
    const std::size_t file = std::min(fileOf(place), files_.size() - 1);
    out_.add({severity, code, files_[file], lineOf(place), place.column, std::move(text), std::move(hint)});
    errors_ += severity == Severity::Error ? 1 : 0;
}

void Reporter::forward(Place place, const Diagnostics& faults, const std::string& context, Code otherwise) {
    for (Diagnostic fault : faults.items()) {
        if (fault.code.empty()) fault.code = otherwise;
        fault.context.push_back(context);
        if (fault.file.empty()) {
            fault.file = files_[std::min(fileOf(place), files_.size() - 1)];
            fault.line = lineOf(place);
            fault.column = place.column;
        }
        errors_ += fault.severity == Severity::Error ? 1 : 0;
        out_.add(std::move(fault));
    }
}

const SlotDeclaration* PassDeclaration::slot(std::string_view word) const {
    return byName(slots, word);
}
std::vector<std::string> PassDeclaration::slotNames() const {
    return namesOf(slots);
}

const SettingInfo* PassTree::Description::setting(std::string_view word) const {
    return byName(settingInfos, word);
}
const ImportDeclaration* PassTree::Description::import(std::string_view word) const {
    return byName(imports, word);
}
const ViewDeclaration* PassTree::Description::view(std::string_view word) const {
    return byName(views, word);
}
const AttachmentDeclaration* PassTree::Description::attachment(std::string_view word) const {
    return byName(attachments, word);
}
const PassDeclaration* PassTree::Description::pass(std::string_view word) const {
    return byName(passes, word);
}

Vocabulary PassTree::Description::vocabulary() const {
    Vocabulary vocabulary;
    for (const SettingInfo& info : settingInfos) vocabulary.settings.push_back(&info);
    vocabulary.imports = namesOf(imports);
    return vocabulary;
}

bool PassTree::Description::canBeDisabled(const PassDeclaration& one) const {
    if (!one.enabled || one.enabledWhen) return true;
    const ViewDeclaration* seen = view(one.view);
    if (!seen || !one.forEachLayer) return false;
    if (seen->count.setting.empty()) return seen->count.number == 0;
    const SettingInfo* info = setting(seen->count.setting);
    return info && info->type == SettingValue::Type::Uint && info->min == 0;
}

const std::vector<std::string>& constantNames() {
    static const std::vector<std::string> names{"white",         "black",     "transparent",  "depthFar",
                                                "depthFarArray", "blackCube", "transparent3D"};
    return names;
}

}  // namespace pelage::passes
