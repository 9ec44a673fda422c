// SPDX-License-Identifier: MIT
// How the functors of hair write down their ports.
#pragma once

#include <pelage/materials/functor.hpp>

namespace pelage::hair {

inline materials::Port port(std::string name, materials::ValueType type) {
    return {std::move(name), materials::Port::Kind::Value, type, {}, false};
}
inline materials::Port words(std::string name, std::vector<std::string> list) {
    return {std::move(name), materials::Port::Kind::Value, materials::ValueType::Enum, std::move(list), false};
}

}  // namespace pelage::hair
