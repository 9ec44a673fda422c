// SPDX-License-Identifier: MIT
// Functors: small pure C++ functions with declared, typed ports that turn properties into shader inputs, options and
// states. A material type names them; they run only when one of their inputs has changed.
#pragma once

#include <pelage/materials/value.hpp>
#include <pelage/rhi/types.hpp>

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pelage::materials {

/// Depth words do not say whether depth is reversed: the host does, once.
enum class DepthTest : std::uint8_t { Never, Nearer, NearerEqual, Equal, Always };
enum class Blend : std::uint8_t { Off, Premultiplied, Additive };

/// The state of one shader of a material that is not in its code.
struct RenderState {
    rhi::CullMode cull = rhi::CullMode::None;
    DepthTest depthTest = DepthTest::NearerEqual;
    bool depthWrite = true;
    Blend blend = Blend::Off;
    bool alphaToCoverage = false;
    bool operator==(const RenderState&) const = default;
};

/// What a functor may say about a shader's state; absent fields stay as the material type has them.
struct StateOverlay {
    std::optional<rhi::CullMode> cull = {};
    std::optional<DepthTest> depthTest = {};
    std::optional<bool> depthWrite = {};
    std::optional<Blend> blend = {};
    std::optional<bool> alphaToCoverage = {};
};

struct Port {
    std::string name = {};
    enum class Kind : std::uint8_t { Value, State, Enabled } kind = Kind::Value;  // State, Enabled: outputs only
    ValueType type = ValueType::Float;
    std::vector<std::string> words = {};  // Enum ports: the words the functor knows, in its order
    bool optional = false;                // an output that need not be connected
};

class FunctorOutputs {
public:
    void set(std::size_t port, Value value) { values_[port] = std::move(value); }
    void setState(std::size_t port, StateOverlay overlay) { states_[port] = overlay; }
    void setEnabled(std::size_t port, bool enabled) { values_[port] = Value::boolean(enabled); }
    const std::map<std::size_t, Value>& values() const { return values_; }
    const std::map<std::size_t, StateOverlay>& states() const { return states_; }

private:
    std::map<std::size_t, Value> values_;
    std::map<std::size_t, StateOverlay> states_;
};

/// `run` gets exactly the declared inputs in their order and sets every output by its index; no state, no side effect.
struct FunctorType {
    std::string name = {};
    std::string description = {};
    std::vector<Port> in = {}, out = {};
    std::function<void(std::span<const Value> in, FunctorOutputs& out)> run = {};
};

class FunctorRegistry {
public:
    /// The functors that know nothing of hair: BlendModeToPipeline, TexturedColor, FresnelFromIor.
    static FunctorRegistry standard();
    /// False when the name is taken.
    bool add(FunctorType type);
    const FunctorType* find(std::string_view name) const;
    std::vector<std::string> names() const;

private:
    std::map<std::string, FunctorType, std::less<>> types_;
};

}  // namespace pelage::materials
