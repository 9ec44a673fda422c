// SPDX-License-Identifier: MIT
// The viewer draws when something changed, not all the time: on a CPU device a frame is dear, and hair does not move
// here.
#include "commands.hpp"
#include "data.hpp"
#include "gpu.hpp"
#include "orbit.hpp"
#include "picture_file.hpp"
#include "presenter.hpp"
#include "stage.hpp"
#include "view_window.hpp"
#include "watch.hpp"

#include <cstdio>
#include <filesystem>
#include <utility>

namespace pelage::app {

namespace {

constexpr double idleSeconds = 0.25;  // how often files are looked at
constexpr float radiansPerPixel = 0.006F;

class Viewer {
public:
    Viewer(const ViewOptions& options, Window window, Gpu gpu, rhi::Surface surface, Stage stage,
           hair::Renderer renderer)
        : options_(options),
          window_(std::move(window)),
          gpu_(std::move(gpu)),
          surface_(std::move(surface)),
          stage_(std::move(stage)),
          renderer_(std::move(renderer)),
          presenter_(gpu_.device),
          orbit_(stage_.file.scene.camera) {
        watch_.set(stage_.watched);
    }

    Outcome<void> run() {
        bool stale = true;
        std::uint32_t drawn = 0;
        while (!window_.closed()) {
            const WindowInput input = window_.poll(stale || options_.frames != 0 ? 0 : idleSeconds);
            stale = apply(input) || stale;
            stale = reload() || stale;
            const rhi::Extent3D size = window_.size();
            if (size.width == 0 || size.height == 0) continue;
            if (size != configured_) stale = true;
            if (stale || options_.frames != 0) {
                auto shown = draw(size);
                if (!shown) return tl::unexpected(shown.error());
                stale = !*shown;
                if (*shown) ++drawn;
            }
            if (input.save) save();
            if (options_.frames != 0 && drawn >= options_.frames) break;
        }
        if (auto idle = gpu_.device.waitIdle(); !idle) return tl::unexpected(Failure(idle.error()));
        return {};
    }

    int end() const { return finish(gpu_); }

private:
    bool apply(const WindowInput& input) {
        orbit_.turn(-input.dragX * radiansPerPixel, input.dragY * radiansPerPixel);
        if (input.wheel != 0) orbit_.approach(input.wheel);
        if (input.reset) orbit_.reset();
        return input.any();
    }

    /// Reads changed files again; on an error the last good scene and frame stay, and the error is said once.
    bool reload() {
        if (!watch_.changed()) return false;
        hair::Library library(dataDirectory());
        auto stage = makeStage(options_.stage, library);
        if (!stage) return report(stage.error()), false;
        if (auto set = renderer_.setTree(stage->tree); !set) return report(Failure(set.error())), false;
        stage_ = std::move(*stage);
        warn(stage_.file.notes);
        watch_.set(stage_.watched);
        std::printf("read again: %s\n", options_.stage.input.c_str());
        std::fflush(stdout);
        return true;
    }

    /// False when the window must be configured again.
    Outcome<bool> draw(const rhi::Extent3D& size) {
        if (size != configured_) {
            if (auto done = surface_.configure(gpu_.device, {.size = size}); !done) {
                return tl::unexpected(Failure(done.error()));
            }
            configured_ = size;
        }
        auto texture = surface_.getCurrentTexture();
        if (!texture) return tl::unexpected(Failure(texture.error()));
        if (!*texture) return configured_ = {0, 0, 0}, false;

        stage_.file.scene.camera = orbit_.camera();
        stage_.file.frame.width = size.width;
        stage_.file.frame.height = size.height;
        auto encoder = gpu_.device.createCommandEncoder("view");
        if (auto done = renderer_.encode(stage_.file.scene, stage_.file.frame, encoder); !done) {
            return tl::unexpected(Failure(done.error()));
        }
        if (auto done = presenter_.encode(encoder, renderer_.displayTexture(), *texture); !done) {
            return tl::unexpected(done.error());
        }
        auto commands = encoder.finish();
        if (!commands) return tl::unexpected(Failure(commands.error()));
        auto submission = gpu_.device.queue().submit(*commands);
        if (!submission) return tl::unexpected(Failure(submission.error()));
        auto presented = surface_.present();
        if (!presented) return tl::unexpected(Failure(presented.error()));
        // One frame at a time: a viewer that runs ahead of a slow device answers late.
        if (auto done = gpu_.device.queue().wait(*submission); !done) return tl::unexpected(Failure(done.error()));
        if (!*presented) configured_ = {0, 0, 0};
        return *presented;
    }

    void save() {
        std::error_code ignored;
        std::string path;
        for (int number = 1; path.empty() || std::filesystem::exists(path, ignored); ++number) {
            path = stage_.name + "-" + std::to_string(number) + ".png";
        }
        auto picture = renderer_.render(stage_.file.scene, stage_.file.frame);
        if (!picture) return void(report(Failure(picture.error())));
        if (auto written = writePicture(path, *picture); !written) return void(report(written.error()));
        std::printf("saved %s\n", path.c_str());
        std::fflush(stdout);
    }

    const ViewOptions& options_;
    Window window_;  // outlives the surface and the device
    Gpu gpu_;
    rhi::Surface surface_;
    Stage stage_;
    hair::Renderer renderer_;
    Presenter presenter_;
    Orbit orbit_;
    Watch watch_ = {};
    rhi::Extent3D configured_ = {0, 0, 0};
};

}  // namespace

int view(const ViewOptions& options) {
    hair::Library library(dataDirectory());
    auto stage = makeStage(options.stage, library);
    if (!stage) return report(stage.error());
    warn(stage->file.notes);

    auto window = Window::open("Pelage: " + stage->name, stage->file.frame.width, stage->file.frame.height);
    if (!window) return report(window.error());
    auto gpu = openInstance(options.device, window->surfaceExtensions());
    if (!gpu) return report(gpu.error());
    auto surface = window->createSurface(gpu->instance);
    if (!surface) return report(surface.error());
    if (auto opened = openDevice(*gpu, options.device, *surface); !opened) return report(opened.error());
    auto renderer = makeRenderer(*gpu, stage->tree, false);
    if (!renderer) return report(renderer.error());

    Viewer viewer(options, std::move(*window), *gpu, std::move(*surface), std::move(*stage), std::move(*renderer));
    gpu = Gpu();
    if (auto done = viewer.run(); !done) return report(done.error());
    return viewer.end();
}

}  // namespace pelage::app
