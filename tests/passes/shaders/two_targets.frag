#version 450
layout(location = 0) out vec4 color;
layout(location = 1) out vec4 more;
void main() { color = more = vec4(1.0); }
