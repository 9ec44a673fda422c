#version 450
// The corners of a triangle that covers the target, and how to draw them.
layout(local_size_x = 1) in;
layout(set = 1, binding = 0, std430) writeonly buffer Corners { vec4 corners[]; } b_corners;
layout(set = 1, binding = 1, std430) writeonly buffer Arguments { uint vertices, instances, first, base; } b_arguments;
void main() {
    b_corners.corners[0] = vec4(-1.0, -1.0, 0.5, 1.0);
    b_corners.corners[1] = vec4(3.0, -1.0, 0.5, 1.0);
    b_corners.corners[2] = vec4(-1.0, 3.0, 0.5, 1.0);
    b_arguments.vertices = 3u;
    b_arguments.instances = 1u;
    b_arguments.first = 0u;
    b_arguments.base = 0u;
}
