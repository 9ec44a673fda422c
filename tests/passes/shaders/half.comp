#version 450
#extension GL_EXT_samplerless_texture_functions : require
// One level of a 3D pyramid from the level below it: the mean of eight texels.
layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;
layout(set = 1, binding = 0) uniform texture3D u_fine;
layout(set = 1, binding = 1, r32f) writeonly uniform image3D i_coarse;
void main() {
    ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(i_coarse)))) return;
    float sum = 0.0;
    for (int i = 0; i < 8; ++i) sum += texelFetch(u_fine, 2 * at + ivec3(i & 1, i >> 1 & 1, i >> 2), 0).r;
    imageStore(i_coarse, at, vec4(0.125 * sum));
}
