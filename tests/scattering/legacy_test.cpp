// SPDX-License-Identifier: MIT
// The older models, as published and as corrected. Published: every figure of shared/facts/scattering.md sections 2 and
// 4 that says how far a model is from the truth is measured again, through the source that the shaders are made of. A
// port that reproduces them within 2 % (or half of the last digit printed) is faithful; nothing here is allowed more.
// Left out:
//   Karis' white furnace at r = 0.3, 75 and 85 degrees (0.76, 0.48): measured are 0.83 and 0.59 for the talk's tilt of
//     0.035, 0.67 and 0.41 for none, and no tilt tried gives both figures;
//   Gerard's TRT as (13), exp(-11/2 sigma), and the thesis' (4.11): the models have (8) and (4.12);
//   UE5's other absorption, and the longitudinal figures of widths that no model has.
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
namespace {

using enum hair::ScatteringModel;
using hair::ScatteringModel;
using reference::degree;
using reference::PathLength;
using reference::pi;

constexpr double eta = 1.55;
constexpr double gaussianPeak = 0.398942280401432678;

hair::FiberDirections directions(double thetaI, double thetaO, double phi) {
    return {std::sin(thetaI), std::abs(std::cos(thetaI)), std::sin(thetaO), std::abs(std::cos(thetaO)), phi};
}

hair::FiberProperties fiber(double betaM, double betaN, double alpha = 0, double sigma = 0) {
    hair::FiberProperties f;
    f.betaM = betaM;
    f.betaN = betaN;
    f.alpha = alpha;
    f.sigmaA = {sigma, sigma, sigma};
    return f;
}

// beta_M of a longitudinal lobe R with the standard deviation `deviation`, rad.
double betaOfDeviation(double deviation) {
    double low = 0.001, high = 1;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        (std::sqrt(reference::longitudinalVariances(middle)[0]) < deviation ? low : high) = middle;
    }
    return low;
}

double lobe(ScatteringModel model, bool published, const hair::FiberProperties& f, const hair::FiberDirections& d,
            std::size_t p, hair::MomentTable* table = nullptr) {
    return hair::scatterDouble(model, published, f, d, table).lobe[p][0];
}

// What the model reads of the table's first layer.
double tabulated(hair::MomentTable& table, double cosThetaO, double phi, std::size_t p) {
    const auto s = table.sample(cosThetaO, phi);
    const auto at = [&](std::size_t k) { return static_cast<double>(s.texels[0][k][p]); };
    return (1 - s.weightY) * ((1 - s.weightX) * at(0) + s.weightX * at(1)) +
           s.weightY * ((1 - s.weightX) * at(2) + s.weightX * at(3));
}

// The azimuths and inclinations of the measurement: theta_d in steps of 2.5 degrees with the weight cos(theta_d), phi
// in the middle of steps of 2 degrees.
constexpr std::size_t inclinations = 35, azimuths = 90;
double thetaAt(std::size_t i) {
    return 2.5 * degree * static_cast<double>(i);
}
double phiAt(std::size_t j) {
    return (2.0 * static_cast<double>(j) + 1.0) * degree;
}

using Grid = std::vector<double>;  // inclinations x azimuths
constexpr double sigmas[3] = {0, 0.25, 1};
using Grids = std::array<Grid, 3>;  // by sigma

Grid gridOf(const std::function<double(double thetaD, double phi)>& f) {
    Grid grid;
    for (std::size_t i = 0; i < inclinations; ++i) {
        for (std::size_t j = 0; j < azimuths; ++j) grid.push_back(f(thetaAt(i), phiAt(j)));
    }
    return grid;
}

Grids smooth(int p, PathLength path = PathLength::Chord) {
    Grids grids;
    for (std::size_t s = 0; s < 3; ++s) {
        grids[s] = gridOf([&](double thetaD, double phi) {
            return reference::marschnerSmooth(p, eta, thetaD, phi, sigmas[s], path);
        });
    }
    return grids;
}

enum class Kernel { Logistic, Gaussian };

// The mean over h of A_p kernel(phi - Phi_p), from the reference's terms; its own adaptive quadrature does the same
// (RoughGridsAreTheReference) and is slower by far. gamma = pi/2 cos(t): the midpoint rule in t converges
// exponentially.
Grids rough(int p, Kernel kernel, double width, PathLength path = PathLength::Chord) {
    Grids grids;
    for (Grid& grid : grids) grid.assign(inclinations * azimuths, 0.0);
    constexpr int nodes = 400;
    for (std::size_t i = 0; i < inclinations; ++i) {
        const auto section = reference::crossSection(eta, std::cos(thetaAt(i)));
        for (int k = 0; k < nodes; ++k) {
            const double t = pi * (k + 0.5) / nodes, gamma = 0.5 * pi * std::cos(t), cosine = std::cos(gamma);
            const auto refracted = reference::refract(section, std::sin(gamma), cosine);
            const double azimuth = reference::pathAzimuth(p, gamma, refracted.gammaT);
            const double squared = path == PathLength::Printed ? 2.0 * refracted.cosGammaT : 1.0;
            const double length = p * squared * 2.0 * refracted.cosGammaT / section.cosThetaT;
            const double measure = 0.5 * cosine * 0.5 * pi * std::sin(t) * pi / nodes;
            const double weight =
                measure * reference::attenuation(section, refracted, cosine, 0).p[static_cast<std::size_t>(p)];
            for (std::size_t j = 0; j < azimuths; ++j) {
                const double x = std::remainder(phiAt(j) - azimuth, 2.0 * pi);
                const double density = kernel == Kernel::Logistic
                                           ? reference::trimmedLogistic(x, width)
                                           : std::exp(-0.5 * x * x / (width * width)) * gaussianPeak / width;
                for (std::size_t s = 0; s < 3; ++s) {
                    grids[s][i * azimuths + j] += weight * std::exp(-sigmas[s] * length) * density;
                }
            }
        }
    }
    return grids;
}
Grids chiang(int p, double betaN) {
    return rough(p, Kernel::Logistic, reference::logisticScale(betaN));
}

// N_p of the model, its longitudinal part divided out: it is known where theta_i = -theta_o and alpha = 0.
Grid modelGrid(ScatteringModel model, bool published, std::size_t p, double betaN, double sigma) {
    const double betaM = 0.3;
    const auto f = fiber(betaM, betaN, 0, sigma);
    const double deviation = std::sqrt(reference::longitudinalVariances(betaM)[p]);
    return gridOf([&](double thetaD, double phi) {
        const double s = lobe(model, published, f, directions(-thetaD, thetaD, phi), p);
        if (model == Karis) return s * deviation * (p == 0 ? std::sqrt(2.0) * std::cos(0.5 * phi) : 1.0) / gaussianPeak;
        return s * std::cos(thetaD) * 0.5 * deviation / gaussianPeak * (published ? 1.0 : 2.0);
    });
}

struct Distance {
    double relative, energy, least, most;  // relative L2; energy over the truth's: in all, and by inclination
};
Distance distance(const Grid& model, const Grid& truth) {
    double difference = 0, square = 0, energy = 0, all = 0;
    Distance d{0, 0, 1e9, 0};
    for (std::size_t i = 0; i < inclinations; ++i) {
        const double weight = std::cos(thetaAt(i));
        double here = 0, there = 0;
        for (std::size_t k = i * azimuths; k < (i + 1) * azimuths; ++k) {
            difference += weight * (model[k] - truth[k]) * (model[k] - truth[k]);
            square += weight * truth[k] * truth[k];
            here += model[k];
            there += truth[k];
        }
        energy += weight * here;
        all += weight * there;
        d.least = std::min(d.least, here / there);
        d.most = std::max(d.most, here / there);
    }
    d.relative = std::sqrt(difference / square);
    d.energy = energy / all;
    return d;
}

// 2 %, or half of the last digit printed.
void expectFigure(double measured, double figure, const std::string& what, double digit = 0.001) {
    EXPECT_NEAR(measured, figure, std::max(0.02 * figure, 0.5 * digit)) << what;
}

void expectRelative(ScatteringModel model, std::size_t p, double betaN, const Grids& truth,
                    const std::array<double, 3>& figures, const std::string& what) {
    for (std::size_t s = 0; s < 3; ++s) {
        expectFigure(distance(modelGrid(model, true, p, betaN, sigmas[s]), truth[s]).relative, figures[s],
                     what + ", sigma " + std::to_string(sigmas[s]));
    }
}

TEST(LegacyModels, RoughGridsAreTheReference) {
    const std::size_t i = 12, j = 7;
    const double thetaD = thetaAt(i), phi = phiAt(j);
    reference::Fiber f;
    f.betaN = 0.3;
    f.sigmaA = 1;
    const auto exact = reference::farFieldAzimuthal(f, std::cos(thetaD), phi).value;
    for (const int p : {0, 1, 2}) {
        const double expected = exact.p[static_cast<std::size_t>(p)];
        EXPECT_NEAR(chiang(p, 0.3)[2][i * azimuths + j], expected, 1e-6 * expected) << p;
    }
    const double expected = reference::marschnerRough(2, eta, thetaD, phi, 1, PathLength::Printed, 10 * degree);
    EXPECT_NEAR(rough(2, Kernel::Gaussian, 10 * degree, PathLength::Printed)[2][i * azimuths + j], expected,
                1e-6 * expected);
}

TEST(LegacyModels, KarisRIsAsFarFromTheTruthAsMeasured) {
    const Distance d = distance(modelGrid(Karis, true, 0, 0.3, 0), smooth(0)[0]);
    expectFigure(d.relative, 0.090, "smooth");
    expectFigure(d.energy, 0.94, "energy", 0.01);
    expectFigure(d.least, 0.89, "least", 0.01);
    expectFigure(d.most, 1.05, "most", 0.01);
    const double figures[3][2] = {{0.3, 0.118}, {0.6, 0.191}, {0.8, 0.235}};
    for (const auto& [betaN, figure] : figures) {
        expectFigure(distance(modelGrid(Karis, true, 0, betaN, 0), chiang(0, betaN)[0]).relative, figure,
                     "beta_N " + std::to_string(betaN));
    }
}

TEST(LegacyModels, KarisTTIsAsFarFromTheTruthAsMeasured) {
    const Grids truth = smooth(1);
    expectRelative(Karis, 1, 0.3, truth, {0.237, 0.148, 0.223}, "smooth");
    const double energies[3][3] = {{1.06, 1.02, 1.19}, {0.94, 0.007, 1.01}, {0.79, 0, 0.97}};
    for (std::size_t s = 0; s < 3; ++s) {
        const Distance d = distance(modelGrid(Karis, true, 1, 0.3, sigmas[s]), truth[s]);
        expectFigure(d.energy, energies[s][0], "energy", 0.01);
        expectFigure(d.least, energies[s][1], "least");
        expectFigure(d.most, energies[s][2], "most", 0.01);
    }
    expectRelative(Karis, 1, 0.3, chiang(1, 0.3), {0.271, 0.179, 0.229}, "beta_N 0.3");
    expectRelative(Karis, 1, 0.6, chiang(1, 0.6), {0.543, 0.434, 0.369}, "beta_N 0.6");
    expectRelative(Karis, 1, 0.8, chiang(1, 0.8), {0.885, 0.756, 0.623}, "beta_N 0.8");
}

TEST(LegacyModels, KarisTRTIsAsFarFromTheTruthAsMeasured) {
    const Grids truth = rough(2, Kernel::Gaussian, 10 * degree);
    expectRelative(Karis, 2, 0.3, rough(2, Kernel::Gaussian, 5 * degree), {0.471, 0.360, 0.364}, "5 degrees");
    expectRelative(Karis, 2, 0.3, truth, {0.459, 0.299, 0.353}, "10 degrees");
    expectRelative(Karis, 2, 0.3, rough(2, Kernel::Gaussian, 20 * degree), {0.701, 0.561, 0.698}, "20 degrees");
    const Distance d = distance(modelGrid(Karis, true, 2, 0.3, 0), truth[0]);
    expectFigure(d.energy, 0.98, "energy", 0.01);
    expectFigure(d.least, 0.33, "least", 0.01);
    expectFigure(d.most, 1.16, "most", 0.01);
    expectRelative(Karis, 2, 0.3, chiang(2, 0.3), {0.486, 0.324, 0.397}, "beta_N 0.3");
    expectRelative(Karis, 2, 0.6, chiang(2, 0.6), {1.11, 0.982, 1.23}, "beta_N 0.6");
    expectRelative(Karis, 2, 0.8, chiang(2, 0.8), {1.63, 1.49, 1.88}, "beta_N 0.8");
}

TEST(LegacyModels, ThesisIsAsFarFromTheTruthAsMeasured) {
    const Distance r = distance(modelGrid(Thesis, true, 0, 0.3, 0), smooth(0)[0]);
    expectFigure(r.relative, 0.80, "R (4.12)", 0.01);
    expectFigure(r.energy, 0.39, "R (4.12), energy", 0.01);
    expectRelative(Thesis, 1, 0.3, smooth(1), {0.235, 0.145, 0.259}, "TT, smooth");
    expectRelative(Thesis, 1, 0.3, chiang(1, 0.3), {0.268, 0.175, 0.265}, "TT, beta_N 0.3");
    const double betas[2] = {0.6, 0.8};
    const double relative[2][3] = {{0.554, 0.530, 0.574}, {0.554, 0.594, 0.551}};
    const double energy[2][3] = {{0.70, 0.63, 0.73}, {0.47, 0.43, 0.49}};
    for (std::size_t b = 0; b < 2; ++b) {
        const Grids truth = chiang(2, betas[b]);
        for (std::size_t s = 0; s < 3; ++s) {
            const Distance d = distance(modelGrid(Thesis, true, 2, betas[b], sigmas[s]), truth[s]);
            expectFigure(d.relative, relative[b][s], "TRT");
            expectFigure(d.energy, energy[b][s], "TRT, energy", 0.01);
        }
    }
}

// Gerard's N is the exact one without absorption, times what the model makes of sigma.
TEST(LegacyModels, GerardsAbsorptionIsAsFarFromTheTruthAsMeasured) {
    hair::MomentTable table(eta, 0.3);
    const auto absorbed = [&](const Grid& clear, std::size_t p, double sigma) {
        Grid grid = clear;
        for (std::size_t i = 0; i < inclinations; ++i) {
            const auto d = directions(-thetaAt(i), thetaAt(i), p == 1 ? pi : 0);
            const double left = lobe(Gerard, true, fiber(0.3, 0.3, 0, sigma), d, p, &table) /
                                lobe(Gerard, true, fiber(0.3, 0.3), d, p, &table);
            for (std::size_t k = i * azimuths; k < (i + 1) * azimuths; ++k) grid[k] *= left;
        }
        return grid;
    };
    const Grids tt = smooth(1, PathLength::Printed);
    const double figures[2][2] = {{0.113, 0.96}, {0.463, 0.76}};
    for (std::size_t s = 1; s < 3; ++s) {
        const Distance d = distance(absorbed(tt[0], 1, sigmas[s]), tt[s]);
        expectFigure(d.relative, figures[s - 1][0], "TT");
        expectFigure(d.energy, figures[s - 1][1], "TT, energy", 0.01);
    }
    const Grid dark = gridOf([](double thetaD, double phi) {
        return reference::marschnerSmooth(1, eta, thetaD, phi, 2, PathLength::Printed);
    });
    expectFigure(distance(absorbed(tt[0], 1, 2), dark).relative, 0.82, "TT, sigma 2", 0.01);
    const Grids trt = rough(2, Kernel::Gaussian, 10 * degree, PathLength::Printed);
    expectFigure(distance(absorbed(trt[0], 2, 0.25), trt[1]).relative, 1.19, "TRT (8)", 0.01);
    expectFigure(distance(absorbed(trt[0], 2, 1), trt[2]).relative, 15.7, "TRT (8)", 0.1);
}

TEST(LegacyModels, MarschnersRAndTTAreExact) {
    for (const bool published : {true, false}) {
        const Grids r = smooth(0), tt = smooth(1, published ? PathLength::Printed : PathLength::Chord);
        for (std::size_t s = 0; s < 3; ++s) {
            EXPECT_LT(distance(modelGrid(Marschner, published, 0, 0.3, sigmas[s]), r[s]).relative, 1e-12);
            EXPECT_LT(distance(modelGrid(Marschner, published, 1, 0.3, sigmas[s]), tt[s]).relative, 1e-9);
        }
    }
}

// The cubic and its replaced caustics: measured, not published. The truth is roughened by 10 degrees, as the Gaussians
// are that stand for the caustics; smooth, it is infinite there.
TEST(LegacyModels, MarschnersTRTLosesLightAtTheCausticUntilCorrected) {
    const Grids printed = rough(2, Kernel::Gaussian, 10 * degree, PathLength::Printed);
    const Grids chord = rough(2, Kernel::Gaussian, 10 * degree);
    const double energies[3] = {0.724, 0.674, 0.533};
    for (std::size_t s = 0; s < 3; ++s) {
        const Distance published = distance(modelGrid(Marschner, true, 2, 0.05, sigmas[s]), printed[s]);
        EXPECT_NEAR(published.energy, energies[s], 0.01);
        EXPECT_LT(published.most, 1.03);
        const Distance corrected = distance(modelGrid(Marschner, false, 2, 0.05, sigmas[s]), chord[s]);
        EXPECT_LT(corrected.relative, 0.2);
        EXPECT_NEAR(corrected.energy, 0.96, 0.04);
        EXPECT_GT(corrected.least, 0.85);
        EXPECT_LT(corrected.most, 1.14);
    }
}

// M as printed, from S of R over the exact N_R.
TEST(LegacyModels, PublishedMarschnerCountsEveryAngleTwice) {
    const auto integral = [](double betaDegrees, double thetaODegrees) {
        const auto f = fiber(betaOfDeviation(2 * betaDegrees * degree), 0.3);
        constexpr int steps = 4000;
        double sum = 0;
        for (int k = 0; k < steps; ++k) {
            const double thetaI = -0.5 * pi + pi * (k + 0.5) / steps, thetaO = thetaODegrees * degree;
            const double n = reference::marschnerSmooth(0, eta, 0.5 * (thetaO - thetaI), 0, 0, PathLength::Chord);
            sum += lobe(Marschner, true, f, directions(thetaI, thetaO, 0), 0) / n * std::cos(thetaI) * pi / steps;
        }
        return sum;
    };
    expectFigure(integral(2, 0), 1.99, "2 degrees", 0.01);
    expectFigure(integral(5, 0), 1.96, "5 degrees", 0.01);
    expectFigure(integral(10, 0), 1.83, "10 degrees", 0.01);
    expectFigure(integral(10, 85), 2.36, "10 degrees at 85", 0.01);
}

struct Furnace {
    std::array<double, 4> lobe{};
    double total = 0;
};

// The integral of S over the sphere of wi.
Furnace furnace(ScatteringModel model, bool published, const hair::FiberProperties& f, double thetaODegrees,
                hair::MomentTable* table = nullptr, int inclined = 180, int around = 90) {
    Furnace sum;
    for (int i = 0; i < inclined; ++i) {
        const double thetaI = -0.5 * pi + pi * (i + 0.5) / inclined;
        for (int j = 0; j < around; ++j) {
            const auto d = directions(thetaI, thetaODegrees * degree, pi * (j + 0.5) / around);
            const auto s = hair::scatterDouble(model, published, f, d, table);
            const double weight = std::cos(thetaI) * pi / inclined * 2.0 * pi / around;
            for (std::size_t p = 0; p < 4; ++p) sum.lobe[p] += weight * s.lobe[p][0];
        }
    }
    for (const double x : sum.lobe) sum.total += x;
    return sum;
}

// The mean over h of A_p without absorption.
double meanAttenuation(std::size_t p, double thetaD) {
    const auto section = reference::crossSection(eta, std::cos(thetaD));
    constexpr int nodes = 64;
    double sum = 0;
    for (int k = 0; k < nodes; ++k) {
        const double t = pi * (k + 0.5) / nodes, gamma = 0.5 * pi * std::cos(t), cosine = std::cos(gamma);
        const auto refracted = reference::refract(section, std::sin(gamma), cosine);
        sum += 0.5 * cosine * 0.5 * pi * std::sin(t) * pi / nodes *
               reference::attenuation(section, refracted, cosine, 0).p[p];
    }
    return sum;
}

// beta 10 degrees, alpha -10 degrees. R and TT through the model; TRT's light is taken as that of the exact cylinder,
// which the figures are of, and not of the cubic (see above).
TEST(LegacyModels, PublishedMarschnerGainsLightAsMeasured) {
    const double alpha = -10 * degree, betaTRT = 20 * degree;
    const auto f = fiber(betaOfDeviation(20 * degree), 0.3, alpha);
    const double figures[7][2] = {{0, 1.85}, {30, 2.00}, {60, 2.12}, {75, 2.07}, {85, 2.01}, {-60, 1.24}, {-85, 1.67}};
    for (const auto& [thetaO, figure] : figures) {
        const Furnace own = furnace(Marschner, true, f, thetaO, nullptr, 180, 180);
        double trt = 0;
        constexpr int steps = 720;
        for (int k = 0; k < steps; ++k) {
            const double thetaI = -0.5 * pi + pi * (k + 0.5) / steps;
            const double thetaD = 0.5 * (thetaO * degree - thetaI), thetaH = 0.5 * (thetaO * degree + thetaI);
            const double x = (thetaH + 1.5 * alpha) / betaTRT;
            trt += std::exp(-0.5 * x * x) * gaussianPeak / betaTRT * meanAttenuation(2, thetaD) *
                   std::pow(std::cos(thetaI) / std::cos(thetaD), 2) * pi / steps;
        }
        expectFigure(own.lobe[0] + own.lobe[1] + trt, figure, "theta_o " + std::to_string(thetaO), 0.01);
    }
}

TEST(LegacyModels, PublishedGerardsLobesHaveTheIntegralsMeasured) {
    hair::MomentTable table(eta, 0.3);
    const auto f = fiber(betaOfDeviation(20 * degree), 0.3);
    const double figures[3] = {1.29, 2.37, 0.76}, phis[3] = {0, pi, 0};
    for (std::size_t p = 0; p < 3; ++p) {
        constexpr int steps = 720;
        double sum = 0;
        for (int k = 0; k < steps; ++k) {
            // theta_i = theta_o: theta_h runs, theta_d stays 0.
            const double theta = -0.5 * pi + pi * (k + 0.5) / steps;
            sum += lobe(Gerard, true, f, directions(theta, theta, phis[p]), p, &table) /
                   (tabulated(table, std::cos(theta), phis[p], p) * std::cos(theta)) * pi / steps;
        }
        expectFigure(sum, figures[p], "lobe " + std::to_string(p), 0.01);
    }
}

// As above, with N of the exact cylinder at theta_d in place of the table, which is made at theta_o.
double gerardFurnace(bool published, double betaDegrees, double alphaDegrees, double thetaODegrees) {
    hair::MomentTable table(eta, 0.3);
    const auto f = fiber(betaOfDeviation(2 * betaDegrees * degree), 0.3, alphaDegrees * degree);
    const double phis[3] = {0, pi, 0}, thetaO = thetaODegrees * degree;
    double sum = 0;
    constexpr int steps = 360;
    for (std::size_t p = 0; p < 3; ++p) {
        for (int k = 0; k < steps; ++k) {
            const double thetaI = -0.5 * pi + pi * (k + 0.5) / steps;
            sum += lobe(Gerard, published, f, directions(thetaI, thetaO, phis[p]), p, &table) /
                   tabulated(table, std::cos(thetaO), phis[p], p) * meanAttenuation(p, 0.5 * (thetaO - thetaI)) *
                   std::cos(thetaI) * pi / steps;
        }
    }
    return sum;
}

TEST(LegacyModels, PublishedGerardGainsLightAsMeasured) {
    // Printed as ranges: 3.8 to 4.3 from 0 to 85 degrees, 2.4 to 2.5 at -60 and -85.
    double least = 1e9, most = 0;
    for (const double thetaO : {0.0, 30.0, 60.0, 75.0, 85.0}) {
        const double total = gerardFurnace(true, 10, -10, thetaO);
        least = std::min(least, total);
        most = std::max(most, total);
    }
    expectFigure(least, 3.8, "least", 0.1);
    expectFigure(most, 4.3, "most", 0.1);
    expectFigure(gerardFurnace(true, 10, -10, -60), 2.5, "-60", 0.1);
    expectFigure(gerardFurnace(true, 10, -10, -85), 2.4, "-85", 0.1);
}

// The talk's tilt, 0.035; r^2 is the width.
TEST(LegacyModels, PublishedKarisKeepsAsMuchLightAsMeasured) {
    const double figures[5][3] = {{0.3, 0, 1.00}, {0.3, 30, 1.02}, {0.3, 60, 1.04}, {1.0, 0, 0.90}, {1.0, 85, 0.46}};
    for (const auto& [r, thetaO, figure] : figures) {
        expectFigure(furnace(Karis, true, fiber(betaOfDeviation(r * r), 0.3, -0.035), thetaO).total, figure,
                     "r " + std::to_string(r) + ", theta_o " + std::to_string(thetaO), 0.01);
    }
}

// beta_M = 0.1, relative L2 with the weight cos(theta_i). M from S of TT over what it is at theta_i = -theta_o for the
// same theta_d.
TEST(LegacyModels, KarisConstantWidthIsAsFarFromTheExactLobeAsMeasured) {
    const double width = std::sqrt(reference::longitudinalVariances(0.1)[0]);
    const auto f = fiber(betaOfDeviation(2 * width), 0.3);  // TT is half as wide
    const double figures[5][2] = {{0, 0.002}, {30, 0.12}, {60, 0.49}, {75, 0.70}, {85, 0.91}};
    for (const auto& [thetaO, figure] : figures) {
        double difference = 0, square = 0;
        constexpr int steps = 3600;
        for (int k = 0; k < steps; ++k) {
            const double thetaI = -0.5 * pi + pi * (k + 0.5) / steps, thetaD = 0.5 * (thetaO * degree - thetaI);
            const auto d = directions(thetaI, thetaO * degree, pi);
            const double n = lobe(Karis, true, f, directions(-thetaD, thetaD, pi), 1) * width / gaussianPeak;
            const double exact =
                reference::longitudinal(width * width, d.sinThetaI, d.cosThetaI, d.sinThetaO, d.cosThetaO);
            const double error = lobe(Karis, true, f, d, 1) / n - exact;
            difference += error * error * d.cosThetaI;
            square += exact * exact * d.cosThetaI;
        }
        expectFigure(std::sqrt(difference / square), figure, "theta_o " + std::to_string(thetaO),
                     thetaO > 0 ? 0.01 : 0.001);
    }
}

TEST(LegacyModels, KajiyaKayHasTheIntegralsThatItsNormsAreMadeFrom) {
    // Published: pi^2 for sin(t, l), at any inclination; 4.64 and 1.74 for cos^10 and cos^80.
    for (const double thetaO : {0.0, 40.0, 80.0}) {
        EXPECT_NEAR(furnace(KajiyaKay, true, fiber(0.3, 0.3), thetaO).lobe[3], pi * pi, 1e-3);
    }
    expectFigure(furnace(KajiyaKay, true, fiber(betaOfDeviation(std::sqrt(0.1)), 0.3), 0).lobe[0], 4.64, "p 10", 0.01);
    expectFigure(furnace(KajiyaKay, true, fiber(betaOfDeviation(std::sqrt(1.0 / 80)), 0.3), 0).lobe[0], 1.74, "p 80",
                 0.01);
    // Corrected: 0.075 of the light in the highlight, the colour's share of the rest in the diffuse part.
    for (const double betaM : {0.05, 0.3, 0.7, 1.0}) {
        auto f = fiber(betaM, 0.3);
        f.color = {0.4, 0.4, 0.4};
        const Furnace light = furnace(KajiyaKay, false, f, 0, nullptr, 720, 2);
        EXPECT_NEAR(light.lobe[0], 0.075, 1e-6) << betaM;
        EXPECT_NEAR(light.lobe[3], 0.4 * 0.925, 1e-5) << betaM;
        EXPECT_NEAR(furnace(KajiyaKay, false, f, 70, nullptr, 720, 2).lobe[3], 0.4 * 0.925, 1e-5) << betaM;
    }
}

TEST(LegacyModels, ScheuermannsTermsHaveTheirShares) {
    for (const double betaM : {0.1, 0.3, 1.0}) {
        const Furnace light = furnace(Scheuermann, false, fiber(betaM, 0.3), 0, nullptr, 360, 360);
        EXPECT_NEAR(light.lobe[0], 0.075, 1e-4) << betaM;
        EXPECT_NEAR(light.lobe[2], 0.055, 1e-4) << betaM;
        EXPECT_NEAR(light.lobe[3], 0.87, 1e-4) << betaM;
    }
}

// White hair in white light. Kajiya-Kay and Scheuermann are normalised and never gain. The others are fits: what a fit
// of TT has too much (6 to 9 % over all inclinations, sections above) is what they may gain, and a tilted Gaussian over
// theta_h is not normalised near the ends of the fibre. None comes near the factor of the published forms.
TEST(LegacyModels, CorrectedFormsGainNoMoreThanTheirFitsDo) {
    hair::MomentTable table(eta, 0.3);
    struct Bound {
        ScatteringModel model;
        double least, most;  // beta_M 0.1 and 0.3, theta_o 0 to 75 degrees either way
        double end;          // the most at 85 degrees
    };
    for (const Bound& bound : {Bound{KajiyaKay, 0.93, 1.0005, 0.95}, Bound{Scheuermann, 0.90, 1.0005, 0.92},
                               Bound{Marschner, 0.74, 1.02, 1.0}, Bound{Karis, 0.88, 1.08, 0.9},
                               Bound{Thesis, 0.80, 1.17, 1.0}, Bound{Gerard, 0.83, 1.01, 1.16}}) {
        for (const double betaM : {0.1, 0.3}) {
            for (const double alpha : {0.0, -2 * degree}) {
                for (const double thetaO : {0.0, 30.0, 60.0, 75.0, 85.0, -30.0, -60.0, -75.0, -85.0}) {
                    const double total =
                        furnace(bound.model, false, fiber(betaM, 0.3, alpha), thetaO, &table, 180, 60).total;
                    const std::string what =
                        std::string(hair::scatteringModels()[static_cast<std::size_t>(bound.model)].id) + " " +
                        std::to_string(betaM) + " " + std::to_string(alpha) + " " + std::to_string(thetaO);
                    if (std::abs(thetaO) > 80) {
                        EXPECT_LT(total, bound.end) << what;
                        EXPECT_GT(total, 0.55) << what;
                    } else {
                        EXPECT_LT(total, bound.most) << what;
                        EXPECT_GT(total, bound.least) << what;
                    }
                }
            }
        }
    }
}

// Against the exact fibre over the whole sphere, with some absorption: the corrections must pay.
TEST(LegacyModels, CorrectedFormsAreNearerToTheTruth) {
    hair::MomentTable table(eta, 0.3);
    const auto f = fiber(0.2, 0.3, -2 * degree, 0.25);
    for (const ScatteringModel model : {Marschner, Karis, Thesis, Gerard}) {
        double difference[2] = {}, square = 0;
        for (const double thetaO : {0.0, 40.0, 70.0}) {
            for (int i = 0; i < 36; ++i) {
                for (int j = 0; j < 18; ++j) {
                    const double thetaI = (-87.5 + 5 * i) * degree;
                    const auto d = directions(thetaI, thetaO * degree, (5.0 + 10 * j) * degree);
                    const auto sum = [](const hair::ScatteredLobes& s) {
                        return s.lobe[0][0] + s.lobe[1][0] + s.lobe[2][0] + s.lobe[3][0];
                    };
                    const double exact = sum(hair::scatterDouble(Chiang, false, f, d));
                    for (const bool published : {true, false}) {
                        const double error = sum(hair::scatterDouble(model, published, f, d, &table)) - exact;
                        difference[published ? 1 : 0] += error * error * d.cosThetaI;
                    }
                    square += exact * exact * d.cosThetaI;
                }
            }
        }
        EXPECT_LT(difference[0], difference[1]) << static_cast<int>(model);
    }
}

// Helmholtz: S / cos(theta_i) is the same with the two directions exchanged.
TEST(LegacyModels, MarschnerIsReciprocal) {
    const auto f = fiber(0.3, 0.3, -3 * degree, 0.4);
    for (const bool published : {true, false}) {
        for (const double thetaI : {-70.0, -20.0, 35.0}) {
            for (const double thetaO : {-50.0, 10.0, 80.0}) {
                for (const double phi : {5.0, 60.0, 170.0}) {
                    const auto there = directions(thetaI * degree, thetaO * degree, phi * degree);
                    const auto back = directions(thetaO * degree, thetaI * degree, -phi * degree);
                    for (std::size_t p = 0; p < 3; ++p) {
                        const double s = lobe(Marschner, published, f, there, p) / there.cosThetaI;
                        const double t = lobe(Marschner, published, f, back, p) / back.cosThetaI;
                        EXPECT_NEAR(s, t, 1e-11 * s + 1e-300) << thetaI << " " << thetaO << " " << phi;
                    }
                }
            }
        }
    }
}

// u runs from root to tip, so theta < 0 is towards the root; alpha is negative for real hair. Seen from straight above,
// R is brightest for light from 2 alpha, and the coloured highlight for light from the tip's side.
TEST(LegacyModels, HighlightMovesToRoot) {
    hair::MomentTable table(eta, 0.3);
    const auto peak = [&](ScatteringModel model, bool published, std::size_t p) {
        double best = -1, at = 0;
        for (double thetaI = -60; thetaI <= 60; thetaI += 0.1) {
            const double s =
                lobe(model, published, fiber(0.1, 0.3, -5 * degree), directions(thetaI * degree, 0, 0), p, &table);
            if (s > best) {
                best = s;
                at = thetaI;
            }
        }
        return at;
    };
    for (const ScatteringModel model : {KajiyaKay, Scheuermann, Marschner, Karis, Thesis, Gerard}) {
        const double multiple = model == Karis ? 4 : 2;  // published: the mirror is tilted twice
        EXPECT_NEAR(peak(model, false, 0), -10, 0.5) << static_cast<int>(model);
        EXPECT_NEAR(peak(model, true, 0), model == KajiyaKay ? 0 : -5 * multiple, 0.5) << static_cast<int>(model);
        if (model == KajiyaKay) continue;
        EXPECT_NEAR(peak(model, false, 2), model == Karis ? 20 : 15, 1.0) << static_cast<int>(model);
        EXPECT_NEAR(peak(model, true, 2), model == Karis ? 20 : 15, 1.0) << static_cast<int>(model);
    }
}

// Poles are bounded, in both precisions, at every end of every range.
TEST(LegacyModels, NothingIsInfiniteOrNegativeAnywhere) {
    for (const double index : {1.0001, 1.05, 1.33, 1.55, 3.0}) {
        hair::MomentTable table(index, 0.3);
        for (const double beta : {0.01, 0.3, 1.0}) {
            for (const double sigma : {0.0, 1.0, 1e4}) {
                auto f = fiber(beta, 0.3, -2 * degree, sigma);
                f.eta = index;
                f.color = {0, 0.5, 1};
                for (const double thetaI : {-90.0, -89.999, -60.0, 0.0, 45.0, 90.0}) {
                    for (const double thetaO : {-90.0, -45.0, 0.0, 60.0, 89.999, 90.0}) {
                        for (const double phi : {0.0, 1e-6, 18.6, 80.4, 179.9999, 180.0}) {
                            auto d = directions(thetaI * degree, thetaO * degree, phi * degree);
                            if (std::abs(thetaI) == 90) d.cosThetaI = 0;
                            if (std::abs(thetaO) == 90) d.cosThetaO = 0;
                            for (const ScatteringModel model :
                                 {KajiyaKay, Scheuermann, Marschner, Karis, Thesis, Gerard}) {
                                for (const bool published : {true, false}) {
                                    for (const auto& s : {hair::scatterDouble(model, published, f, d, &table),
                                                          hair::scatterFloat(model, published, f, d, &table)}) {
                                        for (const auto& x : s.lobe) {
                                            for (const double y : x) ASSERT_TRUE(y >= 0 && y < 1e12);
                                        }
                                    }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

TEST(LegacyModels, FloatFollowsDouble) {
    hair::MomentTable table(eta, 0.3);
    for (const ScatteringModel model : {KajiyaKay, Scheuermann, Marschner, Karis, Thesis, Gerard}) {
        for (const bool published : {true, false}) {
            double worst = 0;  // of the value, or of 1e-4 where it is less
            for (const double beta : {0.1, 0.3, 0.8}) {
                const auto f = fiber(beta, 0.3, -2 * degree, 0.3);
                for (double thetaO = -84; thetaO < 90; thetaO += 12) {
                    for (double thetaI = -85; thetaI < 90; thetaI += 3.7) {
                        for (double phi = -178; phi < 180; phi += 11.3) {
                            const auto d = directions(thetaI * degree, thetaO * degree, phi * degree);
                            const auto exact = hair::scatterDouble(model, published, f, d, &table);
                            const auto rounded = hair::scatterFloat(model, published, f, d, &table);
                            for (std::size_t p = 0; p < 4; ++p) {
                                const double error = std::abs(rounded.lobe[p][0] - exact.lobe[p][0]);
                                worst = std::max(worst, error / (exact.lobe[p][0] + 1e-4));
                            }
                        }
                    }
                }
            }
            EXPECT_LT(worst, 5e-4) << static_cast<int>(model) << published;
        }
    }
}

}  // namespace
}  // namespace pelage::test
