#version 460
layout(push_constant) uniform Push { vec4 a; vec4 b; } push;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;
void main() { color = push.a + push.b; }
