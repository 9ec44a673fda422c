#version 460
#extension GL_EXT_samplerless_texture_functions : require
// For the reflection tests only: one of each.
layout(local_size_x = 4, local_size_y = 2, local_size_z = 3) in;
layout(constant_id = 3) const bool FLAG = true;
layout(constant_id = 5) const int COUNT = -2;
layout(constant_id = 7) const float SCALE = 1.5;
layout(constant_id = 9) const uint BITS = 6u;
struct Light { vec4 position; };
layout(set = 0, binding = 0) uniform Frame { mat4 view; vec3 eye; float time; Light lights[2]; } frame;
layout(set = 1, binding = 2) readonly buffer In { uint value[]; } source;
layout(set = 1, binding = 3) buffer Out { uint count; uint value[]; } result;
layout(set = 2, binding = 0) uniform texture2D image;
layout(set = 2, binding = 1) uniform texture2DArray layers;
layout(set = 2, binding = 2) uniform textureCube sky;
layout(set = 2, binding = 3) uniform texture3D density;
layout(set = 2, binding = 4) uniform texture2DMS multi;
layout(set = 2, binding = 5) uniform sampler filtering;
layout(set = 2, binding = 6, rgba16f) uniform writeonly image2D target;
layout(set = 2, binding = 7, r32ui) uniform readonly uimage2D counters;
layout(push_constant) uniform Push { vec4 color; ivec2 size; uint mode; } push;
void main() {
    vec4 c = texture(sampler2D(image, filtering), vec2(0)) + texture(sampler2DArray(layers, filtering), vec3(0)) +
             texture(samplerCube(sky, filtering), frame.eye) + texture(sampler3D(density, filtering), vec3(0)) +
             texelFetch(multi, ivec2(0), 0) + push.color + frame.lights[1].position;
    imageStore(target, ivec2(0), c * SCALE);
    result.value[0] = source.value[0] + (FLAG ? 1u : 0u) + uint(COUNT) + BITS + imageLoad(counters, push.size).x;
}
