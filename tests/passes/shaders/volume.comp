#version 450
// Numbers each texel of a 3D image, times a constant of the pass.
layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;
layout(constant_id = 0) const float gain = 1.0;
layout(set = 1, binding = 0, r32f) writeonly uniform image3D i_grid;
void main() {
    ivec3 at = ivec3(gl_GlobalInvocationID), size = imageSize(i_grid);
    if (any(greaterThanEqual(at, size))) return;
    imageStore(i_grid, at, vec4(gain * float(at.x + size.x * (at.y + size.y * at.z))));
}
