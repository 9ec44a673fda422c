#version 460
void main() { gl_Position = vec4(gl_VertexIndex == 0 ? -0.5 : 0.5, 0, 0.5, 1); }
