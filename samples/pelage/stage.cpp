// SPDX-License-Identifier: MIT
#include "stage.hpp"

#include "data.hpp"
#include "environment_file.hpp"

#include <pelage/hair/settings.hpp>

#include <filesystem>
#include <utility>

namespace pelage::app {

namespace fs = std::filesystem;

namespace {

bool isSceneFile(const std::string& path) {
    return path.ends_with(".json");
}

Result<hair::SceneFile> loadInput(const StageOptions& options, const Size& size, hair::Library& library,
                                  std::string& path) {
    std::error_code ignored;
    path = options.input;
    if (!fs::exists(path, ignored)) {
        if (const std::string shipped = scenePath(options.input); !shipped.empty()) {
            path = shipped;
        } else if (fs::path(options.input).extension().empty()) {
            const auto known = sceneNames();
            const std::string_view nearest = nearestName(options.input, known);
            std::string hint = "give a .scene.json, .glb, .gltf, .tfx or .hair file, or one of the shipped scenes";
            if (!nearest.empty()) hint = "did you mean \"" + std::string(nearest) + "\"?";
            return tl::unexpected(
                failure("A002", "there is no file and no shipped scene \"" + options.input + "\"; " + hint));
        }
    }
    const float aspect =
        static_cast<float>(size.given() ? size.width : 1) / static_cast<float>(size.given() ? size.height : 1);
    auto loaded = isSceneFile(path) ? hair::loadScene(path, library)
                                    : hair::sceneFromAsset(path, options.material, aspect, library);
    if (!loaded) return tl::unexpected(loaded.error());
    return std::move(*loaded);
}

Result<void> applyOverrides(hair::Scene& scene, const std::vector<std::string>& overrides, Diagnostics& notes) {
    for (const std::string& text : overrides) {
        auto assignment = parseAssignment(text, "--set");
        if (!assignment) return tl::unexpected(assignment.error());
        for (hair::Object& object : scene.objects) {
            if (!hair::isHair(object.geometry)) continue;
            const Diagnostics found = object.material.setFromText(assignment->first, assignment->second);
            if (found.hasErrors()) return tl::unexpected(found);
            notes.append(found);
        }
    }
    return {};
}

Result<void> applySettings(const std::vector<std::string>& settings, const passes::PassTree& tree,
                           hair::FrameSettings& frame) {
    for (const std::string& text : settings) {
        auto assignment = parseAssignment(text, "--setting");
        if (!assignment) return tl::unexpected(assignment.error());
        auto value = hair::parseSetting(tree, assignment->first, assignment->second);
        if (!value) return tl::unexpected(value.error());
        frame.settings[assignment->first] = *value;
    }
    return {};
}

Result<void> applyView(const StageOptions& options, hair::SceneFile& file) {
    hair::Scene& scene = file.scene;
    if (!options.background.empty()) {
        auto color = parseColor(options.background, "--background");
        if (!color) return tl::unexpected(color.error());
        scene.background = *color;
    }
    if (options.exposure) scene.exposure = *options.exposure;
    if (!options.environment.empty()) {
        auto environment = chooseEnvironment(options.environment);
        if (!environment) return tl::unexpected(environment.error());
        scene.environment = *environment;
    }
    if (!options.camera.empty()) {
        auto camera = parseCamera(options.camera);
        if (!camera) return tl::unexpected(camera.error());
        scene.camera = *camera;
        file.hasCamera = true;
    } else if (!file.hasCamera) {
        glm::vec3 low, high;
        hair::bounds(scene, true, low, high);
        const float aspect = static_cast<float>(file.frame.width) / static_cast<float>(file.frame.height);
        scene.camera = hair::frameBox(low, high, glm::vec3(0.35F, 0.12F, 1.0F), aspect);
    }
    return {};
}

}  // namespace

Result<void> applyMaterial(hair::Scene& scene, const std::string& material, hair::Library& library) {
    if (material.empty()) return {};
    auto parsed = library.material(material);
    if (!parsed) return tl::unexpected(parsed.error());
    for (hair::Object& object : scene.objects) {
        if (hair::isHair(object.geometry)) object.material = parsed->material;
    }
    return {};
}

Result<Stage> makeStage(const StageOptions& options, hair::Library& library) {
    Size size;
    if (!options.size.empty()) {
        auto parsed = parseSize(options.size);
        if (!parsed) return tl::unexpected(parsed.error());
        size = *parsed;
    }
    std::string path;
    auto file = loadInput(options, size, library, path);
    if (!file) return tl::unexpected(file.error());

    Stage stage;
    stage.file = std::move(*file);
    stage.name = fs::path(path).stem().string();
    if (stage.name.ends_with(".scene")) stage.name.resize(stage.name.size() - 6);
    if (size.given()) {
        stage.file.frame.width = size.width;
        stage.file.frame.height = size.height;
    }
    if (isSceneFile(path)) {
        stage.watched.push_back(path);
        if (auto done = applyMaterial(stage.file.scene, options.material, library); !done) {
            return tl::unexpected(done.error());
        }
    }
    if (auto done = applyOverrides(stage.file.scene, options.overrides, stage.file.notes); !done) {
        return tl::unexpected(done.error());
    }
    if (!options.frame.empty()) stage.file.passTree = options.frame;
    auto tree = library.passTree(stage.file.passTree);
    if (!tree) return tl::unexpected(tree.error());
    stage.tree = *tree;
    stage.file.notes.append(stage.tree->warnings());
    if (auto done = applySettings(options.settings, *stage.tree, stage.file.frame); !done) {
        return tl::unexpected(done.error());
    }
    if (auto done = applyView(options, stage.file); !done) return tl::unexpected(done.error());

    const auto watch = [&](const std::vector<std::string>& files) {
        stage.watched.insert(stage.watched.end(), files.begin(), files.end());
    };
    watch(stage.tree->files());
    for (const hair::Object& object : stage.file.scene.objects) {
        watch({object.material.type().file()});
        watch(object.material.files());
    }
    return stage;
}

}  // namespace pelage::app
