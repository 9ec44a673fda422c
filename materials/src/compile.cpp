// SPDX-License-Identifier: MIT
// From property values to what the renderer needs. Only what depends on a changed property is touched.
#include "convert.hpp"
#include "link.hpp"

#include <algorithm>
#include <cmath>

namespace pelage::materials {
namespace {

class Compiler {
public:
    Compiler(const MaterialType::Linked& linked, CompiledMaterial& out) : linked_(linked), out_(out) {}

    // Everything but the values; those follow from running all functors.
    void prepare() {
        for (const Input& input : linked_.inputs) {
            Value empty;
            empty.type = input.type;
            (isTexture(input.type) ? out_.textures : out_.inputs).push_back({input.name, std::move(empty)});
        }
        for (const Option& option : linked_.options)
            out_.options.push_back({option.name, static_cast<double>(option.defaultValue)});
        for (std::size_t i = 0; i < linked_.shaders.size(); ++i) {
            const ShaderUse& use = linked_.shaders[i];
            CompiledMaterial::Shader shader{use, use.enabledByDefault, use.state, {}};
            for (const std::size_t option : linked_.shaderOptions[i]) shader.constants.push_back(out_.options[option]);
            out_.shaders.push_back(std::move(shader));
        }
    }

    void drive(const Target& target, const Value& value) {
        switch (target.kind) {
            case Target::Kind::Input:
                driveInput(target.index, value);
                break;
            case Target::Kind::Option:
                driveOption(target.index, value);
                break;
            case Target::Kind::ShaderEnabled:
                out_.shaders[target.index].enabled = value.integer != 0;
                break;
            case Target::Kind::ShaderState:
            case Target::Kind::None:
                break;
        }
    }

    void overlay(const Target& target, const StateOverlay& overlay) {
        if (target.kind != Target::Kind::ShaderState) return;
        RenderState state = linked_.shaders[target.index].state;
        state.cull = overlay.cull.value_or(state.cull);
        state.depthTest = overlay.depthTest.value_or(state.depthTest);
        state.depthWrite = overlay.depthWrite.value_or(state.depthWrite);
        state.blend = overlay.blend.value_or(state.blend);
        state.alphaToCoverage = overlay.alphaToCoverage.value_or(state.alphaToCoverage);
        out_.shaders[target.index].state = state;
    }

private:
    void driveInput(std::size_t index, const Value& value) {
        // A functor that made a NaN must not reach the GPU: the last good value stays.
        for (const float number : value.number) {
            if (!std::isfinite(number)) return;
        }
        const Input& input = linked_.inputs[index];
        Value& now = (isTexture(input.type) ? out_.textures : out_.inputs)[linked_.inputSlots[index]].value;
        now = value;
        now.type = input.type;
    }

    void driveOption(std::size_t index, const Value& value) {
        const Option& option = linked_.options[index];
        const auto next = static_cast<double>(std::clamp(value.integer, option.min, option.max));
        out_.options[index].value = next;
        for (std::size_t i = 0; i < linked_.shaders.size(); ++i) {
            const std::vector<std::size_t>& used = linked_.shaderOptions[i];
            for (std::size_t k = 0; k < used.size(); ++k) {
                if (used[k] == index) out_.shaders[i].constants[k].value = next;
            }
        }
    }

    const MaterialType::Linked& linked_;
    CompiledMaterial& out_;
};

}  // namespace

const CompiledMaterial& Material::compile() {
    if (!first_ && std::none_of(dirty_.begin(), dirty_.end(), [](bool dirty) { return dirty; })) return compiled_;
    const MaterialType::Linked& linked = type_->linked();
    Compiler compiler(linked, compiled_);
    if (first_) compiler.prepare();
    for (const Connection& connection : linked.connections) {
        if (first_ || dirty_[connection.property]) compiler.drive(connection.target, values_[connection.property]);
    }
    std::vector<Value> in;
    for (const FunctorUse& use : linked.functors) {
        if (!first_ &&
            std::none_of(use.in.begin(), use.in.end(), [&](std::size_t property) { return dirty_[property]; }))
            continue;
        in.clear();
        for (const std::size_t property : use.in) in.push_back(values_[property]);
        FunctorOutputs outputs;
        use.type.run(in, outputs);
        ++compiled_.functorRuns;
        for (const auto& [port, value] : outputs.values()) {
            if (port < use.out.size()) compiler.drive(use.out[port], value);
        }
        for (const auto& [port, overlay] : outputs.states()) {
            if (port < use.out.size()) compiler.overlay(use.out[port], overlay);
        }
    }
    first_ = false;
    dirty_.assign(dirty_.size(), false);
    return compiled_;
}

}  // namespace pelage::materials
