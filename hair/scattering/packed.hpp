// SPDX-License-Identifier: MIT
// FiberMaterial and FiberAngles of fiber.glsl as they lie in a storage buffer (std430).
#pragma once

#include "resolve.hpp"

namespace pelage::hair {

namespace std430 {
using real = float;
using real3 = std::array<float, 3>;
using real4 = std::array<float, 4>;
template <class T>
inline constexpr std::size_t alignment = sizeof(T) == sizeof(float) ? sizeof(float) : sizeof(real4);
}  // namespace std430

struct PackedFiber {
#define FIBER_PARAMETER(type, name) alignas(std430::alignment<std430::type>) std430::type name;
#include "scattering/fiber_parameters.def"
};

struct PackedAngles {
#define FIBER_ANGLE(name) float name;
#include "scattering/fiber_angles.def"
};

inline PackedFiber packed(const ResolvedFiber& fiber) {
    return narrowed<PackedFiber>(fiber);
}
inline PackedAngles packed(const ResolvedDirections& directions) {
    return narrowed<PackedAngles>(directions);
}

}  // namespace pelage::hair
