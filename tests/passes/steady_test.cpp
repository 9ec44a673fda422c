// SPDX-License-Identifier: MIT
// A frame like the one before it: what the graph asks of the heap and of the driver when nothing has changed. No device
// is needed; the driver does nothing.
#include "support/counting_new.hpp"
#include "support/null_driver.hpp"

#include <pelage/passes/graph.hpp>
#include <pelage/rhi/vulkan.hpp>

#include <gtest/gtest.h>

namespace pelage::passes::test {
using pelage::test::allocations;
std::span<const std::uint32_t> embeddedShader(std::string_view name);

namespace {

template <class T>
T good(Result<T> result) {
    EXPECT_TRUE(result.has_value()) << result.error().text();
    return std::move(*result);
}

// A pass of each kind, layers, a history of an image and of a buffer, two imports whose names are too long to lie
// inside a string, counts from a buffer, and a class that asks for a group of its own.
constexpr const char* everything = R"json({
  "format": "pelage.passtree/1", "name": "Everything",
  "imports": { "AnImageThatTheHostLendsUsEachFrame": { "kind": "image", "access": "read" },
               "ABufferThatTheHostLendsUsEachFrame": { "kind": "buffer", "access": "read" } },
  "views": { "main": { "count": 1 }, "layers": { "count": 2 } }, "drawLists": ["all"],
  "attachments": {
    "Map":       { "format": "Depth32Float", "size": { "square": 16 }, "layers": 2 },
    "Depth":     { "format": "Depth32Float", "size": { "frame": 1 } },
    "Drawn":     { "format": "RGBA8Unorm", "size": { "frame": 1 } },
    "Sum":       { "format": "RGBA8Unorm", "size": { "frame": 1 }, "history": 1 },
    "Lit":       { "format": "RGBA8Unorm", "size": { "frame": 1 } },
    "Inverse":   { "format": "RGBA8Unorm", "size": { "frame": 1 } },
    "Copy":      { "format": "RGBA8Unorm", "size": { "frame": 1 } },
    "Arguments": { "kind": "buffer", "bytes": 12 },
    "Values":    { "kind": "buffer", "bytes": 256, "history": 1 }
  },
  "passes": [
    { "name": "AMapForEachOfTheLightsThatCastShadows", "kind": "raster", "view": "layers", "forEachView": "layer",
      "drawList": "all",
      "slots": { "map": { "access": "write", "as": "depth", "clear": { "depth": "far" } } },
      "connect": { "map": "att.Map" } },
    { "name": "Draw", "kind": "raster", "view": "main", "drawList": "all",
      "slots": { "picture": { "access": "read", "as": "sampled", "bind": "u_source" },
                 "depth": { "access": "write", "as": "depth", "clear": { "depth": "far" } },
                 "color": { "access": "write", "as": "color", "clear": [0, 0, 0, 1] } },
      "connect": { "picture": "host.AnImageThatTheHostLendsUsEachFrame", "depth": "att.Depth", "color": "att.Drawn" } },
    { "name": "Add", "kind": "fullscreen", "shader": "accumulate.frag",
      "slots": { "last": { "access": "read", "as": "sampled", "bind": "u_last" },
                 "sum": { "access": "write", "as": "color", "clear": [0.2, 0, 0, 1] } },
      "connect": { "last": "history.Sum", "sum": "att.Sum" } },
    { "name": "Light", "kind": "fullscreen", "shader": "shadowed.frag",
      "slots": { "map": { "access": "read", "as": "sampled", "bind": "u_map" },
                 "sky": { "access": "read", "as": "sampled", "bind": "u_sky", "optional": true },
                 "color": { "access": "write", "as": "color" } },
      "connect": { "map": "AMapForEachOfTheLightsThatCastShadows.map", "color": "att.Lit" } },
    { "name": "Invert", "kind": "compute", "shader": "invert.comp", "dispatchLike": "target", "threads": [8, 4, 1],
      "slots": { "source": { "access": "read", "as": "sampled", "bind": "u_source" },
                 "target": { "access": "write", "as": "storage", "bind": "i_target" } },
      "connect": { "source": "Light.color", "target": "att.Inverse" } },
    { "name": "Keep", "kind": "copy",
      "slots": { "from": { "access": "read", "as": "copy" }, "to": { "access": "write", "as": "copy" } },
      "connect": { "from": "Invert.target", "to": "att.Copy" } },
    { "name": "Ask", "kind": "compute", "shader": "arguments.comp",
      "slots": { "arguments": { "access": "write", "as": "storage", "bind": "b_arguments", "clear": 0 } },
      "connect": { "arguments": "att.Arguments" } },
    { "name": "Count", "class": "Count",
      "slots": { "arguments": { "access": "read", "as": "indirect" },
                 "last": { "access": "read", "as": "storage", "bind": "b_last" },
                 "lent": { "access": "read", "as": "uniform", "bind": "b_lent" },
                 "now": { "access": "write", "as": "storage", "bind": "b_now", "clear": 0 } },
      "connect": { "arguments": "Ask.arguments", "last": "history.Values", "now": "att.Values",
                   "lent": "host.ABufferThatTheHostLendsUsEachFrame" } }
  ],
  "exports": { "Copy": { "from": "Keep.to" }, "Sum": { "from": "Add.sum" }, "Drawn": { "from": "Draw.color" },
               "Values": { "from": "Count.now" } }
})json";

struct Steady {
    pelage::test::NullDriver driver;
    rhi::Device device;
    Graph graph;
    FrameImports imports[2];  // those of two frames in flight
    rhi::ComputePipeline count;
    rhi::RenderPipeline tint;
    std::uint32_t draws = 0;

    Steady() {
        driver.keepCommands = false;
        const auto instance = good(rhi::vulkan::createInstance({}, pelage::test::NullDriver::entry()));
        const auto adapter = good(instance.requestAdapter());
        device = good(adapter.requestDevice({.optionalFeatures = adapter.info().features}));
        count = good(device.createComputePipeline({.compute = {.module = shader("count.comp")}}));
        rhi::RenderPipelineDescriptor descriptor{.vertex = {.module = shader("fullscreen.vert")}};
        descriptor.fragment = {.module = shader("tint.frag")};
        descriptor.targets = {{.format = rhi::TextureFormat::RGBA8Unorm}};
        descriptor.depthStencil = {.format = rhi::TextureFormat::Depth32Float};
        tint = good(device.createRenderPipeline(descriptor));
        PassClassRegistry classes;
        classes.add({.info = {.name = std::string(drawListClass)}, .create = [this](const PassSetup&) {
                         return Result<PassRecorder>([this](PassContext& context) { return draw(context); });
                     }});
        classes.add({.info = {.name = "Count", .kind = PassKind::Compute}, .create = [this](const PassSetup&) {
                         return Result<PassRecorder>([this](PassContext& context) { return dispatch(context); });
                     }});
        graph = Graph({.device = device,
                       .shaders = [this](const std::string& file) -> Result<rhi::ShaderModule> { return shader(file); },
                       .classes = std::move(classes)});
        const auto tree = PassTree::parse(everything, "everything.pass.json");
        EXPECT_TRUE(tree) << tree.error().text();
        HostDescription host{.extent = {64, 32, 1}};
        host.imports["AnImageThatTheHostLendsUsEachFrame"] = {true, rhi::TextureFormat::RGBA8Unorm, {64, 32, 1}, 1};
        host.imports["ABufferThatTheHostLendsUsEachFrame"] = {true};
        const auto built = graph.build(**tree, host);
        EXPECT_TRUE(built) << built.error().text();
        for (FrameImports& each : imports) {
            each.textures["AnImageThatTheHostLendsUsEachFrame"] = good(device.createTexture(
                {.label = "lent", .size = {64, 32, 1}, .usage = rhi::TextureUsage::TextureBinding}));
            each.buffers["ABufferThatTheHostLendsUsEachFrame"] =
                good(device.createBuffer({.label = "lent", .size = 256, .usage = rhi::BufferUsage::Uniform}));
        }
    }
    rhi::ShaderModule shader(const std::string& name) const {
        const auto code = embeddedShader(name);
        EXPECT_FALSE(code.empty()) << name;
        return good(device.createShaderModule({.label = name, .code = {code.begin(), code.end()}}));
    }
    Result<void> draw(PassContext& context) {
        ++draws;
        if (context.targets.colors.empty()) return {};
        auto group = context.bindGroup(tint.bindGroupLayout(1));
        if (!group) return tl::unexpected(group.error());
        context.raster->setPipeline(tint);
        context.raster->setBindGroup(1, *group);
        context.raster->draw(3);
        return {};
    }
    Result<void> dispatch(PassContext& context) const {
        auto group = context.bindGroup(count.bindGroupLayout(1));
        if (!group) return tl::unexpected(group.error());
        context.compute->setPipeline(count);
        context.compute->setBindGroup(1, *group);
        context.compute->dispatchWorkgroupsIndirect(context.buffer("arguments"));
        return {};
    }
    void frame(const FrameImports& lent) {
        auto encoder = device.createCommandEncoder("frame");
        const auto recorded = graph.record(encoder, lent);
        ASSERT_TRUE(recorded) << recorded.error().text();
        const auto commands = encoder.finish();
        ASSERT_TRUE(commands) << commands.error().text();
        ASSERT_TRUE(device.queue().wait(*device.queue().submit(*commands)));
    }
};

TEST(SteadyFrame, AsksNothingOfTheHeapAndMakesNoObject) {
    Steady steady;
    for (std::size_t i = 0; i < 24; ++i) steady.frame(steady.imports[i % 2]);
    const std::uint64_t before = allocations;
    const std::size_t objects = steady.driver.alive().size();
    const std::uint64_t asked = allocations - before;  // what counting the objects takes
    for (std::size_t i = 0; i < 100; ++i) steady.frame(steady.imports[i % 2]);
    EXPECT_EQ(allocations - before - asked, 0U)
        << "in 100 frames of " << steady.graph.plan().passes.size() << " passes";
    EXPECT_EQ(steady.driver.alive().size(), objects);
    EXPECT_EQ(steady.draws, 124U * 3U);
}

// Five images that take turns are one more than is kept: each frame makes what the frame five before it had.
TEST(SteadyFrame, KeepsWhatFourFramesInFlightLend) {
    Steady steady;
    std::vector<FrameImports> lent(5, steady.imports[0]);
    for (FrameImports& each : lent)
        each.textures["AnImageThatTheHostLendsUsEachFrame"] = good(steady.device.createTexture(
            {.label = "lent", .size = {64, 32, 1}, .usage = rhi::TextureUsage::TextureBinding}));
    const auto asked = [&](std::size_t inFlight) {
        for (std::size_t i = 0; i < 40; ++i) steady.frame(lent[i % inFlight]);
        const std::uint64_t before = allocations;
        for (std::size_t i = 0; i < 20; ++i) steady.frame(lent[i % inFlight]);
        return allocations - before;
    };
    EXPECT_EQ(asked(4), 0U);
    EXPECT_GT(asked(5), 20U) << "a group for each frame";
}

}  // namespace
}  // namespace pelage::passes::test
