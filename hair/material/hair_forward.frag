// SPDX-License-Identifier: MIT
// Hair lit fibre by fibre under punctual lights with shadows, one irradiance sample, ambient.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/options.glsl"
#include "shaders/frame.glsl"
#define VARYING in
#include "shaders/varyings.glsl"
#include "lighting/environment.glsl"
#include "lighting/lights.glsl"
#include "material_common.glsl"
#include "fiber_material.glsl"
#include "surface.glsl"

// Nothing here discards: what the depth pass has hidden is not shaded.
layout(early_fragment_tests) in;
layout(location = 0) out vec4 o_color;  // scene-linear, premultiplied

void main() {
    Surface s = fetchSurface();
    FiberMaterial m = fiberMaterial(s.color);
    MomentRow row = fetchRow(m, length(cross(s.tangent, s.wo)));
    float h = pixelOffset(gl_FragCoord.xy, v_strand.x);
    vec3 radiance = vec3(0.0);
    vec3 ambient = frame.ambient;
    for (int i = 0; i < lightCount; ++i) {
        Incident light = arrivingLight(i, s.world, material.shadowDensity, material.shadowBias);
        FiberAngles a = atOffset(fiberAngles(s.tangent, light.direction, s.wo), h);
        radiance += scatter(a, m, row, true) * light.irradiance;
        ambient += light.irradiance * isotropic;
    }
    if (envOn) {
        // One sample in the direction of the normal. No TT, which would need what lies behind the hair (thesis section
        // 4.4).
        FiberAngles a = atOffset(fiberAngles(s.tangent, s.normal, s.wo), h);
        radiance += scatter(a, widened(m), row, false) * environmentIrradiance(s.normal) * material.envScale;
    }
    if (ambientOn) radiance += m.color * ambient * material.ambientScatter;
    o_color = finish(radiance, s);
}
