// SPDX-License-Identifier: MIT
// Models beside the truth, for one fibre seen from one inclination: around the fibre and along it.
#pragma once

#include "plot_canvas.hpp"
#include "scatter_rows.hpp"

#include <pelage/hair/scattering.hpp>

#include <vector>

namespace pelage::app {

struct ScatterPlot {
    ScatterTuple fiber = {};  // its thetaO is the view; thetaI, phi and h are not used
    std::vector<const hair::ModelInfo*> models = {};
    bool published = false;
    std::string title = {};  // before the parameters; may be empty
};

/// 1200 x 600 pixels. Left: the far field around the fibre, the integral of S cos(theta_i) over theta_i at each phi.
/// Right: S over theta_i at phi = 0, on the side of the view, and phi = 180 degrees. In all three the sum of the lobes;
/// grey is pelage::reference::farField.
Drawing drawScatterPlot(const ScatterPlot& plot);

}  // namespace pelage::app
