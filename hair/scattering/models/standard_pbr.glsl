// SPDX-License-Identifier: MIT
// The usual surface material: Lambert and GGX with height-correlated Smith shadowing and Schlick's Fresnel
// (Burley 2012; Heitz 2014). Returns f cos(n, wi).
#ifndef PELAGE_SCATTERING_STANDARD_PBR_GLSL
#define PELAGE_SCATTERING_STANDARD_PBR_GLSL

struct PbrParameters {
    vec3 color;
    float metallic, roughness, f0, specularScale;
};

vec3 scatterStandardPbr(vec3 n, vec3 wi, vec3 wo, PbrParameters p) {
    float cosI = dot(n, wi);
    if (cosI <= 0.0) return vec3(0.0);
    float cosO = max(dot(n, wo), 1e-4);
    vec3 h = normalize(wi + wo);
    float cosH = clamp(dot(n, h), 0.0, 1.0), cosWoH = clamp(dot(wo, h), 0.0, 1.0);
    float alpha = max(p.roughness * p.roughness, 2e-3);
    float a2 = alpha * alpha;
    float k = (cosH * a2 - cosH) * cosH + 1.0;
    float d = a2 / (3.14159265 * k * k);
    float v = 0.5 / (cosI * sqrt(cosO * cosO * (1.0 - a2) + a2) + cosO * sqrt(cosI * cosI * (1.0 - a2) + a2));
    vec3 f0 = mix(vec3(p.f0), p.color, p.metallic);
    float m = 1.0 - cosWoH;
    vec3 f = f0 + (1.0 - f0) * (m * m * m * m * m);
    vec3 diffuse = (1.0 - f) * (1.0 - p.metallic) * p.color * 0.3183098862;
    return (diffuse + p.specularScale * d * v * f) * cosI;
}
#endif
