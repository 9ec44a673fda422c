// SPDX-License-Identifier: MIT
// The uniform block of set 0 (hair/shaders/frame.glsl) for the camera and for each shadowed light. Reversed depth.
#pragma once

#include "lighting/light.hpp"

#include <pelage/hair/renderer.hpp>

#include <glm/glm.hpp>

#include <vector>

namespace pelage::hair {

struct FrameBlock {
    using uint = std::uint32_t;
    using vec2 = glm::vec2;
    using vec3 = glm::vec3;
    using mat4 = glm::mat4;
#define PELAGE_FRAME_MEMBER(type, name) type name = {};
#include "shaders/frame.def"
    LightBlock lights[maxLights] = {};
};

struct FrameViews {
    FrameBlock main = {};
    LightOptions lights = {};
    std::vector<FrameBlock> shadows = {};  // by layer of the shadow map
};

/// `shadowLights`: how many layers the shadow map has; the first that many lights that cast shadows get one.
/// `views` is written over; a scene of as many lights as before allocates nothing.
void makeViews(FrameViews& views, const Scene& scene, const FrameSettings& settings, std::uint32_t shadowSize,
               std::uint32_t shadowLights);

/// Right-handed, looking along -z, depth 1 at the near plane and 0 at the far plane, clip-space +Y up.
glm::mat4 perspectiveReversed(float verticalFov, float aspect, float nearPlane, float farPlane);
glm::mat4 orthographicReversed(float halfWidth, float halfHeight, float nearPlane, float farPlane);

}  // namespace pelage::hair
