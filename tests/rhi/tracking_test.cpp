// SPDX-License-Identifier: MIT
// Barriers, without a device.
#include <gtest/gtest.h>

#include "tracking.hpp"

namespace pelage::rhi::detail {
namespace {

constexpr auto compute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr auto fragment = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
constexpr auto vertex = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT;

struct Tracked {
    AccessState state;
    bool use(UseKind kind, VkPipelineStageFlags2 stages) {
        batch.clear();
        batch.use(state, accessOf(kind, stages, false));
        return !batch.empty();
    }
    BarrierBatch batch;
};

TEST(Tracking, FirstUseOfABufferNeedsNoBarrier) {
    Tracked b;
    EXPECT_FALSE(b.use(UseKind::StorageBufferWrite, compute));
}

TEST(Tracking, ReadsNeedOneBarrierAfterAWriteAndNoneAmongThemselves) {
    Tracked b;
    b.use(UseKind::StorageBufferWrite, compute);
    EXPECT_TRUE(b.use(UseKind::StorageBufferRead, fragment));
    EXPECT_EQ(b.batch.memory().srcStageMask, compute);
    EXPECT_EQ(b.batch.memory().srcAccessMask, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    EXPECT_EQ(b.batch.memory().dstStageMask, fragment);
    EXPECT_FALSE(b.use(UseKind::StorageBufferRead, fragment));
    EXPECT_TRUE(b.use(UseKind::StorageBufferRead, vertex)) << "another stage has not seen the write";
    EXPECT_FALSE(b.use(UseKind::StorageBufferRead, fragment | vertex));
    EXPECT_TRUE(b.use(UseKind::UniformBuffer, fragment)) << "another access has not seen the write";
    EXPECT_FALSE(b.use(UseKind::UniformBuffer, vertex)) << "every stage sees every access";
}

TEST(Tracking, AWriteWaitsForEveryReaderSince) {
    Tracked b;
    b.use(UseKind::StorageBufferRead, fragment);
    b.use(UseKind::StorageBufferRead, vertex);
    b.use(UseKind::VertexBuffer, 0);
    EXPECT_TRUE(b.use(UseKind::StorageBufferWrite, compute));
    EXPECT_EQ(b.batch.memory().srcStageMask, fragment | vertex | VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT);
    EXPECT_TRUE(b.use(UseKind::StorageBufferWrite, compute)) << "write after write";
    EXPECT_EQ(b.batch.memory().srcStageMask, compute);
}

TEST(Tracking, ALayoutChangeIsAnImageBarrierAndSameLayoutReadsAreNone) {
    TextureState t;
    BarrierBatch batch;
    auto* const image = reinterpret_cast<VkImage>(std::uintptr_t{16});
    batch.use(t, image, {}, accessOf(UseKind::ColorAttachment, 0, false));
    ASSERT_EQ(batch.images().size(), 1U);
    EXPECT_EQ(batch.images()[0].oldLayout, VK_IMAGE_LAYOUT_UNDEFINED);
    batch.clear();
    batch.use(t, image, {}, accessOf(UseKind::ColorAttachment, 0, false));
    EXPECT_TRUE(batch.images().empty());
    EXPECT_TRUE(batch.hasMemory()) << "attachment after attachment is a hazard without a transition";
    batch.clear();
    batch.use(t, image, {}, accessOf(UseKind::Sampled, fragment, false));
    ASSERT_EQ(batch.images().size(), 1U);
    EXPECT_EQ(batch.images()[0].srcAccessMask & VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
              VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
    batch.clear();
    batch.use(t, image, {}, accessOf(UseKind::Sampled, fragment, false));
    EXPECT_TRUE(batch.empty());
    // The transition itself was made visible to the fragment stage only; compute chains onto it.
    batch.use(t, image, {}, accessOf(UseKind::Sampled, compute, false));
    EXPECT_TRUE(batch.hasMemory());
    EXPECT_EQ(batch.memory().srcStageMask, fragment);
    EXPECT_EQ(batch.memory().dstStageMask, fragment | compute);
}

TEST(Tracking, ABarrierForOthersShowsATransitionOnlyToWhatItNames) {
    BarrierLog log;
    BarrierBatch batch(&log);
    TextureState painted;
    AccessState read, written;
    auto* const image = reinterpret_cast<VkImage>(std::uintptr_t{16});
    const auto boundary = [&] {
        const bool any = !batch.empty();
        if (batch.hasMemory()) log.note(batch.memory());
        batch.clear();
        return any;
    };
    batch.use(painted, image, {}, accessOf(UseKind::ColorAttachment, 0, false));
    boundary();
    batch.use(painted, image, {}, accessOf(UseKind::Sampled, fragment, false));
    batch.use(read, accessOf(UseKind::StorageBufferRead, fragment, false));
    boundary();
    // Waits for the fragment shader and shows storage to compute, but not what was sampled.
    batch.use(read, accessOf(UseKind::StorageBufferWrite, compute, false));
    EXPECT_TRUE(boundary());
    batch.use(painted, image, {}, accessOf(UseKind::Sampled, compute, false));
    EXPECT_TRUE(boundary()) << "the painted texels never reached compute's caches";
}

TEST(Tracking, ABarrierMadeForAnotherResourceServesAsWell) {
    BarrierLog log;
    BarrierBatch batch(&log);
    AccessState a, b;
    const auto use = [&](AccessState& state, UseKind kind, VkPipelineStageFlags2 stages) {
        batch.use(state, accessOf(kind, stages, false));
        const bool any = !batch.empty();
        if (batch.hasMemory()) log.note(batch.memory());
        batch.clear();
        return any;
    };
    use(a, UseKind::StorageBufferWrite, compute);
    use(b, UseKind::StorageBufferWrite, compute);
    EXPECT_TRUE(use(a, UseKind::StorageBufferRead, fragment));
    EXPECT_FALSE(use(b, UseKind::StorageBufferRead, fragment)) << "the barrier just made is about all memory";
    EXPECT_TRUE(use(b, UseKind::StorageBufferRead, vertex)) << "which it did not name";
    EXPECT_FALSE(use(b, UseKind::StorageBufferRead, fragment));
    use(a, UseKind::StorageBufferWrite, compute);
    EXPECT_TRUE(use(a, UseKind::StorageBufferRead, fragment)) << "a write after the barrier needs a new one";
}

TEST(Tracking, SubresourcesDivergeAndComeTogetherAgain) {
    TextureState t;
    t.mips = 2;
    t.layers = 3;
    BarrierBatch batch;
    auto* const image = reinterpret_cast<VkImage>(std::uintptr_t{16});
    const Range all{0, 2, 0, 3};
    batch.use(t, image, all, accessOf(UseKind::CopyDestination, 0, false));
    EXPECT_EQ(batch.images().size(), 1U);
    EXPECT_EQ(t.states.size(), 1U);
    batch.clear();
    batch.use(t, image, {0, 1, 1, 2}, accessOf(UseKind::Sampled, fragment, false));
    ASSERT_EQ(batch.images().size(), 1U) << "two layers of one mip share a barrier";
    EXPECT_EQ(batch.images()[0].subresourceRange.baseArrayLayer, 1U);
    EXPECT_EQ(batch.images()[0].subresourceRange.layerCount, 2U);
    EXPECT_EQ(t.states.size(), 6U);
    batch.clear();
    batch.use(t, image, all, accessOf(UseKind::Sampled, fragment, false));
    EXPECT_EQ(batch.images().size(), 2U) << "what is left: one layer of mip 0, three of mip 1";
    EXPECT_EQ(t.states.size(), 1U);
}

TEST(Tracking, CompatibilityIsReadsInOneLayoutOrStorageWrites) {
    EXPECT_TRUE(compatible(UseKind::UniformBuffer, UseKind::VertexBuffer, false));
    EXPECT_TRUE(compatible(UseKind::StorageBufferWrite, UseKind::StorageBufferWrite, false));
    EXPECT_FALSE(compatible(UseKind::StorageBufferWrite, UseKind::StorageBufferRead, false));
    EXPECT_TRUE(compatible(UseKind::Sampled, UseKind::ReadOnlyDepth, true));
    EXPECT_FALSE(compatible(UseKind::Sampled, UseKind::DepthAttachment, true));
    EXPECT_FALSE(compatible(UseKind::Sampled, UseKind::StorageTextureRead, false));
    EXPECT_FALSE(compatible(UseKind::ColorAttachment, UseKind::ColorAttachment, false));
}

}  // namespace
}  // namespace pelage::rhi::detail
