// SPDX-License-Identifier: MIT
// Scenes as files (*.scene.json, format pelage.scene/1): objects from assets or generators, materials with overrides,
// lights, environment, camera, pass-tree settings. Paths are relative to the scene file.
#pragma once

#include <pelage/hair/library.hpp>
#include <pelage/hair/renderer.hpp>

namespace pelage::hair {

struct SceneFile {
    Scene scene = {};
    FrameSettings frame = {};
    std::string passTree = "hair_frame";
    bool hasCamera = false;
    Diagnostics notes = {};
};

Result<SceneFile> loadScene(const std::string& path, Library& library);

/// A scene around one asset (.glb, .gltf, .tfx, .hair): framed camera, portrait lights, the studio environment, the
/// given material or a sensible one ("brown").
Result<SceneFile> sceneFromAsset(const std::string& path, const std::string& material, float aspect, Library& library);

}  // namespace pelage::hair
