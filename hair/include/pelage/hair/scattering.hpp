// SPDX-License-Identifier: MIT
// Scattering of light by one fibre, on the CPU: the same source that the shaders are made of (hair/scattering/models),
// compiled in float and in double. What is left between the two is rounding; how far a model is from the truth is asked
// of pelage::reference. No device is needed.
//
// Conventions: u from root to tip, theta = asin(w.u), phi = phi_i - phi_o, both directions away from the fibre, sigma_a
// per fibre radius. S_p = M_p A_p N_p has the integral A_p over the sphere of wi: L_o = S E_perp.
#pragma once

#include <pelage/hair/moment_table.hpp>

#include <array>
#include <optional>
#include <span>
#include <string_view>

namespace pelage::hair {

/// The models of scattering_models.def; the numbers are those of the shader option `scatteringModel`.
enum class ScatteringModel : int {
#define PELAGE_SCATTERING_MODEL(number, id, name, function, traits, title, source) name = number,
#include <pelage/hair/scattering_models.def>
#undef PELAGE_SCATTERING_MODEL
};

struct ModelInfo {
    ScatteringModel model;
    std::string_view id;      ///< as in files and on the command line
    std::string_view title;   ///< what it is, a line
    std::string_view source;  ///< paper or talk
    bool corrected = false;   ///< the published form is wrong somewhere: `published` selects it
    bool usesTable = false;   ///< reads a MomentTable
    bool usesOffset = false;  ///< can be asked for one offset h
    bool nearField = false;   ///< rendered at one random offset per fragment: its mean over h costs too much
    bool reciprocal = false;  ///< S / cos(theta_i) is the same with the two directions exchanged
    bool controls = false;    ///< widths, shifts and glint of the lobes are the artist's
};

/// All models, in the order of their numbers.
std::span<const ModelInfo> scatteringModels();
/// Null when no model has that id.
const ModelInfo* findScatteringModel(std::string_view id);
/// Null for a number that is not an enumerator's.
const ModelInfo* findScatteringModel(ScatteringModel model);

/// A fibre as a user describes it. Everything is clamped to the ranges given; NaN becomes the lower end.
struct FiberProperties {
    double eta = 1.55;   ///< 1.0001 to 3
    double betaM = 0.3;  ///< longitudinal roughness, 0.01 to 1
    double betaN = 0.3;  ///< azimuthal roughness, 0.01 to 1
    double alpha = 0;    ///< tilt of the scales, rad, -0.5 to 0.5; negative moves R toward the root
    std::array<double, 3> sigmaA = {0, 0, 0};      ///< absorption per radius, 0 to 1e4
    std::array<double, 3> color = {1, 1, 1};       ///< reflected colour of kajiya_kay and scheuermann, 0 to 1
    std::array<double, 3> widthScale = {1, 1, 1};  ///< factors of the widths of R, TT, TRT along the fibre, 0.1 to 10
    std::array<double, 3> shift = {0, 0, 0};       ///< added to the tilts of R, TT, TRT, rad, -0.5 to 0.5
    double glintGain = 0;                          ///< pxr: 0 to 10, share of TRT's light in the glint
    double glintWidth = 5;                         ///< pxr: azimuthal width, degrees, 0.5 to 90
    double glintShift = 0;                         ///< pxr: shift along the fibre, degrees, -30 to 30
};

/// Two directions about a fibre. Sines and cosines are kept apart, as either alone loses digits.
struct FiberDirections {
    double sinThetaI = 0, cosThetaI = 1, sinThetaO = 0, cosThetaO = 1;
    double phi = 0;                ///< phi_i - phi_o, rad
    std::optional<double> h = {};  ///< offset of the view ray, -1 to 1; absent: far field
};

/// S_p for three wavelengths: R, TT, TRT, residual. kajiya_kay and scheuermann put their highlights into R and TRT,
/// their diffuse part into the residual.
struct ScatteredLobes {
    std::array<std::array<double, 3>, 4> lobe{};
};

/// The model in float or in double. `table` is needed where ModelInfo::usesTable, and must have been made for the same
/// eta and beta_N. `published`: with the errors of its source, where there are any.
ScatteredLobes scatterFloat(ScatteringModel model, bool published, const FiberProperties& fiber,
                            const FiberDirections& directions, MomentTable* table = nullptr);
ScatteredLobes scatterDouble(ScatteringModel model, bool published, const FiberProperties& fiber,
                             const FiberDirections& directions, MomentTable* table = nullptr);

/// Absorption per radius from what an artist knows.
/// Chiang et al. 2016, equation 9: the colour of a mass of such hair, 0 to 1, after multiple scattering.
double sigmaFromColor(double color, double betaN);
/// Pekelis et al. 2015 as used by Karis 2016 and the thesis (4.17): the colour after one path through the axis,
/// squared: exp(-4 sigma_a) = C.
double sigmaFromPathColor(double color);
/// d'Eon et al. 2011 with the constants of pbrt: concentrations of the two pigments, at least 0.
std::array<double, 3> sigmaFromMelanin(double eumelanin, double pheomelanin);

}  // namespace pelage::hair
