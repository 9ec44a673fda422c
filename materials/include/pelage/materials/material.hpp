// SPDX-License-Identifier: MIT
// Material types and materials. A type (*.materialtype.json) lists properties in groups, shader inputs, shader options,
// shaders with their draw lists, and what connects them; a material (*.material.json) is a type and the values that
// differ. Both are checked when read; every fault is a Diagnostic with its place.
#pragma once

#include <pelage/base/diagnostic.hpp>
#include <pelage/materials/functor.hpp>
#include <pelage/rhi/resources.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pelage::json {
struct Value;
}

namespace pelage::materials {

struct Property {
    std::string id = {};  // "scattering.longitudinalRoughness"
    std::string group = {}, groupLabel = {}, name = {}, label = {}, description = {}, unit = {};
    ValueType type = ValueType::Float;
    Value defaultValue = {};
    std::optional<double> min = {}, max = {}, softMin = {}, softMax = {}, step = {};
    std::vector<std::string> words = {};  // Enum
    bool srgb = false;                    // Color and textures: written in sRGB
    std::string visibleWhen = {}, enabledWhen = {};
};

struct Input {
    std::string name = {};
    ValueType type = ValueType::Float;
    bool srgb = false;  // textures: texels are sRGB-encoded (use an ...Srgb format)
};

struct Option {
    std::string name = {};
    ValueType type = ValueType::Bool;     // Bool, Int or Enum
    std::vector<std::string> words = {};  // Enum; the value of the specialization constant is the index
    std::int64_t defaultValue = 0;
    std::int64_t min = 0, max = 1;  // Int
};

/// A shader of a material: of raster passes (`vertex`, perhaps `fragment`), or a compute shader, which a pass class
/// dispatches for the objects that have the material.
struct ShaderUse {
    std::string name = {};                   // "forward"
    std::string drawList = {};               // joins the material to the passes with the same draw list
    std::string vertex = {}, fragment = {};  // shader files; `fragment` may be empty (depth only)
    std::string compute = {};                // the file of a compute shader; the two others are empty then
    std::vector<std::string> options = {};   // those it reads (the file may say "*")
    RenderState state = {};                  // of a raster shader
    bool enabledByDefault = true;

    bool isCompute() const { return !compute.empty(); }
    /// The files that are not empty.
    std::vector<std::string> files() const;
    bool operator==(const ShaderUse&) const = default;
};

class MaterialType {
public:
    /// Reads and links a type. The type keeps copies of the functors it names; the registry may go.
    static Result<std::shared_ptr<const MaterialType>> parse(std::string_view text, const std::string& file,
                                                             const FunctorRegistry& registry);
    static Result<std::shared_ptr<const MaterialType>> load(const std::string& path, const FunctorRegistry& registry);

    const std::string& name() const;
    const std::string& file() const;
    int version() const;
    const std::vector<Property>& properties() const;
    const std::vector<Input>& inputs() const;
    const std::vector<Option>& options() const;
    const std::vector<ShaderUse>& shaders() const;
    const std::vector<std::string>& presets() const;
    const Property* find(std::string_view id) const;
    /// M017, a warning, for each shader whose draw list is not among `known`, those of a pass tree: nothing draws it.
    Diagnostics unknownDrawLists(const std::vector<std::string>& known) const;
    /// Warnings found while reading (errors do not give a type).
    const Diagnostics& warnings() const;

    struct Linked;  // src/link.hpp
    const Linked& linked() const { return *linked_; }

private:
    friend struct MaterialTypeReader;
    std::shared_ptr<const Linked> linked_;
};

/// The result of a material's connections and functors: what the renderer needs and nothing else.
struct CompiledMaterial {
    struct InputValue {
        std::string name = {};
        Value value = {};
        bool operator==(const InputValue&) const = default;
    };
    struct Shader {
        ShaderUse use = {};
        bool enabled = true;
        RenderState state = {};
        std::vector<rhi::ConstantEntry> constants = {};  // the options this shader reads, as specialization constants
        bool operator==(const Shader&) const = default;
    };
    std::vector<InputValue> inputs = {};    // numbers and colours
    std::vector<InputValue> textures = {};  // Texture2D, TextureCube
    std::vector<rhi::ConstantEntry> options = {};
    std::vector<Shader> shaders = {};
    std::uint64_t functorRuns = 0;  // since the material was made
};

class Material {
public:
    explicit Material(std::shared_ptr<const MaterialType> type);

    /// Finds material types by the name a material file gives, for example "hair.materialtype.json".
    using TypeSource = std::function<Result<std::shared_ptr<const MaterialType>>(const std::string& name)>;
    /// The path of a parent, from the name in "parent" and the path of the file that says so. Without one, parents are
    /// looked for beside that file.
    using ParentSource = std::function<std::string(const std::string& name, const std::string& file)>;
    struct Parsed;
    /// Reads a material and its parents: the values of the nearest file win. A parent that is missing, of another type,
    /// or its own ancestor is V012, at each place concerned.
    static Result<Parsed> parse(std::string_view text, const std::string& file, const TypeSource& types,
                                const ParentSource& parents = {});
    static Result<Parsed> load(const std::string& path, const TypeSource& types, const ParentSource& parents = {});
    /// The files it was read from: its own, its parent, the parent's parent. Empty for a material made by a program.
    const std::vector<std::string>& files() const { return files_; }

    const MaterialType& type() const { return *type_; }
    const std::shared_ptr<const MaterialType>& sharedType() const { return type_; }

    /// Sets a property. Gives nothing when all is well, a warning for a number that was clamped to the range, and an
    /// error (nothing is changed) for a wrong type, an unknown name or word, and numbers that are not finite.
    Diagnostics set(std::string_view id, const Value& value);
    /// As a file writes it.
    Diagnostics set(std::string_view id, const json::Value& value);
    /// As a person writes it: "0.3", "true", "alphaTest", "0.8,0.5,0.2", "#805030" (sRGB), a texture path.
    Diagnostics setFromText(std::string_view id, std::string_view text);
    const Value* get(std::string_view id) const;
    Diagnostics applyPreset(std::string_view name);
    void reset();
    /// What `visibleWhen` (also of the group) and `enabledWhen` say at the present values; true for an unknown name.
    bool isVisible(std::string_view id) const;
    bool isEnabled(std::string_view id) const;

    /// Runs the functors whose inputs changed since the last call.
    const CompiledMaterial& compile();

private:
    friend struct MaterialReader;
    void assign(std::size_t property, const Value& value);
    template <class Given>
    Diagnostics take(std::string_view id, const Given& given);

    std::shared_ptr<const MaterialType> type_;
    std::vector<Value> values_;  // by property index
    std::vector<bool> dirty_;
    std::vector<std::string> files_;
    CompiledMaterial compiled_;
    bool first_ = true;
};

struct Material::Parsed {
    Material material;
    Diagnostics warnings;
};

/// The JSON schemas of material types and of materials, which the readers check with.
std::string_view materialTypeSchema();
std::string_view materialSchema();

}  // namespace pelage::materials
