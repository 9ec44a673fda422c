// SPDX-License-Identifier: MIT
// The far field as curves: around the fibre with theta_i integrated out, and along it at one phi.
#pragma once

#include "scatter_models.hpp"

#include <vector>

namespace pelage::app {

struct CurvePoint {
    double degrees = 0, value = 0;
};
using Curve = std::vector<CurvePoint>;

/// The integral of S cos(theta_i) d(theta_i), all lobes, over phi from 0 to 180 degrees; the other half mirrors it.
/// `method` as for rows: no model is the truth. Of the tuple, thetaI, phi and h are not used.
Curve azimuthalCurve(const ScatterMethod& method, const ScatterTuple& fiber);
/// What the fibre scatters in all, from the curve: 1 when nothing is absorbed, in the truth.
double scatteredShare(const Curve& azimuthal);

/// S, all lobes, over theta_i from -90 to 90 degrees.
Curve longitudinalCurve(const ScatterMethod& method, const ScatterTuple& fiber, double phiDegrees);

}  // namespace pelage::app
