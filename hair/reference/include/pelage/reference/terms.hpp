// SPDX-License-Identifier: MIT
// The terms that S_p = M_p A_p N_p is made of, each alone so that each can be tested alone.
#pragma once

#include <pelage/reference/fiber.hpp>

namespace pelage::reference {

/// exp(-x) I0(x), x >= 0: never overflows, relative error below 3e-15.
double scaledBesselI0(double x);

/// d'Eon et al. 2011, equation 7, in a form without overflow or cancellation:
///   M = exp(E) I0e(a) / (v (1 - exp(-2/v))),  a = cos(theta_i) cos(theta_o) / v,
///   E = -((cos(theta_i) - cos(theta_o))^2 + (sin(theta_i) + sin(theta_o))^2) / (2 v).
/// v: variance, rad^2, above 0. The integral of M cos(theta_i) over theta_i is 1 for every theta_o and v.
double longitudinal(double v, double sinThetaI, double cosThetaI, double sinThetaO, double cosThetaO);

/// Chiang 2016, equation 7: variances of R, TT, TRT, residual for the roughness beta_M.
std::array<double, 4> longitudinalVariances(double betaM);

/// Chiang 2016, equation 8: the scale of the logistic for the roughness beta_N.
double logisticScale(double betaN);

/// The logistic density of scale s trimmed to [-pi, pi] and repeated with period 2 pi; unit integral over a period.
double trimmedLogistic(double x, double s);
/// Its integral from -pi to x, x in [-pi, pi].
double trimmedLogisticCdf(double x, double s);
/// The x at which that integral is u.
double sampleTrimmedLogistic(double u, double s);

/// theta_o with the tilt of each lobe added; the cosine is taken by its size, which mirrors what passes 90 degrees.
void tilt(double alpha, int lobe, double sinThetaO, double cosThetaO, double& sinTilted, double& cosTilted);

/// Unpolarised Fresnel reflectance of a dielectric with index eta (above 1) and its complement; each without
/// cancellation, so both keep their digits where the other is nearly 1. cosine in [0, 1].
struct Fresnel {
    double reflected, transmitted;
};
Fresnel fresnel(double eta, double cosine);

/// The cross-section as an inclined ray sees it: the index eta' (Bravais), and the angle of refraction along the fibre.
struct CrossSection {
    double eta, cosThetaO;
    double etaPerp;    ///< eta' = sqrt(eta^2 - sin^2 theta) / cos(theta)
    double cosThetaT;  ///< sin(theta_t) = sin(theta_o) / eta
};
CrossSection crossSection(double eta, double cosThetaO);

/// gamma_t where the ray meets the surface at gamma_o = asin(h); h^2 + cosGammaO^2 = 1.
struct Refracted {
    double gammaT, cosGammaT;
};
Refracted refract(const CrossSection& section, double h, double cosGammaO);

/// The turn of the path p at gamma_o: Phi(p, h) = 2 p gamma_t - 2 gamma_o + p pi (Marschner 2003, equation 3).
double pathAzimuth(int p, double gammaO, double gammaT);

/// Attenuations A_0..A_3 (Chiang 2016, section 4.2): f, (1-f)^2 T, (1-f)^2 T^2 f, and the rest of the series. They sum
/// to 1 when sigma_a = 0. T = exp(-sigma_a 2 cos(gamma_t) / cos(theta_t)): the chord of the circle, stretched.
Lobes attenuation(const CrossSection& section, const Refracted& refracted, double cosGammaO, double sigmaA);

/// Absorption per radius of a colour C in (0, 1] (Chiang 2016, equation 9).
double sigmaFromColor(double color, double betaN);

}  // namespace pelage::reference
