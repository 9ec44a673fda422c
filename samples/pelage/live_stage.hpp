// SPDX-License-Identifier: MIT
// A scene whose files may change while it is shown. An edit is taken whole or not at all: the new scene, tree and
// renderer are made beside the old ones and draw a frame; only then do they take their place. What fails leaves the old
// ones as they were.
#pragma once

#include "stage.hpp"
#include "watch.hpp"

#include <pelage/hair/renderer.hpp>

#include <chrono>
#include <functional>

namespace pelage::app {

class LiveStage {
public:
    using MakeRenderer = std::function<Result<hair::Renderer>(const std::shared_ptr<const passes::PassTree>&)>;

    /// `stage` was made of `options`; `make` gives a renderer on the same device each time.
    LiveStage(StageOptions options, Stage stage, hair::Renderer renderer, MakeRenderer make);

    enum class Change : std::uint8_t {
        None,   // no file changed
        Taken,  // stage() and renderer() are new
        Kept    // what the files say now cannot be shown; stage() and renderer() are those of before
    };
    struct Polled {
        Change change = Change::None;
        std::string error = {};  // of Kept: one line, without "pelage: error "
        Diagnostics notes = {};  // of Taken: warnings; of Kept: A130, which version is kept
    };
    /// Looks at the files; when one changed, reads everything again and draws a frame of the size that is shown.
    Polled poll();

    Stage& stage() { return stage_; }
    hair::Renderer& renderer() { return renderer_; }

private:
    Result<void> take();

    StageOptions options_;
    Stage stage_;
    hair::Renderer renderer_;
    MakeRenderer make_;
    Watch watch_ = {};
    std::chrono::system_clock::time_point taken_ = std::chrono::system_clock::now();
};

}  // namespace pelage::app
