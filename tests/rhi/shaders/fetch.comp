#version 460
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 1) in;
layout(set = 0, binding = 0) uniform texture2D image;
layout(set = 0, binding = 1) buffer To { vec4 value[]; } to;
void main() { to.value[0] = texelFetch(image, ivec2(0), 0); }
