// SPDX-License-Identifier: MIT
#include "convert.hpp"
#include "link.hpp"

#include <algorithm>

namespace pelage::materials {
namespace {

Diagnostic unknownProperty(std::string_view id, const MaterialType& type) {
    return {.code = "V002",
            .text = "material type has no property '" + std::string(id) + "'",
            .hint = nameHint(id, propertyIds(type.properties()))};
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
        assign(i, properties[i].defaultValue);
    }
}

void Material::assign(std::size_t property, const Value& value) {
    if (value == values_[property]) return;
    values_[property] = value;
    dirty_[property] = true;
}

template <class Given>
Diagnostics Material::take(std::string_view id, const Given& given) {
    const auto index = type_->linked().indexOf(id);
    if (!index) return unknownProperty(id, *type_);
    Diagnostics found;
    const Result<Value> converted = convert(type_->properties()[*index], given, found);
    if (!converted) return converted.error();
    assign(*index, *converted);
    return found;
}

Diagnostics Material::set(std::string_view id, const Value& value) {
    return take(id, value);
}

Diagnostics Material::set(std::string_view id, const json::Value& value) {
    return take(id, value);
}

Diagnostics Material::setFromText(std::string_view id, std::string_view text) {
    return take(id, text);
}

const Value* Material::get(std::string_view id) const {
    const auto index = type_->linked().indexOf(id);
    return index ? &values_[*index] : nullptr;
}

Diagnostics Material::applyPreset(std::string_view name) {
    for (const Preset& preset : type_->linked().presets) {
        if (preset.name != name) continue;
        for (const auto& [property, value] : preset.values) {
            assign(property, value);
        }
        return {};
    }
    return Diagnostic{.code = "V008",
                      .text = "material type has no preset '" + std::string(name) + "'",
                      .hint = nameHint(name, type_->presets())};
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
