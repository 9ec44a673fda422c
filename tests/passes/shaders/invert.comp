#version 450
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 8, local_size_y = 4) in;
layout(set = 1, binding = 0) uniform texture2D u_source;
layout(set = 1, binding = 1, rgba8) uniform writeonly image2D i_target;
void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(i_target)))) return;
    imageStore(i_target, at, vec4(1.0) - texelFetch(u_source, at, 0));
}
