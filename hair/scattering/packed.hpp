// SPDX-License-Identifier: MIT
// A resolved fibre in float, as packed_fiber.glsl reads it (std430).
#pragma once

#include "resolve.hpp"

namespace pelage::hair {

using Vec4 = std::array<float, 4>;

struct PackedFiber {
    Vec4 fiber0, fiber1, sigmaA, color;
    Vec4 inverseVariance, norm, deviation, sinTilt, cosTilt, glint;
};

inline Vec4 packed(double x, double y, double z, double w) {
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), static_cast<float>(w)};
}
inline Vec4 packed(const std::array<double, 4>& x) {
    return packed(x[0], x[1], x[2], x[3]);
}
inline Vec4 packed(const std::array<double, 3>& x) {
    return packed(x[0], x[1], x[2], 0);
}

inline PackedFiber packed(const ResolvedFiber& f, bool nearField) {
    return {packed(f.eta, f.etaExcess, f.alpha, f.betaM),
            packed(f.betaN, f.inverseScale, f.peak, nearField ? 1 : 0),
            packed(f.sigmaA),
            packed(f.color),
            packed(f.inverseVariance),
            packed(f.norm),
            packed(f.deviation),
            packed(f.sinTilt),
            packed(f.cosTilt),
            packed(f.glint)};
}

}  // namespace pelage::hair
