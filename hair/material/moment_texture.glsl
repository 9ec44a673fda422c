// SPDX-License-Identifier: MIT
// The moment table as a texture of three layers; define MOMENT_TEXTURE as a sampler2DArray with linear filtering.
#ifndef PELAGE_MOMENT_TEXTURE_GLSL
#define PELAGE_MOMENT_TEXTURE_GLSL
#include "scattering/models/moments.glsl"

// What of the table depends on the view alone: its row, and the residual, which has no azimuth. One for all lights.
struct MomentRow {
    float y;
    vec4 rest;
};

// Texels lie on the ends of both axes.
MomentRow momentRow(FiberMaterial m, float cosO, bool residual) {
    float size = float(textureSize(MOMENT_TEXTURE, 0).y);
    MomentRow row;
    row.y = (momentAxisTheta(fiberSection(m, cosO), m) * (size - 1.0) + 0.5) / size;
    row.rest = residual ? textureLod(MOMENT_TEXTURE, vec3(0.5, row.y, 2.0), 0.0) : vec4(0.0);
    return row;
}

FiberTable sampleMoments(FiberAngles a, MomentRow row) {
    float size = float(textureSize(MOMENT_TEXTURE, 0).x);
    float x = (momentAxisPhi(a.phi) * (size - 1.0) + 0.5) / size;
    FiberTable t;
    t.lobes = textureLod(MOMENT_TEXTURE, vec3(x, row.y, 0.0), 0.0);
    t.lengths = textureLod(MOMENT_TEXTURE, vec3(x, row.y, 1.0), 0.0);
    t.rest = row.rest;
    return t;
}
#endif
