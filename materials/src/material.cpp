// SPDX-License-Identifier: MIT
#include "convert.hpp"
#include "link.hpp"

#include <algorithm>

namespace pelage::materials {
namespace {

Diagnostic unknownProperty(std::string_view id, const MaterialType& type) {
    return {Severity::Error,
            "V002",
            {},
            0,
            0,
            "material type has no property '" + std::string(id) + "'",
            nameHint(id, propertyIds(type.properties()))};
}

}  // namespace

Material::Material(std::shared_ptr<const MaterialType> type) : type_(std::move(type)) {
    reset();
}

void Material::reset() {
    const std::vector<Property>& properties = type_->properties();
    if (values_.empty()) dirty_.assign(properties.size(), true);
    values_.resize(properties.size());
    for (std::size_t i = 0; i < properties.size(); ++i) {
        if (values_[i] == properties[i].defaultValue) continue;
        values_[i] = properties[i].defaultValue;
        dirty_[i] = true;
    }
}

std::optional<Diagnostic> Material::assign(std::string_view id,
                                           const std::function<Conversion(const Property&)>& from) {
    const auto index = type_->linked().indexOf(id);
    if (!index) return unknownProperty(id, *type_);
    Conversion converted = from(type_->properties()[*index]);
    if (converted.value && !(*converted.value == values_[*index])) {
        values_[*index] = std::move(*converted.value);
        dirty_[*index] = true;
    }
    return converted.problem;
}

std::optional<Diagnostic> Material::set(std::string_view id, const Value& value) {
    return assign(id, [&](const Property& property) { return convert(property, value); });
}

std::optional<Diagnostic> Material::setFromText(std::string_view id, std::string_view text) {
    return assign(id, [&](const Property& property) { return convert(property, text); });
}

const Value* Material::get(std::string_view id) const {
    const auto index = type_->linked().indexOf(id);
    return index ? &values_[*index] : nullptr;
}

std::optional<Diagnostic> Material::applyPreset(std::string_view name) {
    for (const Preset& preset : type_->linked().presets) {
        if (preset.name != name) continue;
        for (const auto& [property, value] : preset.values) {
            if (values_[property] == value) continue;
            values_[property] = value;
            dirty_[property] = true;
        }
        return {};
    }
    return Diagnostic{Severity::Error,
                      "V008",
                      {},
                      0,
                      0,
                      "material type has no preset '" + std::string(name) + "'",
                      nameHint(name, type_->presets())};
}

namespace {

bool hold(const std::vector<json::Condition>& conditions, const std::vector<Value>& values) {
    const auto read = [&](std::size_t property) {
        const Value& value = values[property];
        return value.type == ValueType::Float ? static_cast<double>(value.number[0])
                                              : static_cast<double>(value.integer);
    };
    return std::all_of(conditions.begin(), conditions.end(),
                       [&](const json::Condition& each) { return each.evaluate(read); });
}

}  // namespace

bool Material::isVisible(std::string_view id) const {
    const auto index = type_->linked().indexOf(id);
    return !index || hold(type_->linked().visibleWhen[*index], values_);
}

bool Material::isEnabled(std::string_view id) const {
    const auto index = type_->linked().indexOf(id);
    return !index || hold(type_->linked().enabledWhen[*index], values_);
}

}  // namespace pelage::materials
