// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>
#include <pelage/hair/functors.hpp>
#include <pelage/materials/material.hpp>

#include <fstream>
#include <sstream>

namespace pelage::materials::test {

inline std::string readFile(const std::string& path) {
    std::stringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

inline std::string typePath(const std::string& name) {
    return std::string(PELAGE_MATERIALS) + "/types/" + name + ".materialtype.json";
}

inline std::shared_ptr<const MaterialType> shipped(const std::string& name) {
    auto type = MaterialType::load(typePath(name), hair::functorRegistry());
    EXPECT_TRUE(type) << (type ? "" : type.error().text());
    return type ? *type : nullptr;
}

inline Material::TypeSource shippedSource() {
    return [](const std::string& name) {
        return MaterialType::load(std::string(PELAGE_MATERIALS) + "/types/" + name, hair::functorRegistry());
    };
}

inline float number(const CompiledMaterial& compiled, std::string_view name, std::size_t component = 0) {
    for (const auto& input : compiled.inputs) {
        if (input.name == name) return input.value.number[component];
    }
    ADD_FAILURE() << "no input " << name;
    return 0;
}

inline double option(const CompiledMaterial& compiled, std::string_view name) {
    for (const auto& entry : compiled.options) {
        if (entry.name == name) return entry.value;
    }
    ADD_FAILURE() << "no option " << name;
    return -1;
}

inline const CompiledMaterial::Shader& shader(const CompiledMaterial& compiled, std::string_view name) {
    for (const auto& candidate : compiled.shaders) {
        if (candidate.use.name == name) return candidate;
    }
    ADD_FAILURE() << "no shader " << name;
    return compiled.shaders.front();
}

inline std::string codeOf(const Diagnostics& found) {
    return found.empty() ? "none" : std::string(found.first().code.text());
}

}  // namespace pelage::materials::test
