// SPDX-License-Identifier: MIT
#include "functors_fiber.hpp"

#include "functor_ports.hpp"
#include "scattering/resolve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pelage::hair {
namespace {

constexpr double radiansPerDegree = std::numbers::pi / 180.0;

// Absorption is made in two places: what the material knows becomes `sigma` here; what changes over a surface (base
// colour, its map, the variation from strand to strand) is turned into absorption in the shader, by one of two laws.
struct FiberColor : Functor {
    enum class Mode { PathColor, Color, Melanin, Sigma };
    In<Mode> mode{
        this,
        "mode",
        {{"pathColor", Mode::PathColor}, {"color", Mode::Color}, {"melanin", Mode::Melanin}, {"sigma", Mode::Sigma}}};
    In<Color> base{this, "color"};
    In<Texture> map{this, "map"};
    In<bool> useMap{this, "useMap"};
    In<float> eumelanin{this, "eumelanin"};
    In<float> pheomelanin{this, "pheomelanin"};
    In<Float3> sigma{this, "sigma"};
    In<float> betaN{this, "betaN"};
    Out<Color> usedBase{this, "color"};
    Out<Texture> usedMap{this, "map"};
    Out<bool> isMapped{this, "useMap"};
    Out<Float3> absorption{this, "sigma"};
    Out<float> fit{this, "fit"};
    Out<bool> isChiangs{this, "chiang"};

    void run(const Call& call) const {
        std::array<double, 3> known{};
        if (call[mode] == Mode::Melanin) {
            known = sigmaFromMelanin(static_cast<double>(call[eumelanin]), static_cast<double>(call[pheomelanin]));
        }
        if (call[mode] == Mode::Sigma) {
            for (std::size_t c = 0; c < 3; ++c) {
                known[c] = std::clamp(static_cast<double>(call[sigma][c]), 0.0, 1e4);
            }
        }
        // With pigments or sigma the base colour is white and only its map is left of it.
        if (call[mode] == Mode::Melanin || call[mode] == Mode::Sigma) {
            call.set(usedBase, {1, 1, 1});
        } else {
            call.pass(base, usedBase);
        }
        const bool isWhite = call[map].empty() || call[map] == "builtin.white";
        call.pass(map, usedMap);
        call.set(isMapped, call[useMap] && !isWhite);
        Float3 told;
        narrow(known, told);
        call.set(absorption, told);
        // sigma = (fit ln C)^2, Chiang 2016 (9).
        const double roughness = static_cast<double>(call[betaN]);
        call.set(fit, static_cast<float>(std::sqrt(sigmaFromColor(std::exp(-1.0), roughness))));
        call.set(isChiangs, call[mode] == Mode::Color);
    }
};

Words<ScatteringModel> modelWords() {
    Words<ScatteringModel> words;
    for (const ModelInfo& info : scatteringModels()) words.emplace_back(info.id, info.model);
    return words;
}

// Its outputs are the members of the uniform block of fiber_material.glsl: those of fiber_parameters.def that a
// material has, and ...Wide of those that the wider lobes of the environment change.
struct FiberShape : Functor {
    In<ScatteringModel> model{this, "model", modelWords()};
    In<float> ior{this, "ior"};
    In<float> longitudinalRoughness{this, "betaM"};
    In<float> azimuthalRoughness{this, "betaN"};
    In<float> tilt{this, "tiltDeg"};
    In<Float3> widths{this, "widths"};
    In<Float3> shifts{this, "shifts"};
    In<float> glintGain{this, "glintGain"};
    In<float> glintWidth{this, "glintWidth"};
    In<float> glintShift{this, "glintShift"};
    In<float> envBoost{this, "envBoost"};
    using real = float;
    using real4 = Float4;
#define FIBER_PARAMETER(type, name) Out<type> name{this, #name};
#define FIBER_POINT(type, name)
#include "scattering/fiber_parameters.def"
#define FIBER_PARAMETER(type, name)
#define FIBER_WIDTH(type, name) Out<type> name##Wide{this, #name "Wide"};
#define FIBER_POINT(type, name)
#include "scattering/fiber_parameters.def"
    Out<Texture> table{this, "table"};

    void run(const Call& call) const {
        const ModelInfo* info = findScatteringModel(call[model]);
        const auto at = [&](In<float> port) { return static_cast<double>(call[port]); };
        FiberProperties fiber;
        fiber.eta = at(ior);
        fiber.betaM = at(longitudinalRoughness);
        fiber.betaN = at(azimuthalRoughness);
        fiber.alpha = at(tilt) * radiansPerDegree;
        // What the controls were set to for a model that has them means nothing to the others.
        for (std::size_t p = 0; info && info->controls && p < 3; ++p) {
            fiber.widthScale[p] = static_cast<double>(call[widths][p]);
            fiber.shift[p] = static_cast<double>(call[shifts][p]) * radiansPerDegree;
        }
        fiber.glintGain = at(glintGain);
        fiber.glintWidth = at(glintWidth);
        fiber.glintShift = at(glintShift);
        const ResolvedFiber resolved = resolveFiber(fiber);
        // One irradiance sample stands for a whole environment, so the lobes are widened for it (Karis 2016).
        fiber.betaM += std::max(at(envBoost), 0.0);
        const ResolvedFiber widened = resolveFiber(fiber);
        const auto write = [&](auto port, const auto& number) {
            typename decltype(port)::Type narrowed{};
            narrow(number, narrowed);
            call.set(port, narrowed);
        };
#define FIBER_PARAMETER(type, name) write(name, resolved.name);
#define FIBER_POINT(type, name)
#include "scattering/fiber_parameters.def"
#define FIBER_PARAMETER(type, name)
#define FIBER_WIDTH(type, name) write(name##Wide, widened.name);
#define FIBER_POINT(type, name)
#include "scattering/fiber_parameters.def"
        call.set(table, info && info->usesTable ? momentTableName(resolved.eta, resolved.betaN)
                                                : std::string(momentTableNone));
    }
};

// A lobe whose weight is zero is compiled out.
struct LobeWeights : Functor {
    struct Lobe {
        In<bool> enable;
        In<float> weight;
        In<Color> tint;
    };
    Lobe lobe(const std::string& name) {
        return {{this, "enable" + name}, {this, "weight" + name}, {this, "tint" + name}};
    }
    std::array<Lobe, 4> lobes{lobe("R"), lobe("TT"), lobe("TRT"), lobe("RES")};
    std::array<Out<Color>, 4> gains{{{this, "gainR"}, {this, "gainTT"}, {this, "gainTRT"}, {this, "gainRES"}}};
    std::array<Out<bool>, 4> on{{{this, "onR"}, {this, "onTT"}, {this, "onTRT"}, {this, "onRES"}}};

    void run(const Call& call) const {
        for (std::size_t p = 0; p < lobes.size(); ++p) {
            const float weight = call[lobes[p].enable] ? std::max(call[lobes[p].weight], 0.0F) : 0.0F;
            const Float4& tint = call[lobes[p].tint];
            call.set(gains[p], {weight * tint[0], weight * tint[1], weight * tint[2]});
            call.set(on[p], weight > 0.0F && (tint[0] > 0.0F || tint[1] > 0.0F || tint[2] > 0.0F));
        }
    }
};

}  // namespace

void addFiberFunctors(materials::FunctorRegistry& registry) {
    registry.add(
        functorType<FiberColor>("FiberColor", "Absorption (per radius) from a colour, from pigments or as it is."));
    registry.add(functorType<FiberShape>(
        "FiberShape", "What the scattering models take of a fibre (fiber_parameters.def), and the table they read."));
    registry.add(functorType<LobeWeights>("LobeWeights",
                                          "Weights and tints of the lobes; a lobe of weight zero is compiled out."));
}

}  // namespace pelage::hair
