#version 460
layout(set = 0, binding = 0) uniform texture2DArray image;
layout(set = 0, binding = 1) uniform sampler nearest;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;
void main() { color = texture(sampler2DArray(image, nearest), vec3(0.5, 0.5, floor(gl_FragCoord.x))); }
