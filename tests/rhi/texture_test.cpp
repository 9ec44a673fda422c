// SPDX-License-Identifier: MIT
#include "common.hpp"

#include <numeric>

namespace pelage::test {
namespace {

using Textures = RhiTest;

Texture make(Device& device, TextureDescriptor d) {
    return value(device.createTexture(d));
}
constexpr auto copies = TextureUsage::CopyDst | TextureUsage::CopySrc | TextureUsage::TextureBinding;

TEST_F(Textures, EveryFormatSurvivesUploadAndReadback) {
    using enum TextureFormat;
    for (const auto format : {R8Unorm, RG8Unorm, RGBA8Unorm, RGBA8UnormSrgb, BGRA8Unorm, BGRA8UnormSrgb, RGB10A2Unorm,
                              R8Uint, R16Float, RG16Float, RGBA16Float, RG11B10Ufloat, R32Float, RG32Float, RGBA32Float,
                              R32Uint, RG32Uint, RGBA32Uint, Depth32Float}) {
        SCOPED_TRACE(name(format));
        ASSERT_TRUE(device.supports(format, copies));
        const auto t = make(device, {.label = "t", .size = {7, 5, 1}, .format = format, .usage = copies});
        std::vector<std::uint8_t> bytes(7 * 5 * bytesPerTexel(format));
        // Small values: valid halves, floats and depths in every interpretation.
        for (std::size_t i = 0; i < bytes.size(); ++i)
            bytes[i] = static_cast<std::uint8_t>(i % 4 == 3 ? 0x3e : i * 7 % 60);
        succeed(device.queue().writeTexture({.texture = t}, std::as_bytes(std::span(bytes)), {}, {7, 5, 1}));
        EXPECT_EQ(read<std::uint8_t>(t), bytes);
        EXPECT_EQ(textureFormatFromName(name(format)), format);
    }
}

TEST_F(Textures, PartsOfMipsAndLayersAreWrittenWithRowPitch) {
    const auto t = make(
        device,
        {.label = "parts", .size = {8, 8, 3}, .mipLevelCount = 2, .format = TextureFormat::R8Unorm, .usage = copies});
    std::vector<std::uint8_t> zero(8 * 8 * 3, 0), patch(100, 9);
    std::iota(patch.begin(), patch.end(), std::uint8_t{1});
    auto q = device.queue();
    succeed(q.writeTexture({.texture = t}, std::as_bytes(std::span(zero)), {}, {8, 8, 3}));
    succeed(q.writeTexture({.texture = t, .mipLevel = 1}, std::as_bytes(std::span(zero)), {}, {4, 4, 3}));
    succeed(q.writeTexture({.texture = t, .mipLevel = 1, .origin = {1, 2, 2}}, std::as_bytes(std::span(patch)),
                           {.offset = 4, .bytesPerRow = 16}, {2, 2, 1}));
    const auto out = read<std::uint8_t>(t, 2, 1);
    EXPECT_EQ(out[2 * 4 + 1], 5);
    EXPECT_EQ(out[3 * 4 + 2], 22);
    EXPECT_EQ(std::accumulate(out.begin(), out.end(), 0), 5 + 6 + 21 + 22);
    EXPECT_EQ(read<std::uint8_t>(t, 1, 1), std::vector<std::uint8_t>(16, 0));
}

TEST_F(Textures, CubeViewsFaceTheirAxes) {
    const auto t = make(device, {.label = "cube", .size = {2, 2, 6}, .usage = copies, .cubeCompatible = true});
    std::vector<Texel> texels(4 * 6);
    for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = {static_cast<std::uint8_t>(40 * (i / 4)), 0, 0, 255};
    succeed(device.queue().writeTexture({.texture = t}, std::as_bytes(std::span(texels)), {}, {2, 2, 6}));
    const auto p = pipeline("full.vert", "cube.frag");
    const auto s = value(device.createSampler({.label = "nearest"}));
    const auto g = group(p.bindGroupLayout(0), {{0, view(t, {.dimension = TextureViewDimension::Cube})}, {1, s}});
    const auto out = drawTo(target(6, 1), p, g);
    for (std::size_t face = 0; face < 6; ++face) EXPECT_EQ(out[face][0], 40 * face);
}

TEST_F(Textures, LayersAreRenderedOneByOneAndSampledTogether) {
    const auto t = make(
        device,
        {.label = "layers", .size = {4, 4, 3}, .usage = TextureUsage::RenderAttachment | TextureUsage::TextureBinding});
    auto encoder = device.createCommandEncoder("layers");
    for (std::uint32_t i = 0; i < 3; ++i)
        encoder
            .beginRenderPass(clearPass(view(t, {.dimension = TextureViewDimension::E2D, .baseArrayLayer = i}),
                                       {(static_cast<double>(i) + 1) / 5, 0, 0, 1}))
            .end();
    const auto p = pipeline("full.vert", "layer.frag");
    const auto s = value(device.createSampler({.label = "nearest"}));
    const auto g = group(p.bindGroupLayout(0), {{0, view(t)}, {1, s}});
    const auto out = target(3, 1);
    auto pass = encoder.beginRenderPass(clearPass(view(out)));
    pass.setPipeline(p);
    pass.setBindGroup(0, g);
    pass.draw(3);
    pass.end();
    run(encoder);
    const auto texels = read<Texel>(out);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(texels[i][0], 51 * (i + 1));
}

TEST_F(Textures, OneLayerIsDrawnWhileAnotherIsSampled) {
    const auto t =
        make(device, {.label = "ping-pong",
                      .size = {4, 4, 2},
                      .usage = TextureUsage::RenderAttachment | TextureUsage::TextureBinding | TextureUsage::CopySrc});
    const auto layer = [&](std::uint32_t i) {
        return view(t, {.dimension = TextureViewDimension::E2D, .baseArrayLayer = i});
    };
    const auto p = pipeline("full.vert", "sample.frag");
    const auto s = value(device.createSampler({.label = "nearest"}));
    const auto g = group(p.bindGroupLayout(0), {{0, layer(0)}, {1, s}});
    auto encoder = device.createCommandEncoder("ping-pong");
    encoder.beginRenderPass(clearPass(layer(0), {0.4, 0, 0, 1})).end();
    auto pass = encoder.beginRenderPass(clearPass(layer(1)));
    pass.setPipeline(p);
    pass.setBindGroup(0, g);
    pass.draw(3);
    pass.end();
    run(encoder);
    EXPECT_EQ(read<Texel>(t, 1)[7], (Texel{102, 0, 0, 255}));
}

TEST_F(Textures, LinearFilteringBlendsAndVolumesAreCopied) {
    const auto t = make(device, {.label = "two", .size = {2, 1, 1}, .usage = copies});
    const std::vector<Texel> texels = {{0, 0, 0, 255}, {200, 0, 0, 255}};
    succeed(device.queue().writeTexture({.texture = t}, std::as_bytes(std::span(texels)), {}, {2, 1, 1}));
    const auto p = pipeline("full.vert", "sample.frag");
    const auto s = value(
        device.createSampler({.label = "linear", .magFilter = FilterMode::Linear, .minFilter = FilterMode::Linear}));
    const auto out = drawTo(target(3, 1), p, group(p.bindGroupLayout(0), {{0, view(t)}, {1, s}}));
    EXPECT_NEAR(out[1][0], 100, 1);
    const auto volume = make(device, {.label = "volume",
                                      .size = {2, 2, 2},
                                      .dimension = TextureDimension::E3D,
                                      .format = TextureFormat::R8Unorm,
                                      .usage = copies});
    const std::vector<std::uint8_t> cells = {1, 2, 3, 4, 5, 6, 7, 8};
    succeed(device.queue().writeTexture({.texture = volume}, std::as_bytes(std::span(cells)), {}, {2, 2, 2}));
    EXPECT_EQ(read<std::uint8_t>(volume, 1), (std::vector<std::uint8_t>{5, 6, 7, 8}));
    EXPECT_EQ(view(volume).descriptor().dimension, TextureViewDimension::E3D);
}

TEST_F(Textures, CopyBetweenTextures) {
    const auto a = make(device, {.label = "a", .size = {4, 4, 1}, .usage = copies});
    const auto b = make(device, {.label = "b", .size = {4, 4, 2}, .usage = copies});
    const std::vector<Texel> texels(16, Texel{1, 2, 3, 4}), none(32, Texel{});
    succeed(device.queue().writeTexture({.texture = a}, std::as_bytes(std::span(texels)), {}, {4, 4, 1}));
    succeed(device.queue().writeTexture({.texture = b}, std::as_bytes(std::span(none)), {}, {4, 4, 2}));
    auto encoder = device.createCommandEncoder("copy");
    encoder.copyTextureToTexture({.texture = a}, {.texture = b, .origin = {1, 1, 1}}, {2, 2, 1});
    run(encoder);
    const auto out = read<Texel>(b, 1);
    EXPECT_EQ(out[5], (Texel{1, 2, 3, 4}));
    EXPECT_EQ(out[0], (Texel{}));
    EXPECT_EQ(out[15], (Texel{}));
}

TEST_F(Textures, ViewsAreCachedAndHaveTheirDefaults) {
    const auto t = make(device, {.label = "array", .size = {4, 4, 3}, .mipLevelCount = 3, .usage = copies});
    const auto a = view(t), b = view(t);
    EXPECT_EQ(a, b);
    EXPECT_EQ(a.descriptor().dimension, TextureViewDimension::E2DArray);
    EXPECT_EQ(a.descriptor().arrayLayerCount, 3U);
    EXPECT_EQ(a.descriptor().mipLevelCount, 3U);
    EXPECT_NE(a, view(t, {.baseMipLevel = 1}));
    EXPECT_EQ(a.texture(), t);
}

}  // namespace
}  // namespace pelage::test
