// SPDX-License-Identifier: MIT
// Set 3: what is the same for one object.
#ifndef PELAGE_OBJECT_GLSL
#define PELAGE_OBJECT_GLSL
layout(set = 3, binding = 0, std140) uniform Object {
    mat4 model;
    mat4 normalMatrix;  // upper 3x3
    vec4 center;        // of strands: xyz, object space: what normals lead away from; w: |determinant| of the model matrix
    uvec4 strides;      // of strands, in elements: x of starts, y of widths, z of colours (0: one for all)
} object;
#endif
