// SPDX-License-Identifier: MIT
// Strands as ribbons that face the camera: each instance is a piece of one strand, each pair of vertices its two edges at
// one place of the curve, so that the segments of a strand share their corners. A ribbon is never narrower than a pixel;
// what is drawn too wide is paid back as coverage.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/options.glsl"
#include "shaders/frame.glsl"
#include "shaders/object.glsl"
#define VARYING out
#include "shaders/varyings.glsl"

// As in struct Strands, unchanged. Positions may be those of this frame, and then lie in a layout of their own.
layout(set = 3, binding = 1, std430) readonly buffer Points { float points[]; };   // x, y, z of each point
layout(set = 3, binding = 2, std430) readonly buffer Starts { uint starts[]; };    // where a strand begins in `points`
layout(set = 3, binding = 3, std430) readonly buffer First { uint first[]; };      // and in everything else
layout(set = 3, binding = 4, std430) readonly buffer Widths { float widths[]; };   // m
layout(set = 3, binding = 5, std430) readonly buffer Colors { float colors[]; };   // r, g, b of each point
layout(set = 3, binding = 6, std430) readonly buffer Ids { float ids[]; };         // of each strand
layout(set = 3, binding = 7, std430) readonly buffer Pieces { uvec2 pieces[]; };   // strand, point of it to begin at

const float least = 1e-20;  // squared lengths below have no direction

vec3 pointAt(uint i) { return vec3(points[3u * i], points[3u * i + 1u], points[3u * i + 2u]); }

vec3 colorAt(uint i) {
    uint at = 3u * i * object.strides.z;
    return vec3(colors[at], colors[at + 1u], colors[at + 2u]);
}

// Vertex k of the curve of the strand with points start..start + last, clamped to its ends, and the derivative there:
// uniform Catmull-Rom with doubled end points, as in geometry/curve.cpp.
vec3 onCurve(uint start, int last, int k, out vec3 derivative) {
    k = clamp(k, 0, last * subdivisions);
    int i = min(k / subdivisions, last - 1);
    vec3 b = pointAt(start + uint(i)), c = pointAt(start + uint(i + 1));
    vec3 a = pointAt(start + uint(max(i - 1, 0))), d = pointAt(start + uint(min(i + 2, last)));
    precise vec3 m0 = 0.5 * (c - a), m1 = 0.5 * (d - b), e = c - b;
    precise float t = float(k - i * subdivisions) / float(subdivisions);
    derivative = m0 + t * (2.0 * (3.0 * e - 2.0 * m0 - m1) + 3.0 * t * (m0 + m1 - 2.0 * e));
    precise vec3 between = b + t * (m0 + t * (3.0 * e - 2.0 * m0 - m1 + t * (m0 + m1 - 2.0 * e)));
    return t == 0.0 ? b : t == 1.0 ? c : between;
}

vec2 unitOr(vec2 v, vec2 otherwise) {
    precise float squared = v.x * v.x + v.y * v.y;
    precise vec2 unit = v * inversesqrt(squared);
    return squared > least ? unit : otherwise;
}

vec3 unitOr(vec3 v, vec3 otherwise) {
    precise float squared = v.x * v.x + v.y * v.y + v.z * v.z;
    precise vec3 unit = v * inversesqrt(squared);
    return squared > least ? unit : otherwise;
}

// The part of v perpendicular to the unit vector n; any perpendicular where nothing but rounding is left.
vec3 perpendicularOr(vec3 v, vec3 n) {
    vec3 direction = unitOr(v, vec3(0.0));
    vec3 rest = direction - n * dot(direction, n);
    vec3 axis = abs(n.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
    vec3 chosen = dot(rest, rest) < 3e-8 ? axis - n * dot(axis, n) : rest;
    return normalize(chosen);
}

void main() {
    uvec2 piece = pieces[gl_InstanceIndex];
    uint from = first[piece.x];
    int last = int(first[piece.x + 1u] - from) - 1;
    uint start = starts[piece.x * object.strides.x];
    int k = min(int(piece.y) * subdivisions + (gl_VertexIndex >> 1), last * subdivisions);
    float side = (gl_VertexIndex & 1) == 0 ? 0.5 : -0.5;

    // Loads are what this shader spends most on: without subdivisions a place of the curve is a point, and the derivative
    // there leads from the point before to the point after.
    precise vec3 here, before, after;
    vec3 derivative;
    if (subdivisions == 1) {
        here = pointAt(start + uint(k));
        before = pointAt(start + uint(max(k - 1, 0)));
        after = pointAt(start + uint(min(k + 1, last)));
        derivative = 0.5 * (after - before);
    } else {
        vec3 unused;
        here = onCurve(start, last, k, derivative);
        before = onCurve(start, last, k - 1, unused);
        after = onCurve(start, last, k + 1, unused);
    }

    // The forward pass tests its depth for equality against the depth pass: the same module and no contraction make the
    // positions equal to the bit.
    precise vec4 world = object.model * vec4(here, 1.0);
    precise vec4 clip = frame.viewProjection * world;
    // Gradients of the pixel coordinates, pixels per metre: what a small step in the world does on the screen.
    mat4 m = frame.viewProjection;
    precise float w = abs(clip.w) < 1e-12 ? 1e-12 : clip.w;
    precise vec2 ndc = clip.xy / w;
    precise vec3 row3 = vec3(m[0][3], m[1][3], m[2][3]);
    precise vec3 gradX = (vec3(m[0][0], m[1][0], m[2][0]) - ndc.x * row3) * (0.5 * frame.viewport.x / w);
    precise vec3 gradY = (vec3(m[0][1], m[1][1], m[2][1]) - ndc.y * row3) * (0.5 * frame.viewport.y / w);

    // The edges of two segments meet on the line that halves their angle (a mitre; at most twice as far out).
    precise vec3 stepIn = mat3(object.model) * (here - before), stepOut = mat3(object.model) * (after - here);
    precise vec2 pixelsIn = vec2(dot(gradX, stepIn), dot(gradY, stepIn));
    precise vec2 pixelsOut = vec2(dot(gradX, stepOut), dot(gradY, stepOut));
    precise vec2 outward = unitOr(pixelsOut, unitOr(pixelsIn, vec2(1.0, 0.0)));
    precise vec2 inward = unitOr(pixelsIn, outward);
    precise vec2 along = unitOr(inward + outward, outward);
    precise float mitre = 1.0 / max(along.x * outward.x + along.y * outward.y, 0.5);
    precise vec2 across = vec2(along.y, -along.x);

    uint at = from + uint(k);
    precise float width;
    vec3 color;
    if (subdivisions == 1) {
        width = widths[at * object.strides.y];
        color = colorAt(at);
    } else {
        int i = min(k / subdivisions, last - 1);
        precise float t = float(k - i * subdivisions) / float(subdivisions);
        at = from + uint(i);
        width = mix(widths[at * object.strides.y], widths[(at + 1u) * object.strides.y], t);
        color = mix(colorAt(at), colorAt(at + 1u), t);
    }
    // A circle across the strand becomes an ellipse under the model matrix; its area tells its mean diameter.
    precise vec3 tangent = unitOr(derivative, unitOr(after - before, vec3(0.0, -1.0, 0.0)));
    precise vec3 stretched = mat3(object.model) * tangent;
    precise float stretch = sqrt(dot(stretched, stretched));
    width *= sqrt(object.center.w / max(stretch, 1e-12));
    // How many pixels it is wide: exact for a round strand, whose edges lie across the line of sight, in parallel and
    // central projections alike.
    precise vec3 gradient = gradX * across.x + gradY * across.y;
    precise float projected = width * sqrt(dot(gradient, gradient));
    precise float drawn = max(projected, 1.0);
    precise vec2 offset = across * (side * drawn * mitre);
    clip.xy += 2.0 * offset * frame.pixelSize * clip.w;
    gl_Position = clip;

    v_world = world.xyz;
    v_tangent = stretched;
    v_normal = mat3(object.normalMatrix) * perpendicularOr(here - object.center.xyz, tangent);
    v_strand = vec2(ids[piece.x], float(k) / float(last * subdivisions));
    v_uv = v_strand;
    v_object = here;
    v_coverage = projected / drawn;
    v_color = color;
}
