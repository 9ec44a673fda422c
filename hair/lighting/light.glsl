// SPDX-License-Identifier: MIT
// Light arriving at a point from light i, before shadows.
#ifndef PELAGE_LIGHT_GLSL
#define PELAGE_LIGHT_GLSL
// A beam of E_perp scattered evenly into all directions has the radiance E_perp / (4 pi).
const float isotropic = 0.0795774715;

struct Incident {
    vec3 direction;   // unit, from the surface to the light
    vec3 irradiance;  // E_perp, W/m2, on a plane facing the light
};
Incident incidentLight(LightData light, vec3 world) {
    Incident incident;
    if (light.position.w < 0.5) {
        incident.direction = light.direction.xyz;
        incident.irradiance = light.power.rgb;
    } else {
        vec3 to = light.position.xyz - world;
        // A fibre is never nearer to the light than its own width; keeps a light inside the hair finite.
        float squared = max(dot(to, to), 1e-8);
        incident.direction = to * inversesqrt(squared);
        incident.irradiance = light.power.rgb / squared;
    }
    return incident;
}
#endif
