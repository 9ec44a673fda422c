// SPDX-License-Identifier: MIT
// What can go wrong, as values. Nothing throws across this library's surface and nothing aborts.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace pelage::rhi {

enum class ErrorKind : std::uint8_t { Validation, OutOfMemory, DeviceLost, Unsupported, Internal };

/// Stable codes: one list, error_codes.def; docs/diagnostics.md lists them too. R000 is never used.
enum class ErrorCode : std::uint16_t {
#define PELAGE_RHI_ERROR(name, number, sentence) name = number,
#include <pelage/rhi/error_codes.def>
#undef PELAGE_RHI_ERROR
};

struct Error {
    ErrorKind kind = ErrorKind::Validation;
    ErrorCode code = {};
    std::string message = {};               // one sentence: the labelled object, the value found, the value expected
    std::vector<std::string> context = {};  // innermost first: "RenderPass \"forward\" > draw #3"
};

/// "R012: [Buffer "lights"] ... While validating CommandEncoder "frame" > RenderPass "forward" > draw #3."
std::string toString(const Error& error);

template <class T>
using Result = tl::expected<T, Error>;

}  // namespace pelage::rhi
