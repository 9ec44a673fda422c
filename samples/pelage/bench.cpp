// SPDX-License-Identifier: MIT
// Ratios between shading models inside one process, scene and device. The models take turns frame by frame, so that
// whatever slows the machine slows all of them, and the median of each is compared; milliseconds of a shared CPU device
// would say nothing on another day.
#include "bench_report.hpp"
#include "commands.hpp"
#include "data.hpp"
#include "gpu.hpp"
#include "stage.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>

namespace pelage::app {

namespace {

/// A shading model: a shipped material in brown, and where that is `hair`, its scattering.model.
struct Contender {
    const char* name;
    const char* material;
    const char* model;
};
constexpr Contender known[] = {{"moment_lut", "brown", "momentLut"},
                               {"segment_cdf", "brown", "segmentCdf"},
                               {"chiang", "brown", "chiang"},
                               {"pxr", "brown", "pxr"},
                               {"karis", "brown", "karis"},
                               {"thesis", "brown", "thesis"},
                               {"marschner", "brown", "marschner"},
                               {"gerard", "brown", "gerard"},
                               {"scheuermann", "brown", "scheuermann"},
                               {"kajiya_kay", "kajiya_brown", ""},
                               {"standard_pbr", "pbr_brown", ""}};

Result<std::vector<Contender>> choose(const std::vector<std::string>& names) {
    std::vector<Contender> chosen;
    for (const std::string& name : names) {
        const auto found =
            std::find_if(std::begin(known), std::end(known), [&](const auto& c) { return name == c.name; });
        if (found == std::end(known)) {
            std::string all;
            for (const Contender& contender : known) all += (all.empty() ? "" : ", ") + std::string(contender.name);
            return tl::unexpected(Failure("A063: no shading model \"" + name + "\" to bench; there are " + all));
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
    auto parsed = library.material(contender.material);
    if (!parsed) return tl::unexpected(Failure(parsed.error()));
    if (*contender.model != '\0') {
        if (auto wrong = parsed->material.setFromText("scattering.model", contender.model)) {
            return tl::unexpected(Failure(*wrong));
        }
    }
    return std::move(parsed->material);
}

ModelResult summarise(const Contender& contender, const Samples& samples) {
    ModelResult result{.name = contender.name, .material = contender.material};
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
            if (!picture) return tl::unexpected(Failure(picture.error()));
            if (round > 0) samples.frames.push_back(std::move(picture->report));
        }
    }
    return {};
}

}  // namespace

int bench(const BenchOptions& options) {
    hair::Library library(dataDirectory());
    auto contenders = choose(options.models);
    if (!contenders) return report(contenders.error());
    auto stage = makeStage(options.stage, library);
    if (!stage) return report(stage.error());

    BenchResult result{.scene = stage->name,
                       .width = stage->file.frame.width,
                       .height = stage->file.frame.height,
                       .repeats = options.repeat,
                       .yardstick = contenders->front().name};
    std::vector<Samples> all;
    for (const Contender& contender : *contenders) {
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
    for (std::size_t i = 0; i < all.size(); ++i) result.models.push_back(summarise((*contenders)[i], all[i]));
    for (const Contender& contender : *contenders) {
        auto material = materialOf(contender, library);
        if (!material) return report(material.error());
        if (auto counted = countOptions(contender.name, *material, result.instructions); !counted) {
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
