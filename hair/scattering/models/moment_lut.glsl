// SPDX-License-Identifier: MIT
// Ours: the far field from the table of moments.glsl, with the exact longitudinal lobe.
#ifndef PELAGE_MOMENT_LUT_GLSL
#define PELAGE_MOMENT_LUT_GLSL
#include "moments.glsl"

FiberLobes scatterMomentLut(FiberAngles a, FiberMaterial m, FiberTable table, bool) {
    return alongFiber(azimuthMoments(a, m, table), longitudinals(a, m));
}
#endif
