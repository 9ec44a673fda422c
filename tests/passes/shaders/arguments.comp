#version 450
// How many workgroups the next dispatch has: one for each 4 texels of a row of 8, and one value more in the buffer.
layout(local_size_x = 1) in;
layout(set = 1, binding = 0, std430) buffer Arguments { uint counts[]; } b_arguments;
void main() {
    b_arguments.counts[0] += 2u;  // on zeros
    b_arguments.counts[1] += 1u;
    b_arguments.counts[2] += 1u;
}
