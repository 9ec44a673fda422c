#version 460
layout(local_size_x = 1) in;
layout(set = 0, binding = 0) uniform Params { uvec4 value; } params;
layout(set = 0, binding = 1) buffer To { uint value[]; } to;
void main() { to.value[0] = params.value.x + params.value.y; }
