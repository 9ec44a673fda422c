// SPDX-License-Identifier: MIT
// A fibre's material in a compute shader: what hair_forward.frag does for one light, for a list of directions.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/options.glsl"
#include "material/material_common.glsl"
#include "material/fiber_material.glsl"

layout(local_size_x = 64) in;

struct Query {
    vec4 wi, wo;  // about the tangent (1, 0, 0)
};
layout(set = 0, binding = 0, std430) readonly buffer Queries { Query queries[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Radiances { vec4 radiances[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(queries.length())) return;
    FiberMaterial m = fiberMaterial(material.baseColor);
    FiberAngles a = fiberAngles(vec3(1.0, 0.0, 0.0), queries[i].wi.xyz, queries[i].wo.xyz);
    a = atOffset(a, pixelOffset(vec2(float(i), 0.0), 0.5));
    radiances[i] = vec4(scatter(a, m, fetchRow(m, a.cosO), true), a.h);
}
