// SPDX-License-Identifier: MIT
// The functors between the properties of a fibre and its shader: colour, shape, lobe weights.
#pragma once

#include <pelage/materials/functor.hpp>

namespace pelage::hair {

void addFiberFunctors(materials::FunctorRegistry& registry);

}  // namespace pelage::hair
