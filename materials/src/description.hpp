// SPDX-License-Identifier: MIT
// A *.materialtype.json as typed structs that remember their places: between the schema (phase A) and the linker
// (phase B). Reading it cannot fail; what the schema let through has the right shape.
#pragma once

#include "versions.hpp"

#include <pelage/base/json.hpp>
#include <pelage/materials/material.hpp>

namespace pelage::materials {

struct Word {
    std::string text = {};
    json::Place place = {};
};

struct PropertyDescription {
    Property property = {};
    Word name = {};
    std::optional<Word> wordsOf = {};  // Functor.port instead of a list of words
    std::optional<Word> visibleWhen = {}, enabledWhen = {}, groupVisibleWhen = {};
    struct Connect {
        std::string kind = {};  // "input", "option", "shader"
        Word target = {};
    };
    std::optional<Connect> connect = {};
    const json::Value* defaultValue = nullptr;
    const json::Value* min = nullptr;
};

struct InputDescription {
    Input input = {};
    Word name = {};
};

struct OptionDescription {
    Option option = {};
    Word name = {};
    std::optional<Word> wordsOf = {};  // Functor.port instead of a list of words
    const json::Value* defaultValue = nullptr;
};

struct ShaderDescription {
    ShaderUse shader = {};
    Word name = {};
    json::Place drawList = {};
    bool allOptions = false;
    std::vector<Word> options = {};
};

struct FunctorDescription {
    Word id = {}, type = {};
    struct Link {
        Word port = {}, target = {};
        bool isNamed = true;  // false: made of "*": "input.*"
    };
    std::vector<Link> in = {}, out = {};
    json::Place inPlace = {}, outPlace = {};
};

struct ValueDescription {
    Word property = {};
    const json::Value* value = nullptr;
};

struct PresetDescription {
    Word name = {};
    std::vector<ValueDescription> values = {};
};

struct VersionDescription {
    std::int64_t to = 0;
    json::Place place = {};
    struct Action {
        VersionAction action = {};
        json::Place property = {}, to = {}, value = {}, whole = {};
    };
    std::vector<Action> actions = {};
};

struct TypeDescription {
    std::string file = {}, name = {};
    int version = 1;
    std::vector<Word> groups = {};
    std::vector<PropertyDescription> properties = {};
    std::vector<InputDescription> inputs = {};
    std::vector<OptionDescription> options = {};
    std::vector<ShaderDescription> shaders = {};
    std::vector<FunctorDescription> functors = {};
    std::vector<PresetDescription> presets = {};
    std::vector<VersionDescription> versions = {};
};

/// `document` has passed the schema and outlives the result.
TypeDescription describe(const json::Document& document);

}  // namespace pelage::materials
