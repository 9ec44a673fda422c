// SPDX-License-Identifier: MIT
// What every scattering model takes and gives: the directions in the frame of the fibre, the fibre, a look-up into its
// tables, and one value for each lobe. The members of both structs, with their meaning, stand in fiber_angles.def and
// fiber_parameters.def. Conventions: u is the unit tangent from root to tip; theta = asin(w.u), the
// angle from the normal plane; phi = phi_i - phi_o; both directions point away from the fibre; wo is the view. S_p has
// the integral A_p over the sphere of wi, so L_o = S E_perp.
#ifndef PELAGE_FIBER_GLSL
#define PELAGE_FIBER_GLSL
#include "numerics.glsl"

struct FiberAngles {
#define FIBER_ANGLE(name) real name;
#include "scattering/fiber_angles.def"
};

// Made once per material: resolveFiber() in C++.
struct FiberMaterial {
#define FIBER_PARAMETER(type, name) type name;
#include "scattering/fiber_parameters.def"
};

// Bilinear look-up of the moment table (moments.glsl) at theta_o and phi; zero for models without tables.
struct FiberTable {
    real4 lobes;    // N0 of R, TT, TRT, residual
    real4 lengths;  // mean and variance of the path of TT, of TRT
    real4 rest;     // the residual's mean segment, and its falloff H at 1/3, 2/3, 1 (moments.glsl)
};

// S_p.
struct FiberLobes {
    real3 R, TT, TRT, RES;
};

FiberLobes noLobes() {
    FiberLobes s;
    s.R = real3(0.0);
    s.TT = real3(0.0);
    s.TRT = real3(0.0);
    s.RES = real3(0.0);
    return s;
}

real square(real x) { return x * x; }

// A vector of length 1, or x where there is none: length 0, infinite, not a number.
real3 unitOr(real3 v, real3 x) {
    real large = max(max(abs(v.x), abs(v.y)), abs(v.z));
    if (!(large > 1e-30 && large < 3e38)) return x;
    real3 scaled = v / large;
    real square = dot(scaled, scaled);
    return square >= 1.0 && square <= 3.0 ? scaled * inversesqrt(square) : x;
}

// Angles of two directions about the tangent u. None needs unit length. Cosines come from cross products, which keep
// their digits where a direction lies along the fibre; there phi is any and comes out as 0.
FiberAngles fiberAngles(real3 u, real3 wi, real3 wo) {
    real3 t = unitOr(u, real3(1.0, 0.0, 0.0));
    real3 i = unitOr(wi, real3(0.0, 1.0, 0.0)), o = unitOr(wo, real3(0.0, 1.0, 0.0));
    real3 acrossI = cross(t, i), acrossO = cross(t, o);
    FiberAngles a;
    a.sinI = clamp(dot(t, i), real(-1.0), real(1.0));
    a.sinO = clamp(dot(t, o), real(-1.0), real(1.0));
    a.cosI = sqrt(dot(acrossI, acrossI));
    a.cosO = sqrt(dot(acrossO, acrossO));
    real c = dot(acrossO, acrossI), s = dot(t, cross(acrossO, acrossI));
    a.phi = atanFull(s, c);
    real large = max(abs(c), abs(s));  // squares of products of two small cosines would be zero
    real unit = large > 0.0 ? c / large * inversesqrt(square(c / large) + square(s / large)) : real(1.0);
    a.cosPhi = clamp(unit, real(-1.0), real(1.0));
    a.h = 0.0;
    a.cosGamma = 1.0;
    return a;
}

// The same seen at the offset h of the view ray, -1 to 1.
FiberAngles atOffset(FiberAngles a, real h) {
    FiberAngles b = a;
    b.h = h;
    b.cosGamma = sqrt(max(1.0 - h * h, real(0.0)));
    return b;
}

// |cos| and |sin| of theta_d = (theta_o - theta_i) / 2, as half the sum and difference of two unit vectors: no digits
// are lost near 0 or 90 degrees.
real cosThetaD(FiberAngles a) { return 0.5 * sqrt(square(a.cosI + a.cosO) + square(a.sinI + a.sinO)); }
real sinThetaD(FiberAngles a) { return 0.5 * sqrt(square(a.cosI - a.cosO) + square(a.sinI - a.sinO)); }
real thetaH(FiberAngles a) { return 0.5 * (atanRight(a.sinI, a.cosI) + atanRight(a.sinO, a.cosO)); }
real cosHalfPhi(FiberAngles a) { return sqrt(max(0.5 + 0.5 * a.cosPhi, real(0.0))); }

// M of R, TT, TRT, residual; d'Eon et al. 2011 (7), in the form that neither overflows nor cancels.
real4 longitudinals(FiberAngles a, FiberMaterial m) {
    real4 sinO = a.sinO * m.cosTilt + a.cosO * m.sinTilt;
    real4 cosO = abs(a.cosO * m.cosTilt - a.sinO * m.sinTilt);
    real4 across = real4(a.cosI) - cosO, along = real4(a.sinI) + sinO;
    real4 exponent = m.inverseVariance * (across * across + along * along) * real(-0.5);
    return m.norm * scaledBesselI0(a.cosI * cosO * m.inverseVariance, exponent);
}

// S_p of A_p N_p.
FiberLobes alongFiber(FiberLobes n, real4 m) {
    n.R *= m.x;
    n.TT *= m.y;
    n.TRT *= m.z;
    n.RES *= m.w;
    return n;
}

// Logistic of Chiang 2016 (8), trimmed to one turn and repeated.
real trimmedLogistic(real x, FiberMaterial m) {
    real e = exp(-abs(wrapAngle(x)) * m.inverseScale);
    return m.peak * e / square(1.0 + e);
}

// Unpolarised Fresnel reflectance (x) and transmittance (y) at the cosine of incidence, each without cancellation.
// index > 1; excess = index^2 - 1.
real2 fresnelExact(real index, real excess, real cosine) {
    real inside = sqrt(excess + cosine * cosine);  // index cos(refracted)
    real s = cosine + inside, p = index * index * cosine + inside;
    real rs = (cosine - inside) / s, rp = (index * index * cosine - inside) / p;
    real product = 2.0 * cosine * inside;
    real2 f;
    f.x = 0.5 * (rs * rs + rp * rp);
    f.y = product * (1.0 / (s * s) + index * index / (p * p));
    return f;
}

// Schlick 1994; cosine clamped to 0..1.
real fresnelSchlick(real f0, real cosine) {
    real c = 1.0 - clamp(cosine, real(0.0), real(1.0));
    return f0 + (1.0 - f0) * (c * c) * (c * c) * c;
}

real gaussian(real deviation, real x) {
    real t = x / deviation;
    return exp(-0.5 * t * t) * (0.398942280401432678 / deviation);
}
#endif
