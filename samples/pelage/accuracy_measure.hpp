// SPDX-License-Identifier: MIT
// How far the scattering models are from the truth, from themselves in fewer digits, and from reciprocity: what
// `pelage accuracy` measures. All results are the same whatever the number of cores.
#pragma once

#include "scatter_models.hpp"

#include <functional>

namespace pelage::app {

/// A model in one of its forms.
struct ModelForm {
    const hair::ModelInfo* info = nullptr;
    bool published = false;
    std::string name() const { return std::string(info->id) + (published ? " (published)" : ""); }
    bool is(hair::ScatteringModel model) const { return info->model == model; }
};
/// Every model, and where its source is wrong the published form after the corrected one.
std::vector<ModelForm> modelForms();

/// How finely is measured.
struct AccuracyEffort {
    std::size_t inclinations = 25, azimuths = 180, along = 45;  // points of theta_o, phi, theta_i
    std::size_t furnaceAlong = 180, furnaceAround = 180;
    std::size_t nearRows = 20000, tableRows = 1000;  // of each band of roughness
    std::size_t halfFibers = 50, halfRowsPerFiber = 80;
    std::size_t pairs = 1000;
};
AccuracyEffort quickEffort();

/// Cores, each with its moment tables.
class Workers {
public:
    Workers();
    /// Calls work(0) to work(count - 1), in any order, and waits.
    void each(std::size_t count, const std::function<void(std::size_t, TableCache&)>& work);

private:
    std::vector<TableCache> tables_;
};

/// What the model gives, the first wavelength.
RowLobes lobesOf(const ModelForm& form, const ScatterQuery& query, TableCache& tables, bool inFloat = false);
double totalOf(const ModelForm& form, const ScatterQuery& query, TableCache& tables);
/// Directions in rad, far field.
hair::FiberDirections directionsOf(double thetaI, double thetaO, double phi);

/// The exact A_p N_p over theta_o (0.5 to 87 degrees, even steps) and phi (the middles of even steps to 180).
struct TruthGrid {
    double betaN = 0.3, sigma = 0;
    std::vector<double> thetas = {}, phis = {};  // rad
    std::vector<reference::Lobes> around = {};   // theta by theta
    static constexpr double eta = 1.55, betaM = 0.3;
    ScatterQuery query(double thetaI, double thetaO, double phi) const;
};
TruthGrid truthGrid(Workers& workers, double betaN, double sigma, const AccuracyEffort& effort);

/// Of A_p N_p, S divided by the exact M: for models whose M is exact. No tilt.
struct LobeDistance {
    std::array<double, 4> relative{};        // L2 with the weight cos(theta_o)
    double worst = 0;                        // of R, TT, TRT: largest difference over the lobe's peak
    double energyLeast = 0, energyMost = 0;  // of all lobes over the truth's, by theta_o
};
LobeDistance distanceAround(Workers& workers, const ModelForm& form, const TruthGrid& truth);

/// Relative L2 of S over both spheres with the weight cos(theta_i) cos(theta_o). No tilt.
double distanceOverSphere(Workers& workers, const ModelForm& form, const TruthGrid& truth,
                          const AccuracyEffort& effort);

/// The integral of S over the sphere, nothing absorbed, beta 0.3, no tilt. Degrees.
double whiteFurnace(Workers& workers, const ModelForm& form, double thetaO, const AccuracyEffort& effort);

/// Floats against doubles in a band of roughness; relative, or to 1e-6 where there is less.
struct RoundingBand {
    double low, high, goal;
};
std::span<const RoundingBand> roundingBands();
struct RoundingResult {
    ModelForm form = {};
    RoundingBand band = {};
    double cpp = 0;
    std::optional<double> gpu = {};
};
/// `device`: null leaves the GPU out.
Result<std::vector<RoundingResult>> roundingOf(Workers& workers, const DeviceOptions* device,
                                               const AccuracyEffort& effort);

/// Relative change of S when something is stored in half floats.
struct HalfLoss {
    double median = 0, worst = 0;
};
struct HalfResult {
    ModelForm form = {};
    std::size_t rows = 0;
    HalfLoss output = {}, directions = {}, material = {};
};
HalfResult halfLossOf(Workers& workers, const ModelForm& form, const AccuracyEffort& effort);

/// Largest difference of S / cos(theta_i) when the two directions are exchanged, relative to the larger of the two.
double reciprocityError(Workers& workers, const ModelForm& form, const AccuracyEffort& effort);

}  // namespace pelage::app
