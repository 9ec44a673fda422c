// SPDX-License-Identifier: MIT
// What the tests of the published models share: one lobe of a model, and what it reads of its table.
#pragma once

#include <pelage/hair/scattering.hpp>
#include <pelage/reference/marschner.hpp>
#include <pelage/reference/terms.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace pelage::test {

using enum hair::ScatteringModel;
using hair::ScatteringModel;
using reference::degree;
using reference::PathLength;
using reference::pi;

inline constexpr double eta = 1.55;
inline constexpr double gaussianPeak = 0.398942280401432678;

inline hair::FiberDirections directions(double thetaI, double thetaO, double phi) {
    return {std::sin(thetaI), std::abs(std::cos(thetaI)), std::sin(thetaO), std::abs(std::cos(thetaO)), phi};
}

inline hair::FiberProperties fiber(double betaM, double betaN, double alpha = 0, double sigma = 0) {
    hair::FiberProperties f;
    f.betaM = betaM;
    f.betaN = betaN;
    f.alpha = alpha;
    f.sigmaA = {sigma, sigma, sigma};
    return f;
}

// beta_M of a longitudinal lobe R with the standard deviation `deviation`, rad.
inline double betaOfDeviation(double deviation) {
    double low = 0.001, high = 1;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        (std::sqrt(reference::longitudinalVariances(middle)[0]) < deviation ? low : high) = middle;
    }
    return low;
}

inline double lobe(ScatteringModel model, bool published, const hair::FiberProperties& f,
                   const hair::FiberDirections& d, std::size_t p, hair::MomentTable* table = nullptr) {
    return hair::scatterDouble(model, published, f, d, table).lobe[p][0];
}

// What the model reads of the table's first layer.
inline double tabulated(hair::MomentTable& table, double cosThetaO, double phi, std::size_t p) {
    const auto s = table.sample(cosThetaO, phi);
    const auto at = [&](std::size_t k) { return static_cast<double>(s.texels[0][k][p]); };
    const double rim =
        cosThetaO / (cosThetaO + 0.21 * std::sqrt(eta * eta - 1 + cosThetaO * cosThetaO));  // momentRim of moments.glsl
    return (p == 0 ? 1 : rim * rim) * ((1 - s.weightY) * ((1 - s.weightX) * at(0) + s.weightX * at(1)) +
                                       s.weightY * ((1 - s.weightX) * at(2) + s.weightX * at(3)));
}

// 2 %, or half of the last digit printed.
inline void expectFigure(double measured, double figure, const std::string& what, double digit = 0.001) {
    EXPECT_NEAR(measured, figure, std::max(0.02 * figure, 0.5 * digit)) << what;
}

}  // namespace pelage::test
