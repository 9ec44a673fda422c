// SPDX-License-Identifier: MIT
// The oracle by itself: each kind of hazard is seen, and what orders two accesses is accepted.
#include <gtest/gtest.h>

#include "support/hazard_oracle.hpp"

namespace pelage::test {
namespace {

constexpr auto compute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr auto fragment = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
constexpr auto vertex = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT;
constexpr auto readBit = VK_ACCESS_2_SHADER_STORAGE_READ_BIT, writeBit = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;

class Oracle : public ::testing::Test {
protected:
    Oracle() {
        oracle.addBuffer(1, 100, "buffer");
        oracle.addImage(2, 1, 2, "image");
    }
    void write(VkPipelineStageFlags2 stage, std::uint64_t begin = 0, std::uint64_t end = 100) {
        oracle.touch({.object = 1, .begin = begin, .end = end, .stages = stage, .access = writeBit, .write = true},
                     "write");
    }
    void read(VkPipelineStageFlags2 stage, std::uint64_t begin = 0, std::uint64_t end = 100) {
        oracle.touch({.object = 1, .begin = begin, .end = end, .stages = stage, .access = readBit}, "read");
    }
    void barrier(VkPipelineStageFlags2 from, VkAccessFlags2 made, VkPipelineStageFlags2 to, VkAccessFlags2 seen) {
        VkMemoryBarrier2 b = {VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, nullptr, from, made, to, seen};
        VkDependencyInfo info = {VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
        info.memoryBarrierCount = 1;
        info.pMemoryBarriers = &b;
        oracle.barrier(info, "barrier");
    }
    void move(VkImageLayout from, VkImageLayout to, VkPipelineStageFlags2 src = 0, VkAccessFlags2 made = 0,
              VkPipelineStageFlags2 dst = fragment, VkAccessFlags2 seen = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
              std::uint64_t image = 2) {
        VkImageMemoryBarrier2 b = {VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2, nullptr, src, made, dst, seen, from, to};
        b.image = reinterpret_cast<VkImage>(image);
        b.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 2};
        VkDependencyInfo info = {VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
        info.imageMemoryBarrierCount = 1;
        info.pImageMemoryBarriers = &b;
        oracle.barrier(info, "move");
    }
    std::string only() {
        EXPECT_EQ(oracle.hazards().size(), 1U);
        return oracle.hazards().empty() ? "" : oracle.hazards().front();
    }
    HazardOracle oracle;
};

TEST_F(Oracle, AReadMustSeeTheWriteBeforeIt) {
    write(compute);
    read(fragment);
    EXPECT_EQ(only(), "read after write: read on buffer is not ordered after write");
}
TEST_F(Oracle, ABarrierForTheRightStagesAndAccessesOrdersThem) {
    write(compute);
    barrier(compute, writeBit, fragment, readBit);
    read(fragment);
    EXPECT_TRUE(oracle.hazards().empty());
    read(vertex);
    EXPECT_NE(only().find("read after write"), std::string::npos) << "the vertex stage was not named";
}
TEST_F(Oracle, AnExecutionDependencyAloneMakesNoWriteVisible) {
    write(compute);
    barrier(compute, 0, fragment, readBit);
    read(fragment);
    EXPECT_NE(only().find("read after write"), std::string::npos);
}
TEST_F(Oracle, AWriteWaitsForReadersButNeedsNoMemoryDependency) {
    read(fragment);
    write(compute);
    EXPECT_NE(only().find("write after read"), std::string::npos);
    oracle.forgetHazards();
    barrier(compute, writeBit, fragment, readBit);
    read(fragment);
    barrier(fragment, 0, compute, 0);
    // The reader was waited for, but nothing made the first write visible to the second.
    write(compute);
    EXPECT_NE(only().find("write after write"), std::string::npos);
}
TEST_F(Oracle, BarriersChain) {
    write(compute);
    barrier(compute, writeBit, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT);
    barrier(VK_PIPELINE_STAGE_2_COPY_BIT, 0, fragment, readBit);
    read(fragment);
    EXPECT_TRUE(oracle.hazards().empty());
    barrier(VK_PIPELINE_STAGE_2_BLIT_BIT, 0, vertex, readBit);
    read(vertex);
    EXPECT_EQ(oracle.hazards().size(), 1U) << "blits never waited for it";
}
TEST_F(Oracle, DifferentBytesAreDifferentPlaces) {
    write(compute, 0, 50);
    write(compute, 50, 100);
    EXPECT_TRUE(oracle.hazards().empty());
    write(compute, 49, 51);
    EXPECT_EQ(oracle.hazards().size(), 2U);
}
TEST_F(Oracle, LayoutsAreThoseTheCommandsState) {
    move(VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
    const Touch sampled = {.object = 2,
                           .stages = fragment,
                           .access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                           .layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    oracle.touch(sampled, "sample");
    EXPECT_EQ(oracle.hazards().size(), 2U) << "two layers";
    oracle.forgetHazards();
    move(VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, fragment);
    EXPECT_EQ(oracle.hazards().size(), 2U) << "it was not in the layout it is moved from";
}
TEST_F(Oracle, ATransitionIsAWriteThatOthersWaitFor) {
    move(VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    Touch sampled = {.object = 2,
                     .stages = compute,
                     .access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                     .layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    oracle.touch(sampled, "sample");
    EXPECT_EQ(oracle.hazards().size(), 2U) << "it was made visible to the fragment stage only";
    oracle.forgetHazards();
    move(VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_IMAGE_LAYOUT_GENERAL, fragment);
    EXPECT_EQ(oracle.hazards().size(), 2U) << "compute still reads";
}
TEST_F(Oracle, MemoryIsTakenOverOnlyWhenItsLastUserIsDone) {
    oracle.addImage(3, 1, 1, "next");
    oracle.bindImage(2, 7, 0, 1000);
    oracle.bindImage(3, 7, 500, 1000);
    move(VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL, 0, 0, compute, writeBit);
    oracle.touch({.object = 2, .stages = compute, .access = writeBit, .write = true}, "fill");
    EXPECT_TRUE(oracle.hazards().empty());
    // Waits for compute, but no barrier on memory makes what was written through the other image available.
    move(VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL, compute, writeBit, fragment, writeBit, 3);
    EXPECT_EQ(oracle.hazards().size(), 2U);
    EXPECT_NE(oracle.hazards()[0].find("alias"), std::string::npos);
}
TEST_F(Oracle, TheHostSeesWhatABarrierShowedIt) {
    write(compute);
    oracle.hostReads(1);
    EXPECT_NE(only().find("host read"), std::string::npos);
    oracle.forgetHazards();
    barrier(compute, writeBit, VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    oracle.hostReads(1);
    EXPECT_TRUE(oracle.hazards().empty());
}

}  // namespace
}  // namespace pelage::test
