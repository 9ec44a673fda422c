// SPDX-License-Identifier: MIT
// Kajiya and Kay 1989, normalised: the integral of the diffuse part over the sphere is Kd (the integral of sin(t, l) is
// pi^2), that of the specular part is its weight at normal incidence and less elsewhere.
#ifndef PELAGE_SCATTERING_KAJIYA_KAY_GLSL
#define PELAGE_SCATTERING_KAJIYA_KAY_GLSL

struct KajiyaKayParameters {
    vec3 diffuse, specular;  // albedos
    float exponent, norm;    // norm: 1 / integral of cos^p(theta_i + theta_o) over the sphere at theta_o = 0
};

vec3 scatterKajiyaKay(vec3 u, vec3 wi, vec3 wo, KajiyaKayParameters p) {
    float sinI = clamp(dot(u, wi), -1.0, 1.0), sinO = clamp(dot(u, wo), -1.0, 1.0);
    float cosI = sqrt(1.0 - sinI * sinI), cosO = sqrt(1.0 - sinO * sinO);
    // cos(theta_i + theta_o) is 1 on the mirror cone theta_i = -theta_o; both vectors point away from the fibre.
    float mirror = max(cosI * cosO - sinI * sinO, 1e-6);
    return p.diffuse * (cosI * 0.1013211836) + p.specular * (p.norm * pow(mirror, p.exponent));
}
#endif
