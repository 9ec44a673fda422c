// SPDX-License-Identifier: MIT
// A smooth dielectric cylinder traced with vectors in three dimensions: intersections, Snell's law, Fresnel's
// equations, Beer's law. It knows nothing of theta, gamma or Bravais, so what it agrees with is not agreeing with
// itself.
#pragma once

#include <array>

namespace pelage::reference {

struct CylinderPath {
    double sinTheta;  ///< of the direction in which light leaves, along the axis
    double phi;       ///< azimuth at which it leaves, minus that of the arriving ray's origin
    double length;    ///< inside the fibre, in radii
    double weight;    ///< light that takes the path, absorption included
};

/// The paths 0 (R), 1 (TT) and 2 (TRT) of a ray that comes from inclination theta (rad) and azimuth 0, and passes the
/// axis of the unit cylinder at the signed distance h, -1 < h < 1.
std::array<CylinderPath, 3> traceCylinder(double eta, double theta, double h, double sigmaA);

}  // namespace pelage::reference
