// SPDX-License-Identifier: MIT
// The faults that the toggles are for, with the toggle off: each is there on a driver that has it and gone on one that
// does not, so that a workaround does not outlive its reason.
#include "common.hpp"

namespace pelage::test {
namespace {

using DriverFaults = RhiTest;

TEST_F(DriverFaults, AResolveIntoTheSecondLayerWritesNothingWhereTheToggleSaysSo) {
    const auto names = device.toggles();
    const bool faulty = std::find(names.begin(), names.end(), "resolveToFirstLayerOnly") != names.end();
    const auto plain = value(gpu.adapter.requestDevice({.toggles = {{"resolveToFirstLayerOnly", false}}}));
    const auto many = value(plain.createTexture(
        {.label = "many", .size = {8, 8, 1}, .sampleCount = 4, .usage = TextureUsage::RenderAttachment}));
    const auto layers = value(plain.createTexture(
        {.label = "layers", .size = {8, 8, 2}, .usage = TextureUsage::RenderAttachment | TextureUsage::CopySrc}));
    const auto back = value(
        plain.createBuffer({.label = "back", .size = 8 * 8 * 4, .usage = BufferUsage::CopyDst | BufferUsage::MapRead}));
    const auto second =
        value(layers.createView({.dimension = TextureViewDimension::E2D, .baseArrayLayer = 1, .arrayLayerCount = 1}));
    auto encoder = plain.createCommandEncoder();
    auto clear = encoder.beginRenderPass({.label = "clear", .colorAttachments = {{.view = second}}});
    clear.end();
    auto pass = encoder.beginRenderPass(
        {.label = "resolve",
         .colorAttachments = {
             {.view = value(many.createView()), .resolveTarget = second, .clearValue = {1, 1, 1, 1}}}});
    pass.end();
    encoder.copyTextureToBuffer({.texture = layers, .origin = {0, 0, 1}}, {.buffer = back}, {8, 8, 1});
    const auto sent = value(plain.queue().submit(value(encoder.finish())));
    EXPECT_TRUE(value(plain.queue().wait(sent)));
    EXPECT_EQ(std::to_integer<int>(back.mapped()[0]), faulty ? 0 : 255);
}

// The triangles of one pass must not wait in memory without bound; that it is interrupted for it must not show.
TEST_F(DriverFaults, APassInBatchesDrawsEverythingOnce) {
    std::uint32_t barriers[2] = {};
    for (const bool on : {false, true}) {
        const auto own = value(gpu.adapter.requestDevice({.toggles = {{"drawInBatches", on}}}));
        const auto sum = value(own.createTexture({.label = "sum",
                                                  .size = {4, 4, 1},
                                                  .format = TextureFormat::R32Float,
                                                  .usage = TextureUsage::RenderAttachment | TextureUsage::CopySrc}));
        const auto back = value(own.createBuffer(
            {.label = "back", .size = 4 * 4 * 4, .usage = BufferUsage::CopyDst | BufferUsage::MapRead}));
        const auto stage = [&](const char* name) {
            const auto code = embeddedShader(name);
            return value(own.createShaderModule({.label = name, .code = {code.begin(), code.end()}}));
        };
        const BlendComponent add = {BlendOperation::Add, BlendFactor::One, BlendFactor::One};
        const auto pipeline = value(own.createRenderPipeline(
            {.label = "add",
             .vertex = {stage("full.vert")},
             .fragment = ProgrammableStage{stage("color.frag"), {{"RED", 1}}},
             .targets = {{.format = TextureFormat::R32Float, .blend = BlendState{add, add}}}}));
        auto encoder = own.createCommandEncoder();
        auto pass = encoder.beginRenderPass(
            {.label = "many", .colorAttachments = {{.view = value(sum.createView()), .clearValue = {7, 0, 0, 0}}}});
        pass.setPipeline(pipeline);
        pass.draw(3, 50000);
        pass.draw(3, 1000);
        pass.end();
        encoder.copyTextureToBuffer({.texture = sum}, {.buffer = back}, {4, 4, 1});
        const auto commands = value(encoder.finish());
        EXPECT_TRUE(value(own.queue().wait(value(own.queue().submit(commands)))));
        float found = 0;
        std::memcpy(&found, back.mapped().data(), 4);
        EXPECT_EQ(found, 51007.0F);
        barriers[on ? 1 : 0] = commands.counters().barriers;
    }
    EXPECT_EQ(barriers[1], barriers[0] + 2) << "153,000 vertices in batches of at most 65,536";
}

}  // namespace
}  // namespace pelage::test
