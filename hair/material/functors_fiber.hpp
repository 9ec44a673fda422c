// SPDX-License-Identifier: MIT
// The functors between the properties of a fibre and its shader: colour, shape, lobe weights.
#pragma once

#include <pelage/materials/functor.hpp>

namespace pelage::hair {

materials::FunctorType fiberColor();
materials::FunctorType fiberShape();
materials::FunctorType lobeWeights();

}  // namespace pelage::hair
