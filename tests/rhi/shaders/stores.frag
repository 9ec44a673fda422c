#version 460
layout(set = 0, binding = 0) buffer Count { uint value; } count;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;
void main() { atomicAdd(count.value, 1u); color = vec4(1); }
