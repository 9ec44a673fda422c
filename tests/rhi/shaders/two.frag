#version 460
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;
layout(location = 1) out uint number;
void main() { color = vec4(0, 1, 0, 1); number = 7u + uint(gl_FragCoord.x); }
