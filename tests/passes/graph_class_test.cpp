// SPDX-License-Identifier: MIT
// Passes that the host records itself: a class for each kind of encoder.
#include "graph_fixture.hpp"

namespace pelage::passes::test {
namespace {

constexpr const char* classes = R"json({
  "format": "pelage.passtree/1",
  "name": "Classes",
  "settings": { "gain": { "type": "uint", "default": 1, "min": 1, "max": 2 } },
  "views": { "layers": { "count": 2 } },
  "attachments": {
    "Flat":    { "format": "RGBA8Unorm", "size": { "frame": 1 }, "layers": 2 },
    "Inverse": { "format": "RGBA8Unorm", "size": { "frame": 1 } },
    "Copy":    { "format": "RGBA8Unorm", "size": { "frame": 1 } }
  },
  "templates": {
    "Painted": { "class": "Paint",
                 "slots": { "color": { "access": "write", "as": "color", "clear": [0, 0, 0, 1] } } }
  },
  "passes": [
    { "name": "Paint", "template": "Painted", "view": "layers", "forEachView": "layer",
      "connect": { "color": "att.Flat" }, "parameters": { "gain": { "setting": "gain" }, "order": "bgra" } },
    { "name": "Invert", "class": "Invert",
      "slots": { "source": { "access": "read", "as": "sampled", "bind": "u_source" },
                 "target": { "access": "write", "as": "storage", "bind": "i_target" } },
      "connect": { "source": "Paint.color", "target": "att.Inverse" } },
    { "name": "Copy", "class": "Copy",
      "slots": { "from": { "access": "read", "as": "copy" }, "to": { "access": "write", "as": "copy" } },
      "connect": { "from": "Invert.target", "to": "att.Copy" } }
  ],
  "exports": { "Out": { "from": "Copy.to" }, "Flat": { "from": "Paint.color" } }
})json";

class GraphClassTest : public GraphTest {
protected:
    using Made = Result<PassRecorder>;
    std::vector<std::uint32_t> layers;
    std::string grouped;
    int created = 0;

    PassClass paint() {
        using Type = ParameterInfo::Type;
        PassClass made{.info = {.name = "Paint", .kind = PassKind::Raster}};
        made.info.parameters = {{.name = "gain", .min = 1, .max = 4, .defaultNumber = 1},
                                {.name = "order", .type = Type::Word, .words = {"rgba", "bgra"}},
                                {.name = "loud", .type = Type::Bool, .defaultNumber = 1}};
        made.create = [this](const PassSetup& setup) -> Made {
            ++created;
            EXPECT_EQ(setup.parameters.word("order"), "bgra");
            EXPECT_EQ(setup.parameters.index("order"), 1U);
            EXPECT_TRUE(setup.parameters.flag("loud"));
            EXPECT_EQ(setup.parameters.number("absent"), 0);
            rhi::RenderPipelineDescriptor descriptor{.label = "paint",
                                                     .vertex = {.module = value(setup.shaders("fullscreen.vert"))}};
            descriptor.fragment = {.module = value(setup.shaders("triangle.frag"))};
            descriptor.targets.push_back({.format = setup.targets.colors.at(0)});
            auto pipeline = setup.device.createRenderPipeline(descriptor);
            if (!pipeline) return tl::unexpected(pipeline.error());
            return PassRecorder([this, pipeline = *pipeline](PassContext& context) -> Result<void> {
                layers.push_back(context.viewIndex);
                EXPECT_NE(context.raster, nullptr);
                EXPECT_EQ(context.compute, nullptr);
                EXPECT_EQ(context.copy, nullptr);
                context.raster->setPipeline(pipeline);
                // More gain, more rows.
                const auto rows = static_cast<std::uint32_t>(context.parameters.number("gain")) * 2;
                context.raster->setScissorRect(0, 0, context.extent.width, rows);
                context.raster->draw(3);
                context.draws += 1;
                return {};
            });
        };
        return made;
    }
    PassClass invert() {
        PassClass made{.info = {.name = "Invert", .kind = PassKind::Compute}};
        made.create = [this](const PassSetup& setup) -> Made {
            auto pipeline = setup.device.createComputePipeline(
                {.label = "invert", .compute = {.module = value(setup.shaders("invert.comp"))}});
            if (!pipeline) return tl::unexpected(pipeline.error());
            return PassRecorder([this, pipeline = *pipeline](PassContext& context) -> Result<void> {
                const auto group = context.bindGroup(pipeline.bindGroupLayout(1));
                if (!group) return tl::unexpected(group.error());
                EXPECT_EQ(context.texture("source").size().depthOrArrayLayers, 2U);
                EXPECT_FALSE(context.buffer("source"));
                context.compute->setPipeline(pipeline);
                context.compute->setBindGroup(1, *group);
                context.compute->dispatchWorkgroups((context.extent.width + 7) / 8, (context.extent.height + 3) / 4);
                context.draws += 1;
                return {};
            });
        };
        return made;
    }
    static PassClass copy() {
        PassClass made{.info = {.name = "Copy", .kind = PassKind::Copy}};
        made.create = [](const PassSetup&) -> Made {
            return PassRecorder([](PassContext& context) -> Result<void> {
                context.copy->copyTextureToTexture({.texture = context.texture("from")},
                                                   {.texture = context.texture("to")}, context.extent);
                return {};
            });
        };
        return made;
    }
    Graph graphWith(PassClassRegistry registry) {
        return Graph({.device = gpu.device,
                      .shaders = [this](const std::string& file) { return shader(file); },
                      .classes = std::move(registry)});
    }
    PassClassRegistry all() {
        PassClassRegistry registry;
        EXPECT_TRUE(registry.add(paint()));
        EXPECT_TRUE(registry.add(invert()));
        EXPECT_TRUE(registry.add(copy()));
        return registry;
    }
};

TEST_F(GraphClassTest, EachKindRecordsWithItsEncoder) {
    Graph made = graphWith(all());
    HostDescription host{.extent = {16, 8, 1}};
    mustBuild(made, classes, host);
    EXPECT_EQ(created, 1) << "once for a pass, not for a frame or a layer";
    for (int i = 0; i < 2; ++i) {
        layers.clear();
        auto encoder = gpu.device.createCommandEncoder("frame");
        pelage::test::succeed(made.record(encoder));
        run(encoder);
        EXPECT_EQ(layers, (std::vector<std::uint32_t>{0, 1}));
        const auto pixels = read<Pixel>(made.exported("Out"));
        EXPECT_EQ(pixels[0], (Pixel{191, 127, 0, 0})) << "what was painted, inverted";
        EXPECT_EQ(pixels[2 * 16], (Pixel{255, 255, 255, 0})) << "below two rows there is only the clear";
    }
    const auto reports = made.reports();
    ASSERT_EQ(reports.size(), 3U);
    EXPECT_EQ(reports[0].draws, 2U);
    EXPECT_EQ(reports[1].draws, 1U);
    host.settings["gain"] = {SettingValue::Type::Uint, 2, {}};
    mustBuild(made, classes, host);
    EXPECT_EQ(created, 2);
    auto encoder = gpu.device.createCommandEncoder("frame");
    pelage::test::succeed(made.record(encoder));
    run(encoder);
    EXPECT_EQ(read<Pixel>(made.exported("Out"))[2 * 16], (Pixel{191, 127, 0, 0})) << "a setting gave the parameter";
}

TEST_F(GraphClassTest, WhatAClassRefusesKeepsTheOldPlan) {
    PassClassRegistry registry = all();
    PassClass broken{.info = {.name = "Broken", .kind = PassKind::Copy}};
    broken.create = [](const PassSetup&) -> Made { return tl::unexpected(Diagnostic{.text = "no such luck"}); };
    PassClass empty{.info = {.name = "Empty", .kind = PassKind::Copy}};
    empty.create = [](const PassSetup&) -> Made { return PassRecorder(); };
    ASSERT_TRUE(registry.add(broken));
    ASSERT_TRUE(registry.add(empty));
    Graph made = graphWith(std::move(registry));
    const HostDescription host{.extent = {16, 8, 1}};
    mustBuild(made, classes, host);
    for (const std::string name : {"Broken", "Empty", "Invrt"}) {
        const auto built = build(made, edited(classes, R"("class": "Copy")", R"("class": ")" + name + "\""), host);
        ASSERT_FALSE(built) << name;
        const Diagnostic& fault = built.error().items().front();
        EXPECT_EQ(fault.code, name == "Invrt"   ? Code("P053")
                              : name == "Empty" ? Code("P072")
                                                : Code("X001"))
            << built.error().text();
        EXPECT_EQ(fault.line, 22U) << built.error().text();
        EXPECT_EQ(made.plansMade(), 1U);
    }
    auto encoder = gpu.device.createCommandEncoder("frame");
    pelage::test::succeed(made.record(encoder));
    run(encoder);
    EXPECT_EQ(read<Pixel>(made.exported("Out"))[0], (Pixel{191, 127, 0, 0}));
}

TEST_F(GraphClassTest, ARecorderThatFailsEndsTheFrame) {
    PassClassRegistry registry = all();
    PassClass failing{.info = {.name = "Failing", .kind = PassKind::Copy}};
    failing.create = [](const PassSetup&) -> Made {
        return PassRecorder(
            [](PassContext&) -> Result<void> { return tl::unexpected(Diagnostic{.text = "out of paint"}); });
    };
    ASSERT_TRUE(registry.add(failing));
    Graph made = graphWith(std::move(registry));
    mustBuild(made, edited(classes, R"("class": "Copy")", R"("class": "Failing")"), {.extent = {16, 8, 1}});
    auto encoder = gpu.device.createCommandEncoder("frame");
    const auto done = made.record(encoder);
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().first().text, "out of paint");
}

TEST(PassClassRegistry, KnowsEachNameOnce) {
    PassClassRegistry registry;
    PassClass one{.info = {.name = "One"}};
    EXPECT_FALSE(registry.add(one)) << "without create() it can record nothing";
    one.create = [](const PassSetup&) -> Result<PassRecorder> { return PassRecorder(); };
    EXPECT_TRUE(registry.add(one));
    EXPECT_FALSE(registry.add(one));
    one.info.name.clear();
    EXPECT_FALSE(registry.add(one));
    EXPECT_NE(registry.find("One"), nullptr);
    EXPECT_EQ(registry.find("Two"), nullptr);
    EXPECT_EQ(registry.infos().size(), 1U);
}

}  // namespace
}  // namespace pelage::passes::test
