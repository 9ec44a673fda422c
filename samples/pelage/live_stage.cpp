// SPDX-License-Identifier: MIT
#include "live_stage.hpp"

#include "data.hpp"

#include <ctime>
#include <utility>

namespace pelage::app {

namespace {

std::string clockText(std::chrono::system_clock::time_point time) {
    const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
    std::tm local{};
    char text[16] = "";
    if (localtime_r(&seconds, &local)) std::strftime(text, sizeof(text), "%H:%M:%S", &local);
    return text;
}

}  // namespace

LiveStage::LiveStage(StageOptions options, Stage stage, hair::Renderer renderer, MakeRenderer make)
    : options_(std::move(options)), stage_(std::move(stage)), renderer_(std::move(renderer)), make_(std::move(make)) {
    watch_.set(stage_.watched);
}

LiveStage::Polled LiveStage::poll() {
    if (!watch_.changed()) return {};
    if (auto taken = take(); !taken) {
        // What is wrong may be mended in a file that the last good version did not have, or that is not there yet.
        std::vector<std::string> files = stage_.watched;
        files.insert(files.end(), taken.error().files.begin(), taken.error().files.end());
        watch_.set(files, true);
        Polled kept{.change = Change::Kept, .error = taken.error().line};
        kept.notes.add(
            {.severity = Severity::Note, .code = "A130", .text = "keeping the version of " + clockText(taken_)});
        return kept;
    }
    taken_ = std::chrono::system_clock::now();
    watch_.set(stage_.watched);
    return {.change = Change::Taken, .notes = stage_.file.notes};
}

Result<void> LiveStage::take() {
    hair::Library library(dataDirectory());  // a new one: it reads each type once
    auto stage = makeStage(options_, library);
    if (!stage) return tl::unexpected(stage.error());
    auto renderer = make_(stage->tree);
    if (!renderer) return tl::unexpected(renderer.error());
    stage->file.frame.width = stage_.file.frame.width;
    stage->file.frame.height = stage_.file.frame.height;
    stage->file.scene.camera = stage_.file.scene.camera;
    // Much is known only once a frame is drawn: whether the tree can be built for this host, shaders, pipelines.
    if (auto drawn = renderer->render(stage->file.scene, stage->file.frame); !drawn)
        return tl::unexpected(Failure(drawn.error()));
    stage_ = std::move(*stage);
    renderer_ = std::move(*renderer);
    return {};
}

}  // namespace pelage::app
