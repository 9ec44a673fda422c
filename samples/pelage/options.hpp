// SPDX-License-Identifier: MIT
// What the commands can be told, as text from the command line and as values.
#pragma once

#include "failure.hpp"

#include <pelage/hair/scene.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pelage::app {

struct Size {
    std::uint32_t width = 0, height = 0;  // 0: as the scene has it
    bool given() const { return width != 0; }
};

/// Options that change what is seen; shared by render, view, gallery and bench.
struct StageOptions {
    std::string input = {};
    std::string material = {};                // replaces the material of all hair
    std::vector<std::string> overrides = {};  // "group.property=value", of all hair
    std::string camera = {};
    std::string size = {};
    std::string frame = {};                  // pass tree
    std::vector<std::string> settings = {};  // "name=value", of the pass tree
    std::string background = {};
    std::string environment = {};
    std::optional<float> exposure = {};
};

struct DeviceOptions {
    std::string name = {};
    bool validation = false;
};

Result<Size> parseSize(const std::string& text);
/// "ex,ey,ez;tx,ty,tz[;fov_deg]"
Result<hair::Camera> parseCamera(const std::string& text);
/// "r,g,b" scene-linear or "#rrggbb" sRGB.
Result<glm::vec3> parseColor(const std::string& text, const std::string& option);
/// "name=value" split at the first equals sign.
Result<std::pair<std::string, std::string>> parseAssignment(const std::string& text, const std::string& option);

}  // namespace pelage::app
