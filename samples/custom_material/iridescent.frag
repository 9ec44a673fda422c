// SPDX-License-Identifier: MIT
// Kajiya-Kay with the colours of a thin film. Sets 0, 1 and 3 are as the library declares them; set 2 is the material's.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/options.glsl"
#include "shaders/frame.glsl"
#define VARYING in
#include "shaders/varyings.glsl"
#include "lighting/lights.glsl"

layout(constant_id = 30) const bool filmOn = true;

layout(set = 2, binding = 0, std140) uniform Material {
    vec3 rootColor;
    float fade;
    vec3 tipColor;
    float gloss;
    vec3 filmPhase;  // at normal incidence, for red, green and blue
    float filmStrength;
} material;

layout(early_fragment_tests) in;
layout(location = 0) out vec4 o_color;  // scene-linear, premultiplied

// Light reflected by both faces of the film interferes; the inner way shortens with the cosine inside it.
vec3 film(float cosine) {
    return 0.5 - 0.5 * cos(material.filmPhase * cosine);
}

void main() {
    vec3 tangent = normalize(v_tangent), wo = normalize(frame.eye - v_world);
    vec3 dye = mix(material.rootColor, material.tipColor, smoothstep(material.fade, 1.0, v_strand.y));
    float sinO = dot(tangent, wo), cosO = sqrt(max(1.0 - sinO * sinO, 0.0));
    vec3 radiance = dye * frame.ambient * 0.5;
    for (int i = 0; i < lightCount; ++i) {
        Incident light = arrivingLight(i, v_world, 40.0, 0.004);
        float sinI = dot(tangent, light.direction), cosI = sqrt(max(1.0 - sinI * sinI, 0.0));
        vec3 scattered = dye * (cosI * 0.1013211836);
        float highlight = pow(clamp(cosI * cosO - sinI * sinO, 0.0, 1.0), material.gloss);
        vec3 tint = vec3(0.04);
        if (filmOn) tint += material.filmStrength * 0.2 * film(dot(normalize(wo + light.direction), wo));
        radiance += (scattered + tint * highlight) * light.irradiance;
    }
    o_color = vec4(radiance, 1.0);
}
