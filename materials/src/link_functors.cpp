// SPDX-License-Identifier: MIT
#include "convert.hpp"
#include "linker.hpp"

#include <algorithm>
#include <cmath>

namespace pelage::materials {
namespace {

std::vector<std::string> portNames(const std::vector<Port>& ports) {
    return namesOf(ports);
}

bool wholeFits(ValueType from, ValueType to) {
    const auto isWhole = [](ValueType type) { return type == ValueType::Int || type == ValueType::Uint; };
    return sameShape(from, to) || (isWhole(from) && isWhole(to));
}

}  // namespace

void Linker::linkFunctors() {
    std::map<std::string, json::Place> seen;
    for (const FunctorDescription& description : description_.functors) {
        const auto [first, isNew] = seen.emplace(description.id.text, description.id.place);
        if (!isNew)
            error("M002", description.id.place, "second functor named " + quoted(description.id.text),
                  "first at " + text(first->second));
        linkFunctor(description);
    }
}

void Linker::linkFunctor(const FunctorDescription& description) {
    const FunctorType* type = registry_.find(description.type.text);
    if (!type || !type->run) {
        error(
            "M020", description.type.place,
            "functor " + quoted(description.id.text) + ": type " + quoted(description.type.text) + " is not registered",
            nameHint(description.type.text, registry_.names()));
        // Its inputs and outputs are still meant to be used: no second report for them.
        for (const FunctorDescription::Link& link : description.in) {
            if (const auto index = out_.indexOf(link.target.text)) propertyUsed_[*index] = true;
        }
        return;
    }
    FunctorUse use{description.id.text, *type, {}, {}};
    const bool inputsFit = linkFunctorInputs(description, use);
    const bool outputsFit = linkFunctorOutputs(description, use);
    if (inputsFit && outputsFit) out_.functors.push_back(std::move(use));
}

bool Linker::linkFunctorInputs(const FunctorDescription& description, FunctorUse& use) {
    bool fits = true;
    const auto refuse = [&](Code code, json::Place place, std::string text, std::string hint) {
        fits = false;
        error(code, place, std::move(text), std::move(hint));
    };
    const std::vector<Port>& ports = use.type.in;
    std::vector<std::optional<std::size_t>> connected(ports.size());
    bool misnamed = false;  // then a port without connection is the same mistake
    const std::string who = "functor " + quoted(description.id.text);
    for (const FunctorDescription::Link& link : description.in) {
        const auto property = out_.indexOf(link.target.text);
        if (property) propertyUsed_[*property] = true;
        const auto port = indexOfName(ports, link.port.text);
        if (!port) {
            misnamed = true;
            refuse("M021", link.port.place, who + ": " + use.type.name + " has no input " + quoted(link.port.text),
                   nameHint(link.port.text, portNames(ports)));
            continue;
        }
        connected[*port] = property.value_or(0);
        if (!property) {
            refuse("M022", link.target.place, who + " reads unknown property " + quoted(link.target.text),
                   nameHint(link.target.text, propertyIds(out_.properties)));
            continue;
        }
        const Property& source = out_.properties[*property];
        if (!wholeFits(source.type, ports[*port].type)) {
            refuse("M023", link.target.place,
                   "input " + quoted(link.port.text) + " of " + use.type.name + " needs " +
                       std::string(name(ports[*port].type)) + ", " + quoted(source.id) + " is " +
                       std::string(name(source.type)),
                   "");
        } else if (source.type == ValueType::Enum && source.words != ports[*port].words) {
            std::string known;
            for (const std::string& word : ports[*port].words) known += (known.empty() ? "" : ", ") + word;
            refuse("M027", link.target.place,
                   "values of " + quoted(source.id) + " differ from those of input " + quoted(link.port.text) + " of " +
                       use.type.name,
                   "they must be, in this order: " + known);
        }
    }
    for (std::size_t i = 0; i < ports.size(); ++i) {
        if (connected[i]) {
            use.in.push_back(*connected[i]);
        } else if (!misnamed) {
            refuse("M024", description.inPlace,
                   who + ": input " + quoted(ports[i].name) + " of " + use.type.name + " is not connected",
                   "name a property of type " + std::string(name(ports[i].type)));
        }
    }
    return fits;
}

std::optional<Target> Linker::outputTarget(const FunctorDescription& description, const Port& port, const Word& word) {
    const std::string who = "functor " + quoted(description.id.text);
    const std::string_view whole = word.text;
    const std::size_t dot = whole.find('.');
    const std::string_view kind = whole.substr(0, dot);
    std::string_view target = whole.substr(dot + 1);
    std::string_view part;
    if (kind == "shader") {
        const std::size_t second = target.find('.');
        part = target.substr(second + 1);
        target = target.substr(0, second);
    }
    const std::string_view wanted = port.kind == Port::Kind::State     ? "shader.name.state"
                                    : port.kind == Port::Kind::Enabled ? "shader.name.enabled"
                                                                       : "input.name or option.name";
    const bool right = port.kind == Port::Kind::State     ? part == "state"
                       : port.kind == Port::Kind::Enabled ? part == "enabled"
                                                          : kind != "shader";
    if (!right) {
        error("M026", word.place, who + ": output " + quoted(port.name) + " cannot drive " + quoted(whole),
              "write " + std::string(wanted));
        return {};
    }
    if (kind == "input") {
        if (const auto index = indexOfName(out_.inputs, target)) return Target{Target::Kind::Input, *index};
        error("M010", word.place, who + ": unknown input " + quoted(target), nameHint(target, namesOf(out_.inputs)));
    } else if (kind == "option") {
        if (const auto index = indexOfName(out_.options, target)) return Target{Target::Kind::Option, *index};
        error("M011", word.place, who + ": unknown option " + quoted(target), nameHint(target, namesOf(out_.options)));
    } else {
        const auto shader = indexOfName(out_.shaders, target);
        if (shader && part == "state" && out_.shaders[*shader].isCompute()) {
            error("M003", word.place, who + ": " + quoted(target) + " is a compute shader, which has no state",
                  "delete the connection, or drive its \"enabled\"");
            return {};
        }
        if (shader) return Target{part == "state" ? Target::Kind::ShaderState : Target::Kind::ShaderEnabled, *shader};
        error("M015", word.place, who + ": unknown shader " + quoted(target), nameHint(target, namesOf(out_.shaders)));
    }
    return {};
}

bool Linker::outputFits(const FunctorDescription& description, const Port& port, const Word& word,
                        const Target& target) {
    if (target.kind != Target::Kind::Input && target.kind != Target::Kind::Option) return true;
    const bool isInput = target.kind == Target::Kind::Input;
    const ValueType type = isInput ? out_.inputs[target.index].type : out_.options[target.index].type;
    if (isInput ? !sameShape(port.type, type) : !wholeFits(port.type, type)) {
        error("M023", word.place,
              "output " + quoted(port.name) + " of functor " + quoted(description.id.text) + " is " +
                  std::string(name(port.type)) + ", " + quoted(targetName(target)) + " is " + std::string(name(type)));
        return false;
    }
    if (!isInput && type == ValueType::Enum && port.words != out_.options[target.index].words) {
        std::string known;
        for (const std::string& each : port.words) known += (known.empty() ? "" : ", ") + each;
        error("M014", word.place,
              "values of option " + quoted(out_.options[target.index].name) + " differ from those of output " +
                  quoted(port.name) + " of functor " + quoted(description.id.text),
              "they must be, in this order: " + known);
        return false;
    }
    return true;
}

// What is written under "out", with "*": "input.*" spelled out.
std::vector<FunctorDescription::Link> Linker::outputsOf(const FunctorDescription& description,
                                                        const std::vector<Port>& ports) const {
    std::vector<FunctorDescription::Link> links;
    for (const FunctorDescription::Link& link : description.out) {
        if (link.port.text != "*") links.push_back(link);
    }
    const std::size_t written = links.size();
    for (const FunctorDescription::Link& link : description.out) {
        if (link.port.text != "*") continue;
        for (const Port& port : ports) {
            const auto isThis = [&](const FunctorDescription::Link& other) { return other.port.text == port.name; };
            if (std::none_of(links.begin(), links.begin() + static_cast<std::ptrdiff_t>(written), isThis))
                links.push_back({{port.name, link.port.place}, {"input." + port.name, link.target.place}, false});
        }
    }
    return links;
}

bool Linker::linkFunctorOutputs(const FunctorDescription& description, FunctorUse& use) {
    bool fits = true;
    const std::vector<Port>& ports = use.type.out;
    std::vector<bool> named(ports.size(), false);
    bool misnamed = false;
    use.out.resize(ports.size());
    const std::string who = "functor " + quoted(description.id.text);
    for (const FunctorDescription::Link& link : description.out) {
        if (link.port.text != "*" || link.target.text == "input.*") continue;
        error("M026", link.target.place, who + ": \"*\" cannot drive " + quoted(link.target.text), "write input.*");
        return false;
    }
    for (const FunctorDescription::Link& link : outputsOf(description, ports)) {
        const auto port = indexOfName(ports, link.port.text);
        if (!port) {
            error("M021", link.port.place, who + ": " + use.type.name + " has no output " + quoted(link.port.text),
                  nameHint(link.port.text, portNames(ports)));
            fits = false;
            misnamed = true;
            continue;
        }
        named[*port] = true;
        const std::optional<Target> target = outputTarget(description, ports[*port], link.target);
        if (!target || !drive(*target, link.target, who) ||
            !outputFits(description, ports[*port], link.target, *target)) {
            fits = false;
            continue;
        }
        use.out[*port] = *target;
    }
    for (std::size_t i = 0; i < ports.size(); ++i) {
        if (named[i] || misnamed || ports[i].optional) continue;
        error("M025", description.outPlace,
              who + ": output " + quoted(ports[i].name) + " of " + use.type.name + " is not connected",
              "name what it drives");
        fits = false;
    }
    return fits;
}

void Linker::optionDefault(const Target& target, const Value& value, std::string_view by) {
    const Option& option = out_.options[target.index];
    if (value.integer == option.defaultValue) return;
    const auto shownValue = [&](std::int64_t index) {
        if (option.type == ValueType::Bool) return std::string(index ? "true" : "false");
        if (option.type != ValueType::Enum) return std::to_string(index);
        return index >= 0 && static_cast<std::size_t>(index) < option.words.size()
                   ? quoted(option.words[static_cast<std::size_t>(index)])
                   : std::to_string(index);
    };
    warn("M029", description_.options[target.index].defaultValue->place,
         "default of option " + quoted(option.name) + " is " + shownValue(option.defaultValue) + ", but " +
             std::string(by) + " makes it " + shownValue(value.integer) + " at the defaults of the properties",
         "write the same value");
}

void Linker::probeConnections() {
    for (const Connection& connection : out_.connections) {
        if (connection.target.kind == Target::Kind::Option)
            optionDefault(connection.target, out_.properties[connection.property].defaultValue,
                          "property " + quoted(out_.properties[connection.property].id));
    }
}

// Runs every functor once at the defaults: a functor that forgets an output is caught here, not in a frame.
void Linker::probeFunctors() {
    for (const FunctorUse& use : out_.functors) {
        const auto description = std::find_if(description_.functors.begin(), description_.functors.end(),
                                              [&](const FunctorDescription& each) { return each.id.text == use.id; });
        std::vector<Value> in;
        for (const std::size_t property : use.in) in.push_back(out_.properties[property].defaultValue);
        FunctorOutputs outputs;
        use.type.run(in, outputs);
        for (std::size_t i = 0; i < use.out.size(); ++i) {
            const Port& port = use.type.out[i];
            if (use.out[i].kind == Target::Kind::None) continue;
            const auto value = outputs.values().find(i);
            const bool isSet = port.kind == Port::Kind::State     ? outputs.states().count(i) != 0
                               : value == outputs.values().end()  ? false
                               : port.kind == Port::Kind::Enabled ? value->second.type == ValueType::Bool
                                                                  : wholeFits(value->second.type, port.type);
            if (!isSet) {
                error("M028", description->type.place,
                      "functor type " + quoted(use.type.name) + " does not set its output " + quoted(port.name) +
                          " to a value of its type",
                      "this is a fault of the program, not of the file");
            } else if (use.out[i].kind == Target::Kind::Option) {
                optionDefault(use.out[i], value->second, "functor " + quoted(use.id));
            }
        }
    }
}

}  // namespace pelage::materials
