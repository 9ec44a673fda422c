// SPDX-License-Identifier: MIT
#include "blocks.hpp"

#include <algorithm>
#include <iterator>

namespace pelage::rhi::detail {

std::optional<std::uint64_t> FreeList::allocate(std::uint64_t size, std::uint64_t alignment) {
    if (size == 0) return std::nullopt;
    auto best = free_.end();
    for (auto it = free_.begin(); it != free_.end(); ++it) {
        const std::uint64_t start = (it->first + alignment - 1) & ~(alignment - 1);
        const std::uint64_t padding = start - it->first;
        if (it->second < padding || it->second - padding < size) continue;
        if (best == free_.end() || it->second < best->second) best = it;
    }
    if (best == free_.end()) return std::nullopt;
    const auto [offset, length] = *best;
    const std::uint64_t start = (offset + alignment - 1) & ~(alignment - 1);
    free_.erase(best);
    if (start > offset) free_.emplace(offset, start - offset);
    if (start + size < offset + length) free_.emplace(start + size, offset + length - start - size);
    taken_.emplace(start, size);
    used_ += size;
    return start;
}

void FreeList::release(std::uint64_t offset) {
    const auto taken = taken_.find(offset);
    if (taken == taken_.end()) return;
    std::uint64_t start = offset, length = taken->second;
    used_ -= length;
    taken_.erase(taken);
    auto next = free_.lower_bound(start);
    if (next != free_.end() && start + length == next->first) {
        length += next->second;
        next = free_.erase(next);
    }
    if (next != free_.begin()) {
        const auto previous = std::prev(next);
        if (previous->first + previous->second == start) {
            previous->second += length;
            return;
        }
    }
    free_.emplace(start, length);
}

std::uint64_t FreeList::largestFree() const {
    std::uint64_t largest = 0;
    for (const auto& [offset, length] : free_) largest = std::max(largest, length);
    return largest;
}

}  // namespace pelage::rhi::detail
