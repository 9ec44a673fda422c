// SPDX-License-Identifier: MIT
// From options to something to render: the scene with every override applied and the pass tree it wants.
#pragma once

#include "options.hpp"

#include <pelage/hair/library.hpp>
#include <pelage/hair/scene_file.hpp>

#include <memory>
#include <string>
#include <vector>

namespace pelage::app {

struct Stage {
    std::string name = {};  // for output files
    hair::SceneFile file = {};
    std::shared_ptr<const passes::PassTree> tree = {};
    std::vector<std::string> watched = {};  // files a viewer reloads when they change
};

Result<Stage> makeStage(const StageOptions& options, hair::Library& library);

/// Replaces the material of all hair; "" changes nothing.
Result<void> applyMaterial(hair::Scene& scene, const std::string& material, hair::Library& library);

}  // namespace pelage::app
