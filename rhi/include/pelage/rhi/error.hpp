// SPDX-License-Identifier: MIT
// What can go wrong, as values: `Result<T>` of <pelage/base/diagnostic.hpp>. Nothing throws across this library's
// surface and nothing aborts. A device's fault has a `kind` that says what to do about it, one sentence (the labelled
// object, the value found, the value expected) and the context it was found in.
#pragma once

#include <pelage/base/diagnostic.hpp>

/// The codes of a device by name: ErrorCode::InvalidHandle is "R010". The list is base's codes.def.
namespace pelage::rhi::ErrorCode {

#define PELAGE_RHI_CODE(code, name, meaning) inline constexpr Code name = #code;
#include <pelage/base/codes.def>

}  // namespace pelage::rhi::ErrorCode
