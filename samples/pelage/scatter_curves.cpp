// SPDX-License-Identifier: MIT
#include "scatter_curves.hpp"

#include <pelage/reference/terms.hpp>

#include <algorithm>
#include <cmath>

namespace pelage::app {

namespace {

using reference::degree;
using reference::pi;

/// Steps over 180 degrees, so many to the width of the narrowest lobe along the fibre. That is TT, at half the width of
/// R; the old models may have it at beta^2 / 2.
std::size_t stepsAlong(const ScatterMethod& method, double betaM, double perWidth, double least) {
    double narrowest = 0.5 * std::sqrt(reference::longitudinalVariances(betaM)[0]);
    if (method.model && method.model->model < hair::ScatteringModel::Chiang) {
        narrowest = std::min(narrowest, 0.5 * betaM * betaM);
    }
    return static_cast<std::size_t>(std::clamp(pi * perWidth / narrowest, least, 4000.0));
}

double sum(const RowLobes& s) {
    return s[0] + s[1] + s[2] + s[3];
}

/// Far field at one theta_i and phi (degrees).
ScatterTuple at(const ScatterTuple& fiber, double thetaI, double phi) {
    ScatterTuple tuple = fiber;
    tuple.thetaI = thetaI;
    tuple.phiI = phi;
    tuple.phiO = 0;
    tuple.h.reset();
    return tuple;
}

/// As reference::farField, whose costly part, the mean over h, does not depend on theta_i.
class TruthAlong {
public:
    TruthAlong(const ScatterTuple& fiber, double phiDegrees)
        : fiber_(referenceFiber(fiber)),
          view_(referenceAngles(at(fiber, 0, phiDegrees))),
          around_(reference::farFieldAzimuthal(fiber_, view_.cosThetaO, view_.phi).value),
          variances_(reference::longitudinalVariances(fiber_.betaM)) {}

    double operator()(double thetaI) const {
        const double sine = std::sin(thetaI * degree), cosine = std::abs(std::cos(thetaI * degree));
        double total = 0;
        for (std::size_t lobe = 0; lobe < 4; ++lobe) {
            double s = 0, c = 0;
            reference::tilt(fiber_.alpha, static_cast<int>(lobe), view_.sinThetaO, view_.cosThetaO, s, c);
            total += around_.p[lobe] * reference::longitudinal(variances_[lobe], sine, cosine, s, c);
        }
        return total;
    }

private:
    reference::Fiber fiber_;
    reference::Angles view_;
    reference::Lobes around_;
    std::array<double, 4> variances_;
};

}  // namespace

Curve azimuthalCurve(const ScatterMethod& method, const ScatterTuple& fiber) {
    const double width = reference::logisticScale(fiber.betaN) / degree;
    const auto intervals = static_cast<std::size_t>(std::ceil(180.0 / std::clamp(0.5 * width, 0.25, 0.5)));
    const std::size_t steps = stepsAlong(method, fiber.betaM, 1.5, 180);
    TableCache tables;
    Curve curve;
    for (std::size_t i = 0; i <= intervals; ++i) {
        const double phi = 180.0 * static_cast<double>(i) / static_cast<double>(intervals);
        double value = 0;
        if (!method.model) {
            const double cosThetaO = std::abs(std::cos(fiber.thetaO * degree));
            value = reference::farFieldAzimuthal(referenceFiber(fiber), cosThetaO, phi * degree).value.total();
        } else {
            // The midpoint rule: for a Gaussian its error at 1.5 steps to the width is below 1e-15.
            const double step = 180.0 / static_cast<double>(steps);
            for (std::size_t k = 0; k < steps; ++k) {
                const double thetaI = -90.0 + (static_cast<double>(k) + 0.5) * step;
                value += sum(evaluate(method, at(fiber, thetaI, phi), tables)) * std::cos(thetaI * degree);
            }
            value *= step * degree;
        }
        curve.push_back({phi, value});
    }
    return curve;
}

double scatteredShare(const Curve& azimuthal) {
    double area = 0;
    for (std::size_t i = 0; i + 1 < azimuthal.size(); ++i) {
        area += (azimuthal[i].value + azimuthal[i + 1].value) * (azimuthal[i + 1].degrees - azimuthal[i].degrees);
    }
    return area * degree;  // half for the mean of two ends, twice for both halves of the circle
}

Curve longitudinalCurve(const ScatterMethod& method, const ScatterTuple& fiber, double phiDegrees) {
    const std::size_t steps = stepsAlong(method, fiber.betaM, 3, 360);
    std::optional<TruthAlong> truth;
    if (!method.model) truth.emplace(fiber, phiDegrees);
    TableCache tables;
    Curve curve;
    for (std::size_t i = 0; i <= steps; ++i) {
        const double thetaI = -90.0 + 180.0 * static_cast<double>(i) / static_cast<double>(steps);
        curve.push_back(
            {thetaI, truth ? (*truth)(thetaI) : sum(evaluate(method, at(fiber, thetaI, phiDegrees), tables))});
    }
    return curve;
}

}  // namespace pelage::app
