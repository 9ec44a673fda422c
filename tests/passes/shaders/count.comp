#version 450
// Adds the last frame's values to this frame's, with a 1 for every invocation that ran.
layout(local_size_x = 4) in;
layout(set = 1, binding = 0, std430) readonly buffer Last { uint values[]; } b_last;
layout(set = 1, binding = 1, std430) buffer Now { uint values[]; } b_now;
void main() {
    b_now.values[gl_GlobalInvocationID.x] = b_last.values[gl_GlobalInvocationID.x] + 1u;
}
