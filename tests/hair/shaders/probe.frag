// SPDX-License-Identifier: MIT
// A shader of a host's own, for tests: a block, a texture and an option of every kind that a material can fill.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(constant_id = 0) const bool stripes = false;
layout(constant_id = 1) const int rings = 1;

layout(set = 2, binding = 0, std140) uniform Material {
    vec3 tint;
    float gain;
    vec2 pair;
    int steps;
    uint mask;
} material;
layout(set = 2, binding = 1) uniform texture2D noiseMap;
layout(set = 2, binding = 2) uniform sampler s_material;

layout(location = 0) in vec3 v_world;
layout(location = 0) out vec4 o_color;

void main() {
    vec3 color = material.tint * material.gain + texture(sampler2D(noiseMap, s_material), material.pair).rgb;
    if (stripes) color *= 0.5 + 0.5 * sin(v_world.y * float(material.steps * rings));
    o_color = vec4(material.mask > 0u ? color : vec3(0.0), 1.0);
}
