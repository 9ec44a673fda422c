// SPDX-License-Identifier: MIT
#include "quadrature.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <queue>

namespace pelage::reference {
namespace {

double azimuthAt(const CrossSection& section, int p, double gammaO) {
    return pathAzimuth(p, gammaO, refract(section, std::sin(gammaO), std::cos(gammaO)).gammaT);
}

// Ends of the intervals of gamma_o in which Phi is monotone.
std::vector<double> monotoneEnds(const CrossSection& section, int p) {
    const double caustic = causticOffset(section, p);
    if (caustic > 0) return {-0.5 * pi, -caustic, caustic, 0.5 * pi};
    return {-0.5 * pi, 0.5 * pi};
}

struct Piece {
    double from, to;
    Integral part;
};
struct SmallerError {
    bool operator()(const Piece& a, const Piece& b) const { return a.part.error < b.part.error; }
};

// The piece with the largest error is halved until the sum of errors is a 1e-11th of the sum, as in QUADPACK's QAG. The
// rule's error, |Kronrod 31 - Gauss 15|, is that of the weaker of the two: what is returned is far better than its
// bound.
Integral integrate(const std::function<double(double)>& f, std::vector<double> ends) {
    const auto rule = [&](double from, double to) {
        Piece piece{from, to, {}};
        piece.part.value =
            boost::math::quadrature::gauss_kronrod<double, 31>::integrate(f, from, to, 0, 0.0, &piece.part.error);
        return piece;
    };
    std::sort(ends.begin(), ends.end());
    std::priority_queue<Piece, std::vector<Piece>, SmallerError> pieces;
    Integral sum;
    const auto add = [&](const Piece& piece) {
        sum.value += piece.part.value;
        sum.error += piece.part.error;
        pieces.push(piece);
    };
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        if (ends[i + 1] - ends[i] > 1e-15) add(rule(ends[i], ends[i + 1]));
    }
    for (int halvings = 0; halvings < 400 && sum.error > 1e-11 * sum.value; ++halvings) {
        const Piece worst = pieces.top();
        pieces.pop();
        sum.value -= worst.part.value;
        sum.error -= worst.part.error;
        const double middle = 0.5 * (worst.from + worst.to);
        add(rule(worst.from, middle));
        add(rule(middle, worst.to));
    }
    // Summed again: the running sums have rounding of every piece that was taken out.
    sum = {};
    for (; !pieces.empty(); pieces.pop()) {
        sum.value += pieces.top().part.value;
        sum.error += pieces.top().part.error;
    }
    return sum;
}

}  // namespace

double causticOffset(const CrossSection& section, int p) {
    if (p < 2) return -1;
    const double square = (static_cast<double>(p) * p - section.etaPerp * section.etaPerp) / (p * p - 1.0);
    return square > 0 && square < 1 ? std::asin(std::sqrt(square)) : -1;
}

std::vector<double> offsetsAtAzimuth(const CrossSection& section, int p, double target) {
    const std::vector<double> ends = monotoneEnds(section, p);
    std::vector<double> found;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const auto f = [&](double gammaO) { return azimuthAt(section, p, gammaO) - target; };
        const double low = f(ends[i]), high = f(ends[i + 1]);
        if (low == 0) found.push_back(ends[i]);
        if (!(low * high < 0)) continue;
        std::uintmax_t steps = 100;
        const auto bracket = boost::math::tools::toms748_solve(f, ends[i], ends[i + 1], low, high,
                                                               boost::math::tools::eps_tolerance<double>(52), steps);
        found.push_back(0.5 * (bracket.first + bracket.second));
    }
    return found;
}

Integral meanOverOffset(const CrossSection& section, const OffsetWeight& weight) {
    const auto f = [&](double gammaO) {
        const double cosine = std::cos(gammaO);
        return 0.5 * cosine * weight(gammaO, refract(section, std::sin(gammaO), cosine));
    };
    // The weight is even; its steep part is near the rim, at cosines of the order of cos(gamma_t) there.
    std::vector<double> ends{-0.5 * pi, 0.0, 0.5 * pi};
    for (double cosine = 0.5; cosine > 1e-4; cosine *= 0.25) {
        ends.push_back(std::acos(cosine));
        ends.push_back(-std::acos(cosine));
    }
    return integrate(f, ends);
}

Integral meanOverOffset(const CrossSection& section, int p, double phi, const Kernel& kernel,
                        const OffsetWeight& weight) {
    const auto f = [&](double gammaO) {
        const double cosine = std::cos(gammaO);
        const Refracted refracted = refract(section, std::sin(gammaO), cosine);
        return 0.5 * cosine * kernel.density(phi - pathAzimuth(p, gammaO, refracted.gammaT)) *
               weight(gammaO, refracted);
    };
    std::vector<double> ends = monotoneEnds(section, p);
    for (double cosine = 0.5; cosine > 1e-4; cosine *= 0.25) {
        ends.push_back(std::acos(cosine));
        ends.push_back(-std::acos(cosine));
    }
    // Azimuths at a few widths from the peak, and the antipode where the two tails of the kernel meet with a kink.
    std::vector<double> levels{0.0, pi};
    for (double distance = kernel.width; distance < pi; distance *= 4.0) {
        levels.push_back(distance);
        levels.push_back(-distance);
    }
    const double reach = azimuthAt(section, p, 0.0);
    for (const double level : levels) {
        for (int period = -3; period <= 3; ++period) {
            // |Phi - Phi(0)| never exceeds (p + 1) pi.
            const double target = phi + level + 2.0 * pi * period;
            if (std::abs(target - reach) > (p + 1) * pi + 1e-9) continue;
            for (const double gammaO : offsetsAtAzimuth(section, p, target)) ends.push_back(gammaO);
        }
    }
    return integrate(f, ends);
}

}  // namespace pelage::reference
