// SPDX-License-Identifier: MIT
// The arithmetic of sub-allocation, without a device: one FreeList is one block of memory.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace pelage::rhi::detail {

/// Best fit over an address-ordered map of free ranges; neighbours are joined when a range is given back.
class FreeList {
public:
    explicit FreeList(std::uint64_t size) : size_(size) { free_.emplace(0, size); }
    /// An offset that is a multiple of `alignment` (a power of two), or nothing when no free range is long enough.
    std::optional<std::uint64_t> allocate(std::uint64_t size, std::uint64_t alignment);
    void release(std::uint64_t offset);
    std::uint64_t size() const { return size_; }
    std::uint64_t used() const { return used_; }
    bool empty() const { return taken_.empty(); }
    std::uint64_t largestFree() const;

private:
    std::uint64_t size_ = 0, used_ = 0;
    std::map<std::uint64_t, std::uint64_t> free_ = {}, taken_ = {};  // offset -> size
};

}  // namespace pelage::rhi::detail
