// SPDX-License-Identifier: MIT
// The published models' light: how much they return of a white sphere, as printed (the figures of others' measurement,
// within 2 %) and corrected, their symmetries and their extremes.
#include "legacy_support.hpp"

namespace pelage::test {
namespace {

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
                    const std::string what = std::string(hair::findScatteringModel(bound.model)->id) + " " +
                                             std::to_string(betaM) + " " + std::to_string(alpha) + " " +
                                             std::to_string(thetaO);
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
