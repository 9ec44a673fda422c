// SPDX-License-Identifier: MIT
// A point that shines alike in all directions: E = I / d^2.
Incident incidentPoint(LightData light, vec3 world) {
    vec3 to = light.position - world;
    // A fibre is never nearer to the light than its own width; keeps a light inside the hair finite.
    float squared = max(dot(to, to), 1e-8);
    return Incident(to * inversesqrt(squared), light.power / squared);
}
