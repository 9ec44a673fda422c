// SPDX-License-Identifier: MIT
// Hair that is let fall: a walk that starts along the combed direction of the scalp, bends towards gravity and slides
// along whatever it meets. And hair that is tied: a way over the scalp to one point, then a falling tail.
#include "guides.hpp"

#include "head.hpp"

#include <algorithm>
#include <cmath>

namespace pelage::hair {
namespace {

using glm::vec3;

const vec3 kDown(0, -1, 0);
const vec3 kWhorl(0.010F, 1.712F, -0.045F);
const vec3 kPartingFront(0.014F, 1.706F, 0.060F);
const vec3 kTie(0.0F, 1.668F, -0.122F);

vec3 onSurface(const vec3& v, const vec3& normal) {
    return v - normal * glm::dot(v, normal);
}

/// Single precision, unlike unitOr(): the grooms of a seed are these very bits, and strands that slide over the head
/// carry the least difference far.
vec3 unit(const vec3& v, const vec3& fallback) {
    const float length = glm::length(v);
    return length > 1e-6F ? v / length : fallback;
}

/// Where a comb would leave the hair at this point of the scalp: away from the parting, round the whorl, off the face.
vec3 combed(const Root& root, const vec3& normal) {
    const vec3 along = kWhorl - kPartingFront;
    const float t = std::clamp(glm::dot(root.position - kPartingFront, along) / glm::dot(along, along), 0.0F, 1.0F);
    vec3 away = root.position - (kPartingFront + t * along);
    away = unit(away, vec3(root.side, 0, 0));
    if (t < 0.98F) away = unit(away + vec3(1.2F * root.side, 0, 0), away);  // a parting parts to the sides
    const float front = std::clamp((root.position.z + 0.02F) / 0.10F, 0.0F, 1.0F);
    const vec3 back = vec3(0.75F * root.side, 0.0F, -0.55F) * front;
    const vec3 swirl = t > 0.98F ? 0.35F * glm::cross(normal, away) : vec3(0);
    return unit(onSurface(away + back + swirl + 0.5F * kDown, normal), kDown);
}

/// Pushes strands that hang in front of the face to their side: hair is not combed over the nose.
vec3 offTheFace(const vec3& p, float side) {
    if (p.z < 0.0F || p.y > 1.70F) return vec3(0);
    const float inFront = std::clamp((p.z - 0.005F) / 0.05F, 0.0F, 1.0F);
    const float middle = std::clamp((0.088F - p.x * side) / 0.06F, 0.0F, 1.0F);
    return (vec3(1.0F * side, 0.0F, -0.55F)) * (inFront * middle * 1.6F);
}

/// Rounds the corners that sliding over the head leaves.
void smooth(std::vector<vec3>& curve, int passes) {
    for (int pass = 0; pass < passes; ++pass) {
        vec3 before = curve[0];
        for (std::size_t i = 1; i + 1 < curve.size(); ++i) {
            const vec3 here = curve[i];
            curve[i] = 0.25F * before + 0.5F * here + 0.25F * curve[i + 1];
            before = here;
        }
    }
}

/// The middle of the tail, `s` m beyond the tie.
vec3 tailMiddle(float s) {
    // It leaves back and a little up, and turns down over some 5 cm: the integral of a direction that decays.
    constexpr float turn = 0.045F;  // m
    const vec3 start(0.0F, 0.30F, -0.95F), end(0.0F, -1.0F, -0.03F);
    const float decayed = turn * (1 - std::exp(-s / turn));
    return kTie + end * s + (start - end) * decayed;
}

}  // namespace

std::vector<vec3> growGuide(const Root& root, float length, std::uint32_t points, Random& random) {
    constexpr std::uint32_t kSteps = 56;
    const float step = length / static_cast<float>(kSteps);
    const vec3 normal = headNormal(root.position);
    const float lift = random.between(0.003F, 0.011F);  // m, how far hair lies off the head: the layers of a groom
    const vec3 comb = unit(combed(root, normal) + 0.12F * random.onSphere(), kDown);
    const vec3 drift = onSurface(random.onSphere(), kDown) * 0.06F;
    std::vector<vec3> curve = {root.position};
    vec3 p = root.position, direction = unit(comb + 0.40F * normal, normal);
    for (std::uint32_t k = 0; k < kSteps; ++k) {
        const float s = step * static_cast<float>(k);  // m from the root
        const float falls = 1.0F - std::exp(-std::max(s - 0.015F, 0.0F) / 0.055F);
        const vec3 wanted = unit(glm::mix(comb, kDown + drift, falls) + offTheFace(p, root.side), kDown);
        direction = unit(glm::mix(direction, wanted, std::min(1.0F, step / 0.016F)), wanted);
        const float margin = lift * (1.0F - std::exp(-s / 0.020F)) + 0.0008F;
        const float distance = headDistance(p + direction * step);
        if (distance < margin) {
            const vec3 n = headNormal(p + direction * step);
            const float inward = std::min(glm::dot(direction, n), 0.0F);
            direction = unit(direction - n * inward, unit(onSurface(comb, n), kDown));
        }
        p = keepOutside(p + direction * step, margin);
        curve.push_back(p);
    }
    smooth(curve, 2);
    return resample(curve, points);
}

std::vector<vec3> growPonytail(const Root& root, float tail, std::uint32_t points, Random& random) {
    // Over the scalp: the great circle about the middle of the cranium, laid onto the surface.
    const vec3 middle(0.0F, 1.628F, -0.015F);
    const vec3 from = glm::normalize(root.position - middle), to = glm::normalize(kTie - middle);
    const float angle = std::acos(std::clamp(glm::dot(from, to), -1.0F, 1.0F));
    const float layer = random.between(0.0015F, 0.0065F);  // m above the scalp
    const auto direction = [&](float t) {
        if (angle < 1e-3F) return to;
        return (std::sin((1 - t) * angle) * from + std::sin(t * angle) * to) / std::sin(angle);
    };
    constexpr int kScalpSteps = 26, kTailSteps = 40;
    std::vector<vec3> curve;
    const float shape = random.unit();
    const vec3 around = unit(onSurface(root.position - kTie, glm::normalize(vec3(0, 0.30F, -0.95F))), vec3(1, 0, 0));
    const vec3 ring = around * (0.0095F * std::sqrt(random.between(0.05F, 1.0F)));  // place within the tie
    for (int k = 0; k <= kScalpSteps; ++k) {
        const float t = static_cast<float>(k) / kScalpSteps;
        const vec3 p = middle + direction(t) * glm::mix(glm::length(root.position - middle), 0.105F, t);
        const float height = layer * (1.0F - std::exp(-t * 9.0F));
        const vec3 laid = k == 0 ? root.position : toHeight(p, height);
        const float leave = glm::smoothstep(0.80F, 1.0F, t);
        curve.push_back(glm::mix(laid, kTie + ring, leave * leave));
    }
    const vec3 side(1, 0, 0);
    const float fan = random.between(0.6F, 1.6F), sway = 0.006F * random.bell();
    for (int k = 1; k <= kTailSteps; ++k) {
        const float t = static_cast<float>(k) / kTailSteps, s = tail * t;
        const vec3 center = tailMiddle(s);
        const vec3 heading = unit(tailMiddle(s + 0.002F) - center, kDown);
        const vec3 up = unit(glm::cross(side, heading), kDown);
        // The ring's plane turns with the tail; the bundle opens to some 3 cm and closes towards the tip.
        const float open = (1.0F + 1.9F * fan * glm::smoothstep(0.0F, 0.6F, t)) * (1.0F - 0.6F * t * t);
        const float y = glm::dot(ring, vec3(0, 0.95F, 0.30F));
        vec3 p = center + open * (side * ring.x - up * y);
        p += side * (sway * t * t) + heading * (0.004F * (shape - 0.5F) * t);
        curve.push_back(keepOutside(p, 0.003F));
    }
    smooth(curve, 3);
    return resample(curve, points);
}

}  // namespace pelage::hair
