// SPDX-License-Identifier: MIT
// A groom from a description: guides carry the shape, children follow the nearest guides and gather around one of them
// towards the tip, waves and curls are laid over the result, and nothing is left inside the head.
#include "guides.hpp"
#include "head.hpp"

#include <pelage/hair/generate.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace pelage::hair {
namespace {

using glm::vec3;

constexpr float kTwoPi = 6.2831853F;
constexpr float kLeastClearance = 0.0006F;  // m between a strand and the skin

struct Guide {
    Root root;
    std::vector<vec3> points;
    float phase = 0;  // of waves and curls: strands of a clump wave together
};

/// Waves and curls. Displacement stays within what the points can show: 4 points per turn or more.
struct Curl {
    float pitch = 0;   // m along the strand per turn; 0: straight
    float radius = 0;  // m, where fully grown
    float depth = 0;   // share of the radius in the second direction: 0 a wave, 1 a helix
};

Curl curlOf(const GroomDescriptor& d) {
    const float segment = d.length / static_cast<float>(std::max(d.pointsPerStrand, 2U) - 1);
    switch (d.style) {
        case Style::Wavy:
            return {std::max(0.027F, 4 * segment), 0.0042F, 0.25F};
        case Style::Curly:
            return {std::max(0.025F, 4 * segment), 0.0095F, 1.0F};
        default:
            return {};
    }
}

/// How much longer a curl makes a strand than the line it winds around.
float stretchOf(const Curl& c) {
    if (c.pitch <= 0) return 1;
    const float slope = kTwoPi * c.radius / c.pitch * (c.depth < 0.5F ? 0.62F : 0.9F);
    return std::sqrt(1 + slope * slope);
}

struct Follow {
    std::array<std::uint32_t, 3> guide = {};
    std::array<float, 3> weight = {};
};

/// The three nearest guides on the same side of the parting.
Follow nearestGuides(const Root& root, const std::vector<Guide>& guides) {
    Follow f;
    std::array<float, 3> best = {1e9F, 1e9F, 1e9F};
    for (std::uint32_t g = 0; g < guides.size(); ++g) {
        const vec3 d = guides[g].root.position - root.position;
        const bool across = guides[g].root.side != root.side && root.position.z > -0.06F;
        const float squared = glm::dot(d, d) + (across ? 0.01F : 0.0F);
        if (squared >= best[2]) continue;
        std::size_t at = 2;
        for (; at > 0 && squared < best[at - 1]; --at) {
            best[at] = best[at - 1];
            f.guide[at] = f.guide[at - 1];
        }
        best[at] = squared;
        f.guide[at] = g;
    }
    float sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += f.weight[k] = best[k] < 1e8F ? 1.0F / (best[k] + 1e-5F) : 0.0F;
    for (float& w : f.weight) w /= sum;
    return f;
}

/// A point of a polyline at t in 0..1.
vec3 pointAt(const std::vector<vec3>& points, float t) {
    const float x = std::clamp(t, 0.0F, 1.0F) * static_cast<float>(points.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(x), points.size() - 2);
    return glm::mix(points[i], points[i + 1], x - static_cast<float>(i));
}

/// Lays waves or a helix over a curve, in a frame carried along it without twist.
void addCurl(std::vector<vec3>& strand, const Curl& curl, float phase, float amount) {
    if (curl.pitch <= 0) return;
    const std::vector<vec3> line = strand;
    vec3 side(0);
    float s = 0;
    for (std::size_t i = 1; i < line.size(); ++i) {
        const vec3 step = line[i] - line[i - 1];
        const float length = glm::length(step);
        if (length < 1e-7F) continue;
        const vec3 t = step / length;
        if (side == vec3(0)) side = glm::cross(t, std::abs(t.y) < 0.9F ? vec3(0, 1, 0) : vec3(0, 0, 1));
        side = glm::normalize(side - t * glm::dot(side, t));
        s += length;
        const float grown = curl.radius * amount * glm::smoothstep(0.0F, 0.09F, s);
        const float angle = kTwoPi * s / curl.pitch + phase;
        strand[i] += grown * (std::cos(angle) * side + curl.depth * std::sin(angle) * glm::cross(t, side));
    }
}

class GroomMaker {
public:
    explicit GroomMaker(const GroomDescriptor& d) : d_(d), curl_(curlOf(d)) {
        d_.pointsPerStrand = std::max(d_.pointsPerStrand, 2U);
        guidePoints_ = std::max(d_.pointsPerStrand, 24U);
    }

    Strands make() {
        Strands groom;
        groom.width = d_.width;
        groom.first.push_back(0);
        if (d_.strands == 0) return groom;
        const std::vector<Root> roots = scatterRoots(d_.strands, d_.seed);
        growGuides();
        groom.points.reserve(std::size_t{d_.strands} * d_.pointsPerStrand);
        groom.widths.reserve(groom.points.capacity());
        for (std::uint32_t s = 0; s < d_.strands; ++s) {
            const std::vector<vec3> strand = makeStrand(roots[s], s);
            groom.points.insert(groom.points.end(), strand.begin(), strand.end());
            for (std::size_t i = 0; i < strand.size(); ++i) {
                const float t = static_cast<float>(i) / static_cast<float>(strand.size() - 1);
                groom.widths.push_back(d_.width * (1.0F - 0.65F * t * t));
            }
            groom.first.push_back(static_cast<std::uint32_t>(groom.points.size()));
        }
        return groom;
    }

private:
    void growGuides() {
        const std::uint32_t count = std::clamp(d_.strands / 30, 16U, 700U);
        const std::vector<Root> roots = scatterRoots(count, d_.seed ^ 0x5BD1E995U);
        for (std::uint32_t g = 0; g < count; ++g) {
            Random random(d_.seed, 0x200000000ULL + g);
            Guide guide;
            guide.root = roots[g];
            const float length = d_.length * random.between(0.92F, 1.12F) / stretchOf(curl_);
            guide.points = d_.style == Style::Ponytail ? growPonytail(roots[g], length, guidePoints_, random)
                                                       : growGuide(roots[g], length, guidePoints_, random);
            guide.phase = random.between(0, kTwoPi);
            guides_.push_back(std::move(guide));
        }
    }

    std::vector<vec3> makeStrand(const Root& root, std::uint32_t index) const {
        Random random(d_.seed, 0x300000000ULL + index);
        const bool flyaway = random.unit() < 0.025F;
        std::vector<vec3> strand;
        float phase = random.between(0, kTwoPi);
        const float share = 1.0F - 0.16F * random.unit() * random.unit();  // of the guide's length
        if (d_.style == Style::Ponytail) {
            const float tail = d_.length * (1.22F - 0.33F * std::sqrt(random.unit()));  // few are longest
            strand = growPonytail(root, tail, d_.pointsPerStrand, random);
        } else {
            const Follow follow = nearestGuides(root, guides_);
            phase = guides_[follow.guide[0]].phase + 0.25F * random.bell();
            strand = followGuides(root, follow, share, flyaway, random);
        }
        roughen(strand, flyaway, random);
        addCurl(strand, curl_, phase, random.between(0.85F, 1.1F));
        for (std::size_t i = 1; i < strand.size(); ++i) {
            // Curls near the scalp would cut into it; near the root there is only so much room.
            const float t = static_cast<float>(i) / static_cast<float>(strand.size() - 1);
            strand[i] = keepOutside(strand[i], kLeastClearance + 0.0012F * std::min(1.0F, 6.0F * t));
        }
        return strand;
    }

    /// The blend of the nearest guides, moved to this root, then gathered around the nearest one towards the tip.
    std::vector<vec3> followGuides(const Root& root, const Follow& follow, float share, bool flyaway,
                                   Random& random) const {
        const float gather = flyaway ? 0.1F : random.between(0.55F, 0.9F);
        const vec3 offset = 0.0035F * random.onSphere();
        const Guide& nearest = guides_[follow.guide[0]];
        std::vector<vec3> strand(d_.pointsPerStrand);
        for (std::uint32_t i = 0; i < d_.pointsPerStrand; ++i) {
            const float t = static_cast<float>(i) / static_cast<float>(d_.pointsPerStrand - 1);
            vec3 moved = root.position;
            for (std::size_t k = 0; k < 3; ++k) {
                const Guide& guide = guides_[follow.guide[k]];
                moved += follow.weight[k] * (pointAt(guide.points, t * share) - guide.root.position);
            }
            const vec3 gathered = pointAt(nearest.points, t * share) + offset * (0.4F + 0.6F * t);
            strand[i] = glm::mix(moved, gathered, gather * glm::smoothstep(0.05F, 1.0F, t));
        }
        strand[0] = root.position;
        return strand;
    }

    /// Low waves of each strand's own, and flyaways that leave the rest.
    void roughen(std::vector<vec3>& strand, bool flyaway, Random& random) const {
        const float amplitude = flyaway ? random.between(0.004F, 0.011F) : 0.0010F;
        const vec3 axis = random.onSphere(), other = random.onSphere();
        const float a = random.between(2.0F, 6.0F), b = random.between(5.0F, 11.0F), phase = random.between(0, kTwoPi);
        const vec3 outward = headNormal(strand.front());
        const float lift = flyaway ? random.between(0.0F, 0.016F) : 0.0F;
        for (std::size_t i = 1; i < strand.size(); ++i) {
            const float t = static_cast<float>(i) / static_cast<float>(strand.size() - 1);
            const float envelope = glm::smoothstep(0.0F, 0.7F, t);
            strand[i] += envelope * amplitude * (std::sin(a * t + phase) * axis + 0.5F * std::sin(b * t) * other);
            strand[i] += outward * (lift * t);
        }
    }

    GroomDescriptor d_;
    Curl curl_;
    std::uint32_t guidePoints_ = 24;
    std::vector<Guide> guides_;
};

const char* nameOf(Style style) {
    switch (style) {
        case Style::Straight:
            return "straight";
        case Style::Wavy:
            return "wavy";
        case Style::Curly:
            return "curly";
        case Style::Ponytail:
            return "ponytail";
    }
    return "groom";
}

}  // namespace

Strands makeGroom(const GroomDescriptor& descriptor) {
    Strands groom = GroomMaker(descriptor).make();
    groom.name = nameOf(descriptor.style);
    groom.center = headCenter();
    groom.updateBounds();
    return groom;
}

}  // namespace pelage::hair
