#version 460
layout(set = 0, binding = 0) uniform Frame { mat4 view; vec4 tint; } frame;
layout(location = 0) in vec2 position;
layout(location = 1) in vec4 color_in;
layout(location = 0) out vec4 color_out;
void main() {
    gl_Position = frame.view * vec4(position, 0.5, 1);
    color_out = color_in * frame.tint;
}
