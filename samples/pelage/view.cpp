// SPDX-License-Identifier: MIT
// The viewer draws when something changed, not all the time: on a CPU device a frame is dear, and hair does not move
// here.
#include "commands.hpp"
#include "data.hpp"
#include "gpu.hpp"
#include "live_stage.hpp"
#include "orbit.hpp"
#include "picture_file.hpp"
#include "presenter.hpp"
#include "view_window.hpp"

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
          live_(options.stage, std::move(stage), std::move(renderer),
                [this](const auto& tree) { return makeRenderer(gpu_, tree, false); }),
          presenter_(gpu_.device),
          orbit_(live_.stage().file.scene.camera) {}

    Result<void> run() {
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

    /// True when files changed and can be shown. When they cannot, why is said once, and the picture stays.
    bool reload() {
        const LiveStage::Polled polled = live_.poll();
        if (polled.change == LiveStage::Change::Kept) report(Failure(polled.error));
        tell(polled.notes);
        if (polled.change != LiveStage::Change::Taken) return false;
        std::printf("read again: %s\n", options_.stage.input.c_str());
        std::fflush(stdout);
        return true;
    }

    /// False when the window must be configured again.
    Result<bool> draw(const rhi::Extent3D& size) {
        if (size != configured_) {
            if (auto done = surface_.configure(gpu_.device, {.size = size}); !done) {
                return tl::unexpected(Failure(done.error()));
            }
            configured_ = size;
        }
        auto texture = surface_.getCurrentTexture();
        if (!texture) return tl::unexpected(Failure(texture.error()));
        if (!*texture) return configured_ = {0, 0, 0}, false;

        Stage& stage = live_.stage();
        stage.file.scene.camera = orbit_.camera();
        stage.file.frame.width = size.width;
        stage.file.frame.height = size.height;
        auto encoder = gpu_.device.createCommandEncoder("view");
        if (auto done = live_.renderer().encode(stage.file.scene, stage.file.frame, encoder); !done) {
            return tl::unexpected(Failure(done.error()));
        }
        if (auto done = presenter_.encode(encoder, live_.renderer().displayTexture(), *texture); !done) {
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
        Stage& stage = live_.stage();
        std::error_code ignored;
        std::string path;
        for (int number = 1; path.empty() || std::filesystem::exists(path, ignored); ++number) {
            path = stage.name + "-" + std::to_string(number) + ".png";
        }
        auto picture = live_.renderer().render(stage.file.scene, stage.file.frame);
        if (!picture) return void(report(Failure(picture.error())));
        if (auto written = writePicture(path, *picture); !written) return void(report(written.error()));
        std::printf("saved %s\n", path.c_str());
        std::fflush(stdout);
    }

    const ViewOptions& options_;
    Window window_;  // outlives the surface and the device
    Gpu gpu_;
    rhi::Surface surface_;
    LiveStage live_;
    Presenter presenter_;
    Orbit orbit_;
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
