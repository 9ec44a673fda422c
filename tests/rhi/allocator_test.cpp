// SPDX-License-Identifier: MIT
// The arithmetic of sub-allocation, without a device.
#include <gtest/gtest.h>

#include <random>

#include "blocks.hpp"

namespace pelage::rhi::detail {
namespace {

TEST(Allocator, OffsetsHonourTheAlignment) {
    FreeList list(1024);
    EXPECT_EQ(list.allocate(10, 1), 0U);
    EXPECT_EQ(list.allocate(10, 256), 256U);
    EXPECT_EQ(list.allocate(100, 4), 12U);  // the gap in front of the aligned range is not lost
    EXPECT_EQ(list.used(), 120U);
}

TEST(Allocator, NeighboursJoinWhenTheyAreGivenBack) {
    FreeList list(300);
    const auto a = list.allocate(100, 1), b = list.allocate(100, 1), c = list.allocate(100, 1);
    EXPECT_FALSE(list.allocate(1, 1));
    list.release(*a);
    list.release(*c);
    EXPECT_EQ(list.largestFree(), 100U);
    list.release(*b);
    EXPECT_EQ(list.largestFree(), 300U);
    EXPECT_TRUE(list.empty());
    EXPECT_EQ(list.allocate(300, 1), 0U);
}

TEST(Allocator, TakesTheTightestHole) {
    FreeList list(1000);
    const auto big = list.allocate(400, 1);
    list.allocate(10, 1);
    const auto small = list.allocate(50, 1);
    list.allocate(540, 1);
    list.release(*big);
    list.release(*small);
    EXPECT_EQ(list.allocate(40, 1), small);
}

TEST(Allocator, RefusesNothingAndTooMuch) {
    FreeList list(64);
    EXPECT_FALSE(list.allocate(0, 1));
    EXPECT_FALSE(list.allocate(65, 1));
    list.release(12);  // never given out: ignored
    EXPECT_EQ(list.largestFree(), 64U);
}

TEST(Allocator, RandomUseNeverOverlapsAndLosesNothing) {
    std::mt19937 random(7);
    FreeList list(1 << 16);
    std::map<std::uint64_t, std::uint64_t> live;
    for (int step = 0; step < 20000; ++step) {
        if (random() % 2 == 0 || live.empty()) {
            const std::uint64_t size = random() % 900 + 1, alignment = 1ULL << (random() % 9);
            const auto offset = list.allocate(size, alignment);
            if (!offset) continue;
            EXPECT_EQ(*offset % alignment, 0U);
            EXPECT_LE(*offset + size, list.size());
            const auto next = live.lower_bound(*offset);
            EXPECT_TRUE(next == live.end() || *offset + size <= next->first);
            EXPECT_TRUE(next == live.begin() || std::prev(next)->first + std::prev(next)->second <= *offset);
            live.emplace(*offset, size);
        } else {
            const auto it = std::next(live.begin(), static_cast<std::ptrdiff_t>(random() % live.size()));
            list.release(it->first);
            live.erase(it);
        }
        std::uint64_t used = 0;
        for (const auto& [offset, size] : live) used += size;
        ASSERT_EQ(list.used(), used);
    }
    for (const auto& [offset, size] : live) list.release(offset);
    EXPECT_EQ(list.largestFree(), list.size());
}

}  // namespace
}  // namespace pelage::rhi::detail
