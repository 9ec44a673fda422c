// SPDX-License-Identifier: MIT
// A host's depth in the hair's convention: reversed, 1 near and 0 far.
#version 450
#extension GL_EXT_samplerless_texture_functions : require
#define HOST_DEPTH_REVERSED 0
layout(constant_id = 0) const int hostDepth = HOST_DEPTH_REVERSED;
layout(set = 1, binding = 0) uniform texture2D u_sceneDepth;

void main() {
    float depth = texelFetch(u_sceneDepth, ivec2(gl_FragCoord.xy), 0).r;
    gl_FragDepth = hostDepth == HOST_DEPTH_REVERSED ? depth : 1.0 - depth;
}
