// SPDX-License-Identifier: MIT
// What hair.vert and strands.vert hand to the fragment shaders. Define VARYING as in or out before including.
layout(location = 0) VARYING vec3 v_world;
layout(location = 1) VARYING vec3 v_normal;
layout(location = 2) VARYING vec3 v_tangent;
layout(location = 3) VARYING vec2 v_uv;
layout(location = 4) VARYING vec2 v_strand;   // x: strand ID 0..1, y: 0 root .. 1 tip
layout(location = 5) VARYING vec3 v_object;   // object-space position, anchors hashed alpha
layout(location = 6) VARYING float v_coverage;  // of a strand: projected width over drawn width, 0..1
layout(location = 7) VARYING vec3 v_color;      // of a strand: factor of the base colour
