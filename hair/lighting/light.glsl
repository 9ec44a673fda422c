// SPDX-License-Identifier: MIT
// Light that arrives at a point from light i, before shadows. Expects frame.glsl.
#ifndef PELAGE_LIGHT_GLSL
#define PELAGE_LIGHT_GLSL
// Set by the renderer, not by a material (light.hpp, LightOptions).
layout(constant_id = 23) const int lightCount = 0;
layout(constant_id = 24) const uint lightKinds = 0;    // four bits a light, light 0 lowest: a number of light_kinds.def
layout(constant_id = 25) const uint lightShadows = 0;  // a bit a light: it has a layer of the shadow map

// A beam of E_perp scattered evenly into all directions has the radiance E_perp / (4 pi).
const float isotropic = 0.0795774715;

struct Incident {
    vec3 direction;   // unit, from the surface to the light
    vec3 irradiance;  // E_perp, W/m2, on a plane facing the light
};
#include "light_kind_files.glsl"  // generated from the list: the file of each kind

#define PELAGE_LIGHT_KIND(number, word, name, traits, power) const uint LIGHT_##word = number;
#include "include/pelage/hair/light_kinds.def"
#undef PELAGE_LIGHT_KIND

uint lightKind(int i) { return (lightKinds >> uint(4 * i)) & 15u; }
bool lightHasShadow(int i) { return ((lightShadows >> uint(i)) & 1u) != 0u; }

Incident incidentLight(int i, vec3 world) {
    uint kind = lightKind(i);
#define PELAGE_LIGHT_KIND(number, word, name, traits, power) \
    if (kind == number) return incident##name(frame.lights[i], world);
#include "include/pelage/hair/light_kinds.def"
#undef PELAGE_LIGHT_KIND
    return Incident(vec3(0.0, 1.0, 0.0), vec3(0.0));
}
#endif
