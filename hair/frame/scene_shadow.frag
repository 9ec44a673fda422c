// SPDX-License-Identifier: MIT
// The shadow of hair on a host's picture. The picture's shading is not known here, only that a part of it
// (`sceneShadow` percent) is direct light; of that part, the share of the lights that hair stands before is taken away.
// Position and facing come from the host's depth, so a pixel at a silhouette may take its neighbour's facing.
#version 450
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#define FRAME_SET 1
#define FRAME_BINDING 3
#include "shaders/options.glsl"
#include "shaders/frame.glsl"
#include "lighting/lights.glsl"

#define HOST_DEPTH_REVERSED 0
layout(constant_id = 30) const int hostDepth = HOST_DEPTH_REVERSED;
layout(constant_id = 31) const int sceneShadow = 70;
layout(set = 1, binding = 2) uniform texture2D u_sceneDepth;
layout(location = 0) out vec4 o_color;

void main() {
    float depth = texelFetch(u_sceneDepth, ivec2(gl_FragCoord.xy), 0).r;
    if (hostDepth != HOST_DEPTH_REVERSED) depth = 1.0 - depth;
    vec2 ndc = vec2(2.0, -2.0) * gl_FragCoord.xy * frame.pixelSize + vec2(-1.0, 1.0);
    // What is infinitely far would divide by zero; it is dropped below, after the derivatives.
    vec4 h = frame.inverseViewProjection * vec4(ndc, max(depth, 1e-7), 1.0);
    vec3 world = h.xyz / h.w;
    vec3 normal = cross(dFdx(world), dFdy(world));
    o_color = vec4(0.0);
    if (depth <= 1e-7 || dot(normal, normal) <= 0.0) return;
    normal = normalize(normal);
    if (dot(normal, frame.eye - world) < 0.0) normal = -normal;
    float all = 0.0, lit = 0.0;
    for (int i = 0; i < lightCount; ++i) {
        Incident light = incidentLight(i, world);
        float power = dot(light.irradiance, vec3(0.2126, 0.7152, 0.0722)) * max(dot(normal, light.direction), 0.0);
        all += power;
        lit += power * shadowTransmittance(i, world, 0.0, 1e-3);
    }
    float taken = all > 0.0 ? 1.0 - lit / all : 0.0;
    o_color = vec4(0.0, 0.0, 0.0, taken * float(sceneShadow) * 0.01);
}
