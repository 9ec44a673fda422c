#version 460
#extension GL_EXT_samplerless_texture_functions : require
layout(set = 0, binding = 0) uniform texture2DMS image;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;
void main() {
    color = vec4(0);
    for (int i = 0; i < 4; ++i) color += texelFetch(image, ivec2(gl_FragCoord.xy), i) * 0.25;
}
