// SPDX-License-Identifier: MIT
// Opacity to visibility, for every blending mode but alpha blend.
#ifndef PELAGE_ALPHA_GLSL
#define PELAGE_ALPHA_GLSL
#include "hash.glsl"

// A threshold in (0, 1] anchored to the surface, so that it does not swim when the camera moves: noise on a lattice in
// object space whose cell is about one pixel, interpolated between two power-of-two cell sizes, then mapped through the
// distribution of that interpolation so that it is uniform again.
// Wyman and McGuire, "Hashed Alpha Testing", I3D 2017, section 3 and eq. 3.
float hashedThreshold(vec3 position, float hashScale) {
    float derivative = max(length(dFdx(position)), length(dFdy(position)));
    float scale = 1.0 / (max(hashScale, 1e-3) * max(derivative, 1e-9));
    float level = log2(scale);
    float low = floor(level);
    vec2 scales = exp2(vec2(low, low + 1.0));
    float near = hash01(ivec3(floor(scales.x * position)));
    float far = hash01(ivec3(floor(scales.y * position)));
    float t = level - low;
    float x = mix(near, far, t);
    float a = min(t, 1.0 - t);
    // Cumulative distribution of t U1 + (1 - t) U2.
    float rising = x * x / max(2.0 * a * (1.0 - a), 1e-6);
    float middle = (x - 0.5 * a) / (1.0 - a);
    float falling = 1.0 - (1.0 - x) * (1.0 - x) / max(2.0 * a * (1.0 - a), 1e-6);
    float u = x < 1.0 - a ? (x < a ? rising : middle) : falling;
    return clamp(u, 1e-3, 1.0);
}

// Which samples a surface of opacity `alpha` covers, from one threshold u in (0, 1]: the count is alpha * n rounded
// stochastically, and the samples start at a pixel's own offset, so that layers do not always hide the same ones.
uint stochasticCoverage(float alpha, float u, uint offset) {
    uint n = uint(sampleCount);
    float scaled = alpha * float(n);
    uint covered = uint(scaled) + (fract(scaled) >= u ? 1u : 0u);
    covered = min(covered, n);
    uint mask = (1u << covered) - 1u;
    uint turn = offset % n;
    return ((mask << turn) | (mask >> (n - turn))) & ((1u << n) - 1u);
}
#endif
