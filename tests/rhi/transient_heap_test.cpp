// SPDX-License-Identifier: MIT
// Textures that share memory: which one owns which bytes, and that the next owner waits for all uses before.
#include "transient_heap.hpp"
#include "common.hpp"

namespace pelage::test {
namespace {

using detail::AccessState;
using detail::HeapOwners;
using detail::TextureState;

std::shared_ptr<TextureState> usedBy(VkPipelineStageFlags2 writes, VkPipelineStageFlags2 reads) {
    auto state = std::make_shared<TextureState>();
    state->states[0].writeStages = writes;
    state->states[0].readStages = reads;
    state->states[0].writeAccess = writes != 0 ? VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT : 0;
    return state;
}

TEST(HeapOwners, WhoTakesBytesOverWaitsForEveryoneWhoUsedThem) {
    HeapOwners owners(1000);
    const auto a = usedBy(1, 2), b = usedBy(4, 8), c = usedBy(0, 16);
    EXPECT_EQ(owners.take(0, 600, a).writeStages, 0U) << "fresh memory";
    EXPECT_EQ(owners.take(600, 1000, b).writeStages, 0U);
    const AccessState before = owners.take(500, 700, c);
    EXPECT_EQ(before.writeStages | before.readStages, 1U | 2U | 4U | 8U);
    EXPECT_NE(before.writeAccess, 0U);
    EXPECT_FALSE(a->current);
    EXPECT_FALSE(b->current);
    EXPECT_TRUE(c->current);
}

TEST(HeapOwners, BytesThatAnOwnerLostRememberItsUses) {
    HeapOwners owners(1000);
    owners.take(0, 1000, usedBy(1, 2));
    owners.take(0, 500, usedBy(4, 0));
    // The second half has no owner now, but the first texture's work may still be running on it.
    const AccessState before = owners.take(500, 1000, usedBy(0, 0));
    EXPECT_EQ(before.writeStages | before.readStages, 3U);
    EXPECT_EQ(owners.take(500, 1000, usedBy(0, 0)).writeStages, 0U) << "waited for once";
}

class TransientHeapTest : public RhiTest {
protected:
    static TextureDescriptor placed(const TransientHeap& heap, std::uint64_t offset) {
        return {.label = "placed",
                .size = {64, 64, 1},
                .usage = TextureUsage::RenderAttachment | TextureUsage::CopySrc,
                .heap = heap,
                .heapOffset = offset};
    }
    MemoryRequirements needs() { return value(device.memoryRequirements(placed({}, 0))); }
};

TEST_F(TransientHeapTest, TexturesInOnePlaceTakeTurns) {
    const auto heap = value(device.createTransientHeap({.label = "heap", .size = needs().size}));
    const auto before = device.memoryStatistics();
    const auto a = value(device.createTexture(placed(heap, 0))), b = value(device.createTexture(placed(heap, 0)));
    EXPECT_EQ(device.memoryStatistics().allocations, before.allocations) << "no memory beside the heap";
    EXPECT_EQ(a.memoryBytes(), needs().size);
    const auto draw = pipeline("full.vert", "white.frag");
    const auto fill = [&](CommandEncoder& encoder, const Texture& texture, bool white) {
        auto pass = encoder.beginRenderPass(clearPass(view(texture), {0, 1, 0, 1}));
        if (white) {
            pass.setPipeline(draw);
            pass.draw(3);
        }
        pass.end();
    };
    auto keep = [&](CommandEncoder& encoder, const Texture& texture) {
        const auto to = buffer("kept", 64 * 64 * 4, BufferUsage::CopyDst | BufferUsage::MapRead);
        encoder.copyTextureToBuffer({.texture = texture}, {.buffer = to}, {64, 64, 1});
        return to;
    };
    auto encoder = device.createCommandEncoder("turns");
    fill(encoder, a, true);
    const auto first = keep(encoder, a);
    fill(encoder, b, false);
    const auto second = keep(encoder, b);
    fill(encoder, a, true);
    const auto third = keep(encoder, a);
    const auto counters = run(encoder).counters();
    EXPECT_EQ(counters.barriers, 6U) << "one before each pass and each copy";
    const auto texel = [](const Buffer& kept) { return std::to_integer<int>(kept.mapped()[100 * 4]); };
    EXPECT_EQ(texel(first), 255);
    EXPECT_EQ(texel(second), 0);
    EXPECT_EQ(texel(third), 255);
}

TEST_F(TransientHeapTest, ThePlaceMustBeAlignedAndInside) {
    const auto n = needs();
    const auto heap = value(device.createTransientHeap({.label = "heap", .size = 2 * n.size}));
    device.pushErrorScope();
    EXPECT_FALSE(device.createTexture(placed(heap, 1)));
    const auto odd = device.popErrorScope();
    ASSERT_TRUE(odd);
    EXPECT_EQ(odd->code, ErrorCode::OutOfRange);
    EXPECT_NE(odd->text.find("a multiple of"), std::string::npos) << odd->text;
    device.pushErrorScope();
    EXPECT_FALSE(device.createTexture(placed(heap, 2 * n.size)));
    EXPECT_TRUE(device.popErrorScope());
    device.pushErrorScope();
    EXPECT_FALSE(device.createTransientHeap({.label = "nothing"}));
    EXPECT_EQ(value(Result<Diagnostic>(*device.popErrorScope())).code, ErrorCode::InvalidSize);
}

TEST_F(TransientHeapTest, TheHeapLivesAsLongAsItsTextures) {
    const auto start = device.memoryStatistics().usedBytes;
    Texture texture;
    {
        const auto heap = value(device.createTransientHeap({.label = "heap", .size = needs().size}));
        texture = value(device.createTexture(placed(heap, 0)));
    }
    const auto draw = pipeline("full.vert", "white.frag");
    EXPECT_EQ(drawTo(texture, draw)[0][0], 255);
    texture = {};
    succeed(device.waitIdle());
    device.collect();
    EXPECT_EQ(device.memoryStatistics().usedBytes, start);
}

}  // namespace
}  // namespace pelage::test
