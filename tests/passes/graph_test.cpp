// SPDX-License-Identifier: MIT
// Small frames on a device, read back exactly.
#include "graph_fixture.hpp"

namespace pelage::passes::test {
namespace {

constexpr const char* triangleTree = R"json({
  "format": "pelage.passtree/1",
  "name": "Triangle",
  "settings": {
    "msaa": { "type": "enum", "values": ["1", "4"], "default": "1" },
    "gain": { "type": "uint", "default": 1, "min": 1, "max": 2 },
    "swap": { "type": "bool", "default": false }
  },
  "views": { "main": { "count": 1 } },
  "drawLists": ["all"],
  "attachments": {
    "Drawn": { "format": "RGBA8Unorm", "size": { "frame": 1 }, "samples": { "setting": "msaa" } },
    "Depth": { "format": "Depth32Float", "size": { "frame": 1 }, "samples": { "setting": "msaa" } },
    "Flat":  { "format": "RGBA8Unorm", "size": { "frame": 1 } },
    "Out":   { "format": "RGBA8Unorm", "size": { "frame": 1 } }
  },
  "passes": [
    { "name": "Draw", "kind": "raster", "view": "main", "drawList": "all",
      "slots": {
        "depth": { "access": "write", "as": "depth", "clear": { "depth": "far" } },
        "color": { "access": "write", "as": "color", "clear": [0, 0, 0, 1] } },
      "connect": { "depth": "att.Depth", "color": "att.Drawn" } },
    { "name": "Average", "kind": "fullscreen", "shader": "average.frag", "enabledWhen": "msaa != '1'",
      "slots": {
        "source": { "access": "read", "as": "sampled", "bind": "u_source" },
        "color": { "access": "write", "as": "color" } },
      "connect": { "source": "Draw.color", "color": "att.Flat" } },
    { "name": "Tint", "kind": "fullscreen", "shader": "tint.frag",
      "slots": {
        "source": { "access": "read", "as": "sampled", "bind": "u_source" },
        "color": { "access": "write", "as": "color" } },
      "connect": { "source": ["Average.color", "Draw.color"], "color": "att.Out" },
      "constants": { "gain": { "setting": "gain" }, "swap": { "setting": "swap" } } }
  ],
  "exports": { "Picture": { "from": "Tint.color" } }
})json";

constexpr const char* shadowTree = R"json({
  "format": "pelage.passtree/1",
  "name": "Shadow",
  "settings": { "lights": { "type": "uint", "default": 2, "min": 0, "max": 4 } },
  "imports": { "Sky": { "kind": "imageCube", "access": "read", "optional": true } },
  "views": { "lights": { "count": { "setting": "lights" } } },
  "drawLists": ["all"],
  "attachments": {
    "Map": { "format": "Depth32Float", "size": { "square": 16 }, "layers": { "view": "lights" } },
    "Lit": { "format": "RGBA8Unorm", "size": { "frame": 1 } },
    "Inverse": { "format": "RGBA8Unorm", "size": { "like": "att.Lit" } },
    "Copy": { "format": "RGBA8Unorm", "size": { "like": "att.Lit" } }
  },
  "passes": [
    { "name": "Map", "kind": "raster", "view": "lights", "forEachView": "layer", "drawList": "all",
      "slots": { "map": { "access": "write", "as": "depth", "clear": { "depth": "far" } } },
      "connect": { "map": "att.Map" }, "whenDisabled": { "map": "const.depthFarArray" } },
    { "name": "Light", "kind": "fullscreen", "shader": "shadowed.frag",
      "slots": {
        "map": { "access": "read", "as": "sampled", "bind": "u_map" },
        "sky": { "access": "read", "as": "sampled", "bind": "u_sky", "optional": true },
        "color": { "access": "write", "as": "color" } },
      "connect": { "map": "Map.map", "sky": "host.Sky", "color": "att.Lit" } },
    { "name": "Invert", "kind": "compute", "shader": "invert.comp", "dispatchLike": "target", "threads": [8, 4, 1],
      "slots": {
        "source": { "access": "read", "as": "sampled", "bind": "u_source" },
        "target": { "access": "write", "as": "storage", "bind": "i_target" } },
      "connect": { "source": "Light.color", "target": "att.Inverse" } },
    { "name": "Keep", "kind": "copy",
      "slots": { "from": { "access": "read", "as": "copy" }, "to": { "access": "write", "as": "copy" } },
      "connect": { "from": "Invert.target", "to": "att.Copy" } }
  ],
  "exports": { "Lit": { "from": "Light.color" }, "Copy": { "from": "Keep.to" } }
})json";

// +Y is up in clip space and rows of an image go down: the triangle is what lies below the diagonal from top left.
bool inside(std::size_t x, std::size_t y) {
    return x < y;
}

TEST_F(GraphTest, TriangleThroughAFullscreenPassIsExact) {
    Graph made = graph();
    mustBuild(made, triangleTree, {.extent = {32, 32, 1}});
    frame(made);
    const auto pixels = read<Pixel>(made.exported("Picture"));
    ASSERT_EQ(pixels.size(), 32U * 32U);
    for (std::uint32_t y = 0; y < 32; ++y) {
        for (std::uint32_t x = 0; x < 32; ++x) {
            if (x == y) continue;  // the edge goes through these centres
            const Pixel expected = inside(x, y) ? Pixel{64, 128, 255, 255} : Pixel{0, 0, 0, 255};
            ASSERT_EQ(pixels[y * 32 + x], expected) << x << ", " << y;
        }
    }
    EXPECT_FALSE(made.exported("Nothing"));
}

TEST_F(GraphTest, SettingsReachSpecializationConstants) {
    Graph made = graph();
    HostDescription host{.extent = {8, 8, 1}};
    host.settings["gain"] = {SettingValue::Type::Uint, 2, {}};
    host.settings["swap"] = {SettingValue::Type::Bool, 1, {}};
    mustBuild(made, triangleTree, host);
    frame(made);
    EXPECT_EQ(read<Pixel>(made.exported("Picture"))[7 * 8], (Pixel{255, 255, 128, 255}));
}

TEST_F(GraphTest, SamplesAreAveraged) {
    Graph made = graph();
    HostDescription host{.extent = {32, 32, 1}};
    host.settings["msaa"] = {SettingValue::Type::Enum, 1, {}};
    mustBuild(made, triangleTree, host);
    ASSERT_EQ(made.plan().passes.size(), 3U);
    frame(made);
    const auto pixels = read<Pixel>(made.exported("Picture"));
    EXPECT_EQ(pixels[31 * 32], (Pixel{64, 128, 255, 255}));
    EXPECT_EQ(pixels[31], (Pixel{0, 0, 0, 255}));
    int partly = 0;
    for (std::uint32_t x = 0; x < 32; ++x) {
        const std::uint8_t blue = pixels[x * 32 + x][2];
        partly += blue > 0 && blue < 255 ? 1 : 0;
    }
    EXPECT_GT(partly, 28) << "pixels on the edge are covered by some of their samples";
}

TEST_F(GraphTest, ReportsCountFragmentsAndDraws) {
    Graph made = graph();
    mustBuild(made, triangleTree, {.extent = {32, 32, 1}});
    EXPECT_TRUE(made.reports().empty());
    frame(made);
    const auto reports = made.reports();
    ASSERT_EQ(reports.size(), 2U);
    EXPECT_EQ(reports[0].name, "Draw");
    EXPECT_EQ(reports[0].draws, 1U);
    EXPECT_EQ(reports[1].draws, 1U);
    if (gpu.device.has(rhi::Feature::PipelineStatistics)) {
        // Half of the target; a device that shades whole quads counts those too.
        EXPECT_GE(reports[0].fragments, 32U * 31U / 2);
        EXPECT_LE(reports[0].fragments, 32U * 32U);
        EXPECT_GE(reports[1].fragments, 32U * 32U);
        EXPECT_GE(reports[0].vertices, 3U);
    }
    if (gpu.device.has(rhi::Feature::Timestamps)) {
        double sum = 0;
        for (const PassReport& report : reports) sum += report.gpuMilliseconds;
        EXPECT_GT(sum, 0.0);
        EXPECT_GE(made.frameMilliseconds() * 1.0001, sum);
    }
}

TEST_F(GraphTest, EachLayerIsARenderPassOfItsOwn) {
    for (const DepthConvention depth : {DepthConvention::Reversed, DepthConvention::Conventional}) {
        Graph made = graph();
        mustBuild(made, shadowTree, {.extent = {12, 10, 1}, .depth = depth});
        std::vector<std::uint32_t> views;
        draws = [&](PassContext& context) {
            views.push_back(context.viewIndex);
            EXPECT_EQ(context.extent, (rhi::Extent3D{16, 16, 1}));
            // Into the first layer only: the others stay far.
            return context.viewIndex == 0 ? drawTriangle(context) : Result<void>{};
        };
        frame(made);
        EXPECT_EQ(views, (std::vector<std::uint32_t>{0, 1}));
        // The caster lies at 0.5: lit is what is as near or nearer. There is no sky, so black stands in.
        const bool reversed = depth == DepthConvention::Reversed;
        const Pixel lit{static_cast<std::uint8_t>(reversed ? 255 : 0), static_cast<std::uint8_t>(reversed ? 0 : 255), 0,
                        255};
        EXPECT_EQ(read<Pixel>(made.exported("Lit"))[0], lit);
        const Pixel inverse{static_cast<std::uint8_t>(255 - lit[0]), static_cast<std::uint8_t>(255 - lit[1]), 255, 0};
        const auto copied = read<Pixel>(made.exported("Copy"));
        EXPECT_EQ(copied.front(), inverse);
        EXPECT_EQ(copied.back(), inverse) << "the dispatch covers the whole image";
        EXPECT_EQ(made.reports()[0].draws, 1U);
    }
}

TEST_F(GraphTest, StandInOfADisabledPassIsUnshadowed) {
    for (const DepthConvention depth : {DepthConvention::Reversed, DepthConvention::Conventional}) {
        Graph made = graph();
        HostDescription host{.extent = {4, 4, 1}, .depth = depth};
        host.settings["lights"] = {SettingValue::Type::Uint, 0, {}};
        mustBuild(made, shadowTree, host);
        frame(made);
        EXPECT_EQ(read<Pixel>(made.exported("Lit"))[0], (Pixel{255, 255, 0, 255}));
    }
}

TEST_F(GraphTest, ImportsAreBoundAndMayChangeEachFrame) {
    Graph made = graph();
    HostDescription host{.extent = {4, 4, 1}};
    host.imports["Sky"] = {true, rhi::TextureFormat::RGBA8Unorm, {1, 1, 6}, 1};
    mustBuild(made, shadowTree, host);
    for (const std::uint8_t red : {std::uint8_t{255}, std::uint8_t{51}}) {
        const rhi::Texture sky =
            value(gpu.device.createTexture({.label = "sky",
                                            .size = {1, 1, 6},
                                            .usage = rhi::TextureUsage::TextureBinding | rhi::TextureUsage::CopyDst,
                                            .cubeCompatible = true}));
        std::vector<std::uint8_t> bytes;
        for (int layer = 0; layer < 6; ++layer) bytes.insert(bytes.end(), {red, 0, 0, 255});
        pelage::test::succeed(gpu.device.queue().writeTexture({.texture = sky}, std::as_bytes(std::span(bytes)),
                                                              {.bytesPerRow = 4, .rowsPerImage = 1}, {1, 1, 6}));
        frame(made, {.textures = {{"Sky", sky}}});
        EXPECT_EQ(read<Pixel>(made.exported("Lit"))[0][2], red);
    }
    auto encoder = gpu.device.createCommandEncoder("without");
    const auto lacking = made.record(encoder);
    ASSERT_FALSE(lacking);
    EXPECT_EQ(lacking.error().first().code, Code("P080"));
}

TEST_F(GraphTest, AFailedBuildKeepsTheOldPicture) {
    Graph made = graph();
    const HostDescription host{.extent = {8, 8, 1}};
    mustBuild(made, triangleTree, host);
    const std::pair<std::string, std::string> faults[] = {
        {edited(triangleTree, "\"Tint.color\"", "\"Tnt.color\""), "P016"},
        {edited(triangleTree, "tint.frag", "tin.frag"), "P070"},
        {edited(triangleTree, "\"gain\": { \"setting\": \"gain\" }", "\"gian\": { \"setting\": \"gain\" }"), "P077"},
        // The second slot of that bind is the one in Tint.
        {edited(triangleTree,
                "\"kind\": \"fullscreen\", \"shader\": \"tint.frag\",\n      \"slots\": {\n        \"source\": { "
                "\"access\": \"read\", \"as\": \"sampled\", \"bind\": \"u_source\"",
                "\"kind\": \"fullscreen\", \"shader\": \"tint.frag\",\n      \"slots\": {\n        \"source\": { "
                "\"access\": \"read\", \"as\": \"sampled\", \"bind\": \"u_sauce\""),
         "P073 P074"},
        {edited(triangleTree, "\"shader\": \"tint.frag\"", "\"shader\": \"average.frag\""), "P075"},
        {edited(triangleTree, "\"shader\": \"tint.frag\"", "\"shader\": \"two_targets.frag\""), "P076"},
        {edited(triangleTree, "\"Drawn\": { \"format\": \"RGBA8Unorm\", \"size\": { \"frame\": 1 }",
                "\"Drawn\": { \"format\": \"RGBA8Unorm\", \"size\": { \"square\": 32768 }"),
         "D002"},
    };
    for (const auto& [text, codes] : faults) {
        SCOPED_TRACE(codes);
        const auto built = build(made, text, host);
        ASSERT_FALSE(built);
        for (std::size_t at = 0; at < codes.size(); at += 5) {
            EXPECT_NE(built.error().text().find(codes.substr(at, 4)), std::string::npos) << built.error().text();
        }
        ASSERT_TRUE(made.valid());
        frame(made);
        EXPECT_EQ(read<Pixel>(made.exported("Picture"))[7 * 8], (Pixel{64, 128, 255, 255}));
    }
}

TEST_F(GraphTest, RecordBeforeBuildIsAnError) {
    Graph made = graph();
    auto encoder = gpu.device.createCommandEncoder("frame");
    EXPECT_FALSE(made.record(encoder));
    EXPECT_FALSE(made.valid());
    EXPECT_TRUE(made.plan().passes.empty());
}

TEST_F(GraphTest, WithoutTheClassNobodyDrawsAList) {
    Graph made({.device = gpu.device, .shaders = [this](const std::string& file) { return shader(file); }});
    const auto built = build(made, triangleTree, {.extent = {8, 8, 1}});
    ASSERT_FALSE(built);
    ASSERT_EQ(built.error().items().size(), 1U) << built.error().text();
    EXPECT_EQ(built.error().items().front().code, Code("P053"));
    EXPECT_NE(built.error().text().find("'all'"), std::string::npos) << built.error().text();
    EXPECT_EQ(built.error().items().front().line, 18U) << "where the list is named";
}

TEST_F(GraphTest, RasterPassesGetTheirBindGroups) {
    // A raster pass that samples: its class asks for the group of its pipeline's layout.
    const std::string text = edited(shadowTree, "\"kind\": \"fullscreen\", \"shader\": \"shadowed.frag\"",
                                    "\"kind\": \"raster\", \"view\": \"lights\", \"drawList\": \"all\"");
    const std::string cleared =
        edited(text, "\"color\": { \"access\": \"write\", \"as\": \"color\" }",
               "\"color\": { \"access\": \"write\", \"as\": \"color\", \"load\": \"dontCare\" }");
    Graph made = graph();
    mustBuild(made, cleared, {.extent = {4, 4, 1}});
    std::string missing;
    draws = [&](PassContext& context) -> Result<void> {
        EXPECT_EQ(context.pass.passClass, drawListClass);
        if (context.pass.name != "Light") return drawTriangle(context);
        rhi::RenderPipelineDescriptor descriptor{.label = "light",
                                                 .vertex = {.module = value(shader("fullscreen.vert"))}};
        descriptor.fragment = {.module = value(shader("shadowed.frag"))};
        descriptor.targets.push_back({.format = context.targets.colors.at(0)});
        const auto pipeline = value(gpu.device.createRenderPipeline(descriptor));
        const auto group = context.bindGroup(pipeline.bindGroupLayout(1));
        if (!group) return tl::unexpected(group.error());
        EXPECT_EQ(*group, *context.bindGroup(pipeline.bindGroupLayout(1))) << "made once";
        context.raster->setPipeline(pipeline);
        context.raster->setBindGroup(1, *group);
        context.raster->draw(3);
        // A layout that asks for what the pass has not.
        descriptor.fragment->module = value(shader("tint.frag"));
        const auto other = value(gpu.device.createRenderPipeline(descriptor));
        const auto refused = context.bindGroup(other.bindGroupLayout(1));
        if (!refused) missing = toString(refused.error().first());
        return {};
    };
    frame(made);
    EXPECT_EQ(read<Pixel>(made.exported("Lit"))[0], (Pixel{255, 0, 0, 255}));
    EXPECT_NE(missing.find("P074"), std::string::npos) << missing;
    EXPECT_NE(missing.find("u_source"), std::string::npos) << missing;
}

TEST_F(GraphTest, FramesOfManySizesLeaveNothingBehind) {
    gpu.device.collect();
    const auto before = gpu.device.memoryStatistics();
    {
        Graph made = graph();
        for (const std::uint32_t side : {1U, 7U, 64U, 129U}) {
            mustBuild(made, triangleTree, {.extent = {side, side + 3, 1}});
            frame(made);
            EXPECT_EQ(made.exported("Picture").size(), (rhi::Extent3D{side, side + 3, 1}));
        }
    }
    pelage::test::succeed(gpu.device.waitIdle());
    gpu.device.collect();
    EXPECT_EQ(gpu.device.memoryStatistics().liveTextures, before.liveTextures);
    EXPECT_EQ(gpu.device.memoryStatistics().liveBuffers, before.liveBuffers);
}

}  // namespace
}  // namespace pelage::passes::test
