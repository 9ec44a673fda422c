// SPDX-License-Identifier: MIT
// Ink where something nearer begins: a pixel is inked when one around it is nearer by more than `contrast`. Depth is
// reversed, 1 near and 0 far, so that the ratio of two depths is nearly that of the distances, the other way round.
#version 450
#extension GL_EXT_samplerless_texture_functions : require
layout(constant_id = 0) const float width = 2.0;     // pixels
layout(constant_id = 1) const float strength = 1.0;  // of the ink
layout(constant_id = 2) const float contrast = 0.03;
layout(set = 1, binding = 0) uniform texture2D u_color;  // premultiplied, scene-linear
layout(set = 1, binding = 1) uniform texture2DMS u_depth;
layout(location = 0) out vec4 o_color;

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy), last = textureSize(u_color, 0) - 1;
    int reach = int(ceil(width));
    float ink = 0.0;
    for (int s = 0; s < 4; ++s) {
        float depth = texelFetch(u_depth, here, s).r, edge = 0.0;
        for (int y = -reach; y <= reach; ++y) {
            for (int x = -reach; x <= reach; ++x) {
                if (length(vec2(x, y)) > width) continue;
                float other = texelFetch(u_depth, clamp(here + ivec2(x, y), ivec2(0), last), s).r;
                if (other > depth * (1.0 + contrast)) edge = 1.0;
            }
        }
        ink += 0.25 * strength * edge;
    }
    vec4 color = texelFetch(u_color, here, 0);
    o_color = mix(color, vec4(0.004, 0.003, 0.008, 1.0), ink);
}
