// SPDX-License-Identifier: MIT
#include "check.hpp"

#include <algorithm>
#include <set>

namespace pelage::hair {
namespace {

using materials::Input;
using materials::ValueType;

// How a shader must declare an input of this type. Colours are three numbers, with an alpha of 1 where it wants four.
struct Shape {
    std::string_view text = {};
    std::uint32_t components = 1;
    bool isFloat = true;
};

Shape shapeOf(ValueType type) {
    switch (type) {
        case ValueType::Bool:
        case ValueType::Int:
        case ValueType::Enum:
            return {"int", 1, false};
        case ValueType::Uint:
            return {"uint", 1, false};
        case ValueType::Float2:
            return {"vec2", 2, true};
        case ValueType::Float3:
        case ValueType::Color:
            return {"vec3", 3, true};
        case ValueType::Float4:
            return {"vec4", 4, true};
        default:
            return {"float", 1, true};
    }
}

bool fits(ValueType type, const rhi::BlockMember& member) {
    if (member.columns != 1 || member.arrayLength != 1) return false;
    const Shape shape = shapeOf(type);
    if (type == ValueType::Color && member.components == 4) return member.scalar == rhi::ScalarType::Float;
    if (member.components != shape.components) return false;
    if (shape.isFloat) return member.scalar == rhi::ScalarType::Float;
    // A bool in a block is a uint in SPIR-V.
    if (type == ValueType::Bool) return member.scalar != rhi::ScalarType::Float;
    return member.scalar == (type == ValueType::Uint ? rhi::ScalarType::Uint : rhi::ScalarType::Int);
}

std::string textOf(const rhi::BlockMember& member) {
    std::string_view prefix, scalar;
    switch (member.scalar) {
        case rhi::ScalarType::Float:
            prefix = "", scalar = "float";
            break;
        case rhi::ScalarType::Int:
            prefix = "i", scalar = "int";
            break;
        case rhi::ScalarType::Uint:
            prefix = "u", scalar = "uint";
            break;
        case rhi::ScalarType::Bool:
            prefix = "b", scalar = "bool";
            break;
    }
    std::string text(scalar);
    if (member.columns > 1) {
        text = "mat" + std::to_string(member.columns) + "x" + std::to_string(member.components);
    } else if (member.components > 1) {
        text = std::string(prefix) + "vec" + std::to_string(member.components);
    }
    return member.arrayLength == 1 ? text : text + "[" + std::to_string(member.arrayLength) + "]";
}

class Checker {
public:
    explicit Checker(const materials::MaterialType& type) : type_(type) {
        for (const Input& input : type.inputs()) names_.push_back(input.name);
    }

    void check(const rhi::ShaderModule& module) {
        for (const rhi::SpecConstant& constant : module.reflection().specConstants) constants_.insert(constant.name);
        const rhi::ReflectedBinding* block = nullptr;
        for (const rhi::ReflectedBinding& binding : module.reflection().bindings) {
            if (binding.group != 2) continue;
            switch (binding.entry.type) {
                case rhi::BindingType::UniformBuffer:
                    if (block)
                        fail(module, "set 2 has a second uniform block, '" + binding.entry.name + "'",
                             "put all inputs into one block");
                    block = &binding;
                    for (const rhi::BlockMember& member : binding.members) checkMember(module, member);
                    break;
                case rhi::BindingType::SampledTexture:
                    checkTexture(module, binding.entry);
                    break;
                case rhi::BindingType::Sampler:
                    break;
                default:
                    fail(module, "'" + binding.entry.name + "' in set 2 is none of what a material fills",
                         "use one uniform block, sampled textures and samplers");
            }
        }
    }

    void reportUnread() {
        for (const Input& input : type_.inputs()) {
            if (!read_.count(input.name))
                warn("M052", "input '" + input.name + "' is read by no shader of the material type",
                     "declare it in the uniform block of set 2, or delete the input");
        }
        for (const materials::Option& option : type_.options()) {
            if (constants_.count(option.name)) continue;
            const std::string_view near = nearestName(option.name, {constants_.begin(), constants_.end()});
            warn("M050", "option '" + option.name + "' is a specialization constant of no shader of the material type",
                 near.empty() ? "declare it with layout(constant_id = ...)"
                              : "the shaders have '" + std::string(near) + "'");
        }
    }

    Diagnostics found = {};

private:
    const Input* input(const std::string& name) const {
        const auto at = std::find_if(type_.inputs().begin(), type_.inputs().end(),
                                     [&](const Input& each) { return each.name == name; });
        return at == type_.inputs().end() ? nullptr : &*at;
    }

    void checkMember(const rhi::ShaderModule& module, const rhi::BlockMember& member) {
        const Input* from = input(member.name);
        if (from == nullptr) {
            const std::string_view near = nearestName(member.name, names_);
            fail(module, "the uniform block has '" + member.name + "', which no input of the material type fills",
                 near.empty() ? "declare the input in the material type, or delete the member"
                              : "did you mean '" + std::string(near) + "'?");
            return;
        }
        read_.insert(member.name);
        if (fits(from->type, member)) return;
        const bool isTexture = from->type == ValueType::Texture2D || from->type == ValueType::TextureCube;
        fail(module,
             "member '" + member.name + "' of the uniform block is " + textOf(member) + ", the input is " +
                 std::string(materials::name(from->type)),
             isTexture ? "textures are resources of their own" : "write " + std::string(shapeOf(from->type).text));
    }

    void checkTexture(const rhi::ShaderModule& module, const rhi::BindGroupLayoutEntry& entry) {
        const Input* from = input(entry.name);
        const bool isCube = entry.viewDimension == rhi::TextureViewDimension::Cube;
        if (from == nullptr) {
            const std::string_view near = nearestName(entry.name, names_);
            fail(module, "the shader samples '" + entry.name + "', which no texture input of the material type fills",
                 near.empty() ? "declare a texture2d input of this name" : "did you mean '" + std::string(near) + "'?");
            return;
        }
        read_.insert(entry.name);
        // Moment tables are arrays behind a texture2d input.
        const bool flat = entry.viewDimension == rhi::TextureViewDimension::E2D ||
                          entry.viewDimension == rhi::TextureViewDimension::E2DArray;
        if (from->type == ValueType::Texture2D ? flat : from->type == ValueType::TextureCube && isCube) return;
        fail(module,
             "the shader samples '" + entry.name + "' as another kind of texture than the input, which is " +
                 std::string(materials::name(from->type)),
             "use texture2D for texture2d and textureCube for textureCube");
    }

    void fail(const rhi::ShaderModule& module, std::string text, std::string hint) {
        found.add({Severity::Error, "M051", module.label(), 0, 0, std::move(text) + " (type '" + type_.name() + "')",
                   std::move(hint)});
    }
    void warn(std::string code, std::string text, std::string hint) {
        found.add({Severity::Warning, std::move(code), type_.file(), 0, 0, std::move(text), std::move(hint)});
    }

    const materials::MaterialType& type_;
    std::vector<std::string> names_;
    std::set<std::string> read_, constants_;
};

}  // namespace

Diagnostics checkShaders(const materials::MaterialType& type,
                         const std::function<rhi::ShaderModule(const std::string& file)>& module) {
    Checker checker(type);
    std::set<std::string> seen;
    bool all = true;
    for (const materials::ShaderUse& use : type.shaders()) {
        for (const std::string& file : {use.vertex, use.fragment}) {
            if (file.empty() || !seen.insert(file).second) continue;
            const rhi::ShaderModule made = module(file);
            all = all && made;
            if (made) checker.check(made);
        }
    }
    if (all) checker.reportUnread();
    return std::move(checker.found);
}

}  // namespace pelage::hair
