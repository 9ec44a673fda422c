// SPDX-License-Identifier: MIT
// Ours: the far field of chiang.glsl from a small table per (eta, beta_N). The azimuthal part without absorption, N0,
// is tabulated with exact Fresnel terms; so are mean m1 and variance m2 of the path that light of each lobe has gone
// inside the fibre. Absorption by any colour is then the cumulant expansion of the mean of exp(-sigma length):
//     N(sigma) = N0 exp(-sigma m1 + 1/2 sigma^2 m2 - ...),
// cut after the second cumulant. The exponent is kept below -sigma times the shortest path, which is also what is right
// for sigma -> infinity.
#ifndef PELAGE_MOMENTS_GLSL
#define PELAGE_MOMENTS_GLSL
#include "attenuation.glsl"

// Where the table is read, both in [0, 1]: x from |phi|, y from theta_o (momentAxisTheta below).
real momentAxisPhi(real phi) { return abs(phi) / pi; }

// Near 90 degrees TT and TRT fall with the square of the cosine, and the residual with the cosine. The table holds what
// is left without that, which is nearly linear between its rows. How near depends on the index: 0.21 sqrt(eta^2 - 1) is
// where the transmittance of the middle of a fibre is about a half.
real momentRim(FiberSection s) { return s.cosine / (s.cosine + 0.21 * s.root); }

// Two thirds of the rows lie evenly in cos(theta_o), the others in its rim function: for an index near 1 all that
// Fresnel's terms do happens within a few thousandths of the cosine.
real momentAxisTheta(FiberSection s, FiberMaterial m) {
    return 0.65 * s.cosine + 0.35 * (1.0 + 0.21 * m.eta) * momentRim(s);
}

// N0 of R, TT, TRT, residual.
real4 momentLobes(FiberSection s, FiberTable table) {
    real rim = momentRim(s);
    real4 n = table.lobes;
    n.y *= rim * rim;
    n.z *= rim * rim;
    n.w *= rim;
    return n;
}

// exp(-sigma m1 + 1/2 sigma^2 m2), monotone in sigma.
real3 absorb(real3 sigmaA, real mean, real variance, real shortest) {
    real3 linear = sigmaA * mean;
    real3 quadratic = (0.5 * variance) * sigmaA * sigmaA;
    // The quadratic turns up again at sigma = m1 / m2; x / (1 + q / x) has the same first two terms and does not.
    real3 exponent = linear * linear / (linear + quadratic + real3(1e-30));
    return exp(-max(exponent, sigmaA * shortest));
}

// The residual is all paths of three segments and more: per offset T^3 / (1 + r (1 - T)) of what it is without
// absorption, r = f / (1 - f). The paths along the rim are long, and two moments do not hold them. T is taken at the
// mean segment, and H(x) = 1 / mean of 1 / (1 + r x) is a cubic through its values at 0, 1/3, 2/3 and 1.
real3 absorbResidual(real3 sigmaA, real4 rest) {
    real3 t = exp(-sigmaA * rest.x);
    real3 x = real3(3.0) * (real3(1.0) - t);
    real3 a = x - real3(1.0), b = x - real3(2.0), c = x - real3(3.0);
    real3 h = a * b * c * real(-0.166666666666666667) + x * b * c * (0.5 * rest.y) - x * a * c * (0.5 * rest.z) +
              x * a * b * (rest.w * 0.166666666666666667);
    return t * t * t / max(h, real3(1.0));
}

FiberLobes azimuthMoments(FiberAngles a, FiberMaterial m, FiberTable table) {
    FiberSection s = fiberSection(m, a.cosO);
    real shortest = shortestSegment(s, m);
    real4 n0 = momentLobes(s, table);
    FiberLobes n;
    n.R = real3(n0.x);
    n.TT = n0.y * absorb(m.sigmaA, table.lengths.x, table.lengths.y, shortest);
    n.TRT = n0.z * absorb(m.sigmaA, table.lengths.z, table.lengths.w, 2.0 * shortest);
    n.RES = n0.w * absorbResidual(m.sigmaA, table.rest);
    return n;
}
#endif
