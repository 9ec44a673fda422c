// SPDX-License-Identifier: MIT
// sample() and pdf(): the directions follow the density that they claim, seen by something other than themselves.
#include "integrate.hpp"

#include <pelage/reference/terms.hpp>

#include <gtest/gtest.h>

namespace pelage::reference::test {
namespace {

struct View {
    Fiber fiber;
    double theta, h;
};
const View views[] = {
    {{1.55, 0.3, 0.3, -3 * degree, 0}, 0.3, 0.4},
    {{1.55, 0.6, 0.8, 2 * degree, 0.3}, -1.1, -0.8},
    {{1.33, 0.2, 0.5, 8 * degree, 0.05}, 1.45, 0.95},
};

Lobes attenuationAt(const View& view) {
    const CrossSection section = crossSection(view.fiber.eta, std::cos(view.theta));
    const double cosGammaO = std::sqrt((1 - view.h) * (1 + view.h));
    return attenuation(section, refract(section, view.h, cosGammaO), cosGammaO, view.fiber.sigmaA);
}

FiberSample draw(const View& view, Random& random) {
    std::array<double, 4> u{};
    for (double& x : u) x = random();
    return sample(view.fiber, std::sin(view.theta), std::cos(view.theta), view.h, u);
}

// f / pdf is the albedo, the sum of A_p, whatever was drawn; 1 when nothing is absorbed (Chiang 2016).
TEST(Sampling, SamplingIsPerfect) {
    Random random(61);
    for (int k = 0; k < 20000; ++k) {
        const bool white = k % 2 == 0;
        const View view{{1 + random.scale(1e-4, 1), random.scale(0.02, 1), random.scale(0.02, 1),
                         random.between(-10, 10) * degree, white ? 0 : random.scale(0.01, 10)},
                        random.between(-89.9, 89.9) * degree,
                        k % 10 == 0   ? 1
                        : k % 10 == 1 ? -1
                                      : random.between(-1, 1)};
        const FiberSample drawn = draw(view, random);
        EXPECT_NEAR(drawn.weight, white ? 1 : attenuationAt(view).total(), 1e-9);
        EXPECT_NEAR(drawn.sinThetaI * drawn.sinThetaI + drawn.cosThetaI * drawn.cosThetaI, 1, 1e-14);
        const Angles angles{drawn.sinThetaI, drawn.cosThetaI, std::sin(view.theta), std::cos(view.theta), drawn.phi};
        EXPECT_NEAR(pdf(view.fiber, angles, view.h), drawn.pdf, 1e-12 * drawn.pdf);
    }
}

// The ends of the unit interval give directions too.
TEST(Sampling, EndsOfTheUnitIntervalAreFinite) {
    const double last = 1 - 0x1p-53;
    for (const View& view : views) {
        for (int corner = 0; corner < 16; ++corner) {
            std::array<double, 4> u{};
            for (std::size_t k = 0; k < 4; ++k) u[k] = (corner >> k & 1) ? last : 0;
            const FiberSample s = sample(view.fiber, std::sin(view.theta), std::cos(view.theta), view.h, u);
            EXPECT_TRUE(std::isfinite(s.phi) && std::isfinite(s.pdf) && std::abs(s.sinThetaI) <= 1) << corner;
            EXPECT_TRUE(std::isfinite(s.weight) && s.weight >= 0) << corner;
        }
    }
}

// One lobe by A_p; within it the mean of sin(theta_i) is that of a von Mises-Fisher distribution about the mirrored and
// tilted view, -sin(theta_o') (coth(1/v) - v), and the mean of exp(i phi) is that of the logistic about Phi_p. Means of
// 100,000; five standard errors.
TEST(Sampling, EachLobeHasItsMoments) {
    constexpr int count = 100000;
    Random random(62);
    for (const View& view : views) {
        double drawn[4] = {}, sines[4] = {}, sineSquares[4] = {}, real[4] = {}, imaginary[4] = {};
        for (int k = 0; k < count; ++k) {
            const FiberSample s = draw(view, random);
            const auto lobe = static_cast<std::size_t>(s.lobe);
            drawn[lobe] += 1;
            sines[lobe] += s.sinThetaI;
            sineSquares[lobe] += s.sinThetaI * s.sinThetaI;
            real[lobe] += std::cos(s.phi);
            imaginary[lobe] += std::sin(s.phi);
        }
        const Lobes a = attenuationAt(view);
        const auto v = longitudinalVariances(view.fiber.betaM);
        const double scale = logisticScale(view.fiber.betaN);
        const auto cosine = [&](double x) { return trimmedLogistic(x, scale) * std::cos(x); };
        const double narrowness = integrate(cosine, endsAround(0, scale, -pi, pi));
        const CrossSection section = crossSection(view.fiber.eta, std::cos(view.theta));
        const Refracted inside = refract(section, view.h, std::sqrt(1 - view.h * view.h));
        for (int p = 0; p < 4; ++p) {
            const auto lobe = static_cast<std::size_t>(p);
            const double share = a.p[lobe] / a.total(), n = drawn[lobe];
            EXPECT_NEAR(n / count, share, 5 * std::sqrt(share * (1 - share) / count)) << p;
            if (n < 100) continue;
            double s = 0, c = 0;
            tilt(view.fiber.alpha, p, std::sin(view.theta), std::cos(view.theta), s, c);
            const double mean = -s * (1 / std::tanh(1 / v[lobe]) - v[lobe]);
            const double spread = std::sqrt((sineSquares[lobe] / n - std::pow(sines[lobe] / n, 2)) / n);
            EXPECT_NEAR(sines[lobe] / n, mean, 5 * spread) << p;
            const double turn = pathAzimuth(p, std::asin(view.h), inside.gammaT), length = p == 3 ? 0 : narrowness;
            EXPECT_NEAR(real[lobe] / n, length * std::cos(turn), 5 / std::sqrt(2 * n)) << p;
            EXPECT_NEAR(imaginary[lobe] / n, length * std::sin(turn), 5 / std::sqrt(2 * n)) << p;
        }
    }
}

// Chi-square over 20 x 20 cells of equal solid angle against the integral of pdf() over each cell; cells that expect
// fewer than 10 are counted together. For n cells chi^2 is n - 1 +- sqrt(2 (n - 1)); five of those are allowed.
TEST(Sampling, SampledDirectionsFollowTheDensity) {
    constexpr int cells = 20, count = 100000;
    Random random(63);
    for (const View& view : views) {
        std::vector<double> drawn(cells * cells);
        for (int k = 0; k < count; ++k) {
            const FiberSample s = draw(view, random);
            const int row = std::clamp(static_cast<int>((0.5 + 0.5 * s.sinThetaI) * cells), 0, cells - 1);
            const double turn = std::remainder(s.phi, 2 * pi) / (2 * pi) + 0.5;
            const int column = std::clamp(static_cast<int>(turn * cells), 0, cells - 1);
            drawn[static_cast<std::size_t>(row * cells + column)] += 1;
        }
        double chi = 0, restDrawn = 0, restExpected = 0, all = 0;
        int compared = 0;
        const double so = std::sin(view.theta), co = std::cos(view.theta);
        for (int row = 0; row < cells; ++row) {
            for (int column = 0; column < cells; ++column) {
                // Over z = sin(theta_i), in which solid angle is even; a square root at its ends is taken away.
                const double low = -1 + 2.0 * row / cells, left = -pi + 2 * pi * column / cells;
                const auto overZ = [&](double z) {
                    const auto f = [&](double phi) {
                        return pdf(view.fiber, {z, std::sqrt((1 - z) * (1 + z)), so, co, phi}, view.h);
                    };
                    return integrate(f, {left, left + 2 * pi / cells});
                };
                const double expected = count * integrateSingular(overZ, low, low + 2.0 / cells);
                const double found = drawn[static_cast<std::size_t>(row * cells + column)];
                all += expected;
                if (expected < 10) {
                    restDrawn += found;
                    restExpected += expected;
                    continue;
                }
                chi += (found - expected) * (found - expected) / expected;
                ++compared;
            }
        }
        EXPECT_NEAR(all / count, 1, 1e-4);  // pdf() integrates to 1 over the sphere
        if (restExpected > 0)
            chi += (restDrawn - restExpected) * (restDrawn - restExpected) / std::max(restExpected, 10.0);
        EXPECT_NEAR(chi, compared, 5 * std::sqrt(2.0 * compared));
    }
}

// A world that is not even: L = 1 + 0.8 sin(theta_i) + 4 exp(6 (w.d - 1)). The estimate (mean of weight L over what was
// drawn) against the integral of S L by quadrature, within four standard errors of 100,000.
TEST(Sampling, UnevenEnvironmentIsEstimated) {
    constexpr int count = 100000;
    Random random(64);
    const auto light = [](double sine, double cosine, double phi) {
        const double along = 0.5 * sine + std::sqrt(0.75) * cosine * std::cos(phi - 2);
        return 1 + 0.8 * sine + 4 * std::exp(6 * (along - 1));
    };
    for (const View& view : views) {
        double sum = 0, squares = 0;
        for (int k = 0; k < count; ++k) {
            const FiberSample s = draw(view, random);
            const double term = s.weight * light(s.sinThetaI, s.cosThetaI, s.phi);
            sum += term;
            squares += term * term;
        }
        const double so = std::sin(view.theta), co = std::cos(view.theta);
        const auto overTheta = [&](double theta) {
            const double si = std::sin(theta), ci = std::cos(theta);
            const auto f = [&](double phi) {
                return nearField(view.fiber, {si, ci, so, co, phi}, view.h).total() * light(si, ci, phi);
            };
            return integrate(f, {-pi, pi}, 16) * ci;
        };
        const double expected = integrate(overTheta, {-0.5 * pi, 0.5 * pi}, 8);
        const double error = std::sqrt((squares / count - std::pow(sum / count, 2)) / count);
        EXPECT_LE(error, 0.01 * expected);
        EXPECT_NEAR(sum / count, expected, 4 * error);
    }
}

}  // namespace
}  // namespace pelage::reference::test
