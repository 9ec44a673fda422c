// SPDX-License-Identifier: MIT
// A pass tree as it is compiled, to look at. With a scene it is drawn as the renderer compiled it, with what one frame
// cost; without, as for a host that lends everything.
#include "commands.hpp"
#include "data.hpp"
#include "generous_host.hpp"
#include "gpu.hpp"
#include "stage.hpp"
#include "text_file.hpp"

#include <pelage/hair/library.hpp>
#include <pelage/hair/settings.hpp>
#include <pelage/passes/page.hpp>

#include <cstdio>

namespace pelage::app {

namespace {

struct Drawn {
    passes::Plan plan = {};
    passes::PageOptions page = {};
    int result = exitOk;  // of the device
};

Result<void> checkPath(const std::string& path) {
    if (path.ends_with(".html") || path.ends_with(".dot")) return {};
    return tl::unexpected(Failure("A120: \"" + path + "\" is neither .html nor .dot; name one of them"));
}

std::vector<std::pair<std::string, std::string>> settingsOf(const passes::PassTree& tree,
                                                            const std::map<std::string, passes::SettingValue>& chosen) {
    std::vector<std::pair<std::string, std::string>> shown;
    for (const passes::SettingInfo& info : tree.settings()) {
        const auto found = chosen.find(info.name);
        const passes::SettingValue& value = found == chosen.end() ? info.defaultValue : found->second;
        std::string text = std::to_string(value.number);
        if (value.type == passes::SettingValue::Type::Enum) text = value.word;
        if (value.type == passes::SettingValue::Type::Bool) text = value.number != 0 ? "true" : "false";
        shown.emplace_back(info.name, text);
    }
    return shown;
}

Result<Drawn> compiled(const GraphOptions& options, const Size& size, hair::Library& library) {
    auto tree = library.passTree(options.input);
    if (!tree) return tl::unexpected(Failure(tree.error()));
    passes::HostDescription host =
        generousHost(**tree, size.given() ? rhi::Extent3D{size.width, size.height, 1} : rhi::Extent3D{1920, 1080, 1});
    for (const std::string& text : options.settings) {
        auto assignment = parseAssignment(text, "--setting");
        if (!assignment) return tl::unexpected(assignment.error());
        auto value = hair::parseSetting(**tree, assignment->first, assignment->second);
        if (!value) return tl::unexpected(Failure(value.error()));
        host.settings[assignment->first] = *value;
    }
    auto plan = (*tree)->compile(host);
    if (!plan) return tl::unexpected(Failure(plan.error()));
    return Drawn{std::move(*plan), {.title = (*tree)->name(), .settings = settingsOf(**tree, host.settings)}};
}

Result<Drawn> measured(const GraphOptions& options, hair::Library& library) {
    auto stage = makeStage(
        {.input = options.measure, .size = options.size, .frame = options.input, .settings = options.settings},
        library);
    if (!stage) return tl::unexpected(stage.error());
    auto gpu = openGpu(options.device);
    if (!gpu) return tl::unexpected(gpu.error());
    auto renderer = makeRenderer(*gpu, stage->tree);
    if (!renderer) return tl::unexpected(renderer.error());
    // The first frame compiles shaders and uploads; the second is the one that is shown.
    Drawn drawn;
    for (int frame = 0; frame < 2; ++frame) {
        auto picture = renderer->render(stage->file.scene, stage->file.frame);
        if (!picture) return tl::unexpected(Failure(picture.error()));
        drawn.page.measured = std::move(picture->report.passes);
        drawn.page.barriers = picture->report.barriers;
    }
    drawn.plan = renderer->plan();
    drawn.page.title = stage->tree->name() + ", " + stage->name;
    drawn.page.settings = settingsOf(*stage->tree, stage->file.frame.settings);
    drawn.page.device = gpu->device.info().name;
    drawn.result = finish(*gpu);
    return drawn;
}

}  // namespace

int graph(const GraphOptions& options) {
    for (const std::string& output : options.outputs) {
        if (auto fine = checkPath(output); !fine) return report(fine.error());
    }
    Size size;
    if (!options.size.empty()) {
        auto parsed = parseSize(options.size);
        if (!parsed) return report(parsed.error());
        size = *parsed;
    }
    hair::Library library(dataDirectory());
    auto drawn = options.measure.empty() ? compiled(options, size, library) : measured(options, library);
    if (!drawn) return report(drawn.error());
    warn(drawn->plan.warnings);
    if (options.outputs.empty()) std::fputs(drawn->plan.dot().c_str(), stdout);
    for (const std::string& output : options.outputs) {
        const std::string text = output.ends_with(".dot") ? drawn->plan.dot() : passes::html(drawn->plan, drawn->page);
        if (auto written = writeTextFile(output, text); !written) return report(written.error());
        std::printf("%s\n", output.c_str());
    }
    return drawn->result;
}

}  // namespace pelage::app
