// SPDX-License-Identifier: MIT
// Each functor is one function that makes its type: ports first, then what it computes.
#include <pelage/hair/functors.hpp>

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

materials::Port port(std::string name, ValueType type) {
    return {std::move(name), materials::Port::Kind::Value, type, {}, false};
}
materials::Port words(std::string name, std::vector<std::string> list) {
    return {std::move(name), materials::Port::Kind::Value, ValueType::Enum, std::move(list), false};
}

constexpr float radiansPerDegree = std::numbers::pi_v<float> / 180.0F;

// exp(-x) I0(x) for x >= 0. Power series below 12 (all terms positive: no cancellation), asymptotic series above; both
// are good to about 1e-9 where they meet, and neither overflows.
double scaledBesselI0(double x) {
    if (x < 12.0) {
        const double quarter = 0.25 * x * x;
        double term = 1.0, sum = 1.0;
        for (int k = 1; k < 60; ++k) {
            term *= quarter / (static_cast<double>(k) * static_cast<double>(k));
            sum += term;
            if (term < 1e-17 * sum) break;
        }
        return sum * std::exp(-x);
    }
    double term = 1.0, sum = 1.0;
    for (int k = 1; k < 40; ++k) {
        const double odd = 2.0 * k - 1.0;
        const double next = term * odd * odd / (8.0 * k * x);
        if (next >= term) break;  // the series is asymptotic: stop at its smallest term
        term = next;
        sum += term;
    }
    return sum / std::sqrt(2.0 * std::numbers::pi * x);
}

// Marschner 2003: R, TT, TRT have widths beta, beta/2, 2 beta and shifts alpha, -alpha/2, -3 alpha/2. alpha < 0 with
// the tangent from root to tip puts the R highlight toward the root. The widths are those of a Gaussian in theta_h.
FunctorType marschnerLobeShape() {
    FunctorType type;
    type.name = "MarschnerLobeShape";
    type.description = "Longitudinal widths and shifts (rad) of the R, TT and TRT lobes.";
    type.in = {port("betaM", ValueType::Float), port("tiltDeg", ValueType::Float)};
    type.out = {port("sigma", ValueType::Float3), port("shift", ValueType::Float3)};
    type.run = [](std::span<const Value> in, FunctorOutputs& out) {
        const float beta = in[0].number[0], alpha = in[1].number[0] * radiansPerDegree;
        const auto width = [](float wanted) { return std::max(wanted, 0.01F); };
        out.set(0, Value::float3(width(beta), width(0.5F * beta), width(2.0F * beta)));
        out.set(1, Value::float3(alpha, -0.5F * alpha, -1.5F * alpha));
    };
    return type;
}

// Karis' TRT azimuth is exp(17 cos phi - 16.78); the thesis (4.27) scales exponent and amplitude by s, which drives the
// energy to zero with s. Here the amplitude keeps the energy of s = 1: the integral over phi of exp(17 s cos phi) is
// 2 pi I0(17 s), so norm = e^-16.78 I0(17) / (e^(-16.78 s) I0(17 s)). With I0(x) = e^x I0e(x) the large exponents leave
// only e^(0.22 (1 - s)).
FunctorType azimuthalTrtScale() {
    FunctorType type;
    type.name = "AzimuthalTrtScale";
    type.description = "How sharp the TRT lobe is around the fibre, and the amplitude that keeps its energy.";
    type.in = {port("betaN", ValueType::Float)};
    type.out = {port("scale", ValueType::Float), port("norm", ValueType::Float)};
    type.run = [](std::span<const Value> in, FunctorOutputs& out) {
        const float scale = std::clamp(1.5F * (1.0F - in[0].number[0]), 0.05F, 1.5F);
        const double s = static_cast<double>(scale);
        const double norm = std::exp(0.22 * (1.0 - s)) * scaledBesselI0(17.0) / scaledBesselI0(17.0 * s);
        out.set(0, Value::scalar(scale));
        out.set(1, Value::scalar(static_cast<float>(norm)));
    };
    return type;
}

FunctorType lobeWeights() {
    FunctorType type;
    type.name = "LobeWeights";
    type.description = "Weights of the lobes; a lobe of weight zero is compiled out.";
    type.in = {port("enableR", ValueType::Bool),   port("weightR", ValueType::Float),
               port("enableTT", ValueType::Bool),  port("weightTT", ValueType::Float),
               port("enableTRT", ValueType::Bool), port("weightTRT", ValueType::Float)};
    type.out = {port("weights", ValueType::Float3), port("onR", ValueType::Bool), port("onTT", ValueType::Bool),
                port("onTRT", ValueType::Bool)};
    type.run = [](std::span<const Value> in, FunctorOutputs& out) {
        std::array<float, 3> weight{};
        for (std::size_t lobe = 0; lobe < 3; ++lobe) {
            weight[lobe] = in[2 * lobe].integer != 0 ? std::max(in[2 * lobe + 1].number[0], 0.0F) : 0.0F;
            out.set(lobe + 1, Value::boolean(weight[lobe] > 0.0F));
        }
        out.set(0, Value::float3(weight[0], weight[1], weight[2]));
    };
    return type;
}

// The integral of max(cos(theta_i - theta_r), 0)^p over the sphere at theta_r = 0 is
// 2 pi sqrt(pi) Gamma((p + 2) / 2) / Gamma((p + 3) / 2): 4.64 for p = 10, 1.74 for p = 80. Its inverse makes the
// highlight reflect `weight` at normal incidence. The ratio of gammas goes through logarithms: both overflow at p =
// 340.
FunctorType kajiyaSpecular() {
    FunctorType type;
    type.name = "KajiyaSpecular";
    type.description = "Kajiya-Kay highlight: exponent, its normalisation, and weights.";
    type.in = {port("enable", ValueType::Bool), port("exponent", ValueType::Float), port("weight", ValueType::Float)};
    type.out = {port("exponent", ValueType::Float), port("norm", ValueType::Float), port("weight", ValueType::Float),
                port("scale", ValueType::Float)};
    type.run = [](std::span<const Value> in, FunctorOutputs& out) {
        const float exponent = std::max(in[1].number[0], 0.0F);
        const double p = static_cast<double>(exponent);
        const double ratio = std::exp(std::lgamma(0.5 * (p + 2.0)) - std::lgamma(0.5 * (p + 3.0)));
        const double integral = 2.0 * std::numbers::pi * std::sqrt(std::numbers::pi) * ratio;
        out.set(0, Value::scalar(exponent));
        out.set(1, Value::scalar(static_cast<float>(1.0 / integral)));
        out.set(2, in[2]);
        out.set(3, Value::scalar(in[0].integer != 0 ? 1.0F : 0.0F));
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
    const std::vector<std::string> modes{"off", "hard", "pcf", "exponential"};
    FunctorType type;
    type.name = "ShadowFalloff";
    type.description = "How shadows are looked up, and how fast light fades inside the hair (1/m).";
    type.in = {words("mode", modes), port("distance", ValueType::Float), port("radius", ValueType::Int)};
    type.out = {words("mode", modes), port("density", ValueType::Float), port("radius", ValueType::Int)};
    type.run = [](std::span<const Value> in, FunctorOutputs& out) {
        const bool isExponential = in[0].integer == 3;
        const float distance = std::max(in[1].number[0], 1e-6F);
        out.set(0, in[0]);
        out.set(1, Value::scalar(isExponential ? std::numbers::ln10_v<float> / distance : 0.0F));
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

// One irradiance sample stands for a whole environment, so the lobes are widened by `boost` for it.
FunctorType environmentSample() {
    FunctorType type = environmentScale();
    type.name = "EnvironmentSample";
    type.description = "Light from the environment through lobes widened for it.";
    type.in.push_back(port("boost", ValueType::Float));
    type.in.push_back(port("betaM", ValueType::Float));
    type.out.push_back(port("roughness", ValueType::Float));
    type.run = [base = type.run](std::span<const Value> in, FunctorOutputs& out) {
        base(in, out);
        out.set(2, Value::scalar(std::clamp(in[3].number[0] + in[2].number[0], 0.0F, 1.0F)));
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
    registry.add(marschnerLobeShape());
    registry.add(azimuthalTrtScale());
    registry.add(lobeWeights());
    registry.add(kajiyaSpecular());
    registry.add(strandIdVariation());
    registry.add(shadowFalloff());
    registry.add(environmentScale());
    registry.add(environmentSample());
    registry.add(constantScatter());
    return registry;
}

}  // namespace pelage::hair
