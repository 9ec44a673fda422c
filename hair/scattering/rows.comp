// SPDX-License-Identifier: MIT
// The scattering models on rows of parameters, for measuring them where they are used. One invocation, one row.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "scattering/models/models.glsl"

layout(constant_id = 0) const int scatteringModel = 8;
layout(constant_id = 1) const bool asPublished = false;
layout(local_size_x = 64) in;

struct Row {
    FiberAngles angles;
    FiberMaterial fiber;
    vec4 weights;     // bilinear, x and y
    vec4 texels[12];  // four of each layer of the moment table
};
struct Result {
    vec4 lobe[4];
};
layout(set = 0, binding = 0, std430) readonly buffer Rows { Row rows[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Results { Result results[]; };

vec4 bilinear(Row r, int layer) {
    return mix(mix(r.texels[4 * layer], r.texels[4 * layer + 1], r.weights.x),
               mix(r.texels[4 * layer + 2], r.texels[4 * layer + 3], r.weights.x), r.weights.y);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(rows.length())) return;
    Row r = rows[i];
    FiberTable t;
    t.lobes = bilinear(r, 0);
    t.lengths = bilinear(r, 1);
    t.rest = bilinear(r, 2);
    FiberLobes s = scatterFiber(scatteringModel, asPublished, r.angles, r.fiber, t);
    results[i].lobe[0] = vec4(s.R, 0.0);
    results[i].lobe[1] = vec4(s.TT, 0.0);
    results[i].lobe[2] = vec4(s.TRT, 0.0);
    results[i].lobe[3] = vec4(s.RES, 0.0);
}
