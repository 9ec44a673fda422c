// SPDX-License-Identifier: MIT
#include <pelage/hair/moment_table.hpp>

#include "resolve.hpp"

#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>
#include <thread>

#define PELAGE_DOUBLE

namespace pelage::hair {
namespace moments_double {

using real = double;
using real2 = glm::dvec2;
using real3 = glm::dvec3;
using real4 = glm::dvec4;
using namespace glm;

#include "scattering/models/moments.glsl"

}  // namespace moments_double

namespace {

using namespace moments_double;

// Light through one offset, for one inclination and lobe: the azimuth it leaves at in [-pi, pi], its share (attenuation
// without absorption, times d(h) / 2), and its path in radii.
struct Node {
    double azimuth, weight, length;
};

struct Row {
    std::array<std::vector<Node>, 3> nodes;  // of R, TT, TRT, by azimuth
    MomentTable::Texel residual, rest;
};

float half(double x) {
    return glm::unpackHalf1x16(glm::packHalf1x16(static_cast<float>(std::min(x, 65504.0))));
}

// Sums over nodes of weight x logistic x (1, length, length^2).
struct Sums {
    double n = 0, first = 0, second = 0;
    void add(const Node& node, double distance, double inverseScale) {
        const double e = std::exp(-std::abs(distance) * inverseScale);
        const double w = node.weight * e / ((1.0 + e) * (1.0 + e));
        n += w;
        first += w * node.length;
        second += w * node.length * node.length;
    }
};

// The light of a lobe at azimuth phi. Nodes more than 60 widths away hold less than 1e-26 of it and are passed over.
Sums gather(const std::vector<Node>& nodes, double phi, double inverseScale) {
    Sums sums;
    const double reach = 60.0 / inverseScale;
    if (reach >= pi) {
        for (const Node& node : nodes) sums.add(node, wrapAngle(phi - node.azimuth), inverseScale);
        return sums;
    }
    for (const double turn : {-2.0 * pi, 0.0, 2.0 * pi}) {
        auto node = std::lower_bound(nodes.begin(), nodes.end(), phi + turn - reach,
                                     [](const Node& n, double azimuth) { return n.azimuth < azimuth; });
        for (; node != nodes.end() && node->azimuth < phi + turn + reach; ++node) {
            sums.add(*node, phi + turn - node->azimuth, inverseScale);
        }
    }
    return sums;
}

}  // namespace

struct MomentTable::State {
    FiberMaterial fiber{};
    std::uint32_t width = 0, height = 64, nodes = 0;
    std::vector<std::unique_ptr<Row>> rows;
    std::vector<std::vector<std::optional<std::array<Texel, 3>>>> texels;  // by row; a row is empty until it is read

    double axisOf(double cosine) const { return momentAxisTheta(fiberSection(fiber, cosine), fiber); }
    double cosineOf(std::uint32_t y) const;
    const Row& row(std::uint32_t y);
    const std::array<Texel, 3>& at(std::uint32_t x, std::uint32_t y);
};

MomentTable::MomentTable(double eta, double betaN) : state_(std::make_unique<State>()) {
    FiberProperties properties;
    properties.eta = eta;
    properties.betaN = betaN;
    State& s = *state_;
    s.fiber = narrowed<FiberMaterial>(resolveFiber(properties));
    const double scale = 1.0 / s.fiber.inverseScale;
    s.width = scale > 0.1 ? 64 : (scale > 0.04 ? 128 : (scale > 0.015 ? 256 : 512));
    s.nodes = static_cast<std::uint32_t>(std::clamp(14.0 * s.fiber.inverseScale, 256.0, 8192.0));
    s.height = s.width > 128 ? 96 : 64;
    s.rows.resize(s.height);
    s.texels.resize(s.height);
}
MomentTable::~MomentTable() = default;
MomentTable::MomentTable(MomentTable&&) noexcept = default;
MomentTable& MomentTable::operator=(MomentTable&&) noexcept = default;

std::uint32_t MomentTable::width() const {
    return state_->width;
}
std::uint32_t MomentTable::height() const {
    return state_->height;
}

// The cosine whose place on the axis is row y. At 90 degrees nothing enters the fibre and no path has a mean: the first
// row is the limit.
double MomentTable::State::cosineOf(std::uint32_t y) const {
    const double wanted = static_cast<double>(y) / (height - 1.0);
    double low = y == 0 ? 1e-6 : 0.0, high = y == 0 ? 1e-6 : 1.0;
    for (int halvings = 0; halvings < 60 && low < high; ++halvings) {
        const double middle = 0.5 * (low + high);
        (axisOf(middle) < wanted ? low : high) = middle;
    }
    return high;
}

const Row& MomentTable::State::row(std::uint32_t y) {
    if (rows[y]) return *rows[y];
    auto made = std::make_unique<Row>();
    const double cosine = cosineOf(y);
    const FiberSection section = fiberSection(fiber, cosine);
    double rest = 0, segments = 0, path = 0, continued[3] = {};
    for (auto& lobe : made->nodes) lobe.reserve(nodes);
    // gamma = pi/2 cos(t): the integrand is then periodic and smooth in t, where the midpoint rule converges faster
    // than any power of its step.
    for (std::uint32_t k = 0; k < nodes; ++k) {
        const double t = pi * (k + 0.5) / nodes;
        const double gamma = halfPi * std::cos(t), cosGamma = std::cos(gamma);
        const double measure = 0.5 * cosGamma * halfPi * std::sin(t) * (pi / nodes);
        const double cosGammaT = cosRefracted(section, fiber, cosGamma);
        const double gammaT = refractedAngle(section, std::sin(gamma), cosGammaT);
        const real2 f = fresnelExact(fiber.eta, fiber.etaExcess, cosine * cosGamma);
        const double segment = segmentLength(section, cosGammaT), through = f.y * f.y;
        const double weights[3] = {f.x, through, through * f.x};
        for (int p = 0; p < 3; ++p) {
            made->nodes[static_cast<std::size_t>(p)].push_back(
                {wrapAngle(2.0 * p * gammaT - 2.0 * gamma + p * pi), measure * weights[p], p * segment});
        }
        // Residual: (1 - f) f^2 of the light without absorption, and with it T^3 / (1 + r (1 - T)), r = f / (1 - f).
        const double light = measure * f.y * f.x * f.x, r = f.x / f.y;
        rest += light;
        segments += light * (3.0 + r);
        path += light * (3.0 + r) * segment;
        for (int k3 = 0; k3 < 3; ++k3) continued[k3] += light / (1.0 + r * (k3 + 1) / 3.0);
    }
    made->residual = {half(rest * 0.5 / pi / momentRim(section))};
    made->rest = {half(path / segments), half(rest / continued[0]), half(rest / continued[1]),
                  half(rest / continued[2])};
    for (auto& lobe : made->nodes) {
        std::sort(lobe.begin(), lobe.end(), [](const Node& a, const Node& b) { return a.azimuth < b.azimuth; });
    }
    rows[y] = std::move(made);
    return *rows[y];
}

const std::array<MomentTable::Texel, 3>& MomentTable::State::at(std::uint32_t x, std::uint32_t y) {
    if (texels[y].empty()) texels[y].resize(width);
    std::optional<std::array<Texel, 3>>& cached = texels[y][x];
    if (cached) return *cached;
    const Row& source = row(y);
    const double phi = pi * static_cast<double>(x) / (width - 1.0);
    double n[3] = {}, mean[3] = {}, variance[3] = {};
    for (std::size_t p = 0; p < 3; ++p) {
        const Sums sums = gather(source.nodes[p], phi, fiber.inverseScale);
        n[p] = sums.n;
        if (!(sums.n > 1e-200)) continue;  // nothing arrives here: no path to take the mean of
        mean[p] = sums.first / sums.n;
        variance[p] = std::max(sums.second / sums.n - mean[p] * mean[p], 0.0);
    }
    const double rim = momentRim(fiberSection(fiber, cosineOf(y))), scale = fiber.peak / (rim * rim);
    cached.emplace();
    (*cached)[0] = {half(fiber.peak * n[0]), half(scale * n[1]), half(scale * n[2]), source.residual[0]};
    (*cached)[1] = {half(mean[1]), half(variance[1]), half(mean[2]), half(variance[2])};
    (*cached)[2] = source.rest;
    return *cached;
}

MomentTable::Texel MomentTable::texel(std::uint32_t layer, std::uint32_t x, std::uint32_t y) {
    return state_->at(std::min(x, width() - 1), std::min(y, height() - 1))[std::min(layer, layers - 1)];
}

MomentTable::Sample MomentTable::sample(double cosThetaO, double phi) {
    const double x = std::abs(std::remainder(phi, 2.0 * pi)) / pi * (width() - 1.0);
    const double y = std::clamp(state_->axisOf(std::clamp(cosThetaO, 0.0, 1.0)), 0.0, 1.0) * (height() - 1.0);
    const auto x0 = static_cast<std::uint32_t>(std::clamp(std::floor(x), 0.0, width() - 2.0));
    const auto y0 = static_cast<std::uint32_t>(std::clamp(std::floor(y), 0.0, height() - 2.0));
    Sample s{};
    s.weightX = x - x0;
    s.weightY = y - y0;
    for (std::size_t k = 0; k < 4; ++k) {
        const auto& texels = state_->at(x0 + static_cast<std::uint32_t>(k % 2), y0 + static_cast<std::uint32_t>(k / 2));
        for (std::size_t layer = 0; layer < layers; ++layer) s.texels[layer][k] = texels[layer];
    }
    return s;
}

std::vector<std::uint16_t> MomentTable::halves() {
    // Rows share nothing, so each thread takes the next. This one works too: it does all of it where no other starts.
    std::atomic<std::uint32_t> next = 0;
    const auto work = [&] {
        for (std::uint32_t y = next++; y < height(); y = next++) {
            for (std::uint32_t x = 0; x < width(); ++x) state_->at(x, y);
        }
    };
    std::vector<std::jthread> workers;
    const std::uint32_t others = std::clamp(std::thread::hardware_concurrency(), 1U, 16U) - 1;
    try {
        for (std::uint32_t i = 0; i < others; ++i) workers.emplace_back(work);
    } catch (const std::system_error&) {
        // No more threads to be had.
    }
    work();
    workers.clear();
    std::vector<std::uint16_t> packed;
    packed.reserve(std::size_t{width()} * height() * layers * 4);
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
        for (std::uint32_t y = 0; y < height(); ++y) {
            for (std::uint32_t x = 0; x < width(); ++x) {
                for (const float value : texel(layer, x, y)) packed.push_back(glm::packHalf1x16(value));
            }
        }
    }
    return packed;
}

std::string momentTableName(double eta, double betaN) {
    // to_chars, unlike printf, does not follow the host's decimal comma.
    const auto number = [](double x) {
        char text[32];
        const auto end = std::to_chars(text, text + sizeof text, x, std::chars_format::general, 6);
        return std::string(text, end.ptr);
    };
    return "moments:" + number(eta) + "," + number(betaN);
}

std::optional<MomentTable> momentTableOf(std::string_view name) {
    constexpr std::string_view prefix = "moments:";
    const std::size_t comma = name.find(',');
    if (!name.starts_with(prefix) || comma == std::string_view::npos) return std::nullopt;
    double eta = 0, betaN = 0;
    const char *middle = name.data() + comma, *end = name.data() + name.size();
    const auto first = std::from_chars(name.data() + prefix.size(), middle, eta);
    const auto second = std::from_chars(middle + 1, end, betaN);
    if (first.ec != std::errc() || first.ptr != middle || second.ec != std::errc() || second.ptr != end) {
        return std::nullopt;
    }
    return MomentTable(eta, betaN);
}

}  // namespace pelage::hair
