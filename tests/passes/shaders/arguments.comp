#version 450
// How many workgroups the next dispatch has: 2 x 1 x 1, added to zeros. What else was there shows, but not for hours.
layout(local_size_x = 1) in;
layout(set = 1, binding = 0, std430) buffer Arguments { uint counts[]; } b_arguments;
void main() {
    b_arguments.counts[0] = min(b_arguments.counts[0], 4u) + 2u;
    b_arguments.counts[1] = min(b_arguments.counts[1], 4u) + 1u;
    b_arguments.counts[2] = min(b_arguments.counts[2], 4u) + 1u;
}
