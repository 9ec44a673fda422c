// SPDX-License-Identifier: MIT
// Passes a single-sampled image on.
#version 450
#extension GL_EXT_samplerless_texture_functions : require
layout(set = 1, binding = 0) uniform texture2D u_source;
layout(location = 0) out vec4 o_color;

void main() { o_color = texelFetch(u_source, ivec2(gl_FragCoord.xy), 0); }
