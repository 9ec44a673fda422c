// SPDX-License-Identifier: MIT
// The mean strand of a cluster, and how wide and how bent the cluster is around it.
#include "clusters.hpp"

#include "geometry/vectors.hpp"

#include <algorithm>
#include <array>

namespace pelage::hair {
namespace {

using glm::vec3;
using Station = CardFrame::Station;

constexpr float kLeastHalfWidth = 0.0025F;  // m

float lengthOfStrand(std::span<const vec3> strand) {
    float length = 0;
    for (std::size_t i = 1; i < strand.size(); ++i) length += glm::length(strand[i] - strand[i - 1]);
    return length;
}

/// The value that `share` of the values do not exceed.
float quantile(std::vector<float> values, float share) {
    if (values.empty()) return 0;
    const auto at = static_cast<std::size_t>(share * static_cast<float>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
    return values[at];
}

float arcOf(const CardFrame& frame, std::size_t station) {
    return frame.length * static_cast<float>(station) / static_cast<float>(frame.stations.size() - 1);
}

/// Roots of a cluster do not lie side by side: some lie further along the card than others. Sets starts and length.
void placeStarts(const Strands& groom, std::span<const std::uint32_t> members, CardFrame& frame) {
    std::vector<float> lengths;
    vec3 root(0), direction(0);
    for (const std::uint32_t s : members) {
        const auto strand = groom.strand(s);
        lengths.push_back(lengthOfStrand(strand));
        vec3 ahead = strand.back();
        pointAtArc(strand, 0.15F * lengths.back(), ahead);
        direction += unitOr(ahead - strand.front(), vec3(0));
        root += strand.front() / static_cast<float>(members.size());
    }
    direction = unitOr(direction, vec3(0, -1, 0));
    const float typical = quantile(lengths, 0.5F);
    for (const std::uint32_t s : members) {
        const float ahead = glm::dot(groom.strand(s).front() - root, direction);
        frame.starts.push_back(std::clamp(ahead, -0.3F * typical, 0.3F * typical));
    }
    const float first = *std::min_element(frame.starts.begin(), frame.starts.end());
    std::vector<float> ends;
    for (std::size_t i = 0; i < members.size(); ++i) {
        frame.starts[i] -= first;
        ends.push_back(frame.starts[i] + lengths[i]);
    }
    frame.length = quantile(ends, 0.95F);
}

/// Means of steps, not of places: where a strand begins or ends, the mean of the others' places would jump.
void placeMiddles(const Strands& groom, std::span<const std::uint32_t> members, CardFrame& frame) {
    const std::size_t count = frame.stations.size();
    // The anchor: the first station where nearly all strands have begun.
    const float begun = quantile(frame.starts, 0.95F);
    std::size_t anchor = 0;
    while (anchor + 2 < count && arcOf(frame, anchor) < begun) ++anchor;
    const auto meanOf = [&](auto&& valueOf, vec3& mean) {
        vec3 sum(0);
        float alive = 0;
        for (std::size_t i = 0; i < members.size(); ++i) {
            vec3 value;
            if (!valueOf(groom.strand(members[i]), frame.starts[i], value)) continue;
            sum += value;
            alive += 1;
        }
        if (alive > 0) mean = sum / alive;
    };
    const auto step = [&](std::size_t from, std::size_t to, vec3& mean) {
        meanOf(
            [&](std::span<const vec3> strand, float start, vec3& value) {
                vec3 a, b;
                if (!pointAtArc(strand, arcOf(frame, from) - start, a)) return false;
                if (!pointAtArc(strand, arcOf(frame, to) - start, b)) return false;
                value = b - a;
                return true;
            },
            mean);
    };
    vec3 middle = groom.strand(members[0]).front();
    meanOf([&](std::span<const vec3> strand, float start,
               vec3& value) { return pointAtArc(strand, arcOf(frame, anchor) - start, value); },
           middle);
    frame.stations[anchor].middle = middle;
    vec3 move(0);
    for (std::size_t k = anchor + 1; k < count; ++k) {
        step(k - 1, k, move);
        frame.stations[k].middle = frame.stations[k - 1].middle + move;
    }
    move = anchor + 1 < count ? frame.stations[anchor].middle - frame.stations[anchor + 1].middle : vec3(0);
    for (std::size_t k = anchor; k-- > 0;) {
        step(k + 1, k, move);
        frame.stations[k].middle = frame.stations[k + 1].middle + move;
    }
}

void smoothMiddles(std::vector<Station>& stations) {
    vec3 before = stations[0].middle;
    for (std::size_t k = 1; k + 1 < stations.size(); ++k) {
        const vec3 here = stations[k].middle;
        stations[k].middle = 0.25F * before + 0.5F * here + 0.25F * stations[k + 1].middle;
        before = here;
    }
}

vec3 tangentAt(const std::vector<Station>& stations, std::size_t k) {
    const std::size_t a = k == 0 ? 0 : k - 1, b = std::min(k + 1, stations.size() - 1);
    return unitOr(stations[b].middle - stations[a].middle, vec3(0, -1, 0));
}

/// Cards face outward. Where the strand itself leads outward (at the root) that says nothing, so the frame starts at
/// the station where it says most and is carried both ways.
void orient(std::vector<Station>& stations, const vec3& center) {
    const std::size_t count = stations.size();
    std::vector<vec3> sides(count);
    std::size_t clearest = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const vec3 away = unitOr(stations[k].middle - center, vec3(0, 1, 0));
        sides[k] = glm::cross(tangentAt(stations, k), away);
        if (glm::length(sides[k]) > glm::length(sides[clearest])) clearest = k;
    }
    const auto settle = [&](std::size_t k, const vec3& carried) {
        const vec3 t = tangentAt(stations, k);
        const float trust = glm::dot(sides[k], sides[k]);  // nothing where the strand leads outward, 1 where across
        stations[k].side = perpendicularOr(glm::mix(carried, sides[k], trust), t);
        stations[k].outward = glm::cross(stations[k].side, t);
    };
    const vec3 start = perpendicularOr(sides[clearest], tangentAt(stations, clearest));
    settle(clearest, start);
    for (std::size_t k = clearest + 1; k < count; ++k) settle(k, stations[k - 1].side);
    for (std::size_t k = clearest; k-- > 0;) settle(k, stations[k + 1].side);
}

/// Width from the spread along `side`, rise and bend from a least-squares parabola through the strands.
void measure(const Strands& groom, std::span<const std::uint32_t> members, CardFrame& frame) {
    const std::size_t count = frame.stations.size();
    std::size_t firstMeasured = count;                         // station with enough strands to tell
    std::vector<std::array<double, 3>> few(count, {0, 0, 0});  // where there are not: their number, sums of y and x^2
    for (std::size_t k = 0; k < count; ++k) {
        Station& station = frame.stations[k];
        std::vector<float> spread;
        double n = 0, sx2 = 0, sx4 = 0, sy = 0, sx2y = 0;
        for (std::size_t i = 0; i < members.size(); ++i) {
            vec3 p;
            if (!pointAtArc(groom.strand(members[i]), arcOf(frame, k) - frame.starts[i], p)) continue;
            const float x = glm::dot(p - station.middle, station.side);
            const double y = glm::dot(p - station.middle, station.outward), x2 = static_cast<double>(x) * x;
            spread.push_back(std::abs(x));
            n += 1, sx2 += x2, sx4 += x2 * x2, sy += y, sx2y += x2 * y;
        }
        const float last = k > 0 ? frame.stations[k - 1].halfWidth : kLeastHalfWidth;
        station.halfWidth = spread.size() < 3 ? last : std::max(kLeastHalfWidth, 1.08F * quantile(spread, 0.90F));
        if (spread.size() >= 3) firstMeasured = std::min(firstMeasured, k);
        const double determinant = n * sx4 - sx2 * sx2;
        if (n < 6 || !(determinant > 1e-12 * n * sx4)) {
            few[k] = {std::max(n, 0.5), sy, sx2};
            continue;
        }
        const float limit = 0.45F / station.halfWidth;  // a card is a strip, not a tube
        station.bend = std::clamp(static_cast<float>((n * sx2y - sx2 * sy) / determinant), -limit, 0.25F * limit);
        station.rise = static_cast<float>((sy - static_cast<double>(station.bend) * sx2) / n);
    }
    for (std::size_t k = 0; k < firstMeasured && firstMeasured < count; ++k) {
        frame.stations[k].halfWidth = frame.stations[firstMeasured].halfWidth;
    }
    // A few strands tell the height but not the bend, which the next station towards the tip lends them.
    for (std::size_t k = count - 1; k-- > 0;) {
        Station &station = frame.stations[k], &next = frame.stations[k + 1];
        const auto [n, sy, sx2] = few[k];
        if (n == 0) continue;
        station.bend = next.bend;
        station.rise = n < 1 ? next.rise : static_cast<float>((sy - static_cast<double>(station.bend) * sx2) / n);
    }
}

void smoothShape(std::vector<Station>& stations) {
    const std::vector<Station> given = stations;
    for (std::size_t k = 0; k < given.size(); ++k) {
        const Station &a = given[k == 0 ? 0 : k - 1], &b = given[k], &c = given[std::min(k + 1, given.size() - 1)];
        const auto mean = [](float x, float y, float z) { return 0.25F * x + 0.5F * y + 0.25F * z; };
        stations[k].halfWidth = mean(a.halfWidth, b.halfWidth, c.halfWidth);
        stations[k].rise = mean(a.rise, b.rise, c.rise);
        stations[k].bend = mean(a.bend, b.bend, c.bend);
    }
}

}  // namespace

bool pointAtArc(std::span<const glm::vec3> strand, float arc, glm::vec3& out) {
    if (arc < 0) return false;
    for (std::size_t i = 1; i < strand.size(); ++i) {
        const float piece = glm::length(strand[i] - strand[i - 1]);
        if (arc <= piece) {
            out = piece > 0 ? glm::mix(strand[i - 1], strand[i], arc / piece) : strand[i - 1];
            return true;
        }
        arc -= piece;
    }
    return false;
}

CardFrame::Station CardFrame::at(float v) const {
    const float x = std::clamp(v, 0.0F, 1.0F) * static_cast<float>(stations.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(x), stations.size() - 2);
    const float t = x - static_cast<float>(i);
    const Station &a = stations[i], &b = stations[i + 1];
    return {glm::mix(a.middle, b.middle, t),
            unitOr(glm::mix(a.side, b.side, t), a.side),
            unitOr(glm::mix(a.outward, b.outward, t), a.outward),
            glm::mix(a.halfWidth, b.halfWidth, t),
            glm::mix(a.rise, b.rise, t),
            glm::mix(a.bend, b.bend, t)};
}

CardFrame frameOf(const Strands& groom, std::span<const std::uint32_t> members, const glm::vec3& center) {
    constexpr std::size_t kStations = 41;
    CardFrame frame;
    frame.stations.resize(kStations);
    placeStarts(groom, members, frame);
    placeMiddles(groom, members, frame);
    // Enough to level curls of a few centimetres: those belong in the texture, not in the shape of the card.
    for (int pass = 0; pass < 12; ++pass) smoothMiddles(frame.stations);
    orient(frame.stations, center);
    measure(groom, members, frame);
    for (int pass = 0; pass < 3; ++pass) smoothShape(frame.stations);
    return frame;
}

}  // namespace pelage::hair
