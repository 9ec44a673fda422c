// SPDX-License-Identifier: MIT
// What arrives from the lights, after shadows, with the lists of tests/hair/extra.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/options.glsl"
#include "shaders/frame.glsl"
#define VARYING in
#include "shaders/varyings.glsl"
#include "lighting/lights.glsl"

layout(set = 2, binding = 0, std140) uniform Material {
    float density;
} material;
layout(location = 0) out vec4 o_color;

void main() {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < lightCount; ++i) sum += arrivingLight(i, v_world, material.density, 0.0).irradiance;
    o_color = vec4(sum, 1.0);
}
