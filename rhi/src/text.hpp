// SPDX-License-Identifier: MIT
// Making messages: cat() joins anything that streams; fail() makes an error in the shape that every function returns.
#pragma once

#include <pelage/rhi/error.hpp>

#include <sstream>
#include <string>

#include "vk.hpp"

namespace pelage::rhi::detail {

template <class... Parts>
std::string cat(const Parts&... parts) {
    std::ostringstream out;
    (out << ... << parts);
    return out.str();
}

inline tl::unexpected<Error> fail(ErrorKind kind, ErrorCode code, std::string message) {
    return tl::unexpected<Error>(Error{kind, code, std::move(message), {}});
}
/// A misuse that was caught before Vulkan saw it.
inline tl::unexpected<Error> invalid(ErrorCode code, std::string message) {
    return fail(ErrorKind::Validation, code, std::move(message));
}
inline tl::unexpected<Error> forward(Error error) {
    return tl::unexpected<Error>(std::move(error));
}

const char* resultName(VkResult result);
/// The error for a Vulkan call that failed: names the call and the object it was made for.
Error vulkanError(VkResult result, std::string_view call, std::string_view object);

}  // namespace pelage::rhi::detail
