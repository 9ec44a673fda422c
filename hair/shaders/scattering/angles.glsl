// SPDX-License-Identifier: MIT
// Light and view in the frame of a fibre. u: unit tangent, root to tip; theta: angle from the normal plane, asin(w.u);
// phi: difference of azimuths. Both directions point away from the fibre.
#ifndef PELAGE_SCATTERING_ANGLES_GLSL
#define PELAGE_SCATTERING_ANGLES_GLSL
struct FiberAngles {
    float sinI, cosI, sinO, cosO;  // of theta_i, theta_o
    float thetaH;                  // (theta_i + theta_o) / 2
    float sinD, cosD;              // of theta_d = (theta_o - theta_i) / 2
    float cosPhi, cosHalfPhi;
};

FiberAngles fiberAngles(vec3 u, vec3 wi, vec3 wo) {
    FiberAngles a;
    a.sinI = clamp(dot(u, wi), -1.0, 1.0);
    a.sinO = clamp(dot(u, wo), -1.0, 1.0);
    a.cosI = sqrt(max(1.0 - a.sinI * a.sinI, 0.0));
    a.cosO = sqrt(max(1.0 - a.sinO * a.sinO, 0.0));
    float thetaI = asin(a.sinI), thetaO = asin(a.sinO);
    a.thetaH = 0.5 * (thetaI + thetaO);
    float thetaD = 0.5 * (thetaO - thetaI);
    a.sinD = sin(thetaD);
    a.cosD = max(cos(thetaD), 1e-2);  // grazing both ways from opposite ends: bounds 1 / cos2
    vec3 pi = wi - a.sinI * u, po = wo - a.sinO * u;
    a.cosPhi = clamp(dot(pi, po) * inversesqrt(max(dot(pi, pi) * dot(po, po), 1e-12)), -1.0, 1.0);
    a.cosHalfPhi = sqrt(max(0.5 + 0.5 * a.cosPhi, 0.0));
    return a;
}

float gaussian(float sigma, float x) {
    return exp(-0.5 * x * x / (sigma * sigma)) * (0.3989422804 / sigma);
}

// Schlick 1994; cosine in 0..1.
float fresnelSchlick(float f0, float cosine) {
    float m = 1.0 - clamp(cosine, 0.0, 1.0);
    float m2 = m * m;
    return f0 + (1.0 - f0) * m2 * m2 * m;
}
#endif
