#version 460
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) buffer Numbers { uint value[]; } numbers;
void main() {
    uint x = gl_GlobalInvocationID.x;
    for (uint i = 0u; i < 2000u; ++i) x = x * 1664525u + 1013904223u;
    numbers.value[gl_GlobalInvocationID.x] = x;
}
