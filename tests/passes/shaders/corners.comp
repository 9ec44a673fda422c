#version 450
// The corners of a triangle that covers the target.
layout(local_size_x = 1) in;
layout(set = 1, binding = 0, std430) writeonly buffer Corners { vec4 corners[]; } b_corners;
void main() {
    b_corners.corners[0] = vec4(-1.0, -1.0, 0.5, 1.0);
    b_corners.corners[1] = vec4(3.0, -1.0, 0.5, 1.0);
    b_corners.corners[2] = vec4(-1.0, 3.0, 0.5, 1.0);
}
