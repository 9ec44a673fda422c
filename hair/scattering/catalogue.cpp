// SPDX-License-Identifier: MIT
#include <pelage/hair/scattering.hpp>

#include <algorithm>

namespace pelage::hair {

namespace {

#include "scattering/models/traits.glsl"

constexpr ModelInfo models[] = {
#define PELAGE_SCATTERING_MODEL(number, id, name, function, traits, title, source) \
    {ScatteringModel::name,                                                        \
     #id,                                                                          \
     title,                                                                        \
     source,                                                                       \
     ((traits)&TRAIT_CORRECTED) != 0,                                              \
     ((traits)&TRAIT_TABLE) != 0,                                                  \
     ((traits)&TRAIT_OFFSET) != 0,                                                 \
     ((traits)&TRAIT_NEAR_FIELD) != 0,                                             \
     ((traits)&TRAIT_RECIPROCAL) != 0,                                             \
     ((traits)&TRAIT_CONTROLS) != 0},
#include <pelage/hair/scattering_models.def>
#undef PELAGE_SCATTERING_MODEL
};

// A file's word is an index in the list of words, and the shader option is that index.
constexpr bool numbersAreIndices() {
    for (std::size_t i = 0; i < std::size(models); ++i) {
        if (static_cast<std::size_t>(models[i].model) != i) return false;
    }
    return true;
}
static_assert(numbersAreIndices(), "the numbers in scattering_models.def are 0, 1, 2 and so on in its order");

}  // namespace

std::span<const ModelInfo> scatteringModels() {
    return models;
}

const ModelInfo* findScatteringModel(std::string_view id) {
    const auto found =
        std::find_if(std::begin(models), std::end(models), [&](const auto& info) { return info.id == id; });
    return found == std::end(models) ? nullptr : found;
}

const ModelInfo* findScatteringModel(ScatteringModel model) {
    const auto index = static_cast<std::size_t>(model);
    return index < std::size(models) ? &models[index] : nullptr;
}

}  // namespace pelage::hair
