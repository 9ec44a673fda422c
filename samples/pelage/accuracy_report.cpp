// SPDX-License-Identifier: MIT
#include "accuracy_report.hpp"

#include "table.hpp"

#include <algorithm>
#include <cstdio>

namespace pelage::app {

namespace {

using Cells = std::vector<std::string>;

std::string row(const Cells& cells) {
    std::string line = "|";
    for (const std::string& cell : cells) line += " " + cell + " |";
    return line + "\n";
}

/// The first column to the left, numbers to the right.
std::string head(const Cells& cells, const char* others = "---:|") {
    std::string rule = "|---|";
    for (std::size_t i = 1; i < cells.size(); ++i) rule += others;
    return row(cells) + rule + "\n";
}

std::string number(const char* format, double x) {
    char digits[48] = {};
    std::snprintf(digits, sizeof digits, format, x);
    return digits;
}
std::string shortly(double x) {
    return number("%.3g", x);
}
std::string brief(double x) {
    return number("%.1e", x);
}
/// An error of four decimals, and of one digit where these show none.
std::string small(double x) {
    return x < 5e-5 ? number("%.0e", x) : fixed(x, 4);
}
std::string mark(bool met) {
    return met ? "pass" : "**MISS**";
}
bool isMomentLut(const ModelForm& form) {
    return form.is(hair::ScatteringModel::MomentLut);
}

std::string modelsText() {
    std::string text =
        "## The models\n\n" + head({"id", "what", "source", "forms", "table", "offset h", "reciprocal"}, "---|");
    for (const hair::ModelInfo& info : hair::scatteringModels()) {
        text += row({std::string(info.id), std::string(info.title), std::string(info.source),
                     info.corrected ? "corrected, published" : "one", info.usesTable ? "yes" : "no",
                     info.usesOffset ? "yes" : "no", info.reciprocal ? "yes" : "no"});
    }
    return text + R"(
Published: with the errors of the source, kept for comparison. Corrected: without them, and what the renderer uses
unless told otherwise. Table: reads one made for the material's index and azimuthal roughness. Offset: knows where
across the fibre it is seen (near field); everything below is the far field unless it says otherwise. Reciprocal:
as the catalogue claims.

)";
}

std::string plotsText(const AccuracyResult& result) {
    std::string text = "## Pictures\n\n";
    for (const PlotResult& plot : result.plots) {
        text += plot.words + "\n\n![" + plot.words + "](images/" + plot.file + ")\n\n";
    }
    return text;
}

struct Goal {
    double trt;
    bool met;
};
/// R, TT 0.005; TRT 0.015, where beta_N is below 0.2 0.02; worst point 2 % of the peak; energy within 1 %.
Goal goalOf(const AroundResult& r) {
    const double trt = r.betaN < 0.19 ? 0.02 : 0.015;
    const LobeDistance& d = r.distance;
    return {trt, d.relative[0] <= 0.005 && d.relative[1] <= 0.005 && d.relative[2] <= trt && d.worst <= 0.02 &&
                     d.energyLeast >= 0.99 && d.energyMost <= 1.01};
}

std::string aroundText(const AccuracyResult& result) {
    std::string text =
        R"(## Distance from the exact far field, around the fibre

Models whose longitudinal lobes are exact, divided by these: what is left is A N, how much light leaves and toward
which side. Relative L2 by lobe with the weight cos θ_o, θ_o 0.5° to 87°, φ 0° to 180°, η 1.55, α 0, against
`reference::farFieldAzimuthal`. Worst: the largest difference of R, TT or TRT in per cent of that lobe's peak. Energy:
all lobes over the truth's, least and most over θ_o. pxr has its controls at rest, and is then moment_lut.

Goal of moment_lut: R and TT at most 0.005, TRT 0.015 (0.02 at β_N 0.1), worst at most 2 %, energy within 1 %. The
residual has no goal of its own: it counts in the energy.

)" + head({"model", "β_N", "σ_a", "R", "TT", "TRT", "residual", "worst, %", "energy", "goal"});
    for (const AroundResult& r : result.around) {
        const LobeDistance& d = r.distance;
        text += row({r.form.name(), shortly(r.betaN), shortly(r.sigma), small(d.relative[0]), small(d.relative[1]),
                     small(d.relative[2]), small(d.relative[3]), fixed(100 * d.worst, 2),
                     fixed(d.energyLeast, 4) + " to " + fixed(d.energyMost, 4),
                     isMomentLut(r.form) ? mark(goalOf(r).met) : ""});
    }
    return text + "\n";
}

std::string sphereText(const AccuracyResult& result) {
    const auto base = std::find_if(result.sphere.begin(), result.sphere.end(),
                                   [](const SphereResult& r) { return isMomentLut(r.form); });
    Cells heads{"model"};
    for (const double sigma : result.sigmas) heads.push_back("σ_a " + shortly(sigma));
    for (const double sigma : result.sigmas) heads.push_back("/ moment_lut, σ_a " + shortly(sigma));
    std::string text =
        R"(## Distance from the exact far field, the whole function

Relative L2 of S, all lobes, over θ_i, φ and θ_o with the weight cos θ_i cos θ_o, against the exact far field; β_M 0.3,
β_N 0.3, η 1.55, α 0. Models that know a colour and no absorption get C = exp(-4 σ_a). The last columns are how many
times as far from the truth as moment_lut.

)" + head(heads);
    for (const SphereResult& r : result.sphere) {
        Cells cells{r.form.name()};
        for (const double distance : r.bySigma) cells.push_back(small(distance));
        for (std::size_t s = 0; s < r.bySigma.size(); ++s) {
            const double times = r.bySigma[s] / base->bySigma[s];
            cells.push_back(fixed(times, times < 100 ? 1 : 0));
        }
        text += row(cells);
    }
    return text + "\n";
}

std::string furnaceText(const AccuracyResult& result) {
    Cells heads{"model"};
    for (const double theta : result.thetas) heads.push_back("θ_o " + shortly(theta) + "°");
    heads.emplace_back("goal");
    std::string text =
        R"(## White furnace

The integral of S over the sphere of lights when nothing is absorbed: what a white fibre returns of white light. 1 is
right; more makes light. In double precision, β_M and β_N 0.3, α 0. Goal of moment_lut: 0.98 to 1.005.

)" + head(heads);
    for (const FurnaceResult& r : result.furnace) {
        Cells cells{r.form.name()};
        for (const double light : r.byTheta) cells.push_back(fixed(light, 4));
        const auto [least, most] = std::minmax_element(r.byTheta.begin(), r.byTheta.end());
        cells.push_back(isMomentLut(r.form) ? mark(*least >= 0.98 && *most <= 1.005) : "");
        text += row(cells);
    }
    return text + "\n";
}

std::string roundingText(const AccuracyResult& result) {
    std::string text =
        R"(## Rounding

The largest relative error of any lobe in floats against the same source in doubles, over random ordinary hair (θ to
85°, η 1.3 to 1.8, σ_a to 3, lights near the mirror cone); relative to 1e-6 where a lobe is less. chiang in the near
field, moment_lut in the far field.

)" + head({"model", "β_M and β_N", "GPU", "C++ float", "goal", ""});
    for (const RoundingResult& r : result.rounding) {
        const bool met = r.cpp <= r.band.goal && (!r.gpu || *r.gpu <= r.band.goal);
        text += row({r.form.name(), shortly(r.band.low) + " to " + shortly(r.band.high),
                     r.gpu ? brief(*r.gpu) : "not measured", brief(r.cpp), brief(r.band.goal), mark(met)});
    }
    return text + "\n";
}

std::string halvesText(const AccuracyResult& result) {
    std::string text =
        R"(## Storage in half floats

Relative change of S, median and worst, when one thing is rounded to 16 bits and everything is then computed in
doubles: the result; the directions (sines, cosines, φ); the material (β_M, β_N, α, η, σ_a, C). Random hair as above
with β 0.1 to 0.9 and σ_a to 1.5, rows with S above 0.01; chiang in the near field.

)" + head({"model", "rows", "result, median", "worst", "directions, median", "worst", "material, median", "worst"});
    for (const HalfResult& r : result.halves) {
        text += row({r.form.name(), std::to_string(r.rows), brief(r.output.median), brief(r.output.worst),
                     brief(r.directions.median), brief(r.directions.worst), brief(r.material.median),
                     brief(r.material.worst)});
    }
    return text + "\n";
}

std::string reciprocityText(const AccuracyResult& result) {
    std::string text =
        R"(## Reciprocity

The largest difference of S / cos θ_i when light and view change places, relative to the larger of the two, over random
pairs of directions within 85° of the normal plane; β_M and β_N 0.3, α -2°, σ_a 0.25. Reciprocal: below 1e-6.

)" + head({"model", "largest difference", "reciprocal", "agrees with the catalogue"});
    for (const ReciprocityResult& r : result.reciprocity) {
        const bool is = r.error < 1e-6;
        text +=
            row({r.form.name(), shortly(r.error), is ? "yes" : "no", is == r.form.info->reciprocal ? "yes" : "**no**"});
    }
    return text + "\n";
}

std::string costText(const AccuracyResult& result) {
    const auto karis = std::find_if(result.costs.begin(), result.costs.end(),
                                    [](const CostResult& r) { return r.form.is(hair::ScatteringModel::Karis); });
    std::string text =
        R"(## Instructions

SPIR-V instructions left of the whole forward shader of the material `brown` (shadows, environment and all) once the
model is a constant; a loop counts once, so that chiang and segment_cdf cost more than they show. Goal of moment_lut: at
most 1.3 times karis. Ratios of time are what `pelage bench` measures.

)" + head({"model", "instructions", "/ karis", "goal"});
    for (const CostResult& r : result.costs) {
        const double ratio = static_cast<double>(r.instructions) / karis->instructions;
        text += row({r.form.name(), std::to_string(r.instructions), fixed(ratio, 2),
                     isMomentLut(r.form) ? mark(ratio <= 1.3) : ""});
    }
    return text + "\n";
}

constexpr const char* closing = R"(## How to reproduce, and limits

`pelage accuracy` in the root of the repository writes this page and its pictures again; `--quick` is coarser,
`--no-device` leaves the GPU out. Single rays: `pelage scatter --exact` and `--model`, see
[scatter-csv.md](scatter-csv.md). The truth is `pelage::reference`: a rough dielectric cylinder with tilted scales
(Chiang et al. 2016, longitudinal lobes of d'Eon et al. 2011), in double precision by adaptive quadrature. It is one
round fibre without a medulla; real hair is neither.

Kept by tests, not by this page: the truth agrees with rows computed elsewhere in 80-bit arithmetic within 1e-9 relative or
1e-12 (`reference.OutsideValues`); the published forms are as far from the truth as others measured them, within 2 %
(`scattering.LegacyModels`, which also names the figures that were not reproduced: Karis' furnace at 75° and 85°); behaviour
at the extremes ([stability.md](stability.md)).

- karis: R narrows without end toward φ 180°, so its slope has no bound there.
- marschner is a smooth cylinder: its slope has no bound at its caustics, and β_N widens only those of TRT.
- marschner, thesis and gerard have the factor 1 / cos² θ_d, a pole for light and view at opposite ends of the fibre:
  the last column of the furnace shows it.
- chiang, pxr, moment_lut and segment_cdf take attenuation and tilt at θ_o, and are therefore not reciprocal.
- β_M and β_N below 0.01 are taken as 0.01.
- moment_lut: the residual, the least of the lobes, is good to a few per cent at σ_a 1; see its column.
- The published forms are as printed. What was wrong in them is told at the head of each model's file in
  `hair/scattering/models`.
)";

}  // namespace

std::string accuracyPage(const AccuracyResult& result) {
    return "# How accurate the scattering models are\n\nWritten by `" + result.command + "` on " +
           (result.device.empty() ? "no device" : result.device) + "; all figures are measured by it.\n\n" +
           modelsText() + plotsText(result) + aroundText(result) + sphereText(result) + furnaceText(result) +
           roundingText(result) + halvesText(result) + reciprocityText(result) + costText(result) + closing;
}

}  // namespace pelage::app
