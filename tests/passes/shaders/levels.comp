#version 450
#extension GL_EXT_samplerless_texture_functions : require
// The first texel of each level of a 3D image, and how many levels there are.
layout(local_size_x = 8) in;
layout(set = 1, binding = 0) uniform texture3D u_grid;
layout(set = 1, binding = 1, std430) writeonly buffer Values { float values[]; } b_values;
void main() {
    int level = int(gl_GlobalInvocationID.x), count = textureQueryLevels(u_grid);
    b_values.values[level] = level < count ? texelFetch(u_grid, ivec3(0), level).r : level == 7 ? float(count) : -1.0;
}
