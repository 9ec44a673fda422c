// SPDX-License-Identifier: MIT
// The older models, as published and as corrected. Published: how far each is from the truth was measured once outside
// this project; every figure of that is measured again here, through the source that the shaders are made of. A port
// that reproduces them within 2 % (or half of the last digit printed) is faithful; nothing here is allowed more.
// Left out:
//   Karis' white furnace at r = 0.3, 75 and 85 degrees (0.76, 0.48): measured are 0.83 and 0.59 for the talk's tilt of
//     0.035, 0.67 and 0.41 for none, and no tilt tried gives both figures;
//   Gerard's TRT as (13), exp(-11/2 sigma), and the thesis' (4.11): the models have (8) and (4.12);
//   UE5's other absorption, and the longitudinal figures of widths that no model has.
#include "legacy_support.hpp"

namespace pelage::test {
namespace {

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

}  // namespace
}  // namespace pelage::test
