// SPDX-License-Identifier: MIT
#include "functors_standard.hpp"

#include <pelage/materials/functor.hpp>

namespace pelage::materials {

FunctorRegistry FunctorRegistry::standard() {
    FunctorRegistry registry;
    registry.add(blendModeToPipeline());
    registry.add(texturedColor());
    registry.add(fresnelFromIor());
    return registry;
}

bool FunctorRegistry::add(FunctorType type) {
    std::string key = type.name;
    return types_.emplace(std::move(key), std::move(type)).second;
}

const FunctorType* FunctorRegistry::find(std::string_view name) const {
    const auto found = types_.find(name);
    return found == types_.end() ? nullptr : &found->second;
}

std::vector<std::string> FunctorRegistry::names() const {
    std::vector<std::string> out;
    for (const auto& [name, type] : types_) out.push_back(name);
    return out;
}

}  // namespace pelage::materials
