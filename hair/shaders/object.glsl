// SPDX-License-Identifier: MIT
// Set 3: what is the same for one object.
#ifndef PELAGE_OBJECT_GLSL
#define PELAGE_OBJECT_GLSL
layout(set = 3, binding = 0, std140) uniform Object {
    mat4 model;
    mat4 normalMatrix;  // upper 3x3
    vec4 lineWidth;     // x: of the main view, y: of shadow views, in pixels
} object;
#endif
