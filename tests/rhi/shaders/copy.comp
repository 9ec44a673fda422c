#version 460
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer From { uint value[]; } from;
layout(set = 0, binding = 1) buffer To { uint value[]; } to;
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < to.value.length()) to.value[i] = from.value[i] + 1u;
}
