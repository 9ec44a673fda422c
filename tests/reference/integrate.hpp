// SPDX-License-Identifier: MIT
// Quadrature and random numbers of the tests' own, so that nothing is measured with the ruler that made it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numbers>
#include <random>
#include <vector>

namespace pelage::reference::test {

struct Node {
    double x, weight;
};

/// Gauss-Legendre nodes on [-1, 1]: Newton's method on P_n in long double.
template <int Count>
const std::array<Node, Count>& gaussLegendre() {
    static const std::array<Node, Count> nodes = [] {
        std::array<Node, Count> made{};
        for (int i = 0; i < Count; ++i) {
            long double z = std::cos(std::numbers::pi_v<long double> * (i + 0.75L) / (Count + 0.5L)), slope = 1;
            for (int step = 0; step < 12; ++step) {
                long double value = 1, previous = 0;
                for (int k = 0; k < Count; ++k) {
                    const long double before = previous;
                    previous = value;
                    value = ((2 * k + 1) * z * previous - k * before) / (k + 1);
                }
                slope = Count * (z * value - previous) / (z * z - 1);
                z -= value / slope;
            }
            made[static_cast<std::size_t>(i)] = {static_cast<double>(z),
                                                 static_cast<double>(2 / ((1 - z * z) * slope * slope))};
        }
        return made;
    }();
    return nodes;
}

/// Integral of f between the sorted `ends`, each interval in `panels` parts of 20 nodes.
template <typename F>
double integrate(const F& f, std::vector<double> ends, int panels = 1) {
    std::sort(ends.begin(), ends.end());
    long double sum = 0;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const double half = 0.5 * (ends[i + 1] - ends[i]) / panels;
        for (int panel = 0; panel < panels; ++panel) {
            const double middle = ends[i] + (2 * panel + 1) * half;
            for (const Node& node : gaussLegendre<20>()) sum += node.weight * half * f(middle + half * node.x);
        }
    }
    return static_cast<double>(sum);
}

/// The same where f may grow like the inverse square root at the ends: x = a + (b - a) (3 t^2 - 2 t^3) removes it.
template <typename F>
double integrateSingular(const F& f, double a, double b, int panels = 1) {
    const auto inner = [&](double t) { return f(a + (b - a) * t * t * (3 - 2 * t)) * (b - a) * 6 * t * (1 - t); };
    return integrate(inner, {0.0, 1.0}, panels);
}

/// Ends for a peak of the given width at `centre` in [from, to]: geometric steps away from it.
inline std::vector<double> endsAround(double centre, double width, double from, double to) {
    std::vector<double> ends{from, to};
    if (centre > from && centre < to) ends.push_back(centre);
    for (double distance = 0.5 * width; distance < to - from; distance *= 1.6) {
        for (const double end : {centre - distance, centre + distance}) {
            if (end > from && end < to) ends.push_back(end);
        }
    }
    return ends;
}

/// Uniform numbers that are the same with every standard library.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    /// In [0, 1).
    double operator()() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
    double between(double from, double to) { return from + (to - from) * (*this)(); }
    /// The logarithm is uniform.
    double scale(double from, double to) { return from * std::pow(to / from, (*this)()); }

private:
    std::mt19937_64 engine_;
};

}  // namespace pelage::reference::test
