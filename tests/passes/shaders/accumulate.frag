#version 450
#extension GL_EXT_samplerless_texture_functions : require
// What the last frame left, and 1/255 more of blue.
layout(set = 1, binding = 0) uniform texture2D u_last;
layout(location = 0) out vec4 color;
void main() {
    color = texelFetch(u_last, ivec2(gl_FragCoord.xy), 0) + vec4(0.0, 0.0, 1.0 / 255.0, 0.0);
}
