// SPDX-License-Identifier: MIT
// What the renderer and pass trees call by one name: what the renderer lends, the settings that it gives, the images
// that it reads. The words stand here and in hair/data/frames/*.pass.json.
#pragma once

#include <string>

namespace pelage::hair::names {

// Lent by the renderer, where a tree imports them.
inline const std::string environmentIrradiance = "EnvIrradiance";  // cube, 16 x 16, RGBA16Float
inline const std::string displayConstants = "DisplayConstants";    // background and exposure: four floats
inline const std::string frameConstants = "FrameConstants";        // the block of shaders/frame.glsl

// Settings that the renderer gives, where a tree has them.
inline const std::string shadowSize = "shadowSize";
inline const std::string shadowLights = "shadowLights";
inline const std::string hostDepth = "hostDepth";

// Exports that the renderer reads.
inline const std::string color = "HdrColor";
inline const std::string display = "LdrColor";
inline const std::string depth = "Depth";

}  // namespace pelage::hair::names
