// SPDX-License-Identifier: MIT
// Each functor is one function that makes its type: ports first, then what it computes.
#include <pelage/hair/functors.hpp>

#include "functor_ports.hpp"
#include "functors_fiber.hpp"
#include "lighting/shadow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pelage::hair {
namespace {

using materials::FunctorOutputs;
using materials::FunctorType;
using materials::Value;
using materials::ValueType;

// The integral of max(cos(theta_i - theta_r), 0)^p over the sphere at theta_r = 0 is
// 2 pi sqrt(pi) Gamma((p + 2) / 2) / Gamma((p + 3) / 2): 4.64 for p = 10, 1.74 for p = 80. Its inverse makes the
// highlight reflect `weight` at normal incidence. The ratio of gammas goes through logarithms: both overflow at p =
// 340.
FunctorType kajiyaSpecular() {
    FunctorType type;
    type.name = "KajiyaSpecular";
    type.description = "Kajiya-Kay highlight: exponent, its normalisation, and weights.";
    type.in = {port("enable", ValueType::Bool), port("exponent", ValueType::Float), port("weight", ValueType::Float)};
    type.out = {port("exponent", ValueType::Float), port("norm", ValueType::Float), port("weight", ValueType::Float)};
    type.run = [](std::span<const Value> in, FunctorOutputs& out) {
        const float exponent = std::max(in[1].number[0], 0.0F);
        const double p = static_cast<double>(exponent);
        const double ratio = std::exp(std::lgamma(0.5 * (p + 2.0)) - std::lgamma(0.5 * (p + 3.0)));
        const double integral = 2.0 * std::numbers::pi * std::sqrt(std::numbers::pi) * ratio;
        out.set(0, Value::scalar(exponent));
        out.set(1, Value::scalar(static_cast<float>(1.0 / integral)));
        out.set(2, Value::scalar(in[0].integer != 0 ? in[2].number[0] : 0.0F));
    };
    return type;
}

FunctorType strandIdVariation() {
    FunctorType type;
    type.name = "StrandIdVariation";
    type.description = "Brightness variation from strand to strand.";
    type.in = {port("map", ValueType::Texture2D), port("useMap", ValueType::Bool), port("amount", ValueType::Float)};
    type.out = {port("map", ValueType::Texture2D), port("useMap", ValueType::Bool),
                port("amplitude", ValueType::Float)};
    type.run = [](std::span<const Value> in, FunctorOutputs& out) {
        const float amplitude = in[1].integer != 0 ? std::max(in[2].number[0], 0.0F) : 0.0F;
        out.set(0, in[0]);
        out.set(1, Value::boolean(amplitude > 0.0F));
        out.set(2, Value::scalar(amplitude));
    };
    return type;
}

// Exponential falloff leaves a tenth of the light `distance` metres behind the first surface: density = ln 10 /
// distance.
FunctorType shadowFalloff() {
    const std::vector<std::string> modes = shadowTechniqueWords();
    FunctorType type;
    type.name = "ShadowFalloff";
    type.description = "How shadows are looked up, and how fast light fades inside the hair (1/m).";
    type.in = {words("mode", modes), port("distance", ValueType::Float), port("radius", ValueType::Int)};
    type.out = {words("mode", modes), port("density", ValueType::Float), port("radius", ValueType::Int)};
    type.run = [](std::span<const Value> in, FunctorOutputs& out) {
        const bool fades = shadowTechniques()[static_cast<std::size_t>(in[0].integer)].fades;
        const float distance = std::max(in[1].number[0], 1e-6F);
        out.set(0, in[0]);
        out.set(1, Value::scalar(fades ? std::numbers::ln10_v<float> / distance : 0.0F));
        out.set(2, in[2]);
    };
    return type;
}

FunctorType environmentScale() {
    FunctorType type;
    type.name = "EnvironmentScale";
    type.description = "Light from the environment; off when its intensity is zero.";
    type.in = {port("enable", ValueType::Bool), port("intensity", ValueType::Float)};
    type.out = {port("on", ValueType::Bool), port("scale", ValueType::Float)};
    type.run = [](std::span<const Value> in, FunctorOutputs& out) {
        const float scale = in[0].integer != 0 ? std::max(in[1].number[0], 0.0F) : 0.0F;
        out.set(0, Value::boolean(scale > 0.0F));
        out.set(1, Value::scalar(scale));
    };
    return type;
}

FunctorType constantScatter() {
    FunctorType type;
    type.name = "ConstantScatter";
    type.description = "A constant in place of multiple scattering; off when its factor is zero.";
    type.in = {words("mode", {"off", "constant"}), port("factor", ValueType::Float)};
    type.out = {port("on", ValueType::Bool), port("amount", ValueType::Float)};
    type.run = [](std::span<const Value> in, FunctorOutputs& out) {
        const float amount = in[0].integer == 1 ? std::max(in[1].number[0], 0.0F) : 0.0F;
        out.set(0, Value::boolean(amount > 0.0F));
        out.set(1, Value::scalar(amount));
    };
    return type;
}

}  // namespace

materials::FunctorRegistry functorRegistry() {
    materials::FunctorRegistry registry = materials::FunctorRegistry::standard();
    registry.add(fiberColor());
    registry.add(fiberShape());
    registry.add(lobeWeights());
    registry.add(kajiyaSpecular());
    registry.add(strandIdVariation());
    registry.add(shadowFalloff());
    registry.add(environmentScale());
    registry.add(constantScatter());
    return registry;
}

}  // namespace pelage::hair
