// SPDX-License-Identifier: MIT
#include "functors_standard.hpp"

#include <algorithm>

namespace pelage::materials {
namespace {

Port port(std::string name, ValueType type) {
    return {std::move(name), Port::Kind::Value, type, {}, false};
}
Port words(std::string name, std::vector<std::string> list) {
    return {std::move(name), Port::Kind::Value, ValueType::Enum, std::move(list), false};
}
Port state(std::string name) {
    return {std::move(name), Port::Kind::State, ValueType::Float, {}, true};
}
Port enabled(std::string name) {
    return {std::move(name), Port::Kind::Enabled, ValueType::Bool, {}, true};
}

Value enumValue(const std::vector<std::string>& list, std::int64_t index) {
    return {ValueType::Enum, {}, index, list[static_cast<std::size_t>(index)]};
}

}  // namespace

// With a depth pre-pass the forward shader needs no blending: it tests `equal`, so each sample shows exactly the
// fragment that won. Blending cannot use one; there the depth and forward shaders give way to the blend shader.
FunctorType blendModeToPipeline() {
    const std::vector<std::string> out{"opaque", "test", "coverage", "hashed", "blend"};
    FunctorType type;
    type.name = "BlendModeToPipeline";
    type.description = "How alpha removes parts of a surface: shader option, draw lists and states.";
    type.in = {words("mode", {"opaque", "alphaTest", "alphaToCoverage", "hashedAlpha", "alphaBlend"}),
               port("threshold", ValueType::Float), port("hashScale", ValueType::Float),
               port("doubleSided", ValueType::Bool)};
    type.out = {words("alphaMode", out),
                port("threshold", ValueType::Float),
                port("hashScale", ValueType::Float),
                enabled("depthEnabled"),
                enabled("forwardEnabled"),
                enabled("blendEnabled"),
                state("shadowState"),
                state("depthState"),
                state("forwardState"),
                state("blendState")};
    type.run = [out](std::span<const Value> in, FunctorOutputs& outputs) {
        const std::int64_t mode = std::clamp<std::int64_t>(in[0].integer, 0, 4);
        const bool isCoverage = mode == 2, isBlend = mode == 4;
        const rhi::CullMode cull = in[3].integer != 0 ? rhi::CullMode::None : rhi::CullMode::Back;
        outputs.set(0, enumValue(out, mode));
        outputs.set(1, in[1]);
        outputs.set(2, in[2]);
        outputs.setEnabled(3, !isBlend);
        outputs.setEnabled(4, !isBlend);
        outputs.setEnabled(5, isBlend);
        outputs.setState(6, {cull, DepthTest::Nearer, true, Blend::Off, false});
        // Coverage is decided where depth is written; the forward pass then runs on exactly those samples.
        outputs.setState(7, {cull, DepthTest::NearerEqual, true, Blend::Off, isCoverage});
        outputs.setState(8, {cull, DepthTest::Equal, false, Blend::Off, false});
        outputs.setState(9, {cull, DepthTest::NearerEqual, false, Blend::Premultiplied, false});
    };
    return type;
}

FunctorType texturedColor() {
    FunctorType type;
    type.name = "TexturedColor";
    type.description = "A colour, times a texture when there is one.";
    type.in = {port("color", ValueType::Color), port("map", ValueType::Texture2D), port("useMap", ValueType::Bool)};
    type.out = {port("color", ValueType::Color), port("map", ValueType::Texture2D), port("useMap", ValueType::Bool)};
    type.run = [](std::span<const Value> in, FunctorOutputs& outputs) {
        // White changes nothing: no need to sample it.
        const bool isWhite = in[1].text.empty() || in[1].text == "builtin.white";
        outputs.set(0, in[0]);
        outputs.set(1, in[1]);
        outputs.set(2, Value::boolean(in[2].integer != 0 && !isWhite));
    };
    return type;
}

FunctorType fresnelFromIor() {
    FunctorType type;
    type.name = "FresnelFromIor";
    type.description = "Reflectance at normal incidence of a dielectric in air: ((eta - 1) / (eta + 1))^2.";
    type.in = {port("ior", ValueType::Float)};
    type.out = {port("f0", ValueType::Float), port("eta", ValueType::Float)};
    type.out[1].optional = true;
    type.run = [](std::span<const Value> in, FunctorOutputs& outputs) {
        const float eta = std::max(in[0].number[0], 1.0001F);
        const float ratio = (eta - 1.0F) / (eta + 1.0F);
        outputs.set(0, Value::scalar(ratio * ratio));
        outputs.set(1, Value::scalar(eta));
    };
    return type;
}

}  // namespace pelage::materials
