// SPDX-License-Identifier: MIT
#include "functors_fiber.hpp"

#include "functor_ports.hpp"
#include "scattering/resolve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pelage::hair {
namespace {

using materials::FunctorOutputs;
using materials::FunctorType;
using materials::Value;
using materials::ValueType;

Value float4(const std::array<double, 4>& x) {
    return {ValueType::Float4,
            {static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2]), static_cast<float>(x[3])},
            0,
            {}};
}

double real(const Value& value) {
    return static_cast<double>(value.number[0]);
}

constexpr double radiansPerDegree = std::numbers::pi / 180.0;

}  // namespace

// Absorption is made in two places: what the material knows becomes `sigma` here; what changes over a surface (base
// colour, its map, the variation from strand to strand) is turned into absorption in the shader, by one of two laws.
FunctorType fiberColor() {
    const std::vector<std::string> modes{"pathColor", "color", "melanin", "sigma"};
    FunctorType type;
    type.name = "FiberColor";
    type.description = "Absorption (per radius) from a colour, from pigments or as it is.";
    type.in = {words("mode", modes),
               port("color", ValueType::Color),
               port("map", ValueType::Texture2D),
               port("useMap", ValueType::Bool),
               port("eumelanin", ValueType::Float),
               port("pheomelanin", ValueType::Float),
               port("sigma", ValueType::Float3),
               port("betaN", ValueType::Float)};
    type.out = {port("color", ValueType::Color),  port("map", ValueType::Texture2D), port("useMap", ValueType::Bool),
                port("sigma", ValueType::Float3), port("fit", ValueType::Float),     port("chiang", ValueType::Bool)};
    type.run = [](std::span<const Value> in, FunctorOutputs& out) {
        const std::int64_t mode = in[0].integer;
        std::array<double, 3> sigma{};
        if (mode == 2) sigma = sigmaFromMelanin(real(in[4]), real(in[5]));
        if (mode == 3) {
            for (std::size_t c = 0; c < 3; ++c) sigma[c] = std::clamp(static_cast<double>(in[6].number[c]), 0.0, 1e4);
        }
        // With pigments or sigma the base colour is white and only its map is left of it.
        out.set(0, mode >= 2 ? Value::color(1, 1, 1) : in[1]);
        const bool isWhite = in[2].text.empty() || in[2].text == "builtin.white";
        out.set(1, in[2]);
        out.set(2, Value::boolean(in[3].integer != 0 && !isWhite));
        out.set(
            3, Value::float3(static_cast<float>(sigma[0]), static_cast<float>(sigma[1]), static_cast<float>(sigma[2])));
        // sigma = (fit ln C)^2, Chiang 2016 (9).
        out.set(4, Value::scalar(static_cast<float>(std::sqrt(sigmaFromColor(std::exp(-1.0), real(in[7]))))));
        out.set(5, Value::boolean(mode == 1));
    };
    return type;
}

FunctorType fiberShape() {
    FunctorType type;
    type.name = "FiberShape";
    type.description = "What the scattering models take of a fibre (fiber.glsl), and the table they read.";
    type.in = {words("model", {"kajiyaKay", "scheuermann", "marschner", "karis", "thesis", "gerard", "chiang", "pxr",
                               "momentLut", "segmentCdf"}),
               port("ior", ValueType::Float),
               port("betaM", ValueType::Float),
               port("betaN", ValueType::Float),
               port("tiltDeg", ValueType::Float),
               port("widths", ValueType::Float3),
               port("shifts", ValueType::Float3),
               port("glintGain", ValueType::Float),
               port("glintWidth", ValueType::Float),
               port("glintShift", ValueType::Float),
               port("envBoost", ValueType::Float)};
    type.out = {port("fiber0", ValueType::Float4),
                port("fiber1", ValueType::Float4),
                port("inverseVariance", ValueType::Float4),
                port("norm", ValueType::Float4),
                port("deviation", ValueType::Float4),
                port("sinTilt", ValueType::Float4),
                port("cosTilt", ValueType::Float4),
                port("glint", ValueType::Float4),
                port("envInverseVariance", ValueType::Float4),
                port("envNorm", ValueType::Float4),
                port("envDeviation", ValueType::Float4),
                port("table", ValueType::Texture2D)};
    type.run = [](std::span<const Value> in, FunctorOutputs& out) {
        FiberProperties fiber;
        fiber.eta = real(in[1]);
        fiber.betaM = real(in[2]);
        fiber.betaN = real(in[3]);
        fiber.alpha = real(in[4]) * radiansPerDegree;
        // The controls belong to pxr; what they were set to there means nothing to the others.
        const bool controls = in[0].integer == static_cast<std::int64_t>(ScatteringModel::Pxr);
        for (std::size_t p = 0; controls && p < 3; ++p) {
            fiber.widthScale[p] = static_cast<double>(in[5].number[p]);
            fiber.shift[p] = static_cast<double>(in[6].number[p]) * radiansPerDegree;
        }
        fiber.glintGain = real(in[7]);
        fiber.glintWidth = real(in[8]);
        fiber.glintShift = real(in[9]);
        const ResolvedFiber r = resolve(fiber);
        out.set(0, float4({r.eta, r.etaExcess, r.alpha, r.betaM}));
        out.set(1, float4({r.betaN, r.inverseScale, r.peak, 0}));
        out.set(2, float4(r.inverseVariance));
        out.set(3, float4(r.norm));
        out.set(4, float4(r.deviation));
        out.set(5, float4(r.sinTilt));
        out.set(6, float4(r.cosTilt));
        out.set(7, float4(r.glint));
        // One irradiance sample stands for a whole environment, so the lobes are widened for it (Karis 2016).
        fiber.betaM += std::max(real(in[10]), 0.0);
        const ResolvedFiber wide = resolve(fiber);
        out.set(8, float4(wide.inverseVariance));
        out.set(9, float4(wide.norm));
        out.set(10, float4(wide.deviation));
        const auto model = static_cast<std::size_t>(std::clamp<std::int64_t>(in[0].integer, 0, 9));
        out.set(11, Value::texture(scatteringModels()[model].usesTable ? momentTableName(r.eta, r.betaN)
                                                                       : std::string(momentTableNone)));
    };
    return type;
}

// A lobe whose weight is zero is compiled out.
FunctorType lobeWeights() {
    FunctorType type;
    type.name = "LobeWeights";
    type.description = "Weights and tints of the lobes; a lobe of weight zero is compiled out.";
    for (const char* lobe : {"R", "TT", "TRT", "RES"}) {
        type.in.push_back(port(std::string("enable") + lobe, ValueType::Bool));
        type.in.push_back(port(std::string("weight") + lobe, ValueType::Float));
        type.in.push_back(port(std::string("tint") + lobe, ValueType::Color));
        type.out.push_back(port(std::string("gain") + lobe, ValueType::Color));
    }
    for (const char* lobe : {"R", "TT", "TRT", "RES"}) {
        type.out.push_back(port(std::string("on") + lobe, ValueType::Bool));
    }
    type.run = [](std::span<const Value> in, FunctorOutputs& out) {
        for (std::size_t lobe = 0; lobe < 4; ++lobe) {
            const float weight = in[3 * lobe].integer != 0 ? std::max(in[3 * lobe + 1].number[0], 0.0F) : 0.0F;
            const std::array<float, 4>& tint = in[3 * lobe + 2].number;
            out.set(lobe, Value::color(weight * tint[0], weight * tint[1], weight * tint[2]));
            out.set(lobe + 4, Value::boolean(weight > 0.0F && (tint[0] > 0.0F || tint[1] > 0.0F || tint[2] > 0.0F)));
        }
    };
    return type;
}

}  // namespace pelage::hair
