// SPDX-License-Identifier: MIT
// The members of a light as members of a block, so that reflection sees them.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(set = 0, binding = 0, std140) uniform Light {
#define PELAGE_LIGHT_MEMBER(type, name) type name;
#include "lighting/light.def"
} light;
layout(location = 0) out vec4 o_color;

void main() { o_color = vec4(light.power, light.shadowCentral); }
