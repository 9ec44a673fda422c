// SPDX-License-Identifier: MIT
#include <pelage/reference/terms.hpp>

#include <algorithm>
#include <cmath>

namespace pelage::reference {

double scaledBesselI0(double x) {
    // Below 30 the power series: all its terms are positive, so nothing cancels. Above, the asymptotic series, whose
    // smallest term there is near e^-60.
    if (x < 30.0) {
        const double quarter = 0.25 * x * x;
        double term = 1.0, sum = 1.0;
        for (int k = 1; term > 1e-18 * sum; ++k) {
            term *= quarter / (static_cast<double>(k) * k);
            sum += term;
        }
        return sum * std::exp(-x);
    }
    double term = 1.0, sum = 1.0;
    for (int k = 1; k < 40 && term > 1e-18 * sum; ++k) {
        const double odd = 2.0 * k - 1.0;
        term *= odd * odd / (8.0 * k * x);
        sum += term;
    }
    return sum / std::sqrt(2.0 * pi * x);
}

double longitudinal(double v, double sinThetaI, double cosThetaI, double sinThetaO, double cosThetaO) {
    const double across = cosThetaI - cosThetaO, along = sinThetaI + sinThetaO;
    const double exponent = -(across * across + along * along) / (2.0 * v);
    return std::exp(exponent) * scaledBesselI0(cosThetaI * cosThetaO / v) / (-v * std::expm1(-2.0 / v));
}

std::array<double, 4> longitudinalVariances(double betaM) {
    const double root = 0.726 * betaM + 0.812 * betaM * betaM + 3.7 * std::pow(betaM, 20);
    const double v = root * root;
    return {v, 0.25 * v, 4.0 * v, 4.0 * v};
}

double logisticScale(double betaN) {
    return std::sqrt(pi / 8.0) * (0.265 * betaN + 1.194 * betaN * betaN + 5.372 * std::pow(betaN, 22));
}

double trimmedLogistic(double x, double s) {
    const double e = std::exp(-std::abs(std::remainder(x, 2.0 * pi)) / s);
    return e / (s * (1.0 + e) * (1.0 + e)) / std::tanh(pi / (2.0 * s));
}

double trimmedLogisticCdf(double x, double s) {
    // 1 / (1 + exp(-x / s)) - 1 / (1 + exp(pi / s)) over tanh(pi / 2s), as one sinh quotient would cancel at the tails.
    const double z = std::tanh(pi / (2.0 * s));
    return (1.0 / (1.0 + std::exp(-x / s)) - 1.0 / (1.0 + std::exp(pi / s))) / z;
}

double sampleTrimmedLogistic(double u, double s) {
    const double low = 1.0 / (1.0 + std::exp(pi / s));
    const double y = std::clamp(low + u * std::tanh(pi / (2.0 * s)), low, 1.0 - low);
    return std::clamp(s * (std::log(y) - std::log1p(-y)), -pi, pi);
}

void tilt(double alpha, int lobe, double sinThetaO, double cosThetaO, double& sinTilted, double& cosTilted) {
    constexpr double multiple[4] = {-2.0, 1.0, 4.0, 0.0};
    const double s = std::sin(multiple[lobe] * alpha), c = std::cos(multiple[lobe] * alpha);
    sinTilted = sinThetaO * c + cosThetaO * s;
    cosTilted = std::abs(cosThetaO * c - sinThetaO * s);
}

Fresnel fresnel(double eta, double cosine) {
    const double ci = std::clamp(cosine, 0.0, 1.0);
    // cos^2 of the refracted ray: 1 - (1 - ci^2) / eta^2.
    const double ct = std::sqrt((eta - 1.0) * (eta + 1.0) + ci * ci) / eta;
    const double rs = (ci - eta * ct) / (ci + eta * ct), rp = (eta * ci - ct) / (eta * ci + ct);
    const double product = 4.0 * eta * ci * ct;
    const double ts = product / ((ci + eta * ct) * (ci + eta * ct));
    const double tp = product / ((eta * ci + ct) * (eta * ci + ct));
    return {0.5 * (rs * rs + rp * rp), 0.5 * (ts + tp)};
}

CrossSection crossSection(double eta, double cosThetaO) {
    // eta^2 - sin^2 = (eta^2 - 1) + cos^2 keeps its digits for eta near 1 and theta near 90 degrees.
    // At 90 degrees eta' is infinite; a cosine of 1e-16 is as good as none and leaves numbers.
    const double cosine = std::max(cosThetaO, 1e-16);
    const double root = std::sqrt((eta - 1.0) * (eta + 1.0) + cosine * cosine);
    return {eta, cosine, root / cosine, root / eta};
}

Refracted refract(const CrossSection& section, double h, double cosGammaO) {
    // cos^2 gamma_t = 1 - h^2 / eta'^2 = (eta'^2 - 1 + cos^2 gamma_o) / eta'^2, with eta'^2 - 1 = (eta^2 - 1) /
    // cos^2 theta.
    const double excess = (section.eta - 1.0) * (section.eta + 1.0) / (section.cosThetaO * section.cosThetaO);
    const double cosGammaT = std::sqrt(excess + cosGammaO * cosGammaO) / section.etaPerp;
    return {std::atan2(h / section.etaPerp, cosGammaT), cosGammaT};
}

double pathAzimuth(int p, double gammaO, double gammaT) {
    return 2.0 * p * gammaT - 2.0 * gammaO + p * pi;
}

Lobes attenuation(const CrossSection& section, const Refracted& refracted, double cosGammaO, double sigmaA) {
    const Fresnel f = fresnel(section.eta, section.cosThetaO * cosGammaO);
    const double t = std::exp(-sigmaA * 2.0 * refracted.cosGammaT / section.cosThetaT);
    const double tt = f.transmitted * f.transmitted * t;
    // The series A_3 = A_2 f T (1 + f T + ...); 1 - f T = (1 - f) + f (1 - T), whose parts do not cancel.
    const double rest =
        f.transmitted - f.reflected * std::expm1(-sigmaA * 2.0 * refracted.cosGammaT / section.cosThetaT);
    const double ft = f.reflected * t;
    Lobes a;
    a.p = {f.reflected, tt, tt * ft, rest > 0.0 ? tt * ft * ft / rest : 0.0};
    return a;
}

double sigmaFromColor(double color, double betaN) {
    const double b = betaN;
    const double fit = 5.969 + b * (-0.215 + b * (2.532 + b * (-10.73 + b * (5.574 + b * 0.245))));
    const double root = std::log(color) / fit;
    return root * root;
}

}  // namespace pelage::reference
