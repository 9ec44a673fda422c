// SPDX-License-Identifier: MIT
// The shipped frame: what it is by default, what becomes of it when a pass is taken away.
#include "tree_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace pelage::passes::test {
namespace {

std::string shipped() {
    return shippedText("hair_frame.pass.json");
}
HostDescription frame() {
    HostDescription host{.extent = {320, 200, 1}};
    host.imports["DisplayConstants"] = {true};
    return host;
}
using Names = std::vector<std::string>;

struct Outcome {
    std::string codes = {};  // errors, or warnings of parsing and compiling
    bool works = false;
    Plan plan = {};
    std::string text = {};
};

Outcome run(const std::string& text, const HostDescription& host = frame()) {
    const auto tree = PassTree::parse(text, "hair_frame.pass.json");
    if (!tree) return {.codes = codes(tree.error()), .text = tree.error().text()};
    const auto plan = (*tree)->compile(host);
    if (!plan) return {.codes = codes(plan.error()), .text = plan.error().text()};
    Diagnostics warnings = (*tree)->warnings();
    warnings.append(plan->warnings);
    return {codes(warnings), true, *plan, warnings.text()};
}

json::Value& passesOf(json::Value& root) {
    for (json::Member& member : root.members) {
        if (member.key == "passes") return member.value;
    }
    return root;
}

TEST(ShippedFrame, IsWithoutFault) {
    const Outcome made = run(shipped());
    ASSERT_TRUE(made.works) << made.text;
    EXPECT_EQ(made.codes, "") << made.text;
    EXPECT_EQ(passNames(made.plan), (Names{"Shadow", "Depth", "ForwardHair", "BlendHair", "Resolve", "Display"}));
    EXPECT_TRUE(made.plan.culled.empty());
    ASSERT_EQ(made.plan.exports.count("HdrColor"), 1U);
    EXPECT_EQ(made.plan.resources[made.plan.exports.at("HdrColor")].name, "att.Color");
    EXPECT_EQ(made.plan.resources[made.plan.exports.at("LdrColor")].name, "att.Display");
    EXPECT_EQ(made.plan.resources[made.plan.exports.at("Depth")].name, "att.Depth");
}

TEST(ShippedFrame, SettingsChangeThePlan) {
    HostDescription host = frame();
    host.settings = {{"shadowLights", whole(3)},
                     {"shadowSize", whole(512)},
                     {"msaa", word("1")},
                     {"displayTransform", word("none")}};
    const Outcome made = run(shipped(), host);
    ASSERT_TRUE(made.works) << made.text;
    EXPECT_EQ(resource(made.plan, "att.ShadowMap")->extent, (rhi::Extent3D{512, 512, 3}));
    EXPECT_EQ(resource(made.plan, "att.ColorMS")->samples, 1U);
    for (const PlanPass& pass : made.plan.passes) {
        if (pass.name == "Resolve") {
            EXPECT_EQ(pass.shader, "copy.frag");
        }
        if (pass.name == "Display") {
            EXPECT_EQ(pass.constants.at("displayTransform"), 1.0);
        }
    }
    host.settings = {{"shadowLights", whole(0)}};
    const Outcome unshadowed = run(shipped(), host);
    ASSERT_TRUE(unshadowed.works) << unshadowed.text;
    EXPECT_EQ(unshadowed.codes, "") << unshadowed.text;
    EXPECT_EQ(passNames(unshadowed.plan).front(), "Depth");
    const PlanSlot* map = slot(unshadowed.plan, "ForwardHair", "shadowMap");
    EXPECT_EQ(unshadowed.plan.resources[map->resource].name, "const.depthFarArray");
    host.settings = {{"shadowLights", whole(9)}};
    EXPECT_EQ(run(shipped(), host).codes, "P082");
}

// Deleting a pass from the file gives another picture or one clear error, as passes/README.md promises.
TEST(ShippedFrame, EachPassCanBeDeleted) {
    struct Row {
        std::string pass, codes;
        Names left;
    };
    const std::vector<Row> rows{
        // Unshadowed: both readers say that they take const.depthFarArray; ShadowMap and its draw list are left over.
        {"Shadow", "P047 P047 P049 P049", {"Depth", "ForwardHair", "BlendHair", "Resolve", "Display"}},
        // Nothing can be tested against: errors at both readers. The optional export would be a warning.
        {"Depth", "P016 P016 P049", {}},
        // Only see-through hair: BlendHair clears and begins the picture.
        {"ForwardHair", "P047 P049 P049", {"Shadow", "Depth", "BlendHair", "Resolve", "Display"}},
        {"BlendHair", "P047 P049", {"Shadow", "Depth", "ForwardHair", "Resolve", "Display"}},
        // The picture itself.
        {"Resolve", "P016 P016", {}},
        // HdrColor only.
        {"Display", "P047 P047 P047 P049", {"Shadow", "Depth", "ForwardHair", "BlendHair", "Resolve"}},
    };
    for (const Row& row : rows) {
        SCOPED_TRACE(row.pass);
        json::Value root = readJson(shipped());
        auto& passes = passesOf(root).elements;
        std::erase_if(passes, [&](const json::Value& pass) { return pass.find("name")->string == row.pass; });
        ASSERT_EQ(passes.size(), 5U);
        const Outcome made = run(write(root));
        std::string sorted = made.codes;
        std::vector<std::string> each;
        for (std::size_t i = 0; i < sorted.size(); i += 5) each.push_back(sorted.substr(i, 4));
        std::sort(each.begin(), each.end());
        sorted.clear();
        for (const std::string& code : each) sorted += (sorted.empty() ? "" : " ") + code;
        EXPECT_EQ(sorted, row.codes) << made.text;
        EXPECT_EQ(made.works, !row.left.empty()) << made.text;
        EXPECT_EQ(passNames(made.plan), row.left);
    }
}

TEST(ShippedFrame, EachPassCanBeSwitchedOff) {
    const std::vector<std::pair<std::string, std::string>> rows{{"Shadow", ""},           {"Depth", "P044 P044"},
                                                                {"ForwardHair", ""},      {"BlendHair", ""},
                                                                {"Resolve", "P044 P044"}, {"Display", ""}};
    for (const auto& [name, expected] : rows) {
        SCOPED_TRACE(name);
        const std::string found = "\"name\": \"" + name + "\",";
        const Outcome made = run(edited(shipped(), found, found + " \"enabled\": false,"));
        EXPECT_EQ(made.codes, expected) << made.text;
        EXPECT_EQ(made.works, expected.empty()) << made.text;
        if (made.works) {
            EXPECT_EQ(made.plan.culled, Names{name + ": switched off, \"enabled\" is false"});
        }
    }
}

TEST(ShippedFrame, PlanDoesNotDependOnTheOrderInTheFile) {
    for (const std::string& text : {shipped(), wholeGrammar()}) {
        const HostDescription host = text == shipped() ? frame() : test::host();
        const Outcome expected = run(text, host);
        ASSERT_TRUE(expected.works) << expected.text;
        json::Value root = readJson(text);
        for (unsigned seed = 0; seed < 200; ++seed) {
            std::mt19937 random(seed);
            std::shuffle(passesOf(root).elements.begin(), passesOf(root).elements.end(), random);
            const Outcome made = run(write(root), host);
            ASSERT_TRUE(made.works) << made.text;
            EXPECT_EQ(passNames(made.plan), passNames(expected.plan)) << "seed " << seed;
            EXPECT_EQ(made.plan.dot(), expected.plan.dot()) << "seed " << seed;
        }
    }
}

TEST(ShippedFrame, NothingLiesCloserThanItsLivesAllow) {
    // Depth and ColorMS are alive at once and are most of the whole: the heap is the peak, not less.
    const Outcome made = run(shipped());
    EXPECT_EQ(made.plan.heapBytes, made.plan.peakBytes);
    EXPECT_LT(made.plan.heapBytes, made.plan.naiveBytes);
}

TEST(ShippedFrame, AnExportNobodyWantsCostsNothing) {
    HostDescription host = frame();
    const Plan all = run(shipped(), host).plan;
    host.unwantedExports = {"Depth"};
    const Outcome less = run(shipped(), host);
    EXPECT_EQ(less.codes, "");
    EXPECT_EQ(passNames(less.plan), passNames(all)) << "other passes test against the depth";
    EXPECT_EQ(less.plan.exports.count("Depth"), 0U);
    EXPECT_EQ(resource(less.plan, "att.Depth")->lastPass, 3U);
    host.extent = {1920, 1080, 1};
    const Plan large = run(shipped(), host).plan;
    host.unwantedExports.clear();
    EXPECT_LT(large.heapBytes, run(shipped(), host).plan.heapBytes);
    host.unwantedExports = {"LdrColor"};
    const Outcome linear = run(shipped(), host);
    EXPECT_EQ(linear.codes, "") << linear.text;
    EXPECT_EQ(linear.plan.culled, Names{"Display: no export needs its result"});
    host.unwantedExports = {"Dept"};
    EXPECT_EQ(run(shipped(), host).codes, "P084");
}

// Editors show these sentences, and the documentation of the grammar is made of them.
TEST(Schema, EveryMemberHasADescription) {
    std::size_t members = 0;
    const std::function<void(const json::Value&, const std::string&)> walk = [&](const json::Value& value,
                                                                                 const std::string& path) {
        if (const json::Value* properties = value.find("properties"); properties && properties->isObject()) {
            for (const json::Member& member : properties->members) {
                const json::Value* text = member.value.find("description");
                EXPECT_TRUE(text && text->string.size() > 3) << path << "/" << member.key;
                ++members;
            }
        }
        for (const json::Member& member : value.members) walk(member.value, path + "/" + member.key);
        for (const json::Value& element : value.elements) walk(element, path);
    };
    walk(readJson(std::string(passTreeSchema())), "");
    EXPECT_GT(members, 80U);
}

TEST(ShippedFrame, NamesForTheHost) {
    const auto tree = PassTree::parse(shipped(), "hair_frame.pass.json");
    ASSERT_TRUE(tree) << tree.error().text();
    EXPECT_EQ((*tree)->name(), "HairFrame");
    EXPECT_EQ((*tree)->drawLists(), (Names{"shadow", "depth", "forward", "blend"}));
    EXPECT_EQ((*tree)->exports(), (Names{"HdrColor", "LdrColor", "Depth"}));
    EXPECT_TRUE((*tree)->passClasses().empty());
    ASSERT_EQ((*tree)->imports().size(), 2U);
    EXPECT_EQ((*tree)->imports()[0].name, "EnvIrradiance");
    EXPECT_TRUE((*tree)->imports()[0].cube && (*tree)->imports()[0].optional);
    EXPECT_TRUE((*tree)->imports()[1].buffer && !(*tree)->imports()[1].optional);
    ASSERT_EQ((*tree)->settings().size(), 4U);
    EXPECT_EQ((*tree)->settings()[0].name, "shadowSize");
    EXPECT_EQ((*tree)->settings()[0].defaultValue.number, 1024U);
    EXPECT_EQ((*tree)->settings()[2].words, (Names{"1", "4"}));
    EXPECT_EQ((*tree)->settings()[2].defaultValue.number, 1U);
}

}  // namespace
}  // namespace pelage::passes::test
