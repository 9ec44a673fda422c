#version 460
// One triangle over the lower left half of the screen, counter-clockwise; depth by a constant.
layout(constant_id = 0) const float DEPTH = 0.5;
layout(location = 0) out vec2 uv;
void main() {
    vec2 corner = vec2(gl_VertexIndex == 1 ? 1 : 0, gl_VertexIndex == 2 ? 1 : 0);
    uv = corner;
    gl_Position = vec4(corner * 2.0 - 1.0, DEPTH, 1);
}
