// SPDX-License-Identifier: MIT
// 3D images, mip levels, counts inside a buffer, and constants of classes, on a device and exact.
#include "graph_fixture.hpp"

namespace pelage::passes::test {
namespace {

class GraphVolumeTest : public GraphTest {
protected:
    // One 2D slice of a level of a 3D image.
    std::vector<float> slice(const rhi::Texture& source, std::uint32_t level, std::uint32_t z) {
        const rhi::Extent3D size = levelExtent(source.size(), true, level);
        const std::uint64_t bytes = std::uint64_t{4} * size.width * size.height;
        auto target = buffer("slice", bytes, rhi::BufferUsage::MapRead | rhi::BufferUsage::CopyDst);
        auto encoder = gpu.device.createCommandEncoder("slice");
        encoder.copyTextureToBuffer({.texture = source, .mipLevel = level, .origin = {0, 0, z}}, {.buffer = target},
                                    {size.width, size.height, 1});
        run(encoder);
        std::vector<float> out(bytes / 4);
        std::memcpy(out.data(), target.mapped().data(), bytes);
        return out;
    }
};

constexpr const char* pyramid = R"json({
  "format": "pelage.passtree/1", "name": "Pyramid",
  "settings": { "cells": { "type": "uint", "default": 8, "min": 1, "max": 64 } },
  "attachments": {
    "Grid": { "format": "R32Float", "size": { "square": { "setting": "cells" }, "depth": { "setting": "cells" } },
              "mipLevels": "full" },
    "Kept": { "format": "R32Float", "size": { "like": "att.Grid" }, "mipLevels": "full" },
    "Values": { "kind": "buffer", "bytes": 32 }
  },
  "passes": [
    { "name": "Fill", "kind": "compute", "shader": "volume.comp", "dispatchLike": "grid", "threads": [4, 4, 4],
      "slots": { "grid": { "access": "write", "as": "storage", "bind": "i_grid" } },
      "connect": { "grid": "att.Grid" }, "constants": { "gain": 2 } },
    { "name": "Half1", "kind": "compute", "shader": "half.comp", "dispatchLike": "coarse", "threads": [4, 4, 4],
      "slots": { "fine": { "access": "read", "as": "sampled", "bind": "u_fine", "level": 0 },
                 "coarse": { "access": "readWrite", "as": "storage", "bind": "i_coarse", "level": 1 } },
      "connect": { "fine": "Fill.grid", "coarse": "Fill.grid" } },
    { "name": "Half2", "kind": "compute", "shader": "half.comp", "dispatchLike": "coarse", "threads": [4, 4, 4],
      "slots": { "fine": { "access": "read", "as": "sampled", "bind": "u_fine", "level": 1 },
                 "coarse": { "access": "readWrite", "as": "storage", "bind": "i_coarse", "level": 2 } },
      "connect": { "fine": "Half1.coarse", "coarse": "Half1.coarse" } },
    { "name": "Half3", "kind": "compute", "shader": "half.comp", "dispatchLike": "coarse", "threads": [4, 4, 4],
      "slots": { "fine": { "access": "read", "as": "sampled", "bind": "u_fine", "level": 2 },
                 "coarse": { "access": "readWrite", "as": "storage", "bind": "i_coarse", "level": 3 } },
      "connect": { "fine": "Half2.coarse", "coarse": "Half2.coarse" } },
    { "name": "Keep", "kind": "copy",
      "slots": { "from": { "access": "read", "as": "copy" }, "to": { "access": "write", "as": "copy" } },
      "connect": { "from": "Half3.coarse", "to": "att.Kept" } },
    { "name": "Look", "kind": "compute", "shader": "levels.comp",
      "slots": { "grid": { "access": "read", "as": "sampled", "bind": "u_grid" },
                 "values": { "access": "write", "as": "storage", "bind": "b_values", "clear": 0 } },
      "connect": { "grid": "Half3.coarse", "values": "att.Values" } }
  ],
  "exports": { "Grid": { "from": "Half3.coarse" }, "Kept": { "from": "Keep.to" }, "Values": { "from": "Look.values" } }
})json";

TEST_F(GraphVolumeTest, APyramidIsBuiltPassByPass) {
    Graph made = graph();
    mustBuild(made, pyramid, {.extent = {4, 4, 1}});
    frame(made);
    // Texel (x, y, z) is 2 (x + 8 y + 64 z): linear, so the mean of eight lies in their middle.
    const auto at = [](double x, double y, double z) { return static_cast<float>(2 * (x + 8 * y + 64 * z)); };
    for (const char* name : {"Grid", "Kept"}) {
        const rhi::Texture grid = made.exported(name);
        ASSERT_EQ(grid.size(), (rhi::Extent3D{8, 8, 8}));
        EXPECT_EQ(grid.descriptor().dimension, rhi::TextureDimension::E3D);
        for (std::uint32_t level = 0; level < 4; ++level) {
            const std::uint32_t side = 8U >> level;
            const double step = 1U << level, middle = (step - 1) / 2;
            for (std::uint32_t z = 0; z < side; ++z) {
                const std::vector<float> texels = slice(grid, level, z);
                for (std::uint32_t i = 0; i < side * side; ++i)
                    ASSERT_EQ(texels[i], at(step * (i % side) + middle, step * (i / side) + middle, step * z + middle))
                        << name << " level " << level << ", " << i << ", " << z;
            }
        }
    }
    EXPECT_EQ(read<float>(made.exportedBuffer("Values"), 8),
              (std::vector<float>{0, at(0.5, 0.5, 0.5), at(1.5, 1.5, 1.5), at(3.5, 3.5, 3.5), -1, -1, -1, 4}));
}

TEST_F(GraphVolumeTest, TargetsOfOneLevelAreAsLargeAsIt) {
    // A raster triangle in level 0, then two levels of maxima by fullscreen passes, with all that is unwritten painted.
    Graph made = graph(true);
    mustBuild(made, R"json({
  "format": "pelage.passtree/1", "name": "Maxima", "views": { "main": { "count": 1 } }, "drawLists": ["all"],
  "attachments": { "Chain": { "format": "RGBA8Unorm", "size": { "frame": 1 }, "mipLevels": 3 } },
  "passes": [
    { "name": "Draw", "kind": "raster", "view": "main", "drawList": "all",
      "slots": { "color": { "access": "write", "as": "color", "clear": [0, 0, 0, 0] } },
      "connect": { "color": "att.Chain" } },
    { "name": "One", "kind": "fullscreen", "shader": "shrink.frag",
      "slots": { "fine": { "access": "read", "as": "sampled", "bind": "u_fine", "level": 0 },
                 "color": { "access": "readWrite", "as": "color", "level": 1 } },
      "connect": { "fine": "Draw.color", "color": "Draw.color" } },
    { "name": "Two", "kind": "fullscreen", "shader": "shrink.frag",
      "slots": { "fine": { "access": "read", "as": "sampled", "bind": "u_fine", "level": 1 },
                 "color": { "access": "readWrite", "as": "color", "level": 2 } },
      "connect": { "fine": "One.color", "color": "One.color" } }
  ],
  "exports": { "Chain": { "from": "Two.color" } } })json",
              {.extent = {16, 16, 1}});
    frame(made);
    const rhi::Texture chain = made.exported("Chain");
    const Pixel full{64, 128, 255, 255}, none{0, 0, 0, 0};
    // The triangle is what lies below the diagonal; of four texels one is enough.
    EXPECT_EQ(read<Pixel>(chain, 0, 0)[15 * 16], full);
    EXPECT_EQ(read<Pixel>(chain, 0, 0)[15], none);
    const auto one = read<Pixel>(chain, 0, 1), two = read<Pixel>(chain, 0, 2);
    ASSERT_EQ(one.size(), 64U);
    ASSERT_EQ(two.size(), 16U);
    for (std::size_t i = 0; i < 64; ++i) EXPECT_EQ(one[i], i / 8 >= i % 8 ? full : none) << i;
    for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(two[i], i / 4 >= i % 4 ? full : none) << i;
}

TEST_F(GraphVolumeTest, AVolumeThatIsOffIsEmpty) {
    std::string text = pyramid;
    text = edited(text, R"("grid": "Half3.coarse", "values")",
                  R"("grid": ["Half3.coarse", "const.transparent3D"], "values")");
    for (const char* name : {"Half1", "Half2", "Half3", "Fill", "Keep"})
        text = edited(text, std::string("\"name\": \"") + name + "\",",
                      std::string("\"name\": \"") + name + "\", \"enabled\": false,");
    text = edited(text, R"("Grid": { "from": "Half3.coarse" }, "Kept": { "from": "Keep.to" }, )", "");
    Graph made = graph();
    mustBuild(made, text, {.extent = {4, 4, 1}});
    frame(made);
    EXPECT_EQ(read<float>(made.exportedBuffer("Values"), 8), (std::vector<float>{0, -1, -1, -1, -1, -1, -1, 1}));
}

TEST_F(GraphVolumeTest, AShaderThatTakesItForFlatIsRefused) {
    Graph made = graph();
    const auto built = build(made, R"json({
  "format": "pelage.passtree/1", "name": "Flat",
  "attachments": { "Grid": { "format": "R32Float", "size": { "square": 4, "depth": 4 } },
                   "Out": { "format": "RGBA8Unorm", "size": { "frame": 1 } } },
  "passes": [
    { "name": "Fill", "kind": "compute", "shader": "volume.comp",
      "slots": { "grid": { "access": "write", "as": "storage", "bind": "i_grid" } }, "connect": { "grid": "att.Grid" } },
    { "name": "Tint", "kind": "fullscreen", "shader": "tint.frag",
      "slots": { "source": { "access": "read", "as": "sampled", "bind": "u_source" },
                 "color": { "access": "write", "as": "color" } },
      "connect": { "source": "Fill.grid", "color": "att.Out" } }
  ],
  "exports": { "Out": { "from": "Tint.color" } } })json",
                             {.extent = {4, 4, 1}});
    ASSERT_FALSE(built);
    EXPECT_EQ(built.error().items().front().code, Code("P075")) << built.error().text();
    EXPECT_NE(built.error().text().find("texture3D"), std::string::npos) << built.error().text();
}

// The arguments lie behind the first 16 bytes, which hold none.
TEST_F(GraphVolumeTest, CountsMayLieAnywhereInABuffer) {
    Graph made = graph();
    const std::string text = R"json({
  "format": "pelage.passtree/1", "name": "Counts",
  "imports": { "Arguments": { "kind": "buffer", "access": "read" } },
  "attachments": { "Values": { "kind": "buffer", "bytes": 64 }, "Zeros": { "kind": "buffer", "bytes": 64 } },
  "passes": [
    { "name": "Zero", "kind": "compute", "shader": "count.comp", "dispatchIndirect": { "slot": "arguments" },
      "slots": { "arguments": { "access": "read", "as": "indirect" },
                 "last": { "access": "readWrite", "as": "storage", "bind": "b_last", "clear": 0 },
                 "now": { "access": "write", "as": "storage", "bind": "b_now", "clear": 0 } },
      "connect": { "arguments": "host.Arguments", "last": "att.Values", "now": "att.Zeros" } },
    { "name": "Count", "kind": "compute", "shader": "count.comp",
      "dispatchIndirect": { "slot": "arguments", "offset": 16 },
      "slots": { "arguments": { "access": "read", "as": "indirect" },
                 "last": { "access": "read", "as": "storage", "bind": "b_last" },
                 "now": { "access": "readWrite", "as": "storage", "bind": "b_now" } },
      "connect": { "arguments": "host.Arguments", "last": "Zero.now", "now": "Zero.last" } }
  ],
  "exports": { "Values": { "from": "Count.now" } } })json";
    HostDescription host{.extent = {4, 4, 1}};
    host.imports["Arguments"] = {true};
    mustBuild(made, text, host);
    const rhi::Buffer arguments =
        bufferOf<std::uint32_t>("arguments", {0, 0, 0, 0, 3, 1, 1, 0}, rhi::BufferUsage::Indirect);
    frame(made, {.buffers = {{"Arguments", arguments}}});
    std::vector<std::uint32_t> expected(16, 0);
    std::fill_n(expected.begin(), 12, 1U);  // three workgroups of four
    EXPECT_EQ(read<std::uint32_t>(made.exportedBuffer("Values"), 16), expected);
}

TEST_F(GraphVolumeTest, AClassGivesItsShadersTheConstantsOfTheFile) {
    const std::string text = R"json({
  "format": "pelage.passtree/1", "name": "Class",
  "settings": { "gain": { "type": "uint", "default": 3, "min": 1, "max": 9 } },
  "attachments": { "Grid": { "format": "R32Float", "size": { "fixed": [4, 2], "depth": 2 } } },
  "passes": [
    { "name": "Fill", "class": "Fill",
      "slots": { "grid": { "access": "write", "as": "storage", "bind": "i_grid" } }, "connect": { "grid": "att.Grid" },
      "constants": { "gain": { "setting": "gain" } } }
  ],
  "exports": { "Grid": { "from": "Fill.grid" } } })json";
    PassClassRegistry classes;
    classes.add({.info = {.name = "Fill", .kind = PassKind::Compute},
                 .create = [this](const PassSetup& setup) -> Result<PassRecorder> {
                     auto pipeline =
                         setup.device.createComputePipeline({.compute = setup.stage(value(shader("volume.comp")))});
                     if (!pipeline) return tl::unexpected(pipeline.error());
                     return PassRecorder([pipeline = *pipeline](PassContext& context) -> Result<void> {
                         auto group = context.bindGroup(pipeline.bindGroupLayout(1));
                         if (!group) return tl::unexpected(group.error());
                         context.compute->setPipeline(pipeline);
                         context.compute->setBindGroup(1, *group);
                         context.compute->dispatchWorkgroups(1);
                         return {};
                     });
                 }});
    Graph made({.device = gpu.device, .classes = std::move(classes)});
    mustBuild(made, text, {.extent = {4, 4, 1}});
    frame(made);
    EXPECT_EQ(slice(made.exported("Grid"), 0, 1), (std::vector<float>{24, 27, 30, 33, 36, 39, 42, 45}));
    const auto built =
        build(made, edited(text, "\"gain\": { \"setting\"", "\"gian\": { \"setting\""), {.extent = {4, 4, 1}});
    ASSERT_FALSE(built);
    EXPECT_EQ(built.error().items().front().code, Code("P077")) << built.error().text();
    EXPECT_EQ(built.error().items().front().line, 8U) << built.error().text();
    EXPECT_NE(built.error().text().find("'gain'"), std::string::npos) << built.error().text();
}

}  // namespace
}  // namespace pelage::passes::test
