// SPDX-License-Identifier: MIT
#include "convert.hpp"
#include "linker.hpp"

#include <algorithm>

namespace pelage::materials {

std::string quoted(std::string_view text) {
    std::string out = "'";
    out.append(text).push_back('\'');
    return out;
}

std::string text(json::Place place) {
    return std::to_string(place.line) + ":" + std::to_string(place.column);
}

bool sameShape(ValueType from, ValueType to) {
    const auto isColor = [](ValueType type) { return type == ValueType::Color || type == ValueType::Float3; };
    return from == to || (isColor(from) && isColor(to));
}

std::vector<std::string> propertyIds(const std::vector<Property>& properties) {
    std::vector<std::string> out;
    for (const Property& property : properties) out.push_back(property.id);
    return out;
}

std::optional<std::size_t> MaterialType::Linked::indexOf(std::string_view propertyId) const {
    for (std::size_t i = 0; i < properties.size(); ++i) {
        if (properties[i].id == propertyId) return i;
    }
    return {};
}

MaterialType::Linked Linker::run() {
    out_.name = description_.name;
    out_.file = description_.file;
    out_.version = description_.version;
    linkProperties();
    if (diagnostics_.hasErrors()) return std::move(out_);  // names that stand for two things would only cause echoes
    linkDefaults();
    linkInputs();
    linkOptions();
    linkShaders();
    linkConnections();
    linkFunctors();
    linkConditions();
    reportUndriven();
    linkVersions();
    linkPresets();
    if (!diagnostics_.hasErrors()) {
        probeConnections();
        probeFunctors();
    }
    diagnostics_.sortByPlace();
    return std::move(out_);
}

void Linker::error(Code code, json::Place place, std::string text, std::string hint) {
    diagnostics_.add(
        {Severity::Error, code, description_.file, place.line, place.column, std::move(text), std::move(hint)});
}

void Linker::warn(Code code, json::Place place, std::string text, std::string hint) {
    diagnostics_.add(
        {Severity::Warning, code, description_.file, place.line, place.column, std::move(text), std::move(hint)});
}

std::string Linker::targetName(const Target& target) const {
    switch (target.kind) {
        case Target::Kind::Input:
            return "input." + out_.inputs[target.index].name;
        case Target::Kind::Option:
            return "option." + out_.options[target.index].name;
        case Target::Kind::ShaderEnabled:
            return "shader." + out_.shaders[target.index].name + ".enabled";
        case Target::Kind::ShaderState:
            return "shader." + out_.shaders[target.index].name + ".state";
        case Target::Kind::None:
            break;
    }
    return "nothing";
}

void Linker::linkProperties() {
    for (std::size_t i = 0; i < description_.groups.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (description_.groups[k].text != description_.groups[i].text) continue;
            error("M001", description_.groups[i].place, "second group named " + quoted(description_.groups[i].text),
                  "first at " + text(description_.groups[k].place));
            break;
        }
    }
    std::map<std::string, json::Place> seen;
    for (const PropertyDescription& description : description_.properties) {
        const auto [first, isNew] = seen.emplace(description.property.id, description.name.place);
        if (!isNew)
            error("M001", description.name.place, "second property named " + quoted(description.property.id),
                  "first at " + text(first->second));
        out_.properties.push_back(description.property);
        if (description.wordsOf) out_.properties.back().words = wordsOf(*description.wordsOf);
    }
    propertyUsed_.assign(out_.properties.size(), false);
}

// The words of a functor's port, for an enum that names the port instead of repeating them.
std::vector<std::string> Linker::wordsOf(const Word& at) {
    const std::size_t dot = at.text.find('.');
    const std::string functor = at.text.substr(0, dot), name = at.text.substr(dot + 1);
    const FunctorType* type = registry_.find(functor);
    if (!type) {
        error("M020", at.place, "values: functor type " + quoted(functor) + " is not registered",
              nameHint(functor, registry_.names()));
        return {};
    }
    std::vector<std::string> known;
    for (const std::vector<Port>* ports : {&type->in, &type->out}) {
        for (const Port& port : *ports) {
            if (port.name == name && !port.words.empty()) return port.words;
            if (!port.words.empty()) known.push_back(port.name);
        }
    }
    error("M021", at.place, "values: " + functor + " has no port " + quoted(name) + " with words",
          nameHint(name, known));
    return {};
}

void Linker::linkDefaults() {
    for (std::size_t i = 0; i < out_.properties.size(); ++i) {
        Property& property = out_.properties[i];
        const PropertyDescription& description = description_.properties[i];
        if (property.type == ValueType::Color && property.srgb) {
            for (std::optional<double>* bound : {&property.min, &property.max, &property.softMin, &property.softMax}) {
                if (*bound) *bound = srgbToLinear(static_cast<float>(std::clamp(**bound, 0.0, 1e3)));
            }
        }
        const Range range = rangeOf(property);
        const double low = property.min.value_or(range.min), high = property.max.value_or(range.max);
        const double softLow = property.softMin.value_or(low), softHigh = property.softMax.value_or(high);
        if (low > high || softLow < low || softHigh > high || softLow > softHigh) {
            error("M007", description.min ? description.min->place : description.name.place,
                  "the range of " + quoted(property.id) + " is empty or its soft range leaves it",
                  "needs min <= softMin < softMax <= max");
            continue;
        }
        Diagnostics clamped;
        const Result<Value> converted = convert(property, *description.defaultValue, clamped);
        if (converted) {
            property.defaultValue = *converted;
        } else {
            const Diagnostic& why = converted.error().first();
            error(why.code == "V004" ? Code("M008") : Code("M004"), description.defaultValue->place,
                  "default: " + why.text, why.hint);
        }
        if (!clamped.empty()) {
            const std::string& text = clamped.first().text;
            error("M005", description.defaultValue->place,
                  "default " + text.substr(0, text.find(" is ")) + " of " + quoted(property.id) + " is outside " +
                      shown(range.min) + ".." + shown(range.max));
        }
    }
}

void Linker::condition(const std::optional<Word>& expression, std::string_view key, std::size_t property,
                       std::vector<json::Condition>& out) {
    if (!expression) return;
    Result<json::Condition> parsed = json::Condition::parse(expression->text, names_);
    if (parsed) {
        for (const std::size_t read : parsed->reads()) propertyUsed_[read] = true;
        out.push_back(std::move(*parsed));
        return;
    }
    const Diagnostic& fault = parsed.error().first();
    error(fault.code, {expression->place.line, expression->place.column + fault.column},
          fault.text + ", in " + std::string(key) + " of " + quoted(out_.properties[property].id), fault.hint);
}

void Linker::linkConditions() {
    using Type = json::ConditionNames::Type;
    for (const Property& property : out_.properties) {
        const Type type = property.type == ValueType::Bool     ? Type::Bool
                          : property.type == ValueType::Enum   ? Type::Word
                          : componentCount(property.type) == 1 ? Type::Number
                                                               : Type::Other;
        names_.names.push_back({property.id, type, property.words, property.type == ValueType::Float});
    }
    out_.visibleWhen.resize(out_.properties.size());
    out_.enabledWhen.resize(out_.properties.size());
    const Word* group = nullptr;
    for (std::size_t i = 0; i < out_.properties.size(); ++i) {
        const PropertyDescription& description = description_.properties[i];
        const bool isFirst = i == 0 || out_.properties[i - 1].group != out_.properties[i].group;
        if (description.groupVisibleWhen && (isFirst || group)) {
            const std::size_t before = diagnostics_.items().size();
            condition(description.groupVisibleWhen, "visibleWhen of its group", i, out_.visibleWhen[i]);
            // Say it once for the group.
            group = diagnostics_.items().size() == before ? &*description.groupVisibleWhen : nullptr;
        }
        condition(description.visibleWhen, "visibleWhen", i, out_.visibleWhen[i]);
        condition(description.enabledWhen, "enabledWhen", i, out_.enabledWhen[i]);
    }
}

void Linker::linkInputs() {
    std::size_t numbers = 0, textures = 0;
    for (const InputDescription& description : description_.inputs) {
        out_.inputs.push_back(description.input);
        inputPlaces_.push_back(description.name.place);
    }
    // Those that "*": "input.*" makes.
    for (const FunctorDescription& functor : description_.functors) {
        const FunctorType* type = registry_.find(functor.type.text);
        if (!type) continue;
        for (const FunctorDescription::Link& link : outputsOf(functor, type->out)) {
            if (link.isNamed || indexOfName(out_.inputs, link.port.text)) continue;
            const std::size_t port = *indexOfName(type->out, link.port.text);
            Input input;
            input.name = link.port.text;
            input.type = type->out[port].type;
            out_.inputs.push_back(std::move(input));
            inputPlaces_.push_back(link.port.place);
        }
    }
    for (const Input& input : out_.inputs) out_.inputSlots.push_back(isTexture(input.type) ? textures++ : numbers++);
}

void Linker::linkOptions() {
    for (const OptionDescription& description : description_.options) {
        Option option = description.option;
        const json::Value& value = *description.defaultValue;
        if (option.type == ValueType::Enum) {
            if (description.wordsOf) {
                option.words = wordsOf(*description.wordsOf);
                if (option.words.empty()) {
                    out_.options.push_back(std::move(option));
                    continue;
                }
            }
            option.max = static_cast<std::int64_t>(option.words.size()) - 1;
            const auto found = std::find(option.words.begin(), option.words.end(), value.string);
            if (found == option.words.end())
                error("M008", value.place, quoted(value.string) + " is not a value of option " + quoted(option.name),
                      nameHint(value.string, option.words));
            option.defaultValue = found == option.words.end() ? 0 : found - option.words.begin();
        } else if (option.type == ValueType::Bool) {
            option.defaultValue = value.boolean ? 1 : 0;
        } else if (option.min > option.max) {
            error("M007", description.name.place, "the range of option " + quoted(option.name) + " is empty",
                  "needs min <= max");
        } else if (value.number < static_cast<double>(option.min) || value.number > static_cast<double>(option.max)) {
            error("M005", value.place,
                  "default " + shown(value.number) + " of option " + quoted(option.name) + " is outside " +
                      std::to_string(option.min) + ".." + std::to_string(option.max));
        } else {
            option.defaultValue = static_cast<std::int64_t>(value.number);
        }
        out_.options.push_back(std::move(option));
    }
}

void Linker::linkShaders() {
    for (const ShaderDescription& description : description_.shaders) {
        ShaderUse shader = description.shader;
        std::vector<std::size_t> indices;
        for (std::size_t i = 0; description.allOptions && i < out_.options.size(); ++i) indices.push_back(i);
        for (const Word& word : description.options) {
            if (const auto index = indexOfName(out_.options, word.text)) {
                indices.push_back(*index);
            } else {
                error("M011", word.place, "shader " + quoted(shader.name) + ": unknown option " + quoted(word.text),
                      nameHint(word.text, namesOf(out_.options)));
            }
        }
        for (const std::size_t index : indices) shader.options.push_back(out_.options[index].name);
        out_.shaders.push_back(std::move(shader));
        out_.drawListPlaces.push_back(description.drawList);
        out_.shaderOptions.push_back(std::move(indices));
    }
}

bool Linker::drive(const Target& target, const Word& by, std::string what) {
    for (const Driver& driver : drivers_) {
        if (!(driver.target == target)) continue;
        error("M012", by.place, quoted(targetName(target)) + " is driven twice: by " + driver.what + " and by " + what,
              "first at " + text(driver.place));
        return false;
    }
    drivers_.push_back({target, std::move(what), by.place});
    return true;
}

bool Linker::optionFits(const Property& property, const Option& option, const Word& at) {
    const bool isWhole = property.type == ValueType::Int || property.type == ValueType::Uint;
    if (property.type != option.type && !(isWhole && option.type == ValueType::Int)) {
        error("M013", at.place,
              "property " + quoted(property.id) + " is " + std::string(name(property.type)) + ", option " +
                  quoted(option.name) + " is " + std::string(name(option.type)),
              "change one type, or use a functor");
        return false;
    }
    if (property.type == ValueType::Enum && property.words != option.words) {
        std::vector<std::string> a = property.words, b = option.words;
        std::sort(a.begin(), a.end());
        std::sort(b.begin(), b.end());
        error("M014", at.place,
              "values of " + quoted(property.id) + " and option " + quoted(option.name) +
                  (a == b ? " are in different order" : " differ"),
              "make the lists equal, or use a functor");
        return false;
    }
    const Range range = rangeOf(property);
    if (isWhole && option.min <= option.max &&
        (range.min < static_cast<double>(option.min) || range.max > static_cast<double>(option.max))) {
        error("M009", at.place,
              "range " + shown(range.min) + ".." + shown(range.max) + " of " + quoted(property.id) + " exceeds " +
                  std::to_string(option.min) + ".." + std::to_string(option.max) + " of option " + quoted(option.name),
              "give the property the option's \"min\" and \"max\"");
        return false;
    }
    return true;
}

void Linker::linkConnections() {
    for (std::size_t i = 0; i < out_.properties.size(); ++i) {
        const Property& property = out_.properties[i];
        const auto& connect = description_.properties[i].connect;
        if (!connect) continue;
        propertyUsed_[i] = true;
        const Word& at = connect->target;
        const std::string who = "property " + quoted(property.id);
        Target target;
        if (connect->kind == "input") {
            const auto index = indexOfName(out_.inputs, at.text);
            if (!index) {
                error("M010", at.place, who + ": unknown input " + quoted(at.text),
                      nameHint(at.text, namesOf(out_.inputs)));
                continue;
            }
            const Input& input = out_.inputs[*index];
            target = {Target::Kind::Input, *index};
            if (!drive(target, at, who)) continue;
            if (!sameShape(property.type, input.type)) {
                error("M013", at.place,
                      who + " is " + std::string(name(property.type)) + ", input " + quoted(input.name) + " is " +
                          std::string(name(input.type)),
                      "change one type, or use a functor");
                continue;
            }
            if (isTexture(property.type) && property.srgb != input.srgb) {
                error("M013", at.place,
                      who + " is " + (property.srgb ? "srgb" : "linear") + ", input " + quoted(input.name) + " is " +
                          (input.srgb ? "srgb" : "linear"),
                      "give both the same \"space\"");
                continue;
            }
        } else if (connect->kind == "option") {
            const auto index = indexOfName(out_.options, at.text);
            if (!index) {
                error("M011", at.place, who + ": unknown option " + quoted(at.text),
                      nameHint(at.text, namesOf(out_.options)));
                continue;
            }
            target = {Target::Kind::Option, *index};
            if (!drive(target, at, who) || !optionFits(property, out_.options[*index], at)) continue;
        } else {
            const auto index = indexOfName(out_.shaders, at.text);
            if (!index) {
                error("M015", at.place, who + ": unknown shader " + quoted(at.text),
                      nameHint(at.text, namesOf(out_.shaders)));
                continue;
            }
            target = {Target::Kind::ShaderEnabled, *index};
            if (!drive(target, at, who)) continue;
            if (property.type != ValueType::Bool) {
                error("M013", at.place,
                      who + " is " + std::string(name(property.type)) + ", enabling a shader needs bool");
                continue;
            }
        }
        out_.connections.push_back({i, target});
    }
}

void Linker::reportUndriven() {
    // A functor or a name that could not be linked leaves holes that are not the author's second mistake.
    if (diagnostics_.hasErrors()) return;
    const auto isDriven = [&](const Target& target) {
        return std::any_of(drivers_.begin(), drivers_.end(),
                           [&](const Driver& driver) { return driver.target == target; });
    };
    for (std::size_t i = 0; i < out_.inputs.size(); ++i) {
        if (!isDriven({Target::Kind::Input, i}))
            error("M018", inputPlaces_[i], "nothing drives input " + quoted(out_.inputs[i].name),
                  "connect a property or a functor output to it, or delete it");
    }
    for (std::size_t i = 0; i < out_.options.size(); ++i) {
        const json::Place place = description_.options[i].name.place;
        const bool isRead = std::any_of(out_.shaderOptions.begin(), out_.shaderOptions.end(), [&](const auto& used) {
            return std::find(used.begin(), used.end(), i) != used.end();
        });
        if (!isDriven({Target::Kind::Option, i})) {
            warn("M019", place, "nothing drives option " + quoted(out_.options[i].name) + "; it keeps its default",
                 "connect a property or a functor output to it, or delete it");
        } else if (!isRead) {
            warn("M032", place, "no shader reads option " + quoted(out_.options[i].name),
                 "list it in the \"options\" of a shader, or delete it");
        }
    }
    for (std::size_t i = 0; i < out_.properties.size(); ++i) {
        if (!propertyUsed_[i])
            warn("M016", description_.properties[i].name.place,
                 "property " + quoted(out_.properties[i].id) + " has no effect",
                 "connect it, feed it to a functor, or delete it");
    }
}

}  // namespace pelage::materials
