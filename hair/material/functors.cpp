// SPDX-License-Identifier: MIT
// The functors of all shipped material types; those of fibres alone are in functors_fiber.cpp.
#include <pelage/hair/functors.hpp>

#include "functor_ports.hpp"
#include "functors_fiber.hpp"
#include "lighting/shadow.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pelage::hair {
namespace {

// The integral of max(cos(theta_i - theta_r), 0)^p over the sphere at theta_r = 0 is
// 2 pi sqrt(pi) Gamma((p + 2) / 2) / Gamma((p + 3) / 2): 4.64 for p = 10, 1.74 for p = 80. Its inverse makes the
// highlight reflect `weight` at normal incidence. The ratio of gammas goes through logarithms: both overflow at p =
// 340.
struct KajiyaSpecular : Functor {
    In<bool> enable{this, "enable"};
    In<float> exponent{this, "exponent"};
    In<float> weight{this, "weight"};
    Out<float> usedExponent{this, "exponent"};
    Out<float> norm{this, "norm"};
    Out<float> usedWeight{this, "weight"};

    void run(const Call& call) const {
        const float used = std::max(call[exponent], 0.0F);
        const double p = static_cast<double>(used);
        const double ratio = std::exp(std::lgamma(0.5 * (p + 2.0)) - std::lgamma(0.5 * (p + 3.0)));
        const double integral = 2.0 * std::numbers::pi * std::sqrt(std::numbers::pi) * ratio;
        call.set(usedExponent, used);
        call.set(norm, static_cast<float>(1.0 / integral));
        call.set(usedWeight, call[enable] ? call[weight] : 0.0F);
    }
};

struct StrandIdVariation : Functor {
    In<Texture> map{this, "map"};
    In<bool> useMap{this, "useMap"};
    In<float> amount{this, "amount"};
    Out<Texture> usedMap{this, "map"};
    Out<bool> isUsed{this, "useMap"};
    Out<float> amplitude{this, "amplitude"};

    void run(const Call& call) const {
        const float used = call[useMap] ? std::max(call[amount], 0.0F) : 0.0F;
        call.pass(map, usedMap);
        call.set(isUsed, used > 0.0F);
        call.set(amplitude, used);
    }
};

// Exponential falloff leaves a tenth of the light `distance` metres behind the first surface: density = ln 10 /
// distance.
struct ShadowFalloff : Functor {
    using Mode = ShadowTechnique;
    static Words<Mode> modes() {
        Words<Mode> words;
        for (const ShadowTechniqueInfo& info : shadowTechniques()) words.emplace_back(info.word, info.technique);
        return words;
    }
    In<Mode> mode{this, "mode", modes()};
    In<float> distance{this, "distance"};
    In<int> radius{this, "radius"};
    Out<Mode> usedMode{this, "mode", modes()};
    Out<float> density{this, "density"};
    Out<int> usedRadius{this, "radius"};

    void run(const Call& call) const {
        const bool fades = shadowTechniques()[static_cast<std::size_t>(call[mode])].fades;
        const float tenth = std::max(call[distance], 1e-6F);
        call.pass(mode, usedMode);
        call.set(density, fades ? std::numbers::ln10_v<float> / tenth : 0.0F);
        call.pass(radius, usedRadius);
    }
};

struct EnvironmentScale : Functor {
    In<bool> enable{this, "enable"};
    In<float> intensity{this, "intensity"};
    Out<bool> on{this, "on"};
    Out<float> scale{this, "scale"};

    void run(const Call& call) const {
        const float used = call[enable] ? std::max(call[intensity], 0.0F) : 0.0F;
        call.set(on, used > 0.0F);
        call.set(scale, used);
    }
};

struct ConstantScatter : Functor {
    enum class Mode { Off, Constant };
    In<Mode> mode{this, "mode", {{"off", Mode::Off}, {"constant", Mode::Constant}}};
    In<float> factor{this, "factor"};
    Out<bool> on{this, "on"};
    Out<float> amount{this, "amount"};

    void run(const Call& call) const {
        const float used = call[mode] == Mode::Constant ? std::max(call[factor], 0.0F) : 0.0F;
        call.set(on, used > 0.0F);
        call.set(amount, used);
    }
};

}  // namespace

materials::FunctorRegistry functorRegistry() {
    materials::FunctorRegistry registry = materials::FunctorRegistry::standard();
    addFiberFunctors(registry);
    registry.add(functorType<KajiyaSpecular>("KajiyaSpecular",
                                             "Kajiya-Kay highlight: exponent, its normalisation, and weights."));
    registry.add(functorType<StrandIdVariation>("StrandIdVariation", "Brightness variation from strand to strand."));
    registry.add(functorType<ShadowFalloff>(
        "ShadowFalloff", "How shadows are looked up, and how fast light fades inside the hair (1/m)."));
    registry.add(functorType<EnvironmentScale>("EnvironmentScale",
                                               "Light from the environment; off when its intensity is zero."));
    registry.add(functorType<ConstantScatter>(
        "ConstantScatter", "A constant in place of multiple scattering; off when its factor is zero."));
    return registry;
}

}  // namespace pelage::hair
