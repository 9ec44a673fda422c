// SPDX-License-Identifier: MIT
// What moving strands cost a frame: nothing of the heap and nothing of the driver but the bytes themselves.
#include "support/counting_new.hpp"
#include "support/null_driver.hpp"

#include "resources/strands.hpp"

#include <pelage/hair/generate.hpp>
#include <pelage/rhi/vulkan.hpp>

#include <gtest/gtest.h>

#include <functional>

namespace pelage::test {
namespace {

class Steady : public ::testing::Test {
protected:
    NullDriver driver;
    void SetUp() override {
        driver.keepCommands = false;
        instance = *rhi::vulkan::createInstance({}, NullDriver::entry());
        device = *(*instance.requestAdapter()).requestDevice();
        strands = hair::makeGroom({.strands = 3000, .pointsPerStrand = 40});
        rest = *hair::uploadStrands(device, strands);
        EXPECT_GT(strands.points.size() * 12, std::size_t{1} << 20) << "more than one slice of staging memory";
    }
    /// Allocations and live buffers of frames 5 to 20, when nothing should be new.
    void expectFlat(const std::function<void(hair::MovedPoints&)>& move) {
        hair::MovedPoints moved;
        const std::string name = "hair";
        hair::MovingPoints moving;
        std::uint64_t allocated = 0;
        std::uint32_t buffers = 0;
        for (int frame = 0; frame < 20; ++frame) {
            auto encoder = device.createCommandEncoder("frame");
            const std::uint64_t before = allocations;
            move(moved);
            ASSERT_TRUE(moving.update(device, encoder, name, moved, strands, rest.buffers));
            if (frame == 5) buffers = device.memoryStatistics().liveBuffers;
            if (frame >= 5) allocated += allocations - before;
            ASSERT_TRUE(device.queue().submit(*encoder.finish()));
        }
        EXPECT_EQ(allocated, 0U);
        EXPECT_EQ(device.memoryStatistics().liveBuffers, buffers);
    }

    rhi::Instance instance;
    rhi::Device device;
    hair::Strands strands;
    hair::GpuStrands rest;
};

TEST_F(Steady, ReplacedPointsAllocateNothing) {
    std::vector<glm::vec3> points = strands.points;
    const std::uint64_t before = driver.memoryAllocations;
    expectFlat([&](hair::MovedPoints& moved) {
        points[0].x += 0.01F;
        moved.points = points;
    });
    EXPECT_LE(driver.memoryAllocations - before, 4U) << "staging memory is used again";
}

TEST_F(Steady, LentPointsAllocateNothing) {
    const auto lent = *device.createBuffer({.label = "lent",
                                            .size = strands.points.size() * 12,
                                            .usage = rhi::BufferUsage::Storage | rhi::BufferUsage::CopySrc});
    std::vector<glm::uvec2> ranges;
    for (std::uint32_t s = 0; s < strands.strandCount(); ++s)
        ranges.emplace_back(strands.first[s], strands.first[s + 1]);
    expectFlat([&](hair::MovedPoints& moved) {
        moved.buffer = lent;
        moved.ranges = ranges;
    });
}

}  // namespace
}  // namespace pelage::test
