// SPDX-License-Identifier: MIT
// The techniques of shadow.glsl by their numbers and words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pelage::hair {

/// Values of the shader option `shadowMode`.
enum class ShadowTechnique : std::uint8_t {
    Off = 0,
#define PELAGE_SHADOW_TECHNIQUE(number, word, name, traits) name = number,
#include "shadow_techniques.def"
#undef PELAGE_SHADOW_TECHNIQUE
};

struct ShadowTechniqueInfo {
    ShadowTechnique technique = ShadowTechnique::Off;
    std::string_view word = {};  ///< in material files
    bool hasWindow = false;      ///< reads a window of the map, whose size the material tells
    bool fades = false;          ///< light fades with the depth inside the hair, by a density the material tells
};

/// All, "off" first, in the order of their numbers.
inline std::span<const ShadowTechniqueInfo> shadowTechniques() {
    constexpr unsigned SHADOW_HAS_WINDOW = 1, SHADOW_FADES = 2;
    static constexpr ShadowTechniqueInfo techniques[] = {
        {ShadowTechnique::Off, "off", false, false},
#define PELAGE_SHADOW_TECHNIQUE(number, word, name, traits) \
    {ShadowTechnique::name, #word, ((traits)&SHADOW_HAS_WINDOW) != 0, ((traits)&SHADOW_FADES) != 0},
#include "shadow_techniques.def"
#undef PELAGE_SHADOW_TECHNIQUE
    };
    static_assert(
        [] {
            for (std::size_t i = 0; i < std::size(techniques); ++i) {
                if (static_cast<std::size_t>(techniques[i].technique) != i) return false;
            }
            return true;
        }(),
        "rows of shadow_techniques.def are numbered 1, 2, 3 and so on");
    return techniques;
}

/// The words of the option `shadowMode` and of the functor that sets it.
inline std::vector<std::string> shadowTechniqueWords() {
    std::vector<std::string> words;
    for (const ShadowTechniqueInfo& info : shadowTechniques()) words.emplace_back(info.word);
    return words;
}

}  // namespace pelage::hair
