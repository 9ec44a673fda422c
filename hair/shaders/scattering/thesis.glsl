// SPDX-License-Identifier: MIT
// The thesis' far-field R, TT, TRT model (chapter 4, after Karis 2016 and Tafuri 2019), its printed errors corrected:
//   S = sum over p of 1/2 g(sigma_p; theta_h - alpha_p) N_p(phi) cos(theta_i) / cos2(theta_d)
// so that the integral of S over the sphere is about the attenuation A_p. Corrections to the print:
//   the factor 1/2 (g is a unit Gaussian in theta_h, whose measure is half that of theta_i + theta_o: (4.2), (4.3));
//   theta by asin of the tangent component, not arccos (table 4.1);
//   Fresnel of R at sqrt(1/2 + wi.wo / 2), not wi.wo / 2 (4.11);
//   paths divided by cos(theta_t), and h by eta', not cos(theta_d) and eta (4.17);
//   the azimuthal lobe of TRT keeps its energy when beta_N widens it: azimuthNorm (4.27).
// L_o = S(wi, wo) E_perp: the projected cosine is inside S.
#ifndef PELAGE_SCATTERING_THESIS_GLSL
#define PELAGE_SCATTERING_THESIS_GLSL
#include "angles.glsl"

struct ThesisParameters {
    vec3 color;          // C, 0..1: what two radii of fibre transmit, squared
    vec3 sigma, shift;   // longitudinal width and shift of R, TT, TRT in theta_h, rad
    vec3 weight;         // artist's factor of each
    float azimuthScale;  // s_r of (4.27)
    float azimuthNorm;
    float fresnelF0, eta;
};

vec3 scatterThesis(vec3 u, vec3 wi, vec3 wo, ThesisParameters p) {
    FiberAngles a = fiberAngles(u, wi, wo);
    float etaPerp2 = p.eta * p.eta - a.sinD * a.sinD;  // (eta' cos theta_d)^2
    float inverseEta = a.cosD * inversesqrt(max(etaPerp2, 1e-4));  // 1 / eta', Bravais
    float cosT = sqrt(max(1.0 - a.sinD * a.sinD / (p.eta * p.eta), 1e-4));
    vec3 logColor = log2(max(p.color, vec3(1e-4)));

    vec3 s = vec3(0.0);
    if (lobeR) {
        float f = fresnelSchlick(p.fresnelF0, sqrt(max(0.5 + 0.5 * dot(wi, wo), 0.0)));
        s += p.weight.x * gaussian(p.sigma.x, a.thetaH - p.shift.x) * f * 0.25 * a.cosHalfPhi;  // (4.10), (4.12)
    }
    if (lobeTT) {
        float h = 0.0;
        if (attenuationModel == ATTENUATION_KARIS_H) {
            h = min((1.0 + inverseEta * (0.6 - 0.8 * a.cosPhi)) * a.cosHalfPhi, 1.0);  // (4.16)
        }
        float f = fresnelSchlick(p.fresnelF0, a.cosD * sqrt(1.0 - h * h));  // (4.8)
        float cosGammaT = sqrt(max(1.0 - h * h * inverseEta * inverseEta, 0.0));
        vec3 transmitted = exp2(logColor * (0.5 * cosGammaT / cosT));  // (4.18)
        float d = exp(-3.65 * a.cosPhi - 3.98);                         // (4.21)
        s += p.weight.y * gaussian(p.sigma.y, a.thetaH - p.shift.y) * (1.0 - f) * (1.0 - f) * d * transmitted;
    }
    if (lobeTRT) {
        float f = fresnelSchlick(p.fresnelF0, 0.5 * a.cosD);  // (4.25): h = sqrt(3) / 2
        vec3 transmitted = exp2(logColor * (sqrt(max(1.0 - 0.75 * inverseEta * inverseEta, 0.0)) / cosT));  // (4.24)
        float d = p.azimuthNorm * exp(p.azimuthScale * (17.0 * a.cosPhi - 16.78));                         // (4.27)
        s += p.weight.z * gaussian(p.sigma.z, a.thetaH - p.shift.z) * (1.0 - f) * (1.0 - f) * f * d * transmitted;
    }
    return s * (0.5 * a.cosI / (a.cosD * a.cosD));
}

// Under an irradiance map there is one sample, in the direction of the normal: no TT, which would need what lies behind
// the hair (thesis section 4.4).
vec3 scatterThesisEnvironment(vec3 u, vec3 n, vec3 wo, ThesisParameters p) {
    p.weight.y = 0.0;
    return scatterThesis(u, n, wo, p);
}
#endif
