// SPDX-License-Identifier: MIT
// The light loop's body: for (int i = 0; i < lightCount; ++i) { Incident light = arrivingLight(i, ...); ... }
#ifndef PELAGE_LIGHTS_GLSL
#define PELAGE_LIGHTS_GLSL
#include "light.glsl"
#include "shadow.glsl"

// What is left of light i at a point after its shadow. `density` in 1/m and `bias` in m are the material's.
Incident arrivingLight(int i, vec3 world, float density, float bias) {
    Incident incident = incidentLight(i, world);
    incident.irradiance *= shadowTransmittance(i, world, density, bias);
    return incident;
}
#endif
