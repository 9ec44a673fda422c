#version 460
layout(set = 0, binding = 0) readonly buffer Values { vec4 value[]; } values;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;
void main() { color = values.value[uint(gl_FragCoord.x) & 3u]; }
