#version 450
#extension GL_EXT_samplerless_texture_functions : require
// The greatest of four texels of the level below.
layout(set = 1, binding = 0) uniform texture2D u_fine;
layout(location = 0) out vec4 color;
void main() {
    ivec2 at = 2 * ivec2(gl_FragCoord.xy), last = textureSize(u_fine, 0) - 1;
    vec4 most = vec4(0.0);
    for (int i = 0; i < 4; ++i) most = max(most, texelFetch(u_fine, min(at + ivec2(i & 1, i >> 1), last), 0));
    color = most;
}
