// SPDX-License-Identifier: MIT
// `pelage accuracy`: measures every scattering model and writes the page about it, so that the page cannot claim what
// the code does not do.
#include "accuracy_report.hpp"
#include "commands.hpp"
#include "data.hpp"
#include "gpu.hpp"
#include "instructions.hpp"
#include "scatter_plot.hpp"
#include "text_file.hpp"

#include <pelage/hair/library.hpp>

#include <algorithm>
#include <filesystem>

namespace pelage::app {

namespace fs = std::filesystem;

namespace {

using enum hair::ScatteringModel;

/// M is exact, so that it can be divided out.
bool hasExactLobes(const ModelForm& form) {
    return form.is(Chiang) || form.is(Pxr) || form.is(MomentLut) || form.is(SegmentCdf);
}

void measureDistances(AccuracyResult& result, Workers& workers, const AccuracyEffort& effort) {
    result.sigmas = {0, 0.25, 1};
    const auto forms = modelForms();
    for (const ModelForm& form : forms) {
        if (!form.is(Chiang)) result.sphere.push_back({form});  // a mean over 512 offsets: its A N say enough
    }
    for (const double betaN : {0.1, 0.2, 0.3, 0.6, 0.8}) {
        for (const double sigma : result.sigmas) {
            const TruthGrid truth = truthGrid(workers, betaN, sigma, effort);
            for (const ModelForm& form : forms) {
                if (!hasExactLobes(form)) continue;
                result.around.push_back({form, betaN, sigma, distanceAround(workers, form, truth)});
            }
            if (betaN != 0.3) continue;
            for (SphereResult& sphere : result.sphere) {
                sphere.bySigma.push_back(distanceOverSphere(workers, sphere.form, truth, effort));
            }
        }
    }
    // The model first, then roughness and absorption.
    std::stable_sort(result.around.begin(), result.around.end(), [](const AroundResult& a, const AroundResult& b) {
        const auto place = [](const AroundResult& r) {
            return r.form.is(MomentLut) ? -1 : static_cast<int>(r.form.info->model);
        };
        return place(a) < place(b);
    });
}

Result<void> countCosts(AccuracyResult& result) {
    hair::Library library(dataDirectory());
    auto parsed = library.material("brown");
    if (!parsed) return tl::unexpected(Failure(parsed.error()));
    for (const auto& shader : parsed->material.compile().shaders) {
        if (shader.use.name != "forward") continue;
        const auto code = hair::Renderer::shaderCode(shader.use.fragment);
        if (code.empty()) {
            return tl::unexpected(Failure("A061: there is no shader \"" + shader.use.fragment + "\" in this build"));
        }
        for (const hair::ModelInfo& info : hair::scatteringModels()) {
            auto constants = shader.constants;
            for (auto& constant : constants) {
                if (constant.name == "scatteringModel") constant.value = static_cast<double>(info.model);
            }
            const auto counted = countInstructions(code, constants);
            if (!counted) return tl::unexpected(counted.error());
            result.costs.push_back({{&info, false}, *counted});
        }
    }
    if (result.costs.empty()) {
        return tl::unexpected(
            Failure("A110: the material \"brown\" has no shader \"forward\" to count instructions of"));
    }
    return {};
}

Result<void> drawPlots(AccuracyResult& result, const fs::path& images) {
    const auto models = [](std::initializer_list<hair::ScatteringModel> wanted) {
        std::vector<const hair::ModelInfo*> found;
        for (const auto model : wanted) found.push_back(&hair::scatteringModels()[static_cast<std::size_t>(model)]);
        return found;
    };
    const auto fitted = models({KajiyaKay, Scheuermann, Marschner, Karis, Thesis, Gerard, MomentLut});
    const ScatterTuple usual{.alpha = -2, .sigmaA = 0.25};
    ScatterTuple sharp = usual, grazing = usual;
    sharp.betaN = 0.1;
    grazing.thetaO = 75;
    const std::pair<PlotResult, ScatterPlot> plots[] = {
        {{"scattering_fitted.svg", "The fitted models, and moment_lut on the truth."},
         {.fiber = usual, .models = fitted}},
        {{"scattering_sharp.svg", "Smooth around the fibre, β_N 0.1: the caustics of TRT show."},
         {.fiber = sharp, .models = models({Marschner, Karis, Thesis, Gerard, SegmentCdf, MomentLut})}},
        {{"scattering_grazing.svg", "Seen along the fibre, θ_o 75°."},
         {.fiber = grazing, .models = models({Marschner, Karis, Thesis, Gerard, SegmentCdf, MomentLut})}},
        {{"scattering_published.svg", "The fitted models as published."},
         {.fiber = usual, .models = fitted, .published = true}}};
    for (const auto& [plot, what] : plots) {
        if (auto written = writeDrawing((images / plot.file).string(), drawScatterPlot(what)); !written) return written;
        result.plots.push_back(plot);
    }
    return {};
}

Result<void> measure(AccuracyResult& result, const AccuracyOptions& options) {
    const AccuracyEffort effort = options.quick ? quickEffort() : AccuracyEffort{};
    Workers workers;
    if (auto counted = countCosts(result); !counted) return counted;
    measureDistances(result, workers, effort);
    result.thetas = {0, 30, 60, 75, 85, 89.9};
    for (const ModelForm& form : modelForms()) {
        FurnaceResult furnace{form};
        for (const double theta : result.thetas) furnace.byTheta.push_back(whiteFurnace(workers, form, theta, effort));
        result.furnace.push_back(furnace);
        result.reciprocity.push_back({form, reciprocityError(workers, form, effort)});
        if (!form.published) result.halves.push_back(halfLossOf(workers, form, effort));
    }
    auto rounding = roundingOf(workers, options.useDevice ? &options.device : nullptr, effort);
    if (!rounding) return tl::unexpected(rounding.error());
    result.rounding = std::move(*rounding);
    return {};
}

}  // namespace

int accuracy(const AccuracyOptions& options) {
    AccuracyResult result{.command = options.quick ? "pelage accuracy --quick" : "pelage accuracy"};
    // What may fail comes first: the measuring takes a minute.
    const fs::path directory = options.directory, images = directory / "images";
    std::error_code failed;
    fs::create_directories(images, failed);
    if (failed) {
        return report(Failure("A111: " + images.string() + ": the directory cannot be made: " + failed.message()));
    }
    if (options.useDevice) {
        auto gpu = openGpu(options.device);
        if (!gpu) return report(gpu.error());
        result.device = gpu->device.info().name + ", driver " + gpu->device.info().driver;
    }
    if (auto measured = measure(result, options); !measured) return report(measured.error());
    if (auto drawn = drawPlots(result, images); !drawn) return report(drawn.error());
    const auto written = writeTextFile((directory / "accuracy.md").string(), accuracyPage(result));
    return written ? exitOk : report(written.error());
}

}  // namespace pelage::app
