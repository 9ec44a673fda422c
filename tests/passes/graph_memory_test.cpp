// SPDX-License-Identifier: MIT
// What outlives a pass on a device: heaps that images share, histories, buffers, and the plan itself.
#include "graph_fixture.hpp"

#include <cmath>

namespace pelage::passes::test {
namespace {

// A chain of fullscreen passes; each doubles what it reads.
std::string chain(int count) {
    std::string attachments, passes, before = "Draw.color";
    for (int i = 0; i < count; ++i) {
        const std::string n = std::to_string(i);
        attachments += ", \"A" + n + R"(": { "format": "RGBA8Unorm", "size": { "frame": 1 } })";
        passes += R"(, { "name": "P)" + n + R"(", "kind": "fullscreen", "shader": "tint.frag",
            "slots": { "in": { "access": "read", "as": "sampled", "bind": "u_source" },
                       "out": { "access": "write", "as": "color" } },
            "connect": { "in": ")" +
                  before + R"(", "out": "att.A)" + n + R"(" }, "constants": { "gain": 2 } })";
        before = "P" + n + ".out";
    }
    return R"({ "format": "pelage.passtree/1", "name": "Chain", "views": { "main": { "count": 1 } },
        "drawLists": ["all"], "attachments": { "Drawn": { "format": "RGBA8Unorm", "size": { "frame": 1 } })" +
           attachments + R"(}, "passes": [{ "name": "Draw", "kind": "raster", "view": "main", "drawList": "all",
            "slots": { "color": { "access": "write", "as": "color", "clear": [0.0078431372549, 0, 0, 1] } },
            "connect": { "color": "att.Drawn" } })" +
           passes + R"(], "exports": { "Out": { "from": ")" + before + R"(" }, "First": { "from": "P0.out" } } })";
}

class GraphMemoryTest : public GraphTest {};

TEST_F(GraphMemoryTest, ImagesInOneHeapKeepWhatIsStillRead) {
    draws = drawNothing;
    Graph made = graph();
    mustBuild(made, chain(6), {.extent = {64, 64, 1}});
    const Plan& plan = made.plan();
    EXPECT_LT(plan.heapBytes, plan.naiveBytes);
    const auto before = gpu.device.memoryStatistics();
    for (int i = 0; i < 3; ++i) {
        frame(made);
        EXPECT_EQ(read<Pixel>(made.exported("Out"))[0], (Pixel{128, 0, 0, 255})) << "2 doubled six times";
        EXPECT_EQ(read<Pixel>(made.exported("First"))[0], (Pixel{4, 0, 0, 255})) << "an export stays";
    }
    EXPECT_EQ(gpu.device.memoryStatistics().liveTextures, before.liveTextures);
    // What the driver wants is what was planned.
    for (const PlanResource& image : plan.resources) {
        if (image.heapOffset != notPlaced) {
            EXPECT_GE(image.heapBytes, image.bytes) << image.name;
        }
    }
}

TEST_F(GraphMemoryTest, PoisonShowsWhatAPassLeavesUnwritten) {
    // The triangle covers half of what "dontCare" promises to cover; the other half must not look like anything.
    const std::string text = R"json({
  "format": "pelage.passtree/1", "name": "Half", "views": { "main": { "count": 1 } }, "drawLists": ["all"],
  "attachments": { "Byte": { "format": "RGBA8Unorm", "size": { "frame": 1 } },
                   "Float": { "format": "RGBA32Float", "size": { "frame": 1 } } },
  "passes": [
    { "name": "Byte", "kind": "raster", "view": "main", "drawList": "all",
      "slots": { "color": { "access": "write", "as": "color", "load": "dontCare" } },
      "connect": { "color": "att.Byte" } },
    { "name": "Float", "kind": "raster", "view": "main", "drawList": "all",
      "slots": { "color": { "access": "write", "as": "color", "load": "dontCare" } },
      "connect": { "color": "att.Float" } }
  ],
  "exports": { "Byte": { "from": "Byte.color" }, "Float": { "from": "Float.color" } } })json";
    Graph made = graph(true);
    mustBuild(made, text, {.extent = {8, 8, 1}});
    frame(made);
    EXPECT_EQ(read<Pixel>(made.exported("Byte"))[7 * 8], (Pixel{64, 128, 255, 255}));
    EXPECT_EQ(read<Pixel>(made.exported("Byte"))[7], (Pixel{255, 0, 255, 255}));
    using Texel = std::array<float, 4>;
    EXPECT_EQ(read<Texel>(made.exported("Float"))[7 * 8], (Texel{0.25F, 0.5F, 1.0F, 1.0F}));
    EXPECT_TRUE(std::isnan(read<Texel>(made.exported("Float"))[7][0]));
}

TEST_F(GraphMemoryTest, ExportOfTheLastFrameStaysUntilTheNextIsRecorded) {
    draws = drawNothing;
    Graph made = graph();
    mustBuild(made, chain(4), {.extent = {16, 16, 1}});
    frame(made);
    // Other work in between, which has nothing to do with the graph.
    EXPECT_EQ(read<Pixel>(made.exported("First"))[0], (Pixel{4, 0, 0, 255}));
    EXPECT_EQ(read<Pixel>(made.exported("Out"))[0], (Pixel{32, 0, 0, 255}));
    EXPECT_EQ(read<Pixel>(made.exported("First"))[0], (Pixel{4, 0, 0, 255}));
}

constexpr const char* accumulation = R"json({
  "format": "pelage.passtree/1",
  "name": "Accumulation",
  "settings": { "spare": { "type": "bool", "default": false } },
  "attachments": {
    "Sum":   { "format": "RGBA8Unorm", "size": { "frame": 1 }, "history": 1 },
    "Spare": { "format": "RGBA8Unorm", "size": { "frame": 1 } }
  },
  "passes": [
    { "name": "Add", "kind": "fullscreen", "shader": "accumulate.frag",
      "slots": { "last": { "access": "read", "as": "sampled", "bind": "u_last" },
                 "sum": { "access": "write", "as": "color", "clear": [0.2, 0, 0, 1] } },
      "connect": { "last": "history.Sum", "sum": "att.Sum" } },
    { "name": "Copy", "kind": "fullscreen", "shader": "tint.frag", "enabledWhen": "spare",
      "slots": { "source": { "access": "read", "as": "sampled", "bind": "u_source" },
                 "color": { "access": "write", "as": "color" } },
      "connect": { "source": "Add.sum", "color": "att.Spare" } }
  ],
  "exports": { "Sum": { "from": "Add.sum" }, "Spare": { "from": "Copy.color", "optional": true } }
})json";

TEST_F(GraphMemoryTest, HistoryIsTheLastFrameAndBeginsWithTheClearValue) {
    const auto tree = PassTree::parse(accumulation, "accumulation.pass.json");
    ASSERT_TRUE(tree) << tree.error().text();
    Graph made = graph();
    HostDescription host{.extent = {8, 8, 1}};
    ASSERT_TRUE(made.build(**tree, host));
    const auto next = [&] {
        frame(made);
        return read<Pixel>(made.exported("Sum"))[9];
    };
    for (std::uint8_t i = 1; i <= 5; ++i) EXPECT_EQ(next(), (Pixel{51, 0, i, 255})) << "frame " << int(i);
    // Another setting is another plan, but the image is of the same shape: nothing is forgotten.
    host.settings["spare"] = {SettingValue::Type::Bool, 1, {}};
    ASSERT_TRUE(made.build(**tree, host));
    EXPECT_EQ(made.plansMade(), 2U);
    EXPECT_EQ(next(), (Pixel{51, 0, 6, 255}));
    EXPECT_EQ(next(), (Pixel{51, 0, 7, 255}));
    // Another size begins anew.
    host.extent = {12, 8, 1};
    ASSERT_TRUE(made.build(**tree, host));
    EXPECT_EQ(next(), (Pixel{51, 0, 1, 255}));
    EXPECT_EQ(next(), (Pixel{51, 0, 2, 255}));
}

TEST_F(GraphMemoryTest, DepthHistoryBeginsFar) {
    // Last frame's depth as a picture; no pass clears this frame's to anything else.
    const std::string text = R"json({
  "format": "pelage.passtree/1", "name": "Last", "views": { "main": { "count": 1 } }, "drawLists": ["all"],
  "attachments": { "Depth": { "format": "Depth32Float", "size": { "frame": 1 }, "history": 1 },
                   "Out": { "format": "RGBA8Unorm", "size": { "frame": 1 } } },
  "passes": [
    { "name": "Draw", "kind": "raster", "view": "main", "drawList": "all",
      "slots": { "depth": { "access": "write", "as": "depth", "clear": { "depth": "far" } } },
      "connect": { "depth": "att.Depth" } },
    { "name": "Show", "kind": "fullscreen", "shader": "tint.frag",
      "slots": { "source": { "access": "read", "as": "sampled", "bind": "u_source" },
                 "color": { "access": "write", "as": "color" } },
      "connect": { "source": "history.Depth", "color": "att.Out" } }
  ],
  "exports": { "Out": { "from": "Show.color" } } })json";
    for (const DepthConvention convention : {DepthConvention::Reversed, DepthConvention::Conventional}) {
        Graph made = graph();
        mustBuild(made, text, {.extent = {8, 8, 1}, .depth = convention});
        EXPECT_EQ(made.plan().passes.size(), 2U) << "who is read by the next frame is not culled";
        frame(made);
        const std::uint8_t far = convention == DepthConvention::Reversed ? 0 : 255;
        EXPECT_EQ(read<Pixel>(made.exported("Out"))[7 * 8][0], far);
        frame(made);  // the triangle of the last frame lies at 0.5
        EXPECT_NEAR(read<Pixel>(made.exported("Out"))[7 * 8][0], 127.5, 0.6);
        EXPECT_EQ(read<Pixel>(made.exported("Out"))[7][0], far);
    }
}

constexpr const char* counting = R"json({
  "format": "pelage.passtree/1",
  "name": "Counting",
  "attachments": {
    "Arguments": { "kind": "buffer", "bytes": 12 },
    "Values":    { "kind": "buffer", "bytes": { "perPixel": 0.5 }, "history": 1 },
    "Copied":    { "kind": "buffer", "bytes": { "perPixel": 0.5 } }
  },
  "passes": [
    { "name": "Ask", "kind": "compute", "shader": "arguments.comp",
      "slots": { "arguments": { "access": "write", "as": "storage", "bind": "b_arguments", "clear": 0 } },
      "connect": { "arguments": "att.Arguments" } },
    { "name": "Count", "kind": "compute", "shader": "count.comp", "dispatchIndirect": "arguments",
      "slots": { "arguments": { "access": "read", "as": "indirect" },
                 "last": { "access": "read", "as": "storage", "bind": "b_last" },
                 "now": { "access": "write", "as": "storage", "bind": "b_now", "clear": 0 } },
      "connect": { "arguments": "Ask.arguments", "last": "history.Values", "now": "att.Values" } },
    { "name": "Copy", "kind": "copy",
      "slots": { "from": { "access": "read", "as": "copy" }, "to": { "access": "write", "as": "copy" } },
      "connect": { "from": "Count.now", "to": "att.Copied" } }
  ],
  "exports": { "Values": { "from": "Count.now" }, "Copied": { "from": "Copy.to" } }
})json";

TEST_F(GraphMemoryTest, BuffersAreClearedCountedCopiedAndRemembered) {
    Graph made = graph();
    mustBuild(made, counting, {.extent = {8, 8, 1}});
    EXPECT_FALSE(made.exported("Values")) << "a buffer is no image";
    std::size_t count = 8;
    for (std::uint32_t i = 1; i <= 3; ++i) {
        frame(made);
        // 8 x 8 pixels of half a byte are 32 bytes; two workgroups of four, as the first pass said.
        EXPECT_EQ(read<std::uint32_t>(made.exportedBuffer("Values"), count), std::vector<std::uint32_t>(8, i));
        EXPECT_EQ(read<std::uint32_t>(made.exportedBuffer("Copied"), count), std::vector<std::uint32_t>(8, i));
    }
    // More pixels, as many workgroups: the rest of the buffer stays as it was cleared.
    mustBuild(made, counting, {.extent = {16, 8, 1}});
    frame(made);
    count = 16;
    std::vector<std::uint32_t> expected(count, 0);
    std::fill_n(expected.begin(), 8, 1U);
    EXPECT_EQ(read<std::uint32_t>(made.exportedBuffer("Values"), count), expected);
}

TEST_F(GraphMemoryTest, RasterPassesDrawFromTransientBuffersAsManyAsTheySay) {
    Graph made = graph();
    mustBuild(made, R"json({
  "format": "pelage.passtree/1", "name": "Vertices", "views": { "main": { "count": 1 } }, "drawLists": ["all"],
  "attachments": { "Corners": { "kind": "buffer", "bytes": 48 }, "Count": { "kind": "buffer", "bytes": 16 },
                   "Out": { "format": "RGBA8Unorm", "size": { "frame": 1 } } },
  "passes": [
    { "name": "Make", "kind": "compute", "shader": "corners.comp",
      "slots": { "corners": { "access": "write", "as": "storage", "bind": "b_corners" },
                 "count": { "access": "write", "as": "storage", "bind": "b_arguments" } },
      "connect": { "corners": "att.Corners", "count": "att.Count" } },
    { "name": "Draw", "kind": "raster", "view": "main", "drawList": "all",
      "slots": { "corners": { "access": "read", "as": "vertex" }, "count": { "access": "read", "as": "indirect" },
                 "color": { "access": "write", "as": "color", "clear": [0, 0, 0, 0] } },
      "connect": { "corners": "Make.corners", "count": "Make.count", "color": "att.Out" } }
  ],
  "exports": { "Out": { "from": "Draw.color" } } })json",
              {.extent = {8, 8, 1}});
    draws = [&](PassContext& context) -> Result<void> {
        rhi::RenderPipelineDescriptor descriptor{.label = "corners",
                                                 .vertex = {.module = value(shader("vertices.vert"))}};
        descriptor.fragment = {.module = value(shader("triangle.frag"))};
        descriptor.vertexBuffers = {{.arrayStride = 16, .attributes = {{.format = rhi::VertexFormat::Float32x4}}}};
        descriptor.targets.push_back({.format = context.targets.colors.at(0)});
        context.raster->setPipeline(value(gpu.device.createRenderPipeline(descriptor)));
        EXPECT_FALSE(context.buffer("color"));
        context.raster->setVertexBuffer(0, context.buffer("corners"));
        context.raster->drawIndirect(context.buffer("count"));
        return {};
    };
    frame(made);
    for (const Pixel& pixel : read<Pixel>(made.exported("Out"))) ASSERT_EQ(pixel, (Pixel{64, 128, 255, 255}));
}

TEST_F(GraphMemoryTest, APlanIsMadeOnceForWhatDoesNotChange) {
    const auto tree = PassTree::parse(accumulation, "accumulation.pass.json");
    ASSERT_TRUE(tree) << tree.error().text();
    Graph made = graph();
    HostDescription host{.extent = {8, 8, 1}};
    EXPECT_EQ(made.plansMade(), 0U);
    for (int i = 0; i < 10; ++i) ASSERT_TRUE(made.build(**tree, host));
    EXPECT_EQ(made.plansMade(), 1U);
    frame(made);
    const rhi::Texture picture = made.exported("Sum");
    ASSERT_TRUE(made.build(**tree, host));
    EXPECT_EQ(made.exported("Sum"), picture) << "nothing was made anew";
    made.invalidate();
    ASSERT_TRUE(made.build(**tree, host));
    EXPECT_EQ(made.plansMade(), 2U) << "asked for";
    // Each part of what a plan is made from makes another.
    host.extent = {9, 8, 1};
    ASSERT_TRUE(made.build(**tree, host));
    EXPECT_EQ(made.plansMade(), 3U);
    host.settings["spare"] = {SettingValue::Type::Bool, 1, {}};
    ASSERT_TRUE(made.build(**tree, host));
    EXPECT_EQ(made.plansMade(), 4U);
    host.depth = DepthConvention::Conventional;
    ASSERT_TRUE(made.build(**tree, host));
    EXPECT_EQ(made.plansMade(), 5U);
    const auto again = PassTree::parse(accumulation, "accumulation.pass.json");
    ASSERT_TRUE(made.build(**again, host));
    EXPECT_EQ(made.plansMade(), 6U) << "a tree that was read again is another tree";
    host.extent = {0, 8, 1};
    EXPECT_FALSE(made.build(**again, host));
    EXPECT_EQ(made.plansMade(), 6U);
    host.extent = {9, 8, 1};
    ASSERT_TRUE(made.build(**again, host));
    EXPECT_EQ(made.plansMade(), 6U) << "a build that failed leaves the plan as it was";
}

TEST_F(GraphMemoryTest, AnImportThatIsNotAsPlannedIsAnError) {
    const std::string text = R"json({
  "format": "pelage.passtree/1", "name": "Lent",
  "imports": { "In": { "kind": "image", "access": "read" } },
  "attachments": { "Out": { "format": "RGBA8Unorm", "size": { "frame": 1 } } },
  "passes": [{ "name": "Tint", "kind": "fullscreen", "shader": "tint.frag",
    "slots": { "source": { "access": "read", "as": "sampled", "bind": "u_source" },
               "color": { "access": "write", "as": "color" } },
    "connect": { "source": "host.In", "color": "att.Out" } }],
  "exports": { "Out": { "from": "Tint.color" } } })json";
    const auto tree = PassTree::parse(text, "lent.pass.json");
    ASSERT_TRUE(tree) << tree.error().text();
    const auto image = [&](rhi::TextureFormat format, rhi::Extent3D size) {
        return value(gpu.device.createTexture(
            {.label = "lent", .size = size, .format = format, .usage = rhi::TextureUsage::TextureBinding}));
    };
    Graph made = graph();
    HostDescription host{.extent = {8, 8, 1}};
    host.imports["In"] = {true, rhi::TextureFormat::RGBA8Unorm, {8, 8, 1}, 1};
    ASSERT_TRUE(made.build(**tree, host));
    const auto outcome = [&](const rhi::Texture& lent) {
        auto encoder = gpu.device.createCommandEncoder("frame");
        const auto done = made.record(encoder, {.textures = {{"In", lent}}});
        return done ? std::string("recorded") : std::string(done.error().first().code.text());
    };
    using Format = rhi::TextureFormat;
    EXPECT_EQ(outcome(image(Format::RGBA8Unorm, {8, 8, 1})), "recorded");
    EXPECT_EQ(outcome(image(Format::RGBA16Float, {8, 8, 1})), "P081");
    EXPECT_EQ(outcome(image(Format::RGBA8Unorm, {8, 9, 1})), "P081");
    EXPECT_EQ(outcome(image(Format::RGBA8Unorm, {8, 8, 2})), "P081");
    EXPECT_EQ(outcome({}), "P080");
    host.imports["In"].format = Format::RGBA16Float;
    ASSERT_TRUE(made.build(**tree, host));
    EXPECT_EQ(made.plansMade(), 2U);
    EXPECT_EQ(outcome(image(Format::RGBA16Float, {8, 8, 1})), "recorded");
}

}  // namespace
}  // namespace pelage::passes::test
