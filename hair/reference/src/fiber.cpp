// SPDX-License-Identifier: MIT
#include "quadrature.hpp"

#include <pelage/reference/terms.hpp>

#include <algorithm>
#include <cmath>

namespace pelage::reference {
namespace {

// M_p for the four lobes.
std::array<double, 4> longitudinals(const Fiber& fiber, const Angles& angles) {
    const auto v = longitudinalVariances(fiber.betaM);
    std::array<double, 4> m{};
    for (int p = 0; p < 4; ++p) {
        double s = 0, c = 0;
        tilt(fiber.alpha, p, angles.sinThetaO, angles.cosThetaO, s, c);
        m[static_cast<std::size_t>(p)] =
            longitudinal(v[static_cast<std::size_t>(p)], angles.sinThetaI, angles.cosThetaI, s, c);
    }
    return m;
}

// N_p at gamma_o for the four lobes.
std::array<double, 4> azimuthals(double scale, double gammaO, double gammaT, double phi) {
    std::array<double, 4> n{};
    for (int p = 0; p < 3; ++p) {
        n[static_cast<std::size_t>(p)] = trimmedLogistic(phi - pathAzimuth(p, gammaO, gammaT), scale);
    }
    n[3] = 1.0 / (2.0 * pi);
    return n;
}

}  // namespace

Angles anglesFromDegrees(double thetaI, double phiI, double thetaO, double phiO) {
    const double i = thetaI * degree, o = thetaO * degree;
    // remainder() is exact, so a difference of degrees loses nothing before it becomes radians. A cosine at 90 degrees
    // is 6e-17 here, not 0: every quotient by it stays finite.
    return {std::sin(i), std::abs(std::cos(i)), std::sin(o), std::abs(std::cos(o)),
            std::remainder(phiI - phiO, 360.0) * degree};
}

Lobes nearField(const Fiber& fiber, const Angles& angles, double h) {
    const double clamped = std::clamp(h, -1.0, 1.0);
    const double cosGammaO = std::sqrt((1.0 - clamped) * (1.0 + clamped));
    const CrossSection section = crossSection(fiber.eta, angles.cosThetaO);
    const Refracted refracted = refract(section, clamped, cosGammaO);
    const Lobes a = attenuation(section, refracted, cosGammaO, fiber.sigmaA);
    const auto m = longitudinals(fiber, angles);
    const auto n = azimuthals(logisticScale(fiber.betaN), std::asin(clamped), refracted.gammaT, angles.phi);
    Lobes s;
    for (std::size_t p = 0; p < 4; ++p) s.p[p] = m[p] * a.p[p] * n[p];
    return s;
}

FarField farFieldAzimuthal(const Fiber& fiber, double cosThetaO, double phi) {
    const CrossSection section = crossSection(fiber.eta, cosThetaO);
    const double scale = logisticScale(fiber.betaN);
    FarField result;
    for (int p = 0; p < 4; ++p) {
        const auto lobe = static_cast<std::size_t>(p);
        const auto weight = [&](double gammaO, const Refracted& refracted) {
            return attenuation(section, refracted, std::cos(gammaO), fiber.sigmaA).p[lobe];
        };
        const Integral mean =
            p == 3 ? meanOverOffset(section, weight)
                   : meanOverOffset(section, p, std::remainder(phi, 2.0 * pi),
                                    {scale, [&](double x) { return trimmedLogistic(x, scale); }}, weight);
        const double factor = p == 3 ? 1.0 / (2.0 * pi) : 1.0;
        result.value.p[lobe] = factor * mean.value;
        result.error.p[lobe] = factor * mean.error;
    }
    return result;
}

FarField farField(const Fiber& fiber, const Angles& angles) {
    FarField result = farFieldAzimuthal(fiber, angles.cosThetaO, angles.phi);
    const auto m = longitudinals(fiber, angles);
    for (std::size_t p = 0; p < 4; ++p) {
        result.value.p[p] *= m[p];
        result.error.p[p] *= m[p];
    }
    return result;
}

namespace {

// What sampling and its density share: probabilities of the lobes.
struct Choice {
    Lobes probability;
    double gammaO, gammaT, scale;
};
Choice lobeChoice(const Fiber& fiber, double cosThetaO, double h) {
    const double clamped = std::clamp(h, -1.0, 1.0);
    const double cosGammaO = std::sqrt((1.0 - clamped) * (1.0 + clamped));
    const CrossSection section = crossSection(fiber.eta, cosThetaO);
    const Refracted refracted = refract(section, clamped, cosGammaO);
    Choice choice{attenuation(section, refracted, cosGammaO, fiber.sigmaA), std::asin(clamped), refracted.gammaT,
                  logisticScale(fiber.betaN)};
    const double sum = choice.probability.total();
    for (double& a : choice.probability.p) a /= sum;
    return choice;
}

double densityOf(const Fiber& fiber, const Choice& choice, const Angles& angles) {
    const auto m = longitudinals(fiber, angles);
    const auto n = azimuthals(choice.scale, choice.gammaO, choice.gammaT, angles.phi);
    double density = 0;
    for (std::size_t p = 0; p < 4; ++p) density += choice.probability.p[p] * m[p] * n[p];
    return density;
}

}  // namespace

FiberSample sample(const Fiber& fiber, double sinThetaO, double cosThetaO, double h, const std::array<double, 4>& u) {
    const Choice choice = lobeChoice(fiber, cosThetaO, h);
    int lobe = 0;
    double left = u[0];
    while (lobe < 3 && left >= choice.probability.p[static_cast<std::size_t>(lobe)]) {
        left -= choice.probability.p[static_cast<std::size_t>(lobe)];
        ++lobe;
    }
    // d'Eon 2013: the lobe about the mirrored, tilted view is a von Mises-Fisher distribution of concentration 1 / v.
    const double v = longitudinalVariances(fiber.betaM)[static_cast<std::size_t>(lobe)];
    double s = 0, c = 0;
    tilt(fiber.alpha, lobe, sinThetaO, cosThetaO, s, c);
    // cos = 1 + v log(u + (1 - u) exp(-2 / v)), and what is missing to 1 without cancellation.
    const double below = std::min(-v * std::log(u[1] + (1.0 - u[1]) * std::exp(-2.0 / v)), 2.0);
    const double cosine = 1.0 - below, sine = std::sqrt(below * (2.0 - below));
    FiberSample result{};
    result.lobe = lobe;
    result.sinThetaI = std::clamp(-cosine * s + sine * std::cos(2.0 * pi * u[2]) * c, -1.0, 1.0);
    result.cosThetaI = std::sqrt((1.0 - result.sinThetaI) * (1.0 + result.sinThetaI));
    result.phi = lobe == 3
                     ? 2.0 * pi * u[3] - pi
                     : pathAzimuth(lobe, choice.gammaO, choice.gammaT) + sampleTrimmedLogistic(u[3], choice.scale);
    const Angles angles{result.sinThetaI, result.cosThetaI, sinThetaO, cosThetaO, result.phi};
    result.pdf = densityOf(fiber, choice, angles);
    result.weight = result.pdf > 0 ? nearField(fiber, angles, h).total() / result.pdf : 0;
    return result;
}

double pdf(const Fiber& fiber, const Angles& angles, double h) {
    return densityOf(fiber, lobeChoice(fiber, angles.cosThetaO, h), angles);
}

}  // namespace pelage::reference
