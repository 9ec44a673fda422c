// SPDX-License-Identifier: MIT
// What the linker makes of a good tree: order, versions, sizes, load and store, lifetimes, places in the heap.
#include "tree_text.hpp"

#include <gtest/gtest.h>

namespace pelage::passes::test {
namespace {

using Names = std::vector<std::string>;

Plan plan(const std::string& text = wholeGrammar(), const HostDescription& lent = host()) {
    const auto tree = PassTree::parse(text, "tree.pass.json");
    EXPECT_TRUE(tree) << (tree ? "" : tree.error().text());
    if (!tree) return {};
    auto made = (*tree)->compile(lent);
    EXPECT_TRUE(made) << (made ? "" : made.error().text());
    return made ? *made : Plan{};
}

TEST(Plan, OrderFollowsFromData) {
    EXPECT_EQ(passNames(plan()), (Names{"Shadow", "Count", "Hair", "Glass", "Resolve", "Blur", "Final", "Keep"}));
}

TEST(Plan, CulledPassesAreNamedWithTheReason) {
    const Plan made = plan(edited(wholeGrammar(), R"("Kept":   { "from": "Keep.to" },)", ""));
    EXPECT_EQ(made.culled,
              (Names{"Keep: no export needs its result", "Present: switched off, not (host.has('Screen'))"}));
    EXPECT_EQ(resource(made, "att.Kept"), nullptr);
}

TEST(Plan, SideEffectsKeepAPass) {
    std::string text = edited(wholeGrammar(), R"("Kept":   { "from": "Keep.to" },)", "");
    text = edited(text, R"("name": "Keep",)", R"("name": "Keep", "sideEffects": true,)");
    EXPECT_NE(slot(plan(text), "Keep", "to"), nullptr);
}

TEST(Plan, DisabledPassGivesItsStandIn) {
    HostDescription lent = host();
    lent.settings["lights"] = whole(0);
    const Plan made = plan(wholeGrammar(), lent);
    EXPECT_EQ(slot(made, "Shadow", "map"), nullptr);
    EXPECT_EQ(resource(made, "att.Map"), nullptr);
    const PlanSlot* map = slot(made, "Hair", "map");
    ASSERT_NE(map, nullptr);
    EXPECT_EQ(made.resources[map->resource].name, "const.depthFarArray");
}

TEST(Plan, TheFirstAlternativeThatExistsIsTaken) {
    HostDescription lent = host();
    EXPECT_NE(slot(plan(), "Glass", "color"), nullptr);
    lent.settings["overlay"] = flag(false);
    const Plan made = plan(wholeGrammar(), lent);
    EXPECT_EQ(slot(made, "Glass", "color"), nullptr);
    EXPECT_EQ(made.resources[slot(made, "Resolve", "source")->resource].name, "att.Hair");
}

TEST(Plan, OptionalSlotsMayStayUnconnected) {
    EXPECT_EQ(slot(plan(), "Hair", "sky")->resource, ~0U);
    HostDescription lent = host();
    lent.imports["Sky"] = {true, rhi::TextureFormat::RGBA16Float, {16, 16, 6}, 1};
    const Plan made = plan(wholeGrammar(), lent);
    const PlanSlot* sky = slot(made, "Hair", "sky");
    ASSERT_NE(sky->resource, ~0U);
    EXPECT_TRUE(made.resources[sky->resource].cube);
    EXPECT_EQ(made.resources[sky->resource].kind, PlanResource::Kind::Import);
}

TEST(Plan, SizesSamplesAndLayers) {
    HostDescription lent = host();
    lent.extent = {101, 33, 1};
    lent.imports["Scene"].extent = {201, 99, 1};
    lent.settings["size"] = whole(512);
    lent.settings["lights"] = whole(3);
    lent.settings["msaa"] = word("1");
    const Plan made = plan(wholeGrammar(), lent);
    EXPECT_EQ(resource(made, "att.Map")->extent, (rhi::Extent3D{512, 512, 3}));
    EXPECT_EQ(resource(made, "att.Map")->layers, 3U);
    EXPECT_EQ(resource(made, "att.Map")->bytes, 512ULL * 512 * 4 * 3);
    EXPECT_EQ(resource(made, "att.Hair")->extent, (rhi::Extent3D{101, 33, 1}));
    EXPECT_EQ(resource(made, "att.Hair")->samples, 1U);
    EXPECT_EQ(resource(made, "att.Depth")->extent, (rhi::Extent3D{101, 33, 1}));
    EXPECT_EQ(resource(made, "att.Half")->extent, (rhi::Extent3D{101, 50, 1})) << "half, rounded up";
    EXPECT_EQ(resource(made, "att.Blur")->extent, (rhi::Extent3D{101, 50, 1}));
    EXPECT_EQ(resource(made, "att.Table")->extent, (rhi::Extent3D{16, 8, 1}));
    EXPECT_EQ(resource(plan(), "att.Hair")->bytes, 64ULL * 48 * 8 * 4);
    EXPECT_EQ(made.viewCounts.at("shadow"), 3U);
}

TEST(Plan, DispatchCoversAnImage) {
    const Plan made = plan();
    const PlanPass& count = made.passes[1];
    ASSERT_EQ(count.name, "Count");
    EXPECT_EQ(count.dispatch[0], 2U);
    EXPECT_EQ(count.dispatch[1], 2U);
    EXPECT_EQ(count.dispatch[2], 1U);
}

TEST(Plan, ShaderAndConstantsFollowSettings) {
    HostDescription lent = host();
    const auto resolve = [&] {
        const Plan made = plan(wholeGrammar(), lent);
        for (const PlanPass& pass : made.passes) {
            if (pass.name == "Resolve") return pass;
        }
        return PlanPass{};
    };
    EXPECT_EQ(resolve().shader, "resolve.frag");
    EXPECT_EQ(resolve().constants, (std::map<std::string, double>{{"gain", 1.5}, {"look", 0}, {"overlay", 1}}));
    lent.settings["msaa"] = word("1");
    lent.settings["look"] = word("hard");
    lent.settings["overlay"] = flag(false);
    EXPECT_EQ(resolve().shader, "copy.frag");
    EXPECT_EQ(resolve().constants, (std::map<std::string, double>{{"gain", 1.5}, {"look", 1}, {"overlay", 0}}));
}

TEST(Plan, FirstWriteClearsAndLastUseDiscards) {
    const Plan made = plan();
    EXPECT_EQ(slot(made, "Hair", "color")->load, rhi::LoadOp::Clear);
    EXPECT_EQ(slot(made, "Hair", "color")->store, rhi::StoreOp::Store);
    EXPECT_EQ(slot(made, "Glass", "color")->load, rhi::LoadOp::Load);
    EXPECT_EQ(slot(made, "Resolve", "color")->load, rhi::LoadOp::DontCare) << "a fullscreen pass covers its target";
    EXPECT_EQ(slot(made, "Hair", "depth")->store, rhi::StoreOp::Store) << "Glass tests against it";
    HostDescription lent = host();
    lent.settings["overlay"] = flag(false);
    EXPECT_EQ(slot(plan(wholeGrammar(), lent), "Hair", "depth")->store, rhi::StoreOp::Discard);
}

TEST(Plan, FarFollowsTheDepthConvention) {
    HostDescription lent = host();
    EXPECT_EQ(slot(plan(wholeGrammar(), lent), "Hair", "depth")->clearDepth, 0.0F);
    lent.depth = DepthConvention::Conventional;
    EXPECT_EQ(slot(plan(wholeGrammar(), lent), "Hair", "depth")->clearDepth, 1.0F);
    const std::string text = edited(wholeGrammar(), R"("as": "depth", "clear": { "depth": "far" } },
        "color")",
                                    R"("as": "depth", "clear": { "depth": "near" } },
        "color")");
    EXPECT_EQ(slot(plan(text, lent), "Hair", "depth")->clearDepth, 0.0F);
}

TEST(Plan, LifetimesAndUsage) {
    const Plan made = plan();
    const PlanResource* map = resource(made, "att.Map");
    EXPECT_EQ(map->firstPass, 0U);
    EXPECT_EQ(map->lastPass, 2U);
    EXPECT_EQ(map->usage, rhi::TextureUsage::RenderAttachment | rhi::TextureUsage::TextureBinding);
    EXPECT_EQ(resource(made, "att.Final")->lastPass, 7U) << "exported: read after the frame";
    EXPECT_TRUE(contains(resource(made, "att.Final")->usage, rhi::TextureUsage::CopySrc));
    EXPECT_EQ(resource(made, "att.Table")->usage,
              rhi::TextureUsage::StorageBinding | rhi::TextureUsage::TextureBinding);
}

// A chain of equal images, 0 -> 1 -> 2 -> 3, each read by the next pass only.
std::string chain(int count) {
    std::string attachments, passes, before = "host.In";
    for (int i = 0; i < count; ++i) {
        const std::string n = std::to_string(i);
        attachments +=
            (i ? "," : "") + std::string("\"A") + n + R"(": { "format": "RGBA16Float", "size": { "frame": 1 } })";
        passes += (i ? "," : "") + std::string(R"({ "name": "P)") + n +
                  R"(", "kind": "fullscreen", "shader": "x.frag", "slots": {
            "in": { "access": "read", "as": "sampled", "bind": "u_in" }, "out": { "access": "write", "as": "color" } },
            "connect": { "in": ")" +
                  before + R"(", "out": "att.A)" + n + "\" } }";
        before = "P" + n + ".out";
    }
    return R"({ "format": "pelage.passtree/1", "name": "Chain", "imports": { "In": { "kind": "image", "access": "read" } },
        "attachments": {)" +
           attachments + R"(}, "passes": [)" + passes + R"(], "exports": { "Out": { "from": ")" + before + "\" } } }";
}

HostDescription chainHost() {
    HostDescription lent{.extent = {256, 256, 1}};
    lent.imports["In"] = {true, rhi::TextureFormat::RGBA16Float, {256, 256, 1}, 1};
    return lent;
}

TEST(Plan, ImagesShareBytesOfTheHeapWhenTheirLivesDoNotMeet) {
    const Plan made = plan(chain(4), chainHost());
    constexpr std::uint64_t one = 256ULL * 256 * 8;
    EXPECT_EQ(resource(made, "att.A0")->heapOffset, resource(made, "att.A2")->heapOffset);
    EXPECT_NE(resource(made, "att.A0")->heapOffset, resource(made, "att.A1")->heapOffset);
    EXPECT_NE(resource(made, "att.A3")->heapOffset, resource(made, "att.A2")->heapOffset);
    EXPECT_EQ(made.naiveBytes, 4 * one);
    EXPECT_EQ(made.heapBytes, 2 * one);
    EXPECT_EQ(made.peakBytes, 2 * one);
    EXPECT_EQ(resource(made, "host.In")->heapOffset, notPlaced) << "what the host lends is where it is";
}

TEST(Plan, SizesAndAlignmentsComeFromTheHost) {
    HostDescription lent = chainHost();
    lent.memory = [](const PlanResource& image) {
        return MemoryNeed{image.name == "att.A1" ? 100U : 70U, image.name == "att.A1" ? 1U : 64U};
    };
    const Plan made = plan(chain(2), lent);
    EXPECT_EQ(resource(made, "att.A1")->heapOffset, 0U) << "the largest is placed first";
    EXPECT_EQ(resource(made, "att.A0")->heapOffset, 128U) << "behind it, at its own alignment";
    EXPECT_EQ(made.heapBytes, 198U);
    EXPECT_EQ(made.naiveBytes, 170U);
    lent.memory = {};
    EXPECT_EQ(plan(chain(1), lent).heapBytes % 65536, 0U);
}

TEST(Plan, WhoIsReadByTheNextFrameIsNotCulled) {
    // No pass of this frame reads Accum: only the next frame does, through its history.
    std::string text =
        edited(moreGrammar(), R"("last":  { "access": "read", "as": "sampled", "bind": "u_last" },)", "");
    text = edited(text, R"("last": "history.Accum", )", "");
    text = edited(text, R"("passes": [)", R"("passes": [
        { "name": "Show", "kind": "fullscreen", "shader": "show.frag",
          "slots": { "last": { "access": "read", "as": "sampled", "bind": "u_last" },
                     "color": { "access": "write", "as": "color" } },
          "connect": { "last": "history.Accum", "color": "att.Shown" } },)");
    text = edited(text, R"("attachments": {)",
                  R"("attachments": { "Shown": { "format": "RGBA8Unorm", "size": { "frame": 1 } },)");
    text = edited(text, R"("Color": { "from": "Blend.color" })", R"("Color": { "from": "Show.color" })");
    const Plan made = plan(text, moreHost());
    EXPECT_EQ(passNames(made), (Names{"Show", "Count", "Move", "Keep", "Fill", "Half", "Shade", "Draw", "Blend"}))
        << "and need not be first";
    const PlanResource* last = resource(made, "history.Accum");
    const PlanResource* accum = resource(made, "att.Accum");
    ASSERT_TRUE(last && accum);
    EXPECT_EQ(last->kind, PlanResource::Kind::History);
    EXPECT_EQ(&made.resources[last->partner], accum);
    EXPECT_EQ(&made.resources[accum->partner], last);
    EXPECT_EQ(last->historyClear, (rhi::Color{0.25, 0, 0, 1}));
    EXPECT_EQ(last->usage, accum->usage) << "they take turns";
    EXPECT_EQ(slot(made, "Blend", "color")->store, rhi::StoreOp::Store);
}

TEST(Plan, BuffersHaveTheBytesOfTheirSetting) {
    HostDescription lent = moreHost();
    lent.settings["strands"] = whole(33);
    const Plan made = plan(moreGrammar(), lent);
    EXPECT_EQ(resource(made, "att.Points")->bytes, 33U * 16);
    EXPECT_EQ(resource(made, "att.Args")->bytes, 16U) << "12, rounded up";
    EXPECT_EQ(resource(made, "att.Heads")->bytes, 64U * 48 * 4);
    EXPECT_EQ(resource(made, "history.Points")->bytes, 33U * 16);
    using Usage = rhi::BufferUsage;
    EXPECT_EQ(resource(made, "att.Args")->bufferUsage, Usage::Storage | Usage::CopyDst | Usage::Indirect);
    EXPECT_EQ(resource(made, "att.Points")->bufferUsage,
              Usage::Storage | Usage::CopyDst | Usage::CopySrc | Usage::Vertex);
    EXPECT_EQ(slot(made, "Count", "args")->load, rhi::LoadOp::Clear);
    EXPECT_EQ(slot(made, "Move", "points")->load, rhi::LoadOp::DontCare);
    for (const PlanPass& pass : made.passes) {
        if (pass.name == "Move") {
            EXPECT_EQ(pass.slots[pass.indirect].name, "args");
        }
        if (pass.name == "Count") {
            EXPECT_EQ(pass.indirect, ~0U);
        }
    }
}

TEST(Plan, ParametersOfAClassComeFromTheFileSettingsAndDefaults) {
    const Plan made = plan(moreGrammar(), moreHost());
    const auto found = std::find_if(made.passes.begin(), made.passes.end(),
                                    [](const PlanPass& pass) { return pass.passClass == "Blend"; });
    ASSERT_NE(found, made.passes.end());
    EXPECT_EQ(found->kind, PassKind::Raster);
    EXPECT_EQ(found->parameters, (std::vector<PlanParameter>{
                                     {"weight", 0.25, ""}, {"style", 1, "hard"}, {"glow", 1, ""}, {"gain", 2, ""}}));
}

TEST(Plan, AToolMayTrustClassesItDoesNotKnow) {
    HostDescription lent = moreHost();
    lent.classes.clear();
    const auto tree = PassTree::parse(moreGrammar(), "tree.pass.json");
    ASSERT_TRUE(tree) << tree.error().text();
    EXPECT_EQ((*tree)->passClasses(), (Names{"Shade", "Blend"}));
    EXPECT_EQ(codes((*tree)->compile(lent).error()), "P053 P053");
    lent.trustClasses = true;
    const Plan made = plan(moreGrammar(), lent);
    const auto found = std::find_if(made.passes.begin(), made.passes.end(),
                                    [](const PlanPass& pass) { return pass.passClass == "Blend"; });
    ASSERT_NE(found, made.passes.end());
    EXPECT_EQ(found->kind, PassKind::Raster) << "it has a color slot";
    const auto shade = std::find_if(made.passes.begin(), made.passes.end(),
                                    [](const PlanPass& pass) { return pass.passClass == "Shade"; });
    ASSERT_NE(shade, made.passes.end());
    EXPECT_EQ(shade->kind, PassKind::Compute) << "it has none";
}

TEST(Plan, VersionsNameWhoMadeWhat) {
    const Plan made = plan();
    const PlanSlot* glass = slot(made, "Glass", "color");
    EXPECT_EQ(glass->reads, 1U);
    EXPECT_EQ(glass->makes, 2U);
    EXPECT_EQ(made.passes[glass->producer].name, "Hair");
    EXPECT_EQ(slot(made, "Hair", "color")->reads, ~0U) << "it begins";
    EXPECT_EQ(slot(made, "Hair", "color")->makes, 1U);
    EXPECT_EQ(resource(made, "att.Hair")->versions, 3U);
    EXPECT_EQ(slot(made, "Resolve", "scene")->producer, ~0U) << "lent";
}

TEST(Plan, ReaderOfAnOldVersionRunsBeforeTheChange) {
    std::string text = edited(wholeGrammar(), R"(["Glass.color", "Hair.color"])", R"("Hair.color")");
    text = edited(text, R"("exports": {)", R"("exports": { "Glass": { "from": "Glass.color", "optional": true },)");
    const Plan made = plan(text);
    const Names names = passNames(made);
    const auto at = [&](const char* name) { return std::find(names.begin(), names.end(), name) - names.begin(); };
    EXPECT_LT(at("Resolve"), at("Glass"));
    EXPECT_EQ(codes(made.warnings), "P033");
}

TEST(Plan, FormatFallsBackWhenTheDeviceLacksIt) {
    HostDescription lent = host();
    lent.supports = [](rhi::TextureFormat format, rhi::TextureUsage, std::uint32_t samples) {
        return format != rhi::TextureFormat::RGBA16Float || samples == 1;
    };
    EXPECT_EQ(resource(plan(wholeGrammar(), lent), "att.Hair")->format, rhi::TextureFormat::RGBA32Float);
}

TEST(Plan, ReadWriteWithClearBeginsAnAttachment) {
    const std::string text = edited(wholeGrammar(), R"("color": { "access": "readWrite", "as": "color" } },
      "connect": { "depth": "Hair.depth", "color": "Hair.color" })",
                                    R"("color": { "access": "readWrite", "as": "color", "clear": [1, 0, 0, 1] } },
      "connect": { "depth": "Hair.depth", "color": ["Missing.color", "att.Spare"] })");
    const Plan made = plan(edited(
        text, R"("attachments": {)",
        R"("attachments": { "Spare": { "format": "RGBA16Float", "size": { "like": "att.Hair" }, "samples": 4 },)"));
    const PlanSlot* color = slot(made, "Glass", "color");
    ASSERT_NE(color, nullptr);
    EXPECT_EQ(made.resources[color->resource].name, "att.Spare");
    EXPECT_EQ(color->load, rhi::LoadOp::Clear);
    EXPECT_EQ(color->clear, (rhi::Color{1, 0, 0, 1}));
}

TEST(Plan, DotNamesEveryPassAndImage) {
    const Plan made = plan();
    const std::string dot = made.dot();
    for (const PlanPass& pass : made.passes) EXPECT_NE(dot.find(pass.name), std::string::npos) << dot;
    for (const PlanResource& image : made.resources) EXPECT_NE(dot.find(image.name), std::string::npos) << dot;
    EXPECT_NE(dot.find("Present: switched off"), std::string::npos) << dot;
    EXPECT_EQ(std::count(dot.begin(), dot.end(), '{'), std::count(dot.begin(), dot.end(), '}'));
}

TEST(Plan, A3DImageHasDepthAndLevels) {
    const Plan made = plan(moreGrammar(), moreHost());
    const PlanResource* grid = resource(made, "att.Grid");
    ASSERT_NE(grid, nullptr);
    EXPECT_TRUE(grid->is3D);
    EXPECT_EQ(grid->extent, (rhi::Extent3D{8, 8, 8}));
    EXPECT_EQ(grid->layers, 1U);
    EXPECT_EQ(grid->mipLevels, 4U) << "8, 4, 2, 1";
    EXPECT_EQ(grid->bytes, 4U * (512 + 64 + 8 + 1));
    const PlanResource* lit = resource(made, "att.Lit");
    ASSERT_NE(lit, nullptr);
    EXPECT_TRUE(lit->is3D) << "as what its size follows";
    EXPECT_EQ(lit->extent, (rhi::Extent3D{4, 4, 4}));
    EXPECT_EQ(lit->mipLevels, 2U);
    for (const PlanPass& pass : made.passes) {
        const std::uint32_t groups = pass.name == "Fill" ? 2 : pass.name == "Half" ? 1 : 0;
        if (groups > 0) {
            EXPECT_EQ(std::vector(pass.dispatch, pass.dispatch + 3), std::vector(3, groups)) << pass.name;
        } else if (pass.name == "Move") {
            EXPECT_EQ(pass.indirectOffset, 4U);
        } else if (pass.name == "Shade") {
            EXPECT_EQ(pass.constants.at("steps"), 16);
            EXPECT_EQ(pass.drawList, "hair.forward");
        } else if (pass.name == "Draw") {
            EXPECT_EQ(pass.passClass, drawListClass);
        }
    }
    EXPECT_EQ(resource(plan(), "att.Map")->is3D, false) << "layers are no depth";
}

TEST(Plan, APassReadsOneLevelAndWritesAnother) {
    const Plan made = plan(moreGrammar(), moreHost());
    const PlanSlot *fine = slot(made, "Half", "fine"), *coarse = slot(made, "Half", "coarse");
    EXPECT_EQ(fine->resource, coarse->resource);
    EXPECT_EQ(fine->level, 0U);
    EXPECT_EQ(fine->reads, 1U);
    EXPECT_EQ(coarse->level, 1U);
    EXPECT_EQ(coarse->makes, 2U);
    EXPECT_EQ(coarse->load, rhi::LoadOp::DontCare) << "the level begins here";
    EXPECT_EQ(slot(made, "Fill", "grid")->level, 0U) << "storage has one level: the first";
    EXPECT_EQ(slot(made, "Shade", "grid")->level, 1U);
    EXPECT_EQ(slot(made, "Move", "points")->level, ~0U);
}

TEST(Plan, ALevelThatIsThereIsLoaded) {
    std::string text = edited(moreGrammar(), R"("bind": "u_grid", "level": 1 },)",
                              R"("bind": "u_grid", "level": 0 },
        "more": { "access": "readWrite", "as": "storage", "bind": "i_more", "level": 1 },)");
    text = edited(text, R"("connect": { "grid": "Half.coarse",)",
                  R"("connect": { "more": "Half.coarse", "grid": "Half.coarse",)");
    const Plan made = plan(text, moreHost());
    EXPECT_EQ(slot(made, "Shade", "more")->load, rhi::LoadOp::Load);
    EXPECT_EQ(slot(made, "Shade", "more")->reads, 2U);
}

TEST(Plan, WhatAHostAllowsOf3DImages) {
    HostDescription lent = moreHost();
    lent.maxSide3D = 7;
    const auto tree = PassTree::parse(moreGrammar(), "tree.pass.json");
    EXPECT_EQ(codes((*tree)->compile(lent).error()), "D002");
    lent.maxSide3D = 8;
    EXPECT_TRUE((*tree)->compile(lent));
}

}  // namespace
}  // namespace pelage::passes::test
