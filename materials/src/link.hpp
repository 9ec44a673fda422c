// SPDX-License-Identifier: MIT
// A material type after all names were resolved: indices only, nothing left to look up at run time.
#pragma once

#include "versions.hpp"

#include <pelage/base/condition.hpp>
#include <pelage/materials/material.hpp>

namespace pelage::materials {

struct Target {
    enum class Kind : std::uint8_t { None, Input, Option, ShaderEnabled, ShaderState } kind = Kind::None;
    std::size_t index = 0;
    bool operator==(const Target&) const = default;
};

struct Connection {
    std::size_t property = 0;
    Target target = {};
};

struct FunctorUse {
    std::string id = {};
    FunctorType type = {};
    std::vector<std::size_t> in = {};  // property of each input port
    std::vector<Target> out = {};      // of each output port
};

struct Preset {
    std::string name = {};
    std::vector<std::pair<std::size_t, Value>> values = {};
};

struct MaterialType::Linked {
    std::string name = {}, file = {};
    int version = 1;
    std::vector<Property> properties = {};
    std::vector<Input> inputs = {};
    std::vector<std::size_t> inputSlots = {};  // place in CompiledMaterial::inputs or ::textures
    std::vector<Option> options = {};
    std::vector<ShaderUse> shaders = {};
    std::vector<json::Place> drawListPlaces = {};              // by shader
    std::vector<std::vector<std::size_t>> shaderOptions = {};  // indices of ShaderUse::options
    std::vector<Connection> connections = {};
    std::vector<FunctorUse> functors = {};
    std::vector<std::vector<json::Condition>> visibleWhen = {};  // by property; all must hold (group and property)
    std::vector<std::vector<json::Condition>> enabledWhen = {};
    std::vector<Preset> presets = {};
    std::vector<std::string> presetNames = {};
    std::vector<VersionStep> versionSteps = {};
    Diagnostics warnings = {};

    std::optional<std::size_t> indexOf(std::string_view propertyId) const;
};

std::vector<std::string> propertyIds(const std::vector<Property>& properties);

}  // namespace pelage::materials
