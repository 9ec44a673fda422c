// SPDX-License-Identifier: MIT
#include "light.hpp"

#include <algorithm>

namespace pelage::hair {

std::span<const LightKindInfo> lightKinds() {
    constexpr unsigned LIGHT_HAS_POSITION = 1, LIGHT_HAS_DIRECTION = 2;
    static constexpr LightKindInfo kinds[] = {
#define PELAGE_LIGHT_KIND(number, word, name, traits, power) \
    {Light::Kind::name, #word, ((traits)&LIGHT_HAS_POSITION) != 0, ((traits)&LIGHT_HAS_DIRECTION) != 0, power},
#include <pelage/hair/light_kinds.def>
#undef PELAGE_LIGHT_KIND
    };
    static_assert(std::size(kinds) <= 16, "a kind is four bits of the shader option lightKinds");
    static_assert(
        [] {
            for (std::size_t i = 0; i < std::size(kinds); ++i) {
                if (static_cast<std::size_t>(kinds[i].kind) != i) return false;
            }
            return true;
        }(),
        "rows of light_kinds.def are numbered 0, 1, 2 and so on");
    return kinds;
}

const LightKindInfo& lightKind(Light::Kind kind) {
    return lightKinds()[static_cast<std::size_t>(kind)];
}

LightOptions lightOptions(const Scene& scene, std::uint32_t shadowLights) {
    LightOptions options;
    options.count = static_cast<std::uint32_t>(std::min<std::size_t>(scene.lights.size(), maxLights));
    for (std::uint32_t i = 0, layers = 0; i < options.count; ++i) {
        const Light& light = scene.lights[i];
        options.kinds |= static_cast<std::uint32_t>(light.kind) << (4 * i);
        if (!light.castsShadow || layers >= shadowLights) continue;
        options.shadows |= 1U << i;
        ++layers;
    }
    return options;
}

std::uint32_t countShadowLights(const Scene& scene) {
    const auto end = scene.lights.begin() + std::min<std::ptrdiff_t>(std::ssize(scene.lights), maxLights);
    return static_cast<std::uint32_t>(
        std::count_if(scene.lights.begin(), end, [](const Light& light) { return light.castsShadow; }));
}

}  // namespace pelage::hair
