// SPDX-License-Identifier: MIT
// The truth for one fibre, in double precision and written from the equations: a rough dielectric cylinder with tilted
// scales (Chiang et al. 2016, with the longitudinal lobe of d'Eon et al. 2011). Nothing here is fast.
//
// Frame: x is the tangent u, from root to tip; theta = asin(w.x), from the normal plane; phi = atan2(w.z, w.y). Both
// directions point away from the fibre. wo is the view, and h belongs to it; wi is the light; phi = phi_i - phi_o.
// Lobes: 0 R, 1 TT, 2 TRT, 3 the rest (residual). S_p = M_p A_p N_p with
//     integral of M_p cos(theta_i) d(theta_i) = 1,   integral of N_p d(phi) = 1,
// so the integral of S_p over the sphere of wi is A_p, and radiance L_o = S E_perp needs no further cosine.
#pragma once

#include <array>
#include <numbers>

namespace pelage::reference {

inline constexpr double pi = std::numbers::pi;
inline constexpr double degree = pi / 180.0;

/// What a fibre is made of. `alpha` follows Chiang: R is tilted by -2 alpha, TT by +alpha, TRT by +4 alpha on theta_o,
/// so with u from root to tip real hair, whose R highlight lies toward the root, has alpha < 0.
struct Fiber {
    double eta = 1.55;   ///< index of refraction, at least 1.0001
    double betaM = 0.3;  ///< longitudinal roughness, 0 < beta <= 1
    double betaN = 0.3;  ///< azimuthal roughness, 0 < beta <= 1
    double alpha = 0;    ///< tilt, rad
    double sigmaA = 0;   ///< absorption per fibre radius, at least 0
};

/// Sines and cosines are kept apart: at 89.9 degrees a cosine made from its sine has lost four digits.
struct Angles {
    double sinThetaI = 0, cosThetaI = 1;
    double sinThetaO = 0, cosThetaO = 1;
    double phi = 0;  ///< phi_i - phi_o, any period
};

/// Degrees; theta in [-90, 90].
Angles anglesFromDegrees(double thetaI, double phiI, double thetaO, double phiO);

/// One number for each of R, TT, TRT, residual.
struct Lobes {
    std::array<double, 4> p{};
    double total() const { return p[0] + p[1] + p[2] + p[3]; }
};

/// Near field: S_p at the offset h in [-1, 1] of the view ray.
Lobes nearField(const Fiber& fiber, const Angles& angles, double h);

/// Far field: the mean of S_p over h, by adaptive Gauss-Kronrod quadrature split at every peak and kink of the
/// integrand. `error` is the quadrature's own bound of the absolute error of each lobe.
struct FarField {
    Lobes value;
    Lobes error;
};
FarField farField(const Fiber& fiber, const Angles& angles);

/// The far field's azimuthal part alone, A_p N_p averaged over h, at the view's inclination; `error` as above.
FarField farFieldAzimuthal(const Fiber& fiber, double cosThetaO, double phi);

/// A direction wi drawn in proportion to the lobes (Chiang 2016, section 5 of the supplement; d'Eon 2013): which lobe
/// by A_p, theta_i by M_p, phi by N_p. u: four numbers in [0, 1). `weight` = f / pdf, the sum of all A_p: 1 without
/// absorption.
struct FiberSample {
    double sinThetaI, cosThetaI, phi;  // phi relative to the view
    double pdf;                        // per steradian
    double weight;
    int lobe;
};
FiberSample sample(const Fiber& fiber, double sinThetaO, double cosThetaO, double h, const std::array<double, 4>& u);

/// The density that sample() draws with, per steradian.
double pdf(const Fiber& fiber, const Angles& angles, double h);

}  // namespace pelage::reference
