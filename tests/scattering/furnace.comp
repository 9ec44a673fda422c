// SPDX-License-Identifier: MIT
// A fibre under one view: the light it sends there out of a white sphere of directions, which is the light it would send
// everywhere from there. Midpoint rule; lobes must be wide enough for its steps. One invocation sums one inclination of
// the light: lavapipe ends every loop once an invocation has gone 65,536 times around loops in all.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "scattering/models/models.glsl"

layout(constant_id = 0) const int scatteringModel = 8;
layout(constant_id = 1) const bool asPublished = false;
layout(constant_id = 2) const int steps = 96;
layout(constant_id = 3) const float nearField = 0.0;
layout(local_size_x = 32) in;

struct View {
    float sinO, cosO, h, unused;
};
layout(set = 0, binding = 0, std430) readonly buffer Materials { FiberMaterial materials[]; };
layout(set = 0, binding = 1, std430) readonly buffer Views { View views[]; };
layout(set = 0, binding = 4, std430) writeonly buffer Energies { float energies[]; };  // by view, then inclination
layout(set = 0, binding = 2) uniform texture2DArray momentTable;
layout(set = 0, binding = 3) uniform sampler s_linear;

#define MOMENT_TEXTURE sampler2DArray(momentTable, s_linear)
#include "material/moment_texture.glsl"

void main() {
    uint id = gl_GlobalInvocationID.x / uint(steps), i = gl_GlobalInvocationID.x % uint(steps);
    if (id >= uint(views.length())) return;
    FiberMaterial m = materials[id % uint(materials.length())];
    m.nearField = nearField;
    View v = views[id];
    FiberAngles a;
    a.sinO = v.sinO;
    a.cosO = v.cosO;
    a.h = v.h;
    a.cosGamma = sqrt(max((1.0 - v.h) * (1.0 + v.h), 0.0));
    float theta = pi * ((float(i) + 0.5) / float(steps) - 0.5);
    a.sinI = sin(theta);
    a.cosI = cos(theta);
    float sum = 0.0;
    for (int j = 0; j < steps; ++j) {
        a.phi = pi * (2.0 * (float(j) + 0.5) / float(steps) - 1.0);
        a.cosPhi = clamp(cos(a.phi), -1.0, 1.0);
        FiberLobes s = scatterFiber(scatteringModel, asPublished, a, m, sampleMoments(a, momentRow(m, a.cosO, true)));
        sum += (s.R.x + s.TT.x + s.TRT.x + s.RES.x) * a.cosI;
    }
    energies[gl_GlobalInvocationID.x] = sum * (2.0 * pi * pi) / float(steps * steps);
}
