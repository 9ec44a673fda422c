// SPDX-License-Identifier: MIT
// Averages the samples of a multisampled, premultiplied, scene-linear image.
#version 450
#extension GL_EXT_samplerless_texture_functions : require
layout(constant_id = 0) const int u_source_samples = 4;
layout(set = 1, binding = 0) uniform texture2DMS u_source;
layout(location = 0) out vec4 o_color;

void main() {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < u_source_samples; ++i) sum += texelFetch(u_source, ivec2(gl_FragCoord.xy), i);
    o_color = sum / float(u_source_samples);
}
