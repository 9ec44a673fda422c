// SPDX-License-Identifier: MIT
// What the functors compute: every output of every functor of hair against a closed form written here.
#include "support.hpp"

#include <pelage/hair/scattering.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <set>

using namespace pelage;
using namespace pelage::materials;

namespace {

using Values = std::map<std::string, Value>;

struct Outputs {
    Values values = {};
    std::map<std::string, StateOverlay> states = {};
};

Value word(std::string text) {
    return {ValueType::Enum, {}, -1, std::move(text)};
}
Value float4(double x, double y, double z, double w) {
    return {ValueType::Float4,
            {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), static_cast<float>(w)},
            0,
            {}};
}
Value scalar(double x) {
    return Value::scalar(static_cast<float>(x));
}

// Of inputs by name; words get the index that they have at their port.
Outputs run(const std::string& name, Values in) {
    const FunctorRegistry registry = hair::functorRegistry();
    const FunctorType* type = registry.find(name);
    if (!type) {
        ADD_FAILURE() << "no functor " << name;
        return {};
    }
    std::vector<Value> ordered;
    for (const Port& port : type->in) {
        const auto given = in.find(port.name);
        if (given == in.end()) {
            ADD_FAILURE() << name << " has an input " << port.name;
            return {};
        }
        Value& value = ordered.emplace_back(given->second);
        EXPECT_EQ(value.type, port.type) << name << "." << port.name;
        if (value.type == ValueType::Enum) {
            const auto found = std::find(port.words.begin(), port.words.end(), value.text);
            EXPECT_NE(found, port.words.end()) << name << "." << port.name << " has no word " << value.text;
            value.integer = found - port.words.begin();
        }
        in.erase(given);
    }
    for (const auto& [unknown, value] : in) ADD_FAILURE() << name << " has no input " << unknown;
    FunctorOutputs out;
    type->run(ordered, out);
    Outputs named;
    for (const auto& [index, value] : out.values()) named.values.emplace(type->out.at(index).name, value);
    for (const auto& [index, state] : out.states()) named.states.emplace(type->out.at(index).name, state);
    return named;
}

void expectValue(const Value& found, const Value& expected, const std::string& where) {
    EXPECT_EQ(found.type, expected.type) << where;
    EXPECT_EQ(found.text, expected.text) << where;
    if (expected.type != ValueType::Enum) {
        EXPECT_EQ(found.integer, expected.integer) << where;
    }
    for (std::size_t i = 0; i < 4; ++i) {
        const float tolerance = 1e-6F * std::max(std::abs(expected.number[i]), 1e-6F);
        EXPECT_NEAR(found.number[i], expected.number[i], tolerance) << where << " [" << i << "]";
    }
}

struct Case {
    std::string functor, what;
    Values in, out;
};

void expectAll(const Case& row) {
    const Outputs found = run(row.functor, row.in);
    std::set<std::string> made, expected;
    for (const auto& [name, value] : found.values) made.insert(name);
    for (const auto& [name, value] : row.out) expected.insert(name);
    EXPECT_EQ(made, expected) << row.functor << ", " << row.what;
    for (const auto& [name, value] : row.out) {
        const auto it = found.values.find(name);
        if (it != found.values.end()) expectValue(it->second, value, row.functor + "." + name + ", " + row.what);
    }
}

const Value on = Value::boolean(true), off = Value::boolean(false);
constexpr double degree = std::numbers::pi / 180;

// FiberColor: all with the same inputs but the mode and what a case is about.
Case color(std::string mode, std::string what, const Values& inputs, const Values& outputs) {
    Values in{{"mode", word(std::move(mode))},   {"color", Value::color(0.5F, 0.4F, 0.3F)},
              {"map", Value::texture("a.png")},  {"useMap", on},
              {"eumelanin", Value::scalar(2)},   {"pheomelanin", Value::scalar(0.5F)},
              {"sigma", Value::float3(1, 2, 3)}, {"betaN", Value::scalar(0.4F)}};
    for (const auto& [name, value] : inputs) in[name] = value;
    // Chiang et al. 2016, equation 9, at beta_N 0.4.
    const double b = 0.4;
    const double fit =
        5.969 - 0.215 * b + 2.532 * b * b - 10.73 * b * b * b + 5.574 * std::pow(b, 4) + 0.245 * std::pow(b, 5);
    Values out{{"color", in["color"]},   {"map", in["map"]}, {"useMap", on}, {"sigma", Value::float3(0, 0, 0)},
               {"fit", scalar(1 / fit)}, {"chiang", off}};
    for (const auto& [name, value] : outputs) out[name] = value;
    return {"FiberColor", std::move(what), in, out};
}

// Chiang et al. 2016, equation 7 (R) and its quarter and four times; d'Eon et al. 2011 for the norm.
struct Lobe {
    double variance;
    double inverse() const { return 1 / variance; }
    double norm() const { return 1 / (variance * (1 - std::exp(-2 / variance))); }
    double deviation() const { return std::sqrt(variance); }
};
std::array<Lobe, 4> lobes(double betaM, const std::array<double, 3>& widths) {
    const double v = std::pow(0.726 * betaM + 0.812 * betaM * betaM + 3.7 * std::pow(betaM, 20), 2);
    return {Lobe{v * widths[0] * widths[0]}, Lobe{v / 4 * widths[1] * widths[1]}, Lobe{4 * v * widths[2] * widths[2]},
            Lobe{4 * v}};
}

Case shape(const std::string& model, double boost) {
    const double eta = 1.5, betaM = 0.4, betaN = 0.25, tilt = -3;
    const bool isPxr = model == "pxr";
    const std::array<double, 3> widths = isPxr ? std::array{1.5, 0.5, 2.0} : std::array{1.0, 1.0, 1.0};
    const std::array<double, 3> shifts = isPxr ? std::array{1.0, -2.0, 3.0} : std::array{0.0, 0.0, 0.0};
    // Equation 8, and the logistic trimmed to one turn.
    const double s =
        std::sqrt(std::numbers::pi / 8) * (0.265 * betaN + 1.194 * betaN * betaN + 5.372 * std::pow(betaN, 22));
    const auto narrow = lobes(betaM, widths), wide = lobes(std::min(betaM + std::max(boost, 0.0), 1.0), widths);
    const auto each = [](const std::array<Lobe, 4>& of, double (Lobe::*value)() const) {
        return float4((of[0].*value)(), (of[1].*value)(), (of[2].*value)(), (of[3].*value)());
    };
    const double r = (-2 * tilt + shifts[0]) * degree, tt = (tilt + shifts[1]) * degree,
                 trt = (4 * tilt + shifts[2]) * degree;
    const bool hasTable = isPxr || model == "moment_lut" || model == "gerard";
    return {"FiberShape",
            model,
            {{"model", word(model)},
             {"ior", scalar(eta)},
             {"betaM", scalar(betaM)},
             {"betaN", scalar(betaN)},
             {"tiltDeg", scalar(tilt)},
             {"widths", Value::float3(1.5F, 0.5F, 2)},
             {"shifts", Value::float3(1, -2, 3)},
             {"glintGain", scalar(0.75)},
             {"glintWidth", scalar(8)},
             {"glintShift", scalar(6)},
             {"envBoost", scalar(boost)}},
            {{"eta", scalar(eta)},
             {"etaExcess", scalar(1.25)},
             {"alpha", scalar(tilt * degree)},
             {"betaN", scalar(betaN)},
             {"inverseScale", scalar(1 / s)},
             {"peak", scalar(1 / (s * std::tanh(std::numbers::pi / (2 * s))))},
             {"inverseVariance", each(narrow, &Lobe::inverse)},
             {"norm", each(narrow, &Lobe::norm)},
             {"deviation", each(narrow, &Lobe::deviation)},
             {"sinTilt", float4(std::sin(r), std::sin(tt), std::sin(trt), 0)},
             {"cosTilt", float4(std::cos(r), std::cos(tt), std::cos(trt), 1)},
             {"glint", float4(0.75, 1 / (8 * degree), std::cos(6 * degree), std::sin(6 * degree))},
             {"inverseVarianceWide", each(wide, &Lobe::inverse)},
             {"normWide", each(wide, &Lobe::norm)},
             {"deviationWide", each(wide, &Lobe::deviation)},
             {"table", Value::texture(hasTable ? "moments:1.5,0.25" : "moments:none")}}};
}

Case kajiya(bool enable, double exponent) {
    // The integral of cos^p(theta) cos(theta) over theta and phi, midpoint rule.
    constexpr int steps = 20000;
    double integral = 0;
    for (int i = 0; i < steps; ++i) {
        const double theta = std::numbers::pi * ((i + 0.5) / steps - 0.5);
        integral += std::pow(std::cos(theta), exponent + 1.0);
    }
    integral *= 2.0 * std::numbers::pi * std::numbers::pi / steps;
    return {"KajiyaSpecular",
            "exponent " + std::to_string(exponent),
            {{"enable", Value::boolean(enable)}, {"exponent", scalar(exponent)}, {"weight", scalar(0.25)}},
            {{"exponent", scalar(exponent)}, {"norm", scalar(1 / integral)}, {"weight", scalar(enable ? 0.25 : 0)}}};
}

std::vector<Case> cases() {
    const Value map = Value::texture("ids.png"), white = Value::color(1, 1, 1);
    std::vector<Case> all{
        color("pathColor", "made in the shader", {}, {}),
        color("pathColor", "map off", {{"useMap", off}}, {{"useMap", off}}),
        color("pathColor", "no map", {{"map", Value::texture("")}}, {{"map", Value::texture("")}, {"useMap", off}}),
        color("pathColor", "white map", {{"map", Value::texture("builtin.white")}},
              {{"useMap", off}, {"map", Value::texture("builtin.white")}}),
        color("color", "by Chiang's law", {}, {{"chiang", on}}),
        // Constants of pbrt after d'Eon et al. 2011; two parts of eumelanin, half a part of pheomelanin.
        color("melanin", "pigments", {},
              {{"color", white}, {"sigma", Value::float3(0.838F + 0.0935F, 1.394F + 0.2F, 2.74F + 0.525F)}}),
        color("melanin", "red pigment", {{"eumelanin", Value::scalar(0)}, {"pheomelanin", Value::scalar(1)}},
              {{"color", white}, {"sigma", Value::float3(0.187F, 0.4F, 1.05F)}}),
        color("sigma", "as it is", {}, {{"color", white}, {"sigma", Value::float3(1, 2, 3)}}),
        color("sigma", "in its range", {{"sigma", Value::float3(-1, 2e4F, 3)}},
              {{"color", white}, {"sigma", Value::float3(0, 1e4F, 3)}}),
        {"LobeWeights",
         "one off by weight, one by its switch, one by its tint",
         {{"enableR", on},
          {"weightR", scalar(0)},
          {"tintR", white},
          {"enableTT", off},
          {"weightTT", scalar(1)},
          {"tintTT", white},
          {"enableTRT", on},
          {"weightTRT", scalar(0.5)},
          {"tintTRT", Value::color(1, 0.5F, 0)},
          {"enableRES", on},
          {"weightRES", scalar(1)},
          {"tintRES", Value::color(0, 0, 0)}},
         {{"gainR", Value::color(0, 0, 0)},
          {"gainTT", Value::color(0, 0, 0)},
          {"gainTRT", Value::color(0.5F, 0.25F, 0)},
          {"gainRES", Value::color(0, 0, 0)},
          {"onR", off},
          {"onTT", off},
          {"onTRT", on},
          {"onRES", off}}},
        {"LobeWeights",
         "all on; a weight below zero",
         {{"enableR", on},
          {"weightR", scalar(2)},
          {"tintR", Value::color(0.1F, 0.2F, 0.3F)},
          {"enableTT", on},
          {"weightTT", scalar(3)},
          {"tintTT", Value::color(0, 0.5F, 0)},
          {"enableTRT", on},
          {"weightTRT", scalar(-1)},
          {"tintTRT", white},
          {"enableRES", on},
          {"weightRES", scalar(1)},
          {"tintRES", Value::color(0, 0, 0.25F)}},
         {{"gainR", Value::color(0.2F, 0.4F, 0.6F)},
          {"gainTT", Value::color(0, 1.5F, 0)},
          {"gainTRT", Value::color(0, 0, 0)},
          {"gainRES", Value::color(0, 0, 0.25F)},
          {"onR", on},
          {"onTT", on},
          {"onTRT", off},
          {"onRES", on}}},
        kajiya(true, 1),
        kajiya(true, 10),
        kajiya(true, 80),
        kajiya(false, 1000),
        {"StrandIdVariation",
         "on",
         {{"map", map}, {"useMap", on}, {"amount", scalar(0.25)}},
         {{"map", map}, {"useMap", on}, {"amplitude", scalar(0.25)}}},
        {"StrandIdVariation",
         "off",
         {{"map", map}, {"useMap", off}, {"amount", scalar(0.25)}},
         {{"map", map}, {"useMap", off}, {"amplitude", scalar(0)}}},
        {"StrandIdVariation",
         "of nothing",
         {{"map", map}, {"useMap", on}, {"amount", scalar(-1)}},
         {{"map", map}, {"useMap", off}, {"amplitude", scalar(0)}}},
        {"EnvironmentScale", "on", {{"enable", on}, {"intensity", scalar(2)}}, {{"on", on}, {"scale", scalar(2)}}},
        {"EnvironmentScale", "off", {{"enable", off}, {"intensity", scalar(2)}}, {{"on", off}, {"scale", scalar(0)}}},
        {"EnvironmentScale", "dark", {{"enable", on}, {"intensity", scalar(0)}}, {{"on", off}, {"scale", scalar(0)}}},
        {"ConstantScatter",
         "on",
         {{"mode", word("constant")}, {"factor", scalar(0.5)}},
         {{"on", on}, {"amount", scalar(0.5)}}},
        {"ConstantScatter",
         "off",
         {{"mode", word("off")}, {"factor", scalar(0.5)}},
         {{"on", off}, {"amount", scalar(0)}}},
        {"ConstantScatter",
         "of nothing",
         {{"mode", word("constant")}, {"factor", scalar(0)}},
         {{"on", off}, {"amount", scalar(0)}}}};
    for (const hair::ModelInfo& info : hair::scatteringModels()) all.push_back(shape(std::string(info.id), 0.15));
    all.push_back(shape("moment_lut", -0.2));
    all.push_back(shape("moment_lut", 0.9));
    // A tenth of the light is left at `distance`: ln 10 / 0.03 m.
    for (const char* mode : {"off", "hard", "pcf", "exponential"}) {
        const double density = mode == std::string_view("exponential") ? 76.752836433134857 : 0;
        all.push_back({"ShadowFalloff",
                       mode,
                       {{"mode", word(mode)}, {"distance", scalar(0.03)}, {"radius", Value::int32(2)}},
                       {{"mode", word(mode)}, {"density", scalar(density)}, {"radius", Value::int32(2)}}});
    }
    return all;
}

}  // namespace

TEST(Functors, EveryOutputIsItsClosedForm) {
    std::set<std::string> covered;
    for (const Case& row : cases()) {
        expectAll(row);
        covered.insert(row.functor);
    }
    for (const std::string& name : FunctorRegistry::standard().names()) covered.insert(name);
    const std::vector<std::string> names = hair::functorRegistry().names();
    EXPECT_EQ(covered, std::set<std::string>(names.begin(), names.end())) << "a functor without a case above";
}

// Peaks of highlights and lobes as their papers print them, so that the forms above are not the product's own.
TEST(Functors, KajiyaHighlightHasTheIntegralsOfTheThesis) {
    const auto integral = [](double exponent) {
        return 1 / run("KajiyaSpecular", {{"enable", on}, {"exponent", scalar(exponent)}, {"weight", scalar(1)}})
                       .values.at("norm")
                       .number[0];
    };
    EXPECT_NEAR(integral(10), 4.64F, 0.005F);
    EXPECT_NEAR(integral(80), 1.74F, 0.005F);
    EXPECT_EQ(run("KajiyaSpecular", {{"enable", on}, {"exponent", scalar(-1)}, {"weight", scalar(1)}})
                  .values.at("exponent")
                  .number[0],
              0.0F);
}

// The three laws by which colours become absorption, at the ends of their ranges too.
TEST(Functors, AbsorptionLawsAreThoseOfTheirPapers) {
    EXPECT_NEAR(std::exp(-4 * hair::sigmaFromPathColor(0.3)), 0.3, 1e-14) << "two paths through the axis";
    EXPECT_EQ(hair::sigmaFromPathColor(1), 0);
    EXPECT_NEAR(hair::sigmaFromPathColor(0), std::log(1e4) / 4, 1e-14);
    const double fit = 5.969 - 0.215 + 2.532 - 10.73 + 5.574 + 0.245;  // Chiang 2016 (9) at beta_N 1
    EXPECT_NEAR(hair::sigmaFromColor(0.2, 1), std::pow(std::log(0.2) / fit, 2), 1e-12);
    EXPECT_EQ(hair::sigmaFromMelanin(1, 0), (std::array{0.419, 0.697, 1.37}));
    EXPECT_EQ(hair::sigmaFromMelanin(0, 1), (std::array{0.187, 0.4, 1.05}));
    EXPECT_EQ(hair::sigmaFromMelanin(-1, -1), (std::array{0.0, 0.0, 0.0}));
}

TEST(Functors, FresnelAndTexturedColor) {
    const Outputs fresnel = run("FresnelFromIor", {{"ior", Value::scalar(1.55F)}});
    expectValue(fresnel.values.at("f0"), scalar(std::pow(0.55 / 2.55, 2)), "f0");
    expectValue(fresnel.values.at("eta"), Value::scalar(1.55F), "eta");
    const auto textured = [](const char* map, const Value& use) {
        return run("TexturedColor", {{"color", Value::color(1, 0, 0)}, {"map", Value::texture(map)}, {"useMap", use}});
    };
    EXPECT_EQ(textured("builtin.white", on).values.at("useMap").integer, 0);
    EXPECT_EQ(textured("a.png", off).values.at("useMap").integer, 0);
    EXPECT_EQ(textured("a.png", on).values.at("useMap").integer, 1);
}

TEST(Functors, BlendModeDecidesDrawListsAndStates) {
    for (const std::string mode : {"opaque", "alphaTest", "alphaToCoverage", "hashedAlpha", "alphaBlend"}) {
        const bool isBlend = mode == "alphaBlend", twoSided = mode != "alphaTest";
        const Outputs out = run("BlendModeToPipeline", {{"mode", word(mode)},
                                                        {"threshold", Value::scalar(0.5F)},
                                                        {"hashScale", Value::scalar(2)},
                                                        {"doubleSided", Value::boolean(twoSided)}});
        const std::map<std::string, std::string> words{{"opaque", "opaque"},
                                                       {"alphaTest", "test"},
                                                       {"alphaToCoverage", "coverage"},
                                                       {"hashedAlpha", "hashed"},
                                                       {"alphaBlend", "blend"}};
        EXPECT_EQ(out.values.at("alphaMode").text, words.at(mode));
        expectValue(out.values.at("threshold"), Value::scalar(0.5F), mode);
        expectValue(out.values.at("hashScale"), Value::scalar(2), mode);
        EXPECT_EQ(out.values.at("depthEnabled").integer != 0, !isBlend);
        EXPECT_EQ(out.values.at("forwardEnabled").integer != 0, !isBlend);
        EXPECT_EQ(out.values.at("blendEnabled").integer != 0, isBlend);
        EXPECT_EQ(out.states.at("depthState").alphaToCoverage, mode == "alphaToCoverage");
        EXPECT_EQ(out.states.at("forwardState").depthTest, DepthTest::Equal);
        EXPECT_EQ(out.states.at("forwardState").depthWrite, false);
        EXPECT_EQ(out.states.at("blendState").blend, Blend::Premultiplied);
        EXPECT_EQ(out.states.at("shadowState").cull, twoSided ? rhi::CullMode::None : rhi::CullMode::Back);
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
