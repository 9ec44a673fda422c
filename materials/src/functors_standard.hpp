// SPDX-License-Identifier: MIT
#pragma once

#include <pelage/materials/functor.hpp>

namespace pelage::materials {

FunctorType blendModeToPipeline();
FunctorType texturedColor();
FunctorType fresnelFromIor();

}  // namespace pelage::materials
