// SPDX-License-Identifier: MIT
// A fibre that scatters evenly: S = colour / pi^2, as the integral of cos(theta_i) over the sphere is pi^2.
#ifndef PELAGE_EVEN_GLSL
#define PELAGE_EVEN_GLSL
#include "scattering/models/fiber.glsl"

FiberLobes scatterEven(FiberAngles, FiberMaterial m, FiberTable, bool) {
    FiberLobes s = noLobes();
    s.RES = m.color / (pi * pi);
    return s;
}
#endif
