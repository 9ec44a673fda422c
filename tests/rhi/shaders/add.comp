#version 460
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint STEP = 1;
layout(set = 0, binding = 0) buffer Numbers { uint value[]; } numbers;
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < numbers.value.length()) numbers.value[i] = numbers.value[i] * 2u + STEP;
}
