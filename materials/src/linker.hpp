// SPDX-License-Identifier: MIT
// Phase B of reading a material type: every name is resolved or reported, and each thing has exactly one driver.
#pragma once

#include "description.hpp"
#include "link.hpp"

#include <map>

namespace pelage::materials {

class Linker {
public:
    Linker(const TypeDescription& description, const FunctorRegistry& registry)
        : description_(description), registry_(registry) {}

    /// The linked type; check diagnostics() for errors first.
    MaterialType::Linked run();
    Diagnostics& diagnostics() { return diagnostics_; }

private:
    // link.cpp
    void linkProperties();
    std::vector<std::string> wordsOf(const Word& port);
    void linkDefaults();
    void linkConditions();
    void linkInputs();
    void linkOptions();
    void linkShaders();
    void linkConnections();
    void reportUndriven();
    bool drive(const Target& target, const Word& by, std::string what);
    bool optionFits(const Property& property, const Option& option, const Word& at);
    void condition(const std::optional<Word>& text, std::string_view key, std::size_t property,
                   std::vector<json::Condition>& out);
    // link_functors.cpp
    void linkFunctors();
    void linkFunctor(const FunctorDescription& description);
    bool linkFunctorInputs(const FunctorDescription& description, FunctorUse& use);
    std::vector<FunctorDescription::Link> outputsOf(const FunctorDescription& description,
                                                    const std::vector<Port>& ports) const;
    bool linkFunctorOutputs(const FunctorDescription& description, FunctorUse& use);
    std::optional<Target> outputTarget(const FunctorDescription& description, const Port& port, const Word& target);
    bool outputFits(const FunctorDescription& description, const Port& port, const Word& word, const Target& target);
    void probeFunctors();
    void probeConnections();
    void optionDefault(const Target& target, const Value& value, std::string_view by);
    // link_versions.cpp
    void linkVersions();
    void retire(const VersionDescription::Action& described, std::map<std::string, json::Place>& retired);
    void linkAction(const VersionDescription::Action& described, VersionStep& step);
    void linkPresets();
    std::optional<Value> value(const json::Value& written, std::size_t property);

    void error(Code code, json::Place place, std::string text, std::string hint = {});
    void warn(Code code, json::Place place, std::string text, std::string hint = {});
    std::string targetName(const Target& target) const;

    const TypeDescription& description_;
    const FunctorRegistry& registry_;
    MaterialType::Linked out_ = {};
    Diagnostics diagnostics_ = {};
    json::ConditionNames names_ = {};  // what a condition may read: the properties, by their index
    struct Driver {
        Target target = {};
        std::string what = {};
        json::Place place = {};
    };
    std::vector<Driver> drivers_ = {};
    std::vector<json::Place> inputPlaces_ = {};
    std::vector<bool> propertyUsed_ = {};
};

std::string quoted(std::string_view text);
std::string text(json::Place place);

/// The index of the element called `name`, or nothing.
template <class T>
std::optional<std::size_t> indexOfName(const std::vector<T>& items, std::string_view name) {
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (items[i].name == name) return i;
    }
    return {};
}
template <class T>
std::vector<std::string> namesOf(const std::vector<T>& items) {
    std::vector<std::string> out;
    for (const T& item : items) out.push_back(item.name);
    return out;
}

/// Color and Float3 are the same bytes to a shader; Int and Uint differ in sign only where ranges say so.
bool sameShape(ValueType from, ValueType to);

}  // namespace pelage::materials
