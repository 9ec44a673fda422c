// SPDX-License-Identifier: MIT
#include <pelage/reference/marschner.hpp>

#include "quadrature.hpp"

#include <algorithm>
#include <cmath>

namespace pelage::reference {
namespace {

double segmentLength(PathLength path, const CrossSection& section, double cosGammaT) {
    switch (path) {
        case PathLength::Chord:
            return 2.0 * cosGammaT / section.cosThetaT;
        case PathLength::Printed:
            return 4.0 * cosGammaT * cosGammaT / section.cosThetaT;
        case PathLength::Thesis:
            return 4.0 * cosGammaT * cosGammaT;
    }
    return 0;
}

// A(p, h) of section 4.3: f, (1 - f)^2 T, (1 - f)^2 f T^2. f at cos(theta_d) cos(gamma_o) equals Bravais' pair of
// indices.
double attenuationOf(int p, const CrossSection& section, double cosGammaO, double cosGammaT, double sigmaA,
                     PathLength path) {
    const Fresnel f = fresnel(section.eta, section.cosThetaO * cosGammaO);
    if (p == 0) return f.reflected;
    const double t = std::exp(-sigmaA * p * segmentLength(path, section, cosGammaT));
    return f.transmitted * f.transmitted * t * (p == 2 ? f.reflected : 1.0);
}

CrossSection sectionAt(double eta, double thetaD) {
    return crossSection(eta, std::cos(thetaD));
}

std::vector<double> rootAngles(const CrossSection& section, int p, double phi) {
    std::vector<double> gammas;
    const double near = std::remainder(phi, 2.0 * pi);
    for (int period = -3; period <= 3; ++period) {
        for (const double gammaO : offsetsAtAzimuth(section, p, near + 2.0 * pi * period)) gammas.push_back(gammaO);
    }
    std::sort(gammas.begin(), gammas.end());
    return gammas;
}

double gaussian(double sigma, double x) {
    return std::exp(-0.5 * x * x / (sigma * sigma)) / (sigma * std::sqrt(2.0 * pi));
}

}  // namespace

std::vector<double> marschnerRoots(int p, double eta, double thetaD, double phi) {
    std::vector<double> roots = rootAngles(sectionAt(eta, thetaD), p, phi);
    for (double& root : roots) root = std::sin(root);
    return roots;
}

double marschnerSmooth(int p, double eta, double thetaD, double phi, double sigmaA, PathLength path) {
    const CrossSection section = sectionAt(eta, thetaD);
    double sum = 0;
    for (const double gammaO : rootAngles(section, p, phi)) {
        const double cosine = std::cos(gammaO);
        const Refracted refracted = refract(section, std::sin(gammaO), cosine);
        // |2 d(phi)/dh|^-1 with d(phi)/dh = (2 p cos(gamma_o) / (eta' cos(gamma_t)) - 2) / cos(gamma_o).
        const double slope = 2.0 * p * cosine / (section.etaPerp * refracted.cosGammaT) - 2.0;
        sum += attenuationOf(p, section, cosine, refracted.cosGammaT, sigmaA, path) * cosine / (2.0 * std::abs(slope));
    }
    return sum;
}

double marschnerRough(int p, double eta, double thetaD, double phi, double sigmaA, PathLength path, double width) {
    const CrossSection section = sectionAt(eta, thetaD);
    const Kernel kernel{width, [&](double x) {
                            const double near = std::remainder(x, 2.0 * pi);
                            double sum = 0;
                            for (int period = -2; period <= 2; ++period)
                                sum += gaussian(width, near + 2.0 * pi * period);
                            return sum;
                        }};
    return meanOverOffset(section, p, std::remainder(phi, 2.0 * pi), kernel,
                          [&](double gammaO, const Refracted& refracted) {
                              return attenuationOf(p, section, std::cos(gammaO), refracted.cosGammaT, sigmaA, path);
                          })
        .value;
}

Lobes marschner(const Angles& angles, double eta, double beta, double alpha, double sigmaA, PathLength path,
                bool corrected) {
    const double thetaI = std::atan2(angles.sinThetaI, angles.cosThetaI);
    const double thetaO = std::atan2(angles.sinThetaO, angles.cosThetaO);
    const double thetaD = 0.5 * (thetaO - thetaI), thetaH = 0.5 * (thetaI + thetaO);
    const double widths[3] = {beta, 0.5 * beta, 2.0 * beta}, shifts[3] = {alpha, -0.5 * alpha, -1.5 * alpha};
    const double cosD = std::cos(thetaD);
    Lobes s;
    for (int p = 0; p < 3; ++p) {
        const double m = (corrected ? 0.5 : 1.0) * gaussian(widths[p], thetaH - shifts[p]);
        s.p[static_cast<std::size_t>(p)] =
            m * marschnerSmooth(p, eta, thetaD, angles.phi, sigmaA, path) * angles.cosThetaI / (cosD * cosD);
    }
    return s;
}

}  // namespace pelage::reference
