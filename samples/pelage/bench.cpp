// SPDX-License-Identifier: MIT
// Ratios between shading models inside one process, scene and device. The models take turns frame by frame, so that
// whatever slows the machine slows all of them, and the median of each is compared; milliseconds of a shared CPU device
// would say nothing on another day.
#include "bench_report.hpp"
#include "commands.hpp"
#include "data.hpp"
#include "gpu.hpp"
#include "stage.hpp"

#include <pelage/hair/scattering.hpp>

#include <algorithm>
#include <cstdio>
#include <fstream>

namespace pelage::app {

namespace {

/// A shading model: a shipped material, and where that is `hair`, its scattering.model.
struct Contender {
    std::string_view name;
    std::string_view material;
    const hair::ModelInfo* model = nullptr;
};
/// What is a material type of its own, kajiya_kay among them.
constexpr Contender ownTypes[] = {{"kajiya_kay", "kajiya_brown"}, {"standard_pbr", "pbr_brown"}};

std::vector<Contender> contenders() {
    std::vector<Contender> all(std::begin(ownTypes), std::end(ownTypes));
    for (const hair::ModelInfo& info : hair::scatteringModels()) {
        if (info.id != ownTypes[0].name) all.push_back({info.id, "brown", &info});
    }
    return all;
}

Result<std::vector<Contender>> choose(const std::vector<std::string>& names) {
    const std::vector<Contender> known = contenders();
    std::vector<Contender> chosen;
    for (const std::string& name : names) {
        const auto found = std::find_if(known.begin(), known.end(), [&](const auto& c) { return name == c.name; });
        if (found == known.end()) {
            std::string all;
            for (const Contender& contender : known) all += (all.empty() ? "" : ", ") + std::string(contender.name);
            return tl::unexpected(failure("A063", "no shading model \"" + name + "\" to bench; there are " + all));
        }
        chosen.push_back(*found);
    }
    return chosen;
}

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

/// Frames of one model as they come in.
struct Samples {
    hair::Scene scene = {};
    std::vector<hair::FrameReport> frames = {};
};

/// The material of a contender, on all hair of the scene where one is given.
Result<materials::Material> materialOf(const Contender& contender, hair::Library& library) {
    auto parsed = library.material(std::string(contender.material));
    if (!parsed) return tl::unexpected(parsed.error());
    if (contender.model) {
        const Diagnostics found = parsed->material.setFromText("scattering.model", contender.model->id);
        if (found.hasErrors()) return tl::unexpected(found);
    }
    return std::move(parsed->material);
}

ModelResult summarise(const Contender& contender, const Samples& samples) {
    ModelResult result{.name = std::string(contender.name), .material = std::string(contender.material)};
    const hair::FrameReport& last = samples.frames.back();
    for (std::size_t pass = 0; pass < last.passes.size(); ++pass) {
        std::vector<double> times;
        for (const hair::FrameReport& frame : samples.frames) times.push_back(frame.passes[pass].gpuMilliseconds);
        result.passes.push_back(
            {.name = last.passes[pass].name, .milliseconds = median(times), .fragments = last.passes[pass].fragments});
    }
    std::vector<double> times;
    for (const hair::FrameReport& frame : samples.frames) times.push_back(frame.gpuMilliseconds);
    result.milliseconds = median(times);
    result.attachments = last.attachments;
    return result;
}

Result<void> measure(std::vector<Samples>& all, hair::Renderer& renderer, const hair::FrameSettings& frame,
                     std::uint32_t repeat) {
    // The first round compiles shaders and uploads; it is not counted.
    for (std::uint32_t round = 0; round <= repeat; ++round) {
        for (Samples& samples : all) {
            auto picture = renderer.render(samples.scene, frame);
            if (!picture) return tl::unexpected(picture.error());
            if (round > 0) samples.frames.push_back(std::move(picture->report));
        }
    }
    return {};
}

}  // namespace

int bench(const BenchOptions& options) {
    hair::Library library(dataDirectory());
    auto chosen = choose(options.models);
    if (!chosen) return report(chosen.error());
    auto stage = makeStage(options.stage, library);
    if (!stage) return report(stage.error());

    BenchResult result{.scene = stage->name,
                       .width = stage->file.frame.width,
                       .height = stage->file.frame.height,
                       .repeats = options.repeat,
                       .yardstick = std::string(chosen->front().name)};
    std::vector<Samples> all;
    for (const Contender& contender : *chosen) {
        Samples samples{.scene = stage->file.scene};
        auto material = materialOf(contender, library);
        if (!material) return report(material.error());
        for (hair::Object& object : samples.scene.objects) {
            if (hair::isHair(object.geometry)) object.material = *material;
        }
        all.push_back(std::move(samples));
    }

    auto gpu = openGpu(options.device);
    if (!gpu) return report(gpu.error());
    result.device = gpu->device.info().name;
    result.driver = gpu->device.info().driver;
    auto renderer = makeRenderer(*gpu, stage->tree);
    if (!renderer) return report(renderer.error());
    if (auto measured = measure(all, *renderer, stage->file.frame, options.repeat); !measured) {
        return report(measured.error());
    }
    for (std::size_t i = 0; i < all.size(); ++i) result.models.push_back(summarise((*chosen)[i], all[i]));
    for (const Contender& contender : *chosen) {
        auto material = materialOf(contender, library);
        if (!material) return report(material.error());
        if (auto counted = countOptions(std::string(contender.name), *material, result.instructions); !counted) {
            return report(counted.error());
        }
    }

    std::fputs(benchText(result).c_str(), stdout);
    if (!options.json.empty()) {
        if (auto written = writeBenchJson(options.json, result); !written) return report(written.error());
    }
    return finish(*gpu);
}

}  // namespace pelage::app
