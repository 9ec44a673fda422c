// SPDX-License-Identifier: MIT
// The moment table as a texture of three layers; define MOMENT_TEXTURE as a sampler2DArray with linear filtering.
#ifndef PELAGE_MOMENT_TEXTURE_GLSL
#define PELAGE_MOMENT_TEXTURE_GLSL
#include "scattering/moments.glsl"

// Texels lie on the ends of both axes.
FiberTable sampleMoments(FiberAngles a, FiberMaterial m, bool residual) {
    vec2 size = vec2(textureSize(MOMENT_TEXTURE, 0).xy);
    vec2 at = (vec2(momentAxisPhi(a.phi), momentAxisTheta(fiberSection(m, a.cosO), m)) * (size - 1.0) + 0.5) / size;
    FiberTable t;
    t.lobes = textureLod(MOMENT_TEXTURE, vec3(at, 0.0), 0.0);
    t.lengths = textureLod(MOMENT_TEXTURE, vec3(at, 1.0), 0.0);
    t.rest = residual ? textureLod(MOMENT_TEXTURE, vec3(at, 2.0), 0.0) : vec4(0.0);
    return t;
}
#endif
