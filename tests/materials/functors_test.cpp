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

}  // namespace

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
    }
    EXPECT_EQ(scalar(run("KajiyaSpecular", {Value::boolean(false), Value::scalar(9), Value::scalar(1)}), 2), 0.0);
}

namespace {
// Inputs of FiberShape: model, index, roughnesses, tilt, widths, shifts, glint, boost for the environment.
std::vector<Value> shape(std::int64_t model, float betaM, float betaN, float tilt, float boost) {
    return {{ValueType::Enum, {}, model, {}},
            Value::scalar(1.55F),
            Value::scalar(betaM),
            Value::scalar(betaN),
            Value::scalar(tilt),
            Value::float3(1, 1, 1),
            Value::float3(0, 0, 0),
            Value::scalar(0),
            Value::scalar(5),
            Value::scalar(0),
            Value::scalar(boost)};
}
}  // namespace

// Chiang 2016 (7): v0 = (0.726 b + 0.812 b^2 + 3.7 b^20)^2, v0 / 4, 4 v0; tilts -2, 1, 4 alpha on theta_o.
TEST(Functors, LobesHaveChiangsWidthsAndTilts) {
    const FunctorOutputs out = run("FiberShape", shape(8, 0.3F, 0.3F, -3.0F, 0.2F));
    const auto& inverse = out.values().at(2).number;
    const float root = 0.726F * 0.3F + 0.812F * 0.09F;
    EXPECT_NEAR(1 / inverse[0], root * root, 1e-6F);
    EXPECT_NEAR(inverse[1] / inverse[0], 4, 1e-5F);
    EXPECT_NEAR(inverse[2] / inverse[0], 0.25F, 1e-6F);
    EXPECT_NEAR(out.values().at(5).number[0], std::sin(6 * std::numbers::pi_v<float> / 180), 1e-6F);
    EXPECT_NEAR(out.values().at(5).number[2], -std::sin(12 * std::numbers::pi_v<float> / 180), 1e-6F);
    EXPECT_LT(out.values().at(8).number[0], inverse[0]) << "wider for the environment";
    EXPECT_EQ(out.values().at(11).text, "moments:1.55,0.3");
    EXPECT_EQ(run("FiberShape", shape(3, 0.3F, 0.3F, 0, 0)).values().at(11).text, "moments:none") << "karis";
}

// exp(-4 sigma) = C in the shader, or here: pigments by their constants, and Chiang's fit of ln C.
TEST(Functors, AbsorptionComesFromOneSource) {
    const auto color = [](std::int64_t mode) {
        return std::vector<Value>{{ValueType::Enum, {}, mode, {}},
                                  Value::color(0.5F, 0.4F, 0.3F),
                                  Value::texture("a.png"),
                                  Value::boolean(true),
                                  Value::scalar(2),
                                  Value::scalar(1),
                                  Value::float3(0.1F, 0.2F, 0.3F),
                                  Value::scalar(0.3F)};
    };
    const auto path = run("FiberColor", color(0)), mass = run("FiberColor", color(1));
    EXPECT_EQ(path.values().at(3).number[0], 0) << "all of it is made in the shader";
    EXPECT_EQ(path.values().at(5).integer, 0);
    EXPECT_EQ(mass.values().at(5).integer, 1);
    EXPECT_NEAR(scalar(mass, 4), 1 / 5.88842, 1e-4);
    EXPECT_EQ(scalar(mass, 0), 0.5F);
    const auto melanin = run("FiberColor", color(2)), sigma = run("FiberColor", color(3));
    EXPECT_NEAR(melanin.values().at(3).number[2], 2 * 1.37F + 1.05F, 1e-5F);
    EXPECT_EQ(scalar(melanin, 0), 1) << "white: its map alone is left of the base colour";
    EXPECT_EQ(sigma.values().at(3).number[1], 0.2F);
}

TEST(Functors, WeightZeroTurnsTheLobeOff) {
    const auto on = [](bool value) { return Value::boolean(value); };
    const Value white = Value::color(1, 1, 1);
    const FunctorOutputs out = run("LobeWeights", {on(true), Value::scalar(0), white, on(false), Value::scalar(1),
                                                   white, on(true), Value::scalar(0.5F), Value::color(1, 0.5F, 0),
                                                   on(true), Value::scalar(1), Value::color(0, 0, 0)});
    for (const std::size_t off : {4U, 5U, 7U}) EXPECT_EQ(out.values().at(off).integer, 0);
    EXPECT_EQ(out.values().at(6).integer, 1);
    EXPECT_EQ(out.values().at(2).number, (std::array<float, 4>{0.5F, 0.25F, 0, 1}));
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
    EXPECT_EQ(hair::functorRegistry().names().size(), 11U);
}
