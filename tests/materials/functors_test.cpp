// SPDX-License-Identifier: MIT
// What the functors compute, checked against quadrature and closed forms that are not theirs.
#include "support.hpp"

#include <array>
#include <cmath>
#include <numbers>

using namespace pelage;
using namespace pelage::materials;

namespace {

FunctorOutputs run(std::string_view name, const std::vector<Value>& in) {
    const FunctorRegistry registry = hair::functorRegistry();
    const FunctorType* type = registry.find(name);
    FunctorOutputs out;
    if (!type) {
        ADD_FAILURE() << "no functor " << name;
        return out;
    }
    EXPECT_EQ(type->in.size(), in.size());
    type->run(in, out);
    return out;
}

double scalar(const FunctorOutputs& out, std::size_t port) {
    return static_cast<double>(out.values().at(port).number[0]);
}

// The integral of the TRT azimuth over phi, by the trapezoid rule: exact for smooth periodic functions.
double azimuthalEnergy(double scale, double norm) {
    constexpr int steps = 4096;
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        sum += norm * std::exp(scale * (17.0 * std::cos(2.0 * std::numbers::pi * i / steps) - 16.78));
    return sum * 2.0 * std::numbers::pi / steps;
}

}  // namespace

TEST(Functors, AzimuthKeepsItsEnergyAtEveryRoughness) {
    const double wanted = azimuthalEnergy(1.0, 1.0);
    for (const float betaN : {0.0F, 0.1F, 0.2F, 1.0F / 3.0F, 0.5F, 0.6F, 0.8F, 0.9F, 0.95F, 1.0F}) {
        const FunctorOutputs out = run("AzimuthalTrtScale", {Value::scalar(betaN)});
        const double scale = scalar(out, 0), norm = scalar(out, 1);
        EXPECT_NEAR(scale, std::min(1.5, std::max(0.05, 1.5 * (1.0 - static_cast<double>(betaN)))), 1e-6);
        EXPECT_NEAR(azimuthalEnergy(scale, norm) / wanted, 1.0, 2e-6) << "betaN " << betaN;
    }
    // The printed (4.27), norm = scale, loses it: what this functor is for.
    EXPECT_LT(azimuthalEnergy(0.3, 0.3) / wanted, 0.6);
    EXPECT_LT(azimuthalEnergy(0.05, 0.05) / wanted, 0.3);
}

TEST(Functors, KajiyaHighlightReflectsItsWeight) {
    for (const float exponent : {1.0F, 10.0F, 80.0F, 1000.0F}) {
        const FunctorOutputs out =
            run("KajiyaSpecular", {Value::boolean(true), Value::scalar(exponent), Value::scalar(0.5F)});
        const double p = static_cast<double>(exponent), norm = scalar(out, 1);
        constexpr int steps = 20000;
        double integral = 0;  // of cos(theta)^p cos(theta) over theta and phi, midpoint rule
        for (int i = 0; i < steps; ++i) {
            const double theta = std::numbers::pi * ((i + 0.5) / steps - 0.5);
            integral += std::pow(std::cos(theta), p + 1.0);
        }
        integral *= 2.0 * std::numbers::pi * std::numbers::pi / steps;
        EXPECT_NEAR(integral * norm, 1.0, 1e-6) << exponent;
        if (exponent == 10.0F) {
            EXPECT_NEAR(1.0 / norm, 4.64, 0.005);
        }
        if (exponent == 80.0F) {
            EXPECT_NEAR(1.0 / norm, 1.74, 0.005);
        }
        EXPECT_EQ(scalar(out, 2), 0.5);
        EXPECT_EQ(scalar(out, 3), 1.0);
    }
    EXPECT_EQ(scalar(run("KajiyaSpecular", {Value::boolean(false), Value::scalar(9), Value::scalar(1)}), 3), 0.0);
}

TEST(Functors, LobesHaveMarschnersWidthsAndShifts) {
    const FunctorOutputs out = run("MarschnerLobeShape", {Value::scalar(0.2F), Value::scalar(-7.0F)});
    const auto& sigma = out.values().at(0).number;
    const auto& shift = out.values().at(1).number;
    const float alpha = -7.0F * std::numbers::pi_v<float> / 180.0F;
    EXPECT_FLOAT_EQ(sigma[0], 0.2F);
    EXPECT_FLOAT_EQ(sigma[1], 0.1F);
    EXPECT_FLOAT_EQ(sigma[2], 0.4F);
    EXPECT_FLOAT_EQ(shift[0], alpha);
    EXPECT_FLOAT_EQ(shift[1], -alpha / 2);
    EXPECT_FLOAT_EQ(shift[2], -1.5F * alpha);
    EXPECT_LT(shift[0], 0) << "R toward the root";
    const FunctorOutputs thin = run("MarschnerLobeShape", {Value::scalar(0.001F), Value::scalar(0.0F)});
    for (std::size_t i = 0; i < 3; ++i) EXPECT_FLOAT_EQ(thin.values().at(0).number[i], 0.01F);
}

TEST(Functors, WeightZeroTurnsTheLobeOff) {
    const auto on = [](bool value) { return Value::boolean(value); };
    const FunctorOutputs out =
        run("LobeWeights", {on(true), Value::scalar(0), on(false), Value::scalar(1), on(true), Value::scalar(0.5F)});
    EXPECT_EQ(out.values().at(1).integer, 0);
    EXPECT_EQ(out.values().at(2).integer, 0);
    EXPECT_EQ(out.values().at(3).integer, 1);
    EXPECT_EQ(out.values().at(0).number, (std::array<float, 4>{0, 0, 0.5F, 0}));
}

TEST(Functors, FresnelShadowEnvironmentAmbientAndStrands) {
    const FunctorOutputs fresnel = run("FresnelFromIor", {Value::scalar(1.55F)});
    EXPECT_NEAR(scalar(fresnel, 0), 0.0465, 1e-4);
    EXPECT_FLOAT_EQ(fresnel.values().at(1).number[0], 1.55F);

    const Value exponential{ValueType::Enum, {}, 3, "exponential"}, hard{ValueType::Enum, {}, 1, "hard"};
    const FunctorOutputs shadow = run("ShadowFalloff", {exponential, Value::scalar(0.03F), Value::int32(2)});
    EXPECT_NEAR(std::exp(-scalar(shadow, 1) * 0.03), 0.1, 1e-6);
    EXPECT_EQ(shadow.values().at(2).integer, 2);
    EXPECT_EQ(scalar(run("ShadowFalloff", {hard, Value::scalar(0.03F), Value::int32(1)}), 1), 0.0);

    const std::vector<Value> environment{Value::boolean(true), Value::scalar(2), Value::scalar(0.9F),
                                         Value::scalar(0.2F)};
    EXPECT_EQ(scalar(run("EnvironmentSample", environment), 2), 1.0);
    EXPECT_EQ(run("EnvironmentScale", {Value::boolean(true), Value::scalar(0)}).values().at(0).integer, 0);
    EXPECT_EQ(run("EnvironmentScale", {Value::boolean(false), Value::scalar(1)}).values().at(0).integer, 0);
    EXPECT_EQ(scalar(run("EnvironmentScale", {Value::boolean(true), Value::scalar(2)}), 1), 2.0);

    const Value off{ValueType::Enum, {}, 0, "off"}, constant{ValueType::Enum, {}, 1, "constant"};
    EXPECT_EQ(run("ConstantScatter", {off, Value::scalar(0.5F)}).values().at(0).integer, 0);
    EXPECT_EQ(run("ConstantScatter", {constant, Value::scalar(0)}).values().at(0).integer, 0);
    EXPECT_EQ(scalar(run("ConstantScatter", {constant, Value::scalar(0.5F)}), 1), 0.5);

    const Value map = Value::texture("ids.png");
    EXPECT_EQ(scalar(run("StrandIdVariation", {map, Value::boolean(false), Value::scalar(1)}), 2), 0.0);
    EXPECT_EQ(run("StrandIdVariation", {map, Value::boolean(true), Value::scalar(0)}).values().at(1).integer, 0);
    EXPECT_EQ(run("TexturedColor", {Value::color(1, 0, 0), Value::texture("builtin.white"), Value::boolean(true)})
                  .values()
                  .at(2)
                  .integer,
              0);
    EXPECT_EQ(run("TexturedColor", {Value::color(1, 0, 0), map, Value::boolean(true)}).values().at(2).integer, 1);
}

TEST(Functors, BlendModeDecidesDrawListsAndStates) {
    const std::vector<std::string> words{"opaque", "alphaTest", "alphaToCoverage", "hashedAlpha", "alphaBlend"};
    for (std::size_t mode = 0; mode < words.size(); ++mode) {
        const Value word{ValueType::Enum, {}, static_cast<std::int64_t>(mode), words[mode]};
        const FunctorOutputs out =
            run("BlendModeToPipeline", {word, Value::scalar(0.5F), Value::scalar(1), Value::boolean(mode != 1)});
        const bool isBlend = mode == 4;
        EXPECT_EQ(out.values().at(0).integer, static_cast<std::int64_t>(mode));
        EXPECT_EQ(out.values().at(3).integer != 0, !isBlend);
        EXPECT_EQ(out.values().at(4).integer != 0, !isBlend);
        EXPECT_EQ(out.values().at(5).integer != 0, isBlend);
        EXPECT_EQ(out.states().at(7).alphaToCoverage, mode == 2);
        EXPECT_EQ(out.states().at(8).depthTest, DepthTest::Equal);
        EXPECT_EQ(out.states().at(8).depthWrite, false);
        EXPECT_EQ(out.states().at(9).blend, Blend::Premultiplied);
        EXPECT_EQ(out.states().at(6).cull, mode != 1 ? rhi::CullMode::None : rhi::CullMode::Back);
    }
}

TEST(Registry, NamesAreTakenOnce) {
    FunctorRegistry registry = FunctorRegistry::standard();
    EXPECT_EQ(registry.names(), (std::vector<std::string>{"BlendModeToPipeline", "FresnelFromIor", "TexturedColor"}));
    FunctorType type;
    type.name = "Mine";
    EXPECT_TRUE(registry.add(type));
    EXPECT_FALSE(registry.add(type));
    EXPECT_EQ(registry.find("Nobody"), nullptr);
    EXPECT_EQ(hair::functorRegistry().names().size(), 12U);
}
