// SPDX-License-Identifier: MIT
// Bindings like those of probe.frag under another name: the device shares one layout between the two.
#version 450
layout(set = 2, binding = 0, std140) uniform Material {
    vec3 tint;
    float gain;
    vec2 pair;
    int steps;
    uint mask;
} material;
layout(set = 2, binding = 1) uniform texture2D grainMap;
layout(set = 2, binding = 2) uniform sampler s_material;
layout(location = 0) out vec4 o_color;

void main() {
    o_color = vec4(material.tint * material.gain * float(material.steps) * float(material.mask), 1.0) +
              texture(sampler2D(grainMap, s_material), material.pair);
}
