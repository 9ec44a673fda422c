// SPDX-License-Identifier: MIT
// Means over the offset h of a fibre's cross-section, with the error known.
#pragma once

#include <pelage/reference/terms.hpp>

#include <functional>
#include <vector>

namespace pelage::reference {

struct Integral {
    double value = 0;
    double error = 0;  ///< bound of the absolute error, by the quadrature's own estimate
};

/// What a lobe looks like around its path: a density of x = phi - Phi, repeated with period 2 pi and falling off over
/// `width`.
struct Kernel {
    double width;
    std::function<double(double)> density;
};

using OffsetWeight = std::function<double(double gammaO, const Refracted&)>;

/// 1/2 integral over h of weight(h).
Integral meanOverOffset(const CrossSection& section, const OffsetWeight& weight);

/// 1/2 integral over h of weight(h) kernel(phi - Phi(p, h)). Taken over gamma_o = asin(h), and split where the path
/// turns back (the caustic), where the kernel peaks, and where its repeated tails meet.
Integral meanOverOffset(const CrossSection& section, int p, double phi, const Kernel& kernel,
                        const OffsetWeight& weight);

/// The gamma_o at which Phi(p, .) equals `target` exactly (no period added), in ascending order.
std::vector<double> offsetsAtAzimuth(const CrossSection& section, int p, double target);

/// The positive gamma_o at which the azimuth of path p turns back (Marschner 2003, section 4.3), or a value below 0:
/// h_c^2 = (p^2 - eta'^2) / (p^2 - 1).
double causticOffset(const CrossSection& section, int p);

}  // namespace pelage::reference
