// SPDX-License-Identifier: MIT
// Asks for what a material does not fill: a second block, a storage buffer, an array, a cube under a flat input's name.
#version 450
layout(set = 2, binding = 0, std140) uniform Material {
    float gain;
    vec4 table[2];
} material;
layout(set = 2, binding = 1, std140) uniform Second {
    float gain;
} second;
layout(set = 2, binding = 2, std430) readonly buffer Rows {
    float rows[];
};
layout(set = 2, binding = 3) uniform textureCube noiseMap;
layout(set = 2, binding = 4) uniform sampler s_material;
layout(location = 0) out vec4 o_color;

void main() {
    o_color = vec4(material.gain, material.table[1].x, second.gain, rows[0]) +
              texture(samplerCube(noiseMap, s_material), vec3(1.0));
}
