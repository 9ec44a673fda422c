// SPDX-License-Identifier: MIT
// Depth and shadow passes: decides which samples a card or strand covers and writes their depth. The forward pass then
// tests for equal depth, so this is the only place where opacity becomes visibility.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/options.glsl"
#include "shaders/frame.glsl"
#define VARYING in
#include "shaders/varyings.glsl"
#include "alpha.glsl"

layout(set = 2, binding = 0, std140) uniform Material {
    float alphaThreshold;
    float alphaHashScale;
} material;
layout(set = 2, binding = 1) uniform texture2D opacityMap;
layout(set = 2, binding = 2) uniform sampler s_material;

layout(location = 0) out vec4 o_coverage;  // alpha-to-coverage reads its alpha; no target is bound

void main() {
    float alpha = 1.0;
    if (alphaMode != ALPHA_OPAQUE) {
        alpha = isStrand ? v_coverage : texture(sampler2D(opacityMap, s_material), v_uv).a;
    }
    o_coverage = vec4(0.0, 0.0, 0.0, alpha);
    int mask = -1;
    if (alphaMode == ALPHA_HASHED) {
        uvec3 seed = uvec3(gl_FragCoord.xy, uint(v_strand.x * 16777215.0) + frame.frameIndex * 7919u);
        float u = isStrand ? max(hash01(seed), 1e-3) : hashedThreshold(v_object, material.alphaHashScale);
        if (sampleCount > 1) {
            mask = int(stochasticCoverage(alpha, u, pcg3d(seed).y));
            if (mask == 0) discard;
        } else if (alpha < u) {
            discard;
        }
    } else if (alphaMode == ALPHA_COVERAGE && sampleCount > 1) {
        // Sharpened around the threshold to about one pixel, so that coverage anti-aliases the edge of the alpha test
        // instead of making the whole strand transparent.
        float edge = max(fwidth(alpha), 1e-4);
        o_coverage.a = clamp((alpha - material.alphaThreshold) / edge + 0.5, 0.0, 1.0);
        if (o_coverage.a <= 0.0) discard;
    } else if (alphaMode == ALPHA_TEST || alphaMode == ALPHA_COVERAGE || alphaMode == ALPHA_BLEND) {
        // Alpha blend comes here for its shadow only.
        if (alpha < material.alphaThreshold) discard;
    }
    gl_SampleMask[0] = mask;
}
