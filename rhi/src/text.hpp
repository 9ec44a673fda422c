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

inline tl::unexpected<Diagnostics> fail(ErrorKind kind, Code code, std::string text) {
    return tl::unexpected<Diagnostics>(Diagnostic{.code = code, .text = std::move(text), .kind = kind});
}
/// A call that breaks the rules.
inline tl::unexpected<Diagnostics> invalid(Code code, std::string text) {
    return fail(ErrorKind::Validation, code, std::move(text));
}
inline tl::unexpected<Diagnostics> forward(Diagnostics errors) {
    return tl::unexpected<Diagnostics>(std::move(errors));
}
Diagnostic vulkanError(VkResult result, std::string_view call, std::string_view object);

}  // namespace pelage::rhi::detail
