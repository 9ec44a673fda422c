// SPDX-License-Identifier: MIT
// Parallel light: the same irradiance everywhere.
Incident incidentDirectional(LightData light, vec3 world) {
    return Incident(light.toLight, light.power);
}
