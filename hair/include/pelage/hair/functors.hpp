// SPDX-License-Identifier: MIT
// The functors that know hair: lobe widths and shifts, azimuthal scale, weights, shadow falloff, environment, ambient.
#pragma once

#include <pelage/materials/functor.hpp>

namespace pelage::hair {

/// FunctorRegistry::standard() and the functors of hair.
materials::FunctorRegistry functorRegistry();

}  // namespace pelage::hair
