// SPDX-License-Identifier: MIT
// The uniform block of set 0 (hair/shaders/frame.glsl) for the camera and for each shadowed light. Reversed depth.
#pragma once

#include <pelage/hair/renderer.hpp>

#include <glm/glm.hpp>

#include <vector>

namespace pelage::hair {

struct LightBlock {
    glm::vec4 position = {}, direction = {}, power = {};
    glm::mat4 shadow = glm::mat4(1.0F);
    glm::vec4 shadowDepth = {};
};
struct FrameBlock {
    glm::mat4 viewProjection = glm::mat4(1.0F), inverseViewProjection = glm::mat4(1.0F);
    glm::vec4 eye = {}, viewport = {}, pixel = {}, viewForward = {}, ambient = {};
    LightBlock lights[maxLights] = {};
};
static_assert(sizeof(LightBlock) == 128 && sizeof(FrameBlock) == 208 + 128 * maxLights);

struct FrameViews {
    FrameBlock main = {};
    std::vector<FrameBlock> shadows = {};  // by layer of the shadow map
};

/// `shadowLights`: how many layers the shadow map has; the first that many lights that cast shadows get one.
FrameViews makeViews(const Scene& scene, const FrameSettings& settings, std::uint32_t shadowSize,
                     std::uint32_t shadowLights);

/// Lights of the scene that cast a shadow.
std::uint32_t countShadowLights(const Scene& scene);

/// Right-handed, looking along -z, depth 1 at the near plane and 0 at the far plane, clip-space +Y up.
glm::mat4 perspectiveReversed(float verticalFov, float aspect, float nearPlane, float farPlane);
glm::mat4 orthographicReversed(float halfWidth, float halfHeight, float nearPlane, float farPlane);

}  // namespace pelage::hair
