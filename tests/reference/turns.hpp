// SPDX-License-Identifier: MIT
// Where the paths of a smooth fibre turn to, and where their lobes jump.
#pragma once

#include "quadrature.hpp"

#include <algorithm>
#include <cmath>

namespace pelage::reference::test {

inline CrossSection sectionAt(double eta, double thetaD) {
    return crossSection(eta, std::cos(thetaD));
}

inline double turnAt(const CrossSection& section, int p, double gammaO) {
    return pathAzimuth(p, gammaO, refract(section, std::sin(gammaO), std::cos(gammaO)).gammaT);
}

/// Azimuths at which N_p jumps: the rim, and the caustic where there is one. In (-pi, pi), both signs.
inline std::vector<double> jumps(const CrossSection& section, int p) {
    std::vector<double> made{-pi, pi};
    const double rim = std::remainder(turnAt(section, p, 0.5 * pi), 2 * pi);
    made.insert(made.end(), {rim, -rim});
    if (causticOffset(section, p) > 0) {
        const double caustic = std::remainder(turnAt(section, p, causticOffset(section, p)), 2 * pi);
        made.insert(made.end(), {caustic, -caustic});
    }
    std::sort(made.begin(), made.end());
    return made;
}

}  // namespace pelage::reference::test
