// SPDX-License-Identifier: MIT
// Light leaving the points of a strand toward the eye, by the fibre code of the material `hair`: the same functions and
// the same set 2 as its forward shader. The lights' own shadows are left out.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/options.glsl"
#include "shaders/frame.glsl"
#include "shaders/object.glsl"
#include "lighting/light.glsl"
#include "material/material_common.glsl"
#include "material/fiber_material.glsl"

layout(local_size_x = 64) in;
layout(set = 1, binding = 0, std430) readonly buffer Points { vec4 at[]; } b_points;  // xyz: object space, m
layout(set = 1, binding = 1, std430) writeonly buffer Radiance { vec4 of[]; } b_radiance;

vec3 worldOf(int i) {
    return (object.model * vec4(b_points.at[i].xyz, 1.0)).xyz;
}

void main() {
    int i = int(gl_GlobalInvocationID.x), last = b_points.at.length() - 1;
    if (i > last) return;
    vec3 world = worldOf(i);
    vec3 tangent = normalize(worldOf(min(i + 1, last)) - worldOf(max(i - 1, 0)));
    vec3 wo = normalize(frame.eye - world);
    FiberMaterial m = fiberMaterial(material.baseColor);
    MomentRow row = fetchRow(m, length(cross(tangent, wo)));
    vec3 radiance = vec3(0.0);
    for (int light = 0; light < lightCount; ++light) {
        Incident incident = incidentLight(light, world);
        radiance += scatter(fiberAngles(tangent, incident.direction, wo), m, row, true) * incident.irradiance;
    }
    b_radiance.of[i] = vec4(radiance, 1.0);
}
