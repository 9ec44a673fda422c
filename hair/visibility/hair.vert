// SPDX-License-Identifier: MIT
// Meshes: cards and skin. Strands have strands.vert in its place.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/frame.glsl"
#include "shaders/object.glsl"
#define VARYING out
#include "shaders/varyings.glsl"

layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec3 a_tangent;
layout(location = 3) in vec2 a_uv;
layout(location = 4) in vec2 a_strand;  // id, along

void main() {
    precise vec4 world = object.model * vec4(a_position, 1.0);
    // The forward pass tests its depth for equality against the depth pass: the same module and no contraction make the
    // positions equal to the bit. (`invariant` would say so, but Mesa 22.3 warns of it and ignores it.)
    precise vec4 clip = frame.viewProjection * world;
    gl_Position = clip;
    v_world = world.xyz;
    v_normal = mat3(object.normalMatrix) * a_normal;
    v_tangent = mat3(object.model) * a_tangent;
    v_uv = a_uv;
    v_strand = a_strand;
    v_object = a_position;
    v_coverage = 1.0;
    v_color = vec3(1.0);
}
