// SPDX-License-Identifier: MIT
// Lights as the shaders of light.glsl see them: their part of the uniform block, and the shader options that say how
// many there are and of which kinds.
#pragma once

#include <pelage/hair/scene.hpp>
#include <pelage/rhi/rhi.hpp>

#include <vector>

namespace pelage::hair {

/// LightData of light_data.glsl: an element of an std140 array.
struct alignas(16) LightBlock {
    using vec3 = glm::vec3;
    using mat4 = glm::mat4;
#define PELAGE_LIGHT_MEMBER(type, name) type name = {};
#include "light.def"
};

/// What shaders are specialised for: values of a light may change every frame, these make other pipelines.
struct LightOptions {
    std::uint32_t count = 0;
    std::uint32_t kinds = 0;    // four bits a light, light 0 lowest: its Light::Kind
    std::uint32_t shadows = 0;  // a bit a light: it has a layer of the shadow map
    bool operator==(const LightOptions&) const = default;

    /// By the names of the shader options; pass trees may have settings of these names.
    std::vector<rhi::ConstantEntry> constants() const {
        return {{"lightCount", double(count)}, {"lightKinds", double(kinds)}, {"lightShadows", double(shadows)}};
    }
};
static_assert(4 * maxLights <= 32);

/// `shadowLights`: how many layers the shadow map has; the first that many lights that cast shadows get one.
LightOptions lightOptions(const Scene& scene, std::uint32_t shadowLights);

/// Lights of the scene that cast a shadow.
std::uint32_t countShadowLights(const Scene& scene);

}  // namespace pelage::hair
