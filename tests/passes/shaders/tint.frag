#version 450
#extension GL_EXT_samplerless_texture_functions : require
layout(constant_id = 3) const float gain = 1.0;
layout(constant_id = 4) const bool swap = false;
layout(set = 1, binding = 2) uniform texture2D u_source;
layout(location = 0) out vec4 color;
void main() {
    vec4 source = texelFetch(u_source, ivec2(gl_FragCoord.xy), 0) * gain;
    color = swap ? source.bgra : source;
}
