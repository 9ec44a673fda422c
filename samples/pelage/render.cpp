// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "data.hpp"
#include "gpu.hpp"
#include "picture_file.hpp"
#include "report.hpp"
#include "stage.hpp"

#include <chrono>
#include <cstdio>

namespace pelage::app {

int render(const RenderOptions& options) {
    for (const std::string& output : options.outputs) {
        if (auto fine = checkPicturePath(output); !fine) return report(fine.error());
    }
    const auto start = std::chrono::steady_clock::now();
    hair::Library library(dataDirectory());
    auto stage = makeStage(options.stage, library);
    if (!stage) return report(stage.error());

    auto gpu = openGpu(options.device);
    if (!gpu) return report(gpu.error());
    auto renderer = makeRenderer(*gpu, stage->tree, options.report);
    if (!renderer) return report(renderer.error());
    auto picture = renderer->render(stage->file.scene, stage->file.frame);
    if (!picture) return report(picture.error());

    warn(stage->file.notes);
    warn(picture->report.notes);
    std::vector<std::string> outputs = options.outputs;
    if (outputs.empty()) outputs.push_back(stage->name + ".png");
    for (const std::string& output : outputs) {
        if (auto written = writePicture(output, *picture); !written) return report(written.error());
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        std::printf("%s  %ux%u  %.2f s\n", output.c_str(), picture->width, picture->height, seconds.count());
    }
    if (options.report) {
        std::printf("device: %s\n%s", gpu->device.info().name.c_str(), reportText(picture->report).c_str());
    }
    return finish(*gpu);
}

}  // namespace pelage::app
