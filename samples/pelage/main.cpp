// SPDX-License-Identifier: MIT
// pelage: renders, shows, checks and measures hair from the command line.
#include "commands.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>

namespace pelage::app {

namespace {

void addDevice(CLI::App& command, DeviceOptions& options) {
    command.add_option("--device", options.name, "Part of the device's name, for example llvmpipe")->type_name("NAME");
    command.add_flag("--validation", options.validation, "Run under the Vulkan validation layer; its errors fail");
}

void addStage(CLI::App& command, StageOptions& options) {
    command.add_option("--material", options.material, "Material of all hair: preset, type, or *.material.json");
    command.add_option("--set", options.overrides, "Property of all hair, group.property=value (repeatable)")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
    command.add_option("--camera", options.camera, "\"ex,ey,ez;tx,ty,tz[;fov_deg]\" in metres and degrees");
    command.add_option("--size", options.size, "Width and height in pixels")->type_name("WxH");
    command.add_option("--frame", options.frame, "Pass tree: name or *.pass.json");
    command.add_option("--setting", options.settings, "Setting of the pass tree, name=value (repeatable)")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
    command.add_option("--background", options.background, "\"r,g,b\" scene-linear or \"#rrggbb\" sRGB");
    command.add_option("--exposure", options.exposure, "Factor before the display transform")
        ->check(CLI::Range(0.0, 10000.0));
    command.add_option("--environment", options.environment, "none, studio, or an equirectangular .hdr or .exr");
}

constexpr const char* inputHelp = "A *.scene.json, .glb, .gltf, .tfx or .hair file, or the name of a shipped scene";

void addRender(CLI::App& app, RenderOptions& options, int& result) {
    CLI::App* command = app.add_subcommand("render", "Render one picture");
    command->add_option("input", options.stage.input, inputHelp)->required();
    command->add_option("-o,--output", options.outputs, ".png (display) or .exr (scene-linear); repeatable")
        ->type_name("FILE")
        ->allow_extra_args(false);
    command->add_flag("--report", options.report, "Print time and work of each pass, and bytes of each attachment");
    addStage(*command, options.stage);
    addDevice(*command, options.device);
    command->callback([&] { result = render(options); });
}

void addView(CLI::App& app, ViewOptions& options, int& result) {
    CLI::App* command = app.add_subcommand("view", "Open a window; changed files are read again");
    command->add_option("input", options.stage.input, inputHelp)->required();
    command->add_option("--frames", options.frames, "End after so many frames")->type_name("N");
    addStage(*command, options.stage);
    addDevice(*command, options.device);
    command->footer("Drag turns, the wheel comes nearer, R resets, S saves a PNG, Esc ends.");
    command->callback([&] { result = view(options); });
}

void addGallery(CLI::App& app, GalleryOptions& options, int& result) {
    CLI::App* command = app.add_subcommand("gallery", "Render every shipped scene, and the assets given");
    command->add_option("assets", options.assets, "More to render: scenes or hair files");
    command->add_option("-o,--output", options.directory, "Directory for the pictures")->capture_default_str();
    command->add_option("--only", options.only, "Only this shipped scene (repeatable)")->allow_extra_args(false);
    addStage(*command, options.stage);
    addDevice(*command, options.device);
    command->callback([&] { result = gallery(options); });
}

void addBench(CLI::App& app, BenchOptions& options, int& result) {
    CLI::App* command = app.add_subcommand("bench", "Compare the shading models: time as ratios, and work");
    options.stage.input = "wavy_brown";
    command->add_option("input", options.stage.input, inputHelp)->capture_default_str();
    command->add_option("--models", options.models, "Shading models to compare; the first is 1.00")
        ->delimiter(',')
        ->capture_default_str();
    command->add_option("--repeat", options.repeat, "Frames of each model")
        ->capture_default_str()
        ->check(CLI::Range(1, 10000));
    command->add_option("--json", options.json, "Write the results here as well")->type_name("FILE");
    addStage(*command, options.stage);
    addDevice(*command, options.device);
    command->callback([&] { result = bench(options); });
}

void addScatter(CLI::App& app, ScatterOptions& options, int& result) {
    CLI::App* command = app.add_subcommand("scatter", "Evaluate one fibre for rows of angles, exactly or by a model");
    command->add_option("input", options.input, "CSV of rows, see docs/scatter-csv.md; - is standard input")
        ->capture_default_str();
    command->add_option("-o,--output", options.output, "CSV of rows and results")->capture_default_str();
    command->add_flag("--exact", options.exact, "The ground truth");
    command->add_option("--model", options.model, "A scattering model, for example moment_lut")->type_name("ID");
    command->add_flag("--published", options.published, "The model with the errors of its source");
    command->add_option("--precision", options.precision, "Arithmetic of the model: gpu, float or double")
        ->capture_default_str()
        ->check(CLI::IsMember({"gpu", "float", "double"}));
    addDevice(*command, options.device);
    command->add_option("--plot", options.plot, "Draw the far field of one fibre instead: .svg or .png")
        ->type_name("FILE");
    command->add_option("--models", options.models, "Models drawn, separated by commas")->capture_default_str();
    const auto number = [&](const char* name, double& value, double low, double high, const char* help) {
        command->add_option(name, value, help)->capture_default_str()->check(CLI::Range(low, high));
    };
    number("--eta", options.eta, 1.0001, 3, "Plot: index of refraction");
    number("--beta-m", options.betaM, 0.01, 1, "Plot: longitudinal roughness");
    number("--beta-n", options.betaN, 0.01, 1, "Plot: azimuthal roughness");
    number("--alpha", options.alpha, -28.6, 28.6, "Plot: tilt of the scales, degrees");
    number("--sigma-a", options.sigmaA, 0, 1e4, "Plot: absorption per radius");
    number("--theta-o", options.thetaO, -90, 90, "Plot: inclination of the view, degrees");
    command->callback([&] { result = scatter(options); });
}

void addAccuracy(CLI::App& app, AccuracyOptions& options, int& result) {
    CLI::App* command =
        app.add_subcommand("accuracy", "Measure every scattering model and write a page about it, with plots");
    command->add_option("-o,--output", options.directory, "Directory for accuracy.md and images/scattering_*.svg")
        ->type_name("DIR")
        ->capture_default_str();
    command->add_flag("--quick", options.quick, "Coarser: to see that it works");
    addDevice(*command, options.device);
    command->add_flag("!--no-device", options.useDevice, "Leave out what is measured on a device");
    command->callback([&] { result = accuracy(options); });
}

void addCheck(CLI::App& app, CheckOptions& options, int& result) {
    CLI::App* command = app.add_subcommand("check", "Find faults in pass trees, material types, materials and scenes");
    command->add_option("files", options.files, "Files to read")->required();
    command->add_flag("--json", options.json, "One JSON object a line on standard output, for editors");
    command->footer("0: all are usable, with or without warnings; 2: one is not.");
    command->callback([&] { result = check(options); });
}

void addGraph(CLI::App& app, GraphOptions& options, int& result) {
    CLI::App* command = app.add_subcommand("graph", "Draw a pass tree: order, images, memory, what waits for what");
    command->add_option("input", options.input, "A *.pass.json file, or the name of a shipped tree")->required();
    command->add_option("-o,--output", options.outputs, ".html (one page, needs nothing else) or .dot; repeatable")
        ->type_name("FILE")
        ->allow_extra_args(false);
    command->add_option("--size", options.size, "Width and height of the frame in pixels")->type_name("WxH");
    command->add_option("--setting", options.settings, "Setting of the tree, name=value (repeatable)")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
    command->add_option("--measure", options.measure, "Render this scene with the tree, and show what each pass cost")
        ->type_name("SCENE");
    addDevice(*command, options.device);
    command->callback([&] { result = graph(options); });
}

void addSchema(CLI::App& app, SchemaOptions& options, int& result) {
    CLI::App* command = app.add_subcommand("schema", "Print the schema of a kind of file, or a page about it");
    command->add_option("name", options.name, "passtree or material")->required();
    command->add_flag("--markdown", options.markdown, "The page: docs/passes.md and docs/materials.md are such");
    command->add_option("-o,--output", options.output, "- is standard output")
        ->type_name("FILE")
        ->capture_default_str();
    command->callback([&] { result = schema(options); });
}

void addFiles(CLI::App& app, const char* name, const char* help, std::vector<std::string>& files, int& result,
              int (*run)(const std::vector<std::string>&)) {
    CLI::App* command = app.add_subcommand(name, help);
    command->add_option("files", files, "Files to read")->required();
    command->callback([&files, &result, run] { result = run(files); });
}

int run(int argc, char** argv) {
    CLI::App app("Pelage, a hair renderer");
    app.require_subcommand(1);
    app.set_version_flag("--version", "pelage 0.1.0");
    int result = exitOk;
    RenderOptions renderOptions;
    ViewOptions viewOptions;
    GalleryOptions galleryOptions;
    BenchOptions benchOptions;
    ScatterOptions scatterOptions;
    AccuracyOptions accuracyOptions;
    CheckOptions checkOptions;
    GraphOptions graphOptions;
    SchemaOptions schemaOptions;
    std::vector<std::string> files;
    addRender(app, renderOptions, result);
    addView(app, viewOptions, result);
    addGallery(app, galleryOptions, result);
    addBench(app, benchOptions, result);
    addScatter(app, scatterOptions, result);
    addAccuracy(app, accuracyOptions, result);
    addFiles(app, "info", "Say what is in hair files", files, result, info);
    addCheck(app, checkOptions, result);
    addGraph(app, graphOptions, result);
    addSchema(app, schemaOptions, result);
    addFiles(app, "migrate", "Rewrite material files for the present version of their type; comments are not kept",
             files, result, migrate);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help) {
        return app.exit(help);  // --help and --version print to stdout
    } catch (const CLI::ParseError& error) {
        return report(failure("A000", std::string(error.what()) + "; see pelage --help"));
    }
    return result;
}

}  // namespace

}  // namespace pelage::app

int main(int argc, char** argv) {
    try {
        return pelage::app::run(argc, argv);
    } catch (const std::exception& error) {
        return pelage::app::report(pelage::app::failure("A099", error.what()));
    }
}
