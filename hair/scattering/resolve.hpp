// SPDX-License-Identifier: MIT
// From the properties of a fibre to the numbers its shaders take (FiberMaterial of fiber.glsl), in double.
#pragma once

#include <pelage/hair/scattering.hpp>

namespace pelage::hair {

/// FiberMaterial with every number in double, in the order and with the names of fiber.glsl.
struct ResolvedFiber {
    double eta, etaExcess, alpha, betaM, betaN, inverseScale, peak;
    std::array<double, 3> sigmaA, color;
    std::array<double, 4> inverseVariance, norm, deviation, sinTilt, cosTilt, glint;
};

/// FiberAngles, likewise. Made here and not in shading.inl, whose literals are float in the float build.
struct ResolvedDirections {
    double sinI, cosI, sinO, cosO, phi, cosPhi, h, cosGamma;
};

/// The properties brought into their ranges.
FiberProperties clamped(const FiberProperties& fiber);
ResolvedFiber resolve(const FiberProperties& fiber);
ResolvedDirections resolve(const FiberDirections& directions);

/// Chiang 2016, equations 7 and 8.
std::array<double, 4> longitudinalVariances(double betaM);
double logisticScale(double betaN);

}  // namespace pelage::hair
