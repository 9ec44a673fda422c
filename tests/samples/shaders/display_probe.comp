// SPDX-License-Identifier: MIT
// The generated display functions, one colour per invocation.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "display_ocio.glsl"

layout(local_size_x = 32) in;
layout(constant_id = 0) const bool plain = false;

layout(set = 0, binding = 0, std430) readonly buffer Source { vec4 colors[]; } source;
layout(set = 0, binding = 1, std430) buffer Target { vec4 colors[]; } target;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= source.colors.length()) return;
    target.colors[i] = plain ? displayPlain(source.colors[i]) : displayAces(source.colors[i]);
}
