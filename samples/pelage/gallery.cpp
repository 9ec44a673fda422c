// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "data.hpp"
#include "gpu.hpp"
#include "picture_file.hpp"
#include "progress.hpp"
#include "stage.hpp"
#include "table.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>

namespace pelage::app {

namespace fs = std::filesystem;

namespace {

/// One renderer for each pass tree: its pipelines and uploads serve every picture that uses the tree.
class Painter {
public:
    Painter(const Gpu& gpu, hair::Library& library, std::string directory)
        : gpu_(gpu), library_(library), directory_(std::move(directory)) {}

    /// The line to print.
    Result<std::string> paint(StageOptions options, const std::string& input) {
        const auto start = std::chrono::steady_clock::now();
        options.input = input;
        auto stage = makeStage(options, library_);
        if (!stage) return tl::unexpected(stage.error());
        if (auto ready = prepare(*stage); !ready) return tl::unexpected(ready.error());
        auto picture = renderer_->render(stage->file.scene, stage->file.frame);
        if (!picture) return tl::unexpected(picture.error());
        const std::string base = (fs::path(directory_) / stage->name).string();
        for (const char* ending : {".png", ".exr"}) {
            if (auto written = writePicture(base + ending, *picture); !written) {
                return tl::unexpected(written.error());
            }
        }
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        const std::string name = stage->name + std::string(stage->name.size() < 20 ? 20 - stage->name.size() : 0, ' ');
        return name + "  " + fixed(seconds.count(), 2) + " s  " + base + ".png  " + base + ".exr";
    }

private:
    Result<void> prepare(const Stage& stage) {
        if (renderer_ && tree_ == stage.tree->file()) return {};
        auto renderer = makeRenderer(gpu_, stage.tree, false);
        if (!renderer) return tl::unexpected(renderer.error());
        renderer_ = std::move(*renderer);
        tree_ = stage.tree->file();
        return {};
    }

    const Gpu& gpu_;
    hair::Library& library_;
    std::string directory_;
    std::optional<hair::Renderer> renderer_ = {};
    std::string tree_ = {};
};

Result<std::vector<std::string>> chosenScenes(const std::vector<std::string>& only) {
    const auto all = sceneNames();
    if (all.empty()) {
        return tl::unexpected(
            failure("A040", dataDirectory() + "/scenes has no scenes; set PELAGE_DATA to a data directory of Pelage"));
    }
    if (only.empty()) return all;
    for (const std::string& name : only) {
        if (std::find(all.begin(), all.end(), name) != all.end()) continue;
        std::string known;
        for (const std::string& each : all) known += (known.empty() ? "" : ", ") + each;
        return tl::unexpected(failure("A041", "the gallery has no scene \"" + name + "\"; it has " + known));
    }
    return only;
}

}  // namespace

int gallery(const GalleryOptions& options) {
    auto inputs = chosenScenes(options.only);
    if (!inputs) return report(inputs.error());
    inputs->insert(inputs->end(), options.assets.begin(), options.assets.end());

    std::error_code failed;
    fs::create_directories(options.directory, failed);
    if (failed) {
        return report(failure("A042", "the directory " + options.directory + " cannot be made: " + failed.message()));
    }
    auto gpu = openGpu(options.device);
    if (!gpu) return report(gpu.error());

    hair::Library library(dataDirectory());
    Painter painter(*gpu, library, options.directory);
    Progress progress(inputs->size());
    int result = exitOk;
    for (const std::string& input : *inputs) {
        progress.show(input);
        auto line = painter.paint(options.stage, input);
        if (line) {
            progress.done(*line);
        } else {
            progress.clear();
            result = report(line.error().within("the scene \"" + input + "\""));
            progress.skip();
        }
    }
    progress.clear();
    const int validation = finish(*gpu);
    return result == exitOk ? validation : result;
}

}  // namespace pelage::app
