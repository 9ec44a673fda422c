#version 460
layout(constant_id = 1) const float ALPHA = 0.5;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;
void main() { color = vec4(1, 1, 1, ALPHA); }
