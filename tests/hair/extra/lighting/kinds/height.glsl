// SPDX-License-Identifier: MIT
// A kind of light that the library does not have: the higher, the brighter.
Incident incidentHeight(LightData light, vec3 world) { return Incident(light.toLight, light.power * world.y); }
