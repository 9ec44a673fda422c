#version 460
layout(constant_id = 1) const float RED = 1;
layout(constant_id = 2) const bool GREEN = false;
layout(constant_id = 3) const int BLUE = 0;
layout(constant_id = 4) const uint ALPHA = 255;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;
void main() { color = vec4(RED, GREEN ? 1 : 0, float(BLUE) / 255.0, float(ALPHA) / 255.0); }
