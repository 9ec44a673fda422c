#version 460
layout(set = 0, binding = 0) uniform texture2D depth_map;
layout(set = 0, binding = 1) uniform samplerShadow compare;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;
void main() { color = vec4(texture(sampler2DShadow(depth_map, compare), vec3(uv, 0.5))); }
