#version 450
#extension GL_EXT_samplerless_texture_functions : require
layout(constant_id = 0) const int u_source_samples = 1;
layout(set = 1, binding = 0) uniform texture2DMS u_source;
layout(location = 0) out vec4 color;
void main() {
    vec4 sum = vec4(0);
    for (int i = 0; i < u_source_samples; ++i) sum += texelFetch(u_source, ivec2(gl_FragCoord.xy), i);
    color = sum / float(u_source_samples);
}
