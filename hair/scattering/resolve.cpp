// SPDX-License-Identifier: MIT
#include "resolve.hpp"

#include <cmath>
#include <numbers>

namespace pelage::hair {
namespace {

// NaN goes to the lower end: both comparisons with it are false.
double within(double x, double low, double high) {
    return x >= high ? high : (x >= low ? x : low);
}

constexpr double radiansPerDegree = std::numbers::pi / 180.0;

}  // namespace

std::array<double, 4> longitudinalVariances(double betaM) {
    const double root = 0.726 * betaM + 0.812 * betaM * betaM + 3.7 * std::pow(betaM, 20);
    const double v = root * root;
    return {v, 0.25 * v, 4.0 * v, 4.0 * v};
}

double logisticScale(double betaN) {
    return std::sqrt(std::numbers::pi / 8.0) * (0.265 * betaN + 1.194 * betaN * betaN + 5.372 * std::pow(betaN, 22));
}

FiberProperties clamped(const FiberProperties& fiber) {
    FiberProperties f = fiber;
    f.eta = within(f.eta, 1.0001, 3.0);
    f.betaM = within(f.betaM, 0.01, 1.0);
    f.betaN = within(f.betaN, 0.01, 1.0);
    f.alpha = within(f.alpha, -0.5, 0.5);
    for (double& s : f.sigmaA) s = within(s, 0.0, 1e4);
    for (double& c : f.color) c = within(c, 0.0, 1.0);
    for (double& w : f.widthScale) w = within(w, 0.1, 10.0);
    for (double& x : f.shift) x = within(x, -0.5, 0.5);
    f.glintGain = within(f.glintGain, 0.0, 10.0);
    f.glintWidth = within(f.glintWidth, 0.5, 90.0);
    f.glintShift = within(f.glintShift, -30.0, 30.0);
    return f;
}

ResolvedFiber resolveFiber(const FiberProperties& fiber, bool nearField) {
    const FiberProperties f = clamped(fiber);
    const double s = logisticScale(f.betaN);
    ResolvedFiber r;
    r.eta = f.eta;
    r.etaExcess = (f.eta - 1.0) * (f.eta + 1.0);
    r.alpha = f.alpha;
    r.betaN = f.betaN;
    r.inverseScale = 1.0 / s;
    r.peak = 1.0 / (s * std::tanh(std::numbers::pi / (2.0 * s)));
    r.nearField = nearField ? 1.0 : 0.0;
    r.sigmaA = f.sigmaA;
    r.color = f.color;
    auto v = longitudinalVariances(f.betaM);
    constexpr double multiple[4] = {-2.0, 1.0, 4.0, 0.0};
    for (std::size_t p = 0; p < 4; ++p) {
        if (p < 3) v[p] *= f.widthScale[p] * f.widthScale[p];
        const double tilt = multiple[p] * f.alpha + (p < 3 ? f.shift[p] : 0.0);
        r.inverseVariance[p] = 1.0 / v[p];
        r.norm[p] = 1.0 / (-v[p] * std::expm1(-2.0 / v[p]));
        r.deviation[p] = std::sqrt(v[p]);
        r.sinTilt[p] = std::sin(tilt);
        r.cosTilt[p] = std::cos(tilt);
    }
    const double shift = f.glintShift * radiansPerDegree;
    r.glint = {f.glintGain, 1.0 / (f.glintWidth * radiansPerDegree), std::cos(shift), std::sin(shift)};
    return r;
}

ResolvedDirections resolveDirections(const FiberDirections& d) {
    const double h = d.h ? within(*d.h, -1.0, 1.0) : 0.0;
    return {.sinI = d.sinThetaI,
            .cosI = d.cosThetaI,
            .sinO = d.sinThetaO,
            .cosO = d.cosThetaO,
            .phi = std::remainder(d.phi, 2.0 * std::numbers::pi),
            .cosPhi = std::cos(d.phi),
            .h = h,
            .cosGamma = std::sqrt((1.0 - h) * (1.0 + h))};
}

double sigmaFromColor(double color, double betaN) {
    const double b = within(betaN, 0.01, 1.0);
    const double fit = 5.969 + b * (-0.215 + b * (2.532 + b * (-10.73 + b * (5.574 + b * 0.245))));
    const double root = std::log(within(color, 1e-4, 1.0)) / fit;
    return root * root;
}

double sigmaFromPathColor(double color) {
    return -0.25 * std::log(within(color, 1e-4, 1.0));
}

std::array<double, 3> sigmaFromMelanin(double eumelanin, double pheomelanin) {
    const double e = within(eumelanin, 0.0, 1e3), p = within(pheomelanin, 0.0, 1e3);
    return {e * 0.419 + p * 0.187, e * 0.697 + p * 0.4, e * 1.37 + p * 1.05};
}

}  // namespace pelage::hair
