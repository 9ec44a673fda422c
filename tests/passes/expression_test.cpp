// SPDX-License-Identifier: MIT
#include "tree_text.hpp"

#include <gtest/gtest.h>

namespace pelage::passes::test {
namespace {

// Whether Present runs when its condition is `expression`.
bool holds(const std::string& expression, const std::function<void(HostDescription&)>& change = {}) {
    const std::string text = edited(wholeGrammar(), "host.has('Screen')", expression);
    const auto tree = PassTree::parse(text, "t");
    EXPECT_TRUE(tree) << expression << "\n" << (tree ? "" : tree.error().text());
    if (!tree) return false;
    HostDescription lent = host();
    lent.imports["Screen"] = {true, rhi::TextureFormat::RGBA8Unorm, {64, 48, 1}, 1};
    if (change) change(lent);
    const auto plan = (*tree)->compile(lent);
    EXPECT_TRUE(plan) << (plan ? "" : plan.error().text());
    return plan && slot(*plan, "Present", "color");
}

std::string fault(const std::string& expression) {
    const auto tree = PassTree::parse(edited(wholeGrammar(), "host.has('Screen')", expression), "t");
    return tree ? "none" : codes(tree.error());
}

TEST(Expression, ComparesAndCombines) {
    EXPECT_TRUE(holds("true"));
    EXPECT_FALSE(holds("false"));
    EXPECT_TRUE(holds("lights == 2 && size >= 256 && size <= 256 && lights != 3"));
    EXPECT_FALSE(holds("lights < 2 || lights > 2"));
    EXPECT_TRUE(holds("look == 'soft'"));
    EXPECT_FALSE(holds("look in ['hard']"));
    EXPECT_TRUE(holds("lights in [1, 2, 3]"));
    EXPECT_TRUE(holds("overlay"));
    EXPECT_FALSE(holds("!overlay"));
    EXPECT_TRUE(holds("overlay == true"));
}

TEST(Expression, AndBindsTighterThanOr) {
    EXPECT_TRUE(holds("true || true && false"));
    EXPECT_FALSE(holds("(true || true) && false"));
    EXPECT_FALSE(holds("!(overlay || false)"));
}

TEST(Expression, FollowsSettingsAndImports) {
    EXPECT_FALSE(holds("overlay", [](HostDescription& h) { h.settings["overlay"] = flag(false); }));
    EXPECT_TRUE(holds("look == 'hard'", [](HostDescription& h) { h.settings["look"] = word("hard"); }));
    EXPECT_TRUE(holds("lights == 4", [](HostDescription& h) { h.settings["lights"] = whole(4); }));
    EXPECT_FALSE(holds("host.has('Sky')"));
    EXPECT_TRUE(holds("host.has('Sky')", [](HostDescription& h) {
        h.imports["Sky"] = {true, rhi::TextureFormat::RGBA16Float, {8, 8, 6}, 1};
    }));
}

TEST(Expression, RefusesWhatMeansNothing) {
    for (const char* text :
         {"", "lights >", "(overlay", "overlay)", "overlay overlay", "lights in 2", "lights in [2", "host.has(Screen)",
          "host.has('Screen'", "lights > 'x", "lights @ 2", "&& overlay", "1..2 < lights", "lights > 1e999"}) {
        EXPECT_EQ(fault(text), "E001") << text;
    }
    EXPECT_EQ(fault("host.had('Screen')"), "E002");
    EXPECT_EQ(fault("ligths > 1"), "E002");
    EXPECT_EQ(fault("look == 'sofd'"), "E003");
    EXPECT_EQ(fault("look in ['soft', 'herd']"), "E003");
    for (const char* text : {"lights", "'soft'", "2", "lights && overlay", "look == 2", "look < 'soft'", "overlay > 1",
                             "!lights", "look in [1]"}) {
        EXPECT_EQ(fault(text), "E004") << text;
    }
}

TEST(Expression, DepthAndLengthAreBounded) {
    EXPECT_EQ(fault(std::string(200, '(') + "overlay" + std::string(200, ')')), "E001");
    EXPECT_EQ(fault(std::string(200, '!') + "overlay"), "E001");
    EXPECT_TRUE(holds(std::string(20, '(') + "overlay" + std::string(20, ')')));
    std::string chain = "overlay";
    while (chain.size() < 1000) chain += " || overlay";
    EXPECT_TRUE(holds(chain));
    while (chain.size() < 100000) chain += " || overlay";
    EXPECT_EQ(fault(chain), "E001");
}

}  // namespace
}  // namespace pelage::passes::test
