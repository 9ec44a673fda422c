// SPDX-License-Identifier: MIT
// From the properties of a fibre and from two directions to the numbers that the scattering models take, in double.
#pragma once

#include <pelage/hair/scattering.hpp>

namespace pelage::hair {

/// FiberMaterial of fiber.glsl in double.
struct ResolvedFiber {
    using real = double;
    using real3 = std::array<double, 3>;
    using real4 = std::array<double, 4>;
#define FIBER_PARAMETER(type, name) type name = {};
#include "scattering/fiber_parameters.def"
};

/// FiberAngles, likewise. Made here and not in shading.inl, whose literals are float in the float build.
struct ResolvedDirections {
#define FIBER_ANGLE(name) double name = 0;
#include "scattering/fiber_angles.def"
};

/// The properties brought into their ranges.
FiberProperties clamped(const FiberProperties& fiber);
/// `nearField`: the models are asked for one offset h instead of the mean over all.
ResolvedFiber resolveFiber(const FiberProperties& fiber, bool nearField = false);
ResolvedDirections resolveDirections(const FiberDirections& directions);

/// Chiang 2016, equations 7 and 8.
std::array<double, 4> longitudinalVariances(double betaM);
double logisticScale(double betaN);

inline void narrow(double from, float& to) {
    to = static_cast<float>(from);
}
inline void narrow(double from, double& to) {
    to = from;
}
/// `To` is a vector of GLM or an array.
template <std::size_t n, class To>
void narrow(const std::array<double, n>& from, To& to) {
    for (int i = 0; i < static_cast<int>(n); ++i) narrow(from[static_cast<std::size_t>(i)], to[i]);
}

/// Each parameter, each angle into the member of its name.
template <class To>
To narrowed(const ResolvedFiber& from) {
    To to{};
#define FIBER_PARAMETER(type, name) narrow(from.name, to.name);
#include "scattering/fiber_parameters.def"
    return to;
}
template <class To>
To narrowed(const ResolvedDirections& from) {
    To to{};
#define FIBER_ANGLE(name) narrow(from.name, to.name);
#include "scattering/fiber_angles.def"
    return to;
}

}  // namespace pelage::hair
