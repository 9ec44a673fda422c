// SPDX-License-Identifier: MIT
// Scheuermann 2004 (ATI, after Kajiya and Kay): two highlights sin^p(T', H) around tangents shifted along the normal,
// the first colourless (R), the second of the hair's colour (TRT), over a wrapped diffuse part (residual). Made for
// cards that have a normal; a fibre has none, so the normal is taken where each term is largest: towards H for the
// shift, which then simply turns T in the plane of T and H, and towards the view for the diffuse part. The exponents
// give the widths of R and TRT; as H turns half as fast as the light, p = 4 / v. The strand noise and the ambient
// occlusion are not part of it.
//   published: weights of 1, nothing normalised. smoothstep(-1, 0, T'.H) fades what lies on one side of the highlight,
//              which would make it depend on which end of a hair is its root.
//   corrected: without that step; every term over its integral (highlights: at theta_o = 0, where it is largest), the
//              light split between them.
#ifndef PELAGE_SCHEUERMANN_GLSL
#define PELAGE_SCHEUERMANN_GLSL
#include "kajiya_kay.glsl"

// Share of the light in the second highlight: TRT of a smooth fibre of index 1.55 that does not absorb, at theta_o = 0.
const real scheuermannSecond = 0.055;

// sin(T', H)^p, H at (sinH, cosH) above the normal plane; the highlight is moved by `shift`, given by sine and cosine.
real scheuermannHighlight(real sinH, real cosH, real sinShift, real cosShift, real p, bool published) {
    real along = clamp(sinH * cosShift - cosH * sinShift, real(-1.0), real(1.0));  // T'.H
    real across = abs(cosH * cosShift + sinH * sinShift);
    real fade = clamp(along + 1.0, real(0.0), real(1.0));
    return kajiyaPower(across, along, p) * (published ? fade * fade * (3.0 - 2.0 * fade) : real(1.0));
}

FiberLobes scatterScheuermann(FiberAngles a, FiberMaterial m, FiberTable, bool published) {
    // H = (wi + wo) / |wi + wo|: its part along the fibre and across. Opposite directions have none; 0 is as good as
    // any.
    real along = a.sinI + a.sinO;
    real across2 = max(square(a.cosI - a.cosO) + 2.0 * a.cosI * a.cosO * (1.0 + a.cosPhi), real(0.0));
    real size = sqrt(along * along + across2);
    real sinH = size > 1e-6 ? along / size : real(0.0);
    real cosH = size > 1e-6 ? sqrt(across2) / size : real(1.0);
    // Shifts of Marschner 2003 in theta_h: alpha and -3/2 alpha, the latter by alpha + alpha / 2.
    real sin1 = m.sinTilt.y, cos1 = m.cosTilt.y;
    real cosHalf = sqrt(0.5 + 0.5 * cos1), sinHalf = 0.5 * sin1 / cosHalf;
    real p1 = 4.0 * m.inverseVariance.x, p2 = 4.0 * m.inverseVariance.z;
    real first = scheuermannHighlight(sinH, cosH, sin1, cos1, p1, published);
    real second = scheuermannHighlight(sinH, cosH, -(sin1 * cosHalf + cos1 * sinHalf), cos1 * cosHalf - sin1 * sinHalf,
                                       p2, published);
    real diffuse = clamp(0.25 + 0.75 * a.cosI * a.cosPhi, real(0.0), real(1.0));  // N.L
    FiberLobes s = noLobes();
    if (published) {
        s.R = real3(first);
        s.TRT = m.color * second;
        s.RES = m.color * diffuse;
    } else {
        // d(wi) = 4 (wo.H) d(H): 8 sqrt(pi) Gamma(p/2 + 3/2) / Gamma(p/2 + 2) at theta_o = 0. Diffuse: 4 pi / 3.
        real perNorm = 1.0 / (8.0 * sqrt(pi));
        s.R = real3(kajiyaHighlight * first * perNorm / kajiyaGammaRatio(0.5 * p1 + 1.5));
        s.TRT = m.color * (scheuermannSecond * second * perNorm / kajiyaGammaRatio(0.5 * p2 + 1.5));
        s.RES = m.color * ((1.0 - kajiyaHighlight - scheuermannSecond) * diffuse * 0.75 / pi);
    }
    return s;
}
#endif
