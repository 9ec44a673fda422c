// SPDX-License-Identifier: MIT
// Small things that every reader of outside bytes shares: one-line faults, bounds-checked arithmetic, limits.
#pragma once

#include <pelage/base/diagnostic.hpp>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>

namespace pelage::hair::reading {

static_assert(std::endian::native == std::endian::little, "the file formats read here are little-endian");

constexpr std::uint64_t kMaxVertices = std::uint64_t{64} << 20;  // in one asset, points of strands included
constexpr std::uint32_t kMaxImageSide = 16384;                   // texels
constexpr float kMaxCoordinate = 1e9F;                           // file units; beyond it squares lose all meaning

/// `text` with every control character as a space, runs of spaces as one, and at most `limit` bytes.
std::string oneLine(std::string_view text, std::size_t limit = 300);

tl::unexpected<Diagnostics> fault(Code code, std::string_view file, std::string_view text, std::string_view hint);
Diagnostic remark(Severity severity, Code code, std::string_view file, std::string_view text, std::string_view hint);

/// F001 for a file that ends before the bytes its size promised.
tl::unexpected<Diagnostics> cannotRead(std::string_view file);

/// The value at `offset`; the caller has checked that it lies inside.
template <class T>
T valueAt(std::span<const std::byte> bytes, std::size_t offset) {
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof(T));
    return value;
}

/// True when [offset, offset + count * stride) lies within `size`; no combination of inputs overflows.
inline bool fits(std::uint64_t offset, std::uint64_t count, std::uint64_t stride, std::uint64_t size) {
    if (offset > size) return false;
    return stride == 0 || count <= (size - offset) / stride;
}

inline bool usable(float value) {
    return std::isfinite(value) && std::abs(value) <= kMaxCoordinate;
}
inline bool usable(const glm::vec3& p) {
    return usable(p.x) && usable(p.y) && usable(p.z);
}

}  // namespace pelage::hair::reading
