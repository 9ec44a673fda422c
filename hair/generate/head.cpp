// SPDX-License-Identifier: MIT
#include "head.hpp"

#include <pelage/hair/generate.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace pelage::hair {
namespace {

using glm::vec3;

/// Distance to an ellipsoid, first order: exact on the surface, with unit gradient there.
float ellipsoid(const vec3& p, const vec3& center, const vec3& radii) {
    const vec3 q = (p - center) / radii;
    const float k0 = glm::length(q), k1 = glm::length(q / radii);
    if (k1 < 1e-6F) return -std::min({radii.x, radii.y, radii.z});
    return k0 * (k0 - 1.0F) / k1;
}

/// Distance to a segment with a radius that goes from ra at a to rb at b.
float limb(const vec3& p, const vec3& a, const vec3& b, float ra, float rb) {
    const vec3 ab = b - a;
    const float t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0F, 1.0F);
    return glm::length(p - (a + t * ab)) - glm::mix(ra, rb, t);
}

/// Union with a fillet of about `k` metres.
float join(float a, float b, float k) {
    const float h = std::max(k - std::abs(a - b), 0.0F);
    return std::min(a, b) - h * h / (4.0F * k);
}
float carve(float a, float b, float k) {
    return -join(-a, b, k);
}

/// Everything before the ears. `x` is folded to one half: the head is symmetric.
float faceFeatures(float d, const vec3& p) {
    const vec3 h(std::abs(p.x), p.y, p.z);
    d = join(d, ellipsoid(h, {0.040F, 1.5600F, 0.0560F}, {0.026F, 0.024F, 0.026F}), 0.020F);               // cheekbone
    d = join(d, limb(h, {0.010F, 1.6050F, 0.0830F}, {0.044F, 1.6060F, 0.0640F}, 0.011F, 0.009F), 0.016F);  // brow
    d = carve(d, ellipsoid(h, {0.032F, 1.5880F, 0.0960F}, {0.019F, 0.0125F, 0.020F}), 0.014F);             // eye socket
    d = join(d, ellipsoid(h, {0.0315F, 1.5880F, 0.0700F}, {0.0145F, 0.0125F, 0.0130F}), 0.004F);           // eye
    d = join(d, limb(h, {0.0F, 1.5960F, 0.0870F}, {0.0F, 1.5540F, 0.1060F}, 0.0070F, 0.0105F), 0.012F);    // nose
    d = join(d, ellipsoid(h, {0.0115F, 1.5500F, 0.0950F}, {0.0075F, 0.0070F, 0.0100F}), 0.007F);  // nostril wing
    d = join(d, ellipsoid(h, {0.0F, 1.5290F, 0.0830F}, {0.0230F, 0.0048F, 0.0115F}), 0.005F);     // upper lip
    d = join(d, ellipsoid(h, {0.0F, 1.5195F, 0.0815F}, {0.0190F, 0.0055F, 0.0115F}), 0.004F);     // lower lip
    d = join(d, ellipsoid(h, {0.0F, 1.4975F, 0.0690F}, {0.0210F, 0.0150F, 0.0175F}), 0.022F);     // chin
    return d;
}

float skull(const vec3& p) {
    const vec3 h(std::abs(p.x), p.y, p.z);
    float d = ellipsoid(p, {0, 1.6330F, -0.0150F}, {0.0750F, 0.0870F, 0.0950F});                          // cranium
    d = join(d, ellipsoid(p, {0, 1.6350F, 0.0180F}, {0.0640F, 0.0640F, 0.0680F}), 0.030F);                // forehead
    d = join(d, ellipsoid(p, {0, 1.5560F, 0.0210F}, {0.0560F, 0.0720F, 0.0640F}), 0.030F);                // face
    d = join(d, limb(h, {0.050F, 1.5450F, 0.002F}, {0.010F, 1.5000F, 0.0600F}, 0.014F, 0.013F), 0.030F);  // jaw
    if (p.z > 0.0F) d = faceFeatures(d, p);
    // The ear leans back and stands off the head.
    const vec3 ear = h - vec3(0.0790F, 1.5790F, -0.0120F);
    const vec3 leant(ear.x * 0.94F + ear.z * 0.34F, ear.y * 0.97F + ear.z * 0.24F,
                     ear.z * 0.91F - ear.x * 0.34F - ear.y * 0.24F);
    float shell = ellipsoid(leant, vec3(0), {0.0100F, 0.0310F, 0.0190F});
    shell = carve(shell, ellipsoid(leant, {0.0105F, 0.0030F, 0.0040F}, {0.0065F, 0.0190F, 0.0095F}), 0.006F);
    return join(d, shell, 0.010F);
}

float body(const vec3& p) {
    const vec3 h(std::abs(p.x), p.y, p.z);
    const float neck = limb(p, {0, 1.5600F, -0.0220F}, {0, 1.4100F, -0.0380F}, 0.0520F, 0.0570F);
    float d = limb(h, {0.0F, 1.3800F, -0.0400F}, {0.1600F, 1.3560F, -0.0450F}, 0.0600F, 0.0540F);  // shoulder
    d = join(d, ellipsoid(p, {0, 1.2900F, -0.0250F}, {0.1750F, 0.1050F, 0.0950F}), 0.050F);        // chest
    d = join(d, limb(h, {0.0200F, 1.4600F, -0.0550F}, {0.1200F, 1.3900F, -0.0480F}, 0.0340F, 0.0340F), 0.040F);
    d = join(d, neck, 0.035F);
    return carve(d, p.y - 1.2400F, 0.030F);  // the bust stands on a flat base with a rounded rim
}

}  // namespace

float headDistance(const vec3& p) {
    const float head = p.y > 1.36F ? skull(p) : 1.0F;
    const float rest = p.y < 1.64F ? body(p) : 1.0F;
    return join(head, rest, 0.020F);
}

vec3 headNormal(const vec3& p) {
    constexpr float e = 0.0008F;  // m; the four corners of a tetrahedron give the gradient
    const vec3 a(1, -1, -1), b(-1, -1, 1), c(-1, 1, -1), d(1, 1, 1);
    const vec3 g = a * headDistance(p + e * a) + b * headDistance(p + e * b) + c * headDistance(p + e * c) +
                   d * headDistance(p + e * d);
    const float length = glm::length(g);
    return length > 1e-9F ? g / length : vec3(0, 1, 0);
}

vec3 keepOutside(vec3 p, float margin) {
    for (int i = 0; i < 4; ++i) {
        const float d = headDistance(p);
        if (d >= margin) break;
        p += headNormal(p) * (margin - d + 1e-5F);
    }
    return p;
}

vec3 toHeight(vec3 p, float height) {
    for (int i = 0; i < 3; ++i) {
        const float d = headDistance(p) - height;
        if (std::abs(d) < 2e-5F) break;
        p -= headNormal(p) * d;
    }
    return p;
}

bool isScalp(const vec3& p) {
    // The hairline's height by azimuth, from the middle of the forehead (0) round to the nape (pi).
    struct Knot {
        float azimuth, height;
    };
    constexpr std::array<Knot, 10> line = {{{0.00F, 1.672F},
                                            {0.45F, 1.668F},
                                            {0.75F, 1.655F},
                                            {1.00F, 1.628F},
                                            {1.22F, 1.592F},
                                            {1.38F, 1.616F},
                                            {1.80F, 1.616F},
                                            {2.05F, 1.570F},
                                            {2.50F, 1.538F},
                                            {3.15F, 1.528F}}};
    const float azimuth = std::atan2(std::abs(p.x), p.z);
    std::size_t i = 1;
    while (i + 1 < line.size() && line[i].azimuth < azimuth) ++i;
    const float t = (azimuth - line[i - 1].azimuth) / (line[i].azimuth - line[i - 1].azimuth);
    const float eased = t * t * (3 - 2 * t);
    // A hairline is never a clean curve.
    const float ragged = 0.0025F * std::sin(210.0F * p.x + 90.0F * p.z) * std::sin(170.0F * p.z - 3.0F);
    return p.y > glm::mix(line[i - 1].height, line[i].height, eased) + ragged && std::abs(p.x) < 0.0805F;
}

vec3 headCenter() {
    return {0.0F, 1.60F, 0.0F};
}

}  // namespace pelage::hair
