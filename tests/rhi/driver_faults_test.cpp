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

}  // namespace
}  // namespace pelage::test
