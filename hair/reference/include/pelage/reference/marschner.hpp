// SPDX-License-Identifier: MIT
// Marschner et al. 2003, evaluated exactly: the roots of Phi(p, h) = phi, Fresnel by Bravais' indices, no cubic fit.
// Symmetric in the two inclinations: the cross-section is taken at theta_d = (theta_o - theta_i) / 2.
#pragma once

#include <pelage/reference/fiber.hpp>

#include <vector>

namespace pelage::reference {

/// How far light travels inside the fibre, per segment and radius.
enum class PathLength {
    Chord,    ///< 2 cos(gamma_t) / cos(theta_t): what a ray traced through a cylinder does
    Printed,  ///< 2 (1 + cos(2 gamma_t)) / cos(theta_t): Marschner 2003, section 4.3; the square of the chord
    Thesis,   ///< 2 + 2 cos(2 gamma_t): the same without the inclination, as later texts copy it
};

/// The offsets h in [-1, 1] whose path p leaves at the azimuth phi (any period), ascending. p = 0, 1, 2.
std::vector<double> marschnerRoots(int p, double eta, double thetaD, double phi);

/// N_p of equation 8 for a smooth fibre: sum over the roots of A(p, h) |2 d(phi)/dh|^-1. Infinite at the caustics of
/// TRT. thetaD in rad.
double marschnerSmooth(int p, double eta, double thetaD, double phi, double sigmaA, PathLength path);

/// The same convolved with a Gaussian of standard deviation `width` (rad, wrapped) in azimuth.
double marschnerRough(int p, double eta, double thetaD, double phi, double sigmaA, PathLength path, double width);

/// The whole model S_p(theta_i, theta_o, phi) for R, TT, TRT with Gaussian longitudinal lobes of standard deviation
/// beta (R), beta/2, 2 beta in theta_h, shifted by alpha, -alpha/2, -3/2 alpha (rad). As printed it reflects about
/// twice the light it receives; `corrected` halves M, whose measure d(theta_h) is half of d(theta_i). Either has the
/// paper's pole at theta_i = -theta_o = +-90 degrees, 1 / cos^2(theta_d).
Lobes marschner(const Angles& angles, double eta, double beta, double alpha, double sigmaA, PathLength path,
                bool corrected);

}  // namespace pelage::reference
