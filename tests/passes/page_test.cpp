// SPDX-License-Identifier: MIT
// The page of a plan: that what it says is what the plan holds, and that it is one whole document.
#include "tree_text.hpp"

#include <gtest/gtest.h>
#include <pelage/passes/page.hpp>

#include "plan_text.hpp"

#include <algorithm>

namespace pelage::passes::test {
namespace {

Plan plan(const std::string& text, const HostDescription& host) {
    const auto tree = PassTree::parse(text, "t");
    EXPECT_TRUE(tree) << tree.error().text();
    auto made = (*tree)->compile(host);
    EXPECT_TRUE(made) << made.error().text();
    return *made;
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++found;
    return found;
}

TEST(Page, HoldsEveryPassImageByteRangeAndReason) {
    for (const Plan& made : {plan(wholeGrammar(), host()), plan(moreGrammar(), moreHost())}) {
        const std::string page = html(made, {.title = "Some <tree>"});
        for (const PlanPass& pass : made.passes) EXPECT_NE(page.find(pass.name), std::string::npos) << pass.name;
        for (const PlanResource& resource : made.resources) {
            EXPECT_NE(page.find(resource.name), std::string::npos) << resource.name;
            if (resource.heapOffset == notPlaced) continue;
            const std::string range =
                std::to_string(resource.heapOffset) + " to " + std::to_string(resource.heapOffset + resource.heapBytes);
            EXPECT_NE(page.find(range), std::string::npos) << resource.name << " " << range;
        }
        for (const std::string& culled : made.culled) EXPECT_NE(page.find("<li>" + culled), std::string::npos);
        EXPECT_NE(page.find(byteText(made.naiveBytes)), std::string::npos);
        EXPECT_NE(page.find("Some &lt;tree&gt;"), std::string::npos);
        for (const char* tag : {"svg", "table", "rect", "text", "div", "h2", "ul", "p"}) {
            const std::string open = std::string("<") + tag;
            EXPECT_EQ(count(page, open + ">") + count(page, open + " "), count(page, std::string("</") + tag + ">"))
                << tag;
        }
        EXPECT_EQ(page.find("share of the GPU"), std::string::npos);
    }
}

TEST(Page, SaysWhoseBytesAnImageTakesOver) {
    const Plan made = plan(wholeGrammar(), host());
    std::size_t handovers = 0;
    const auto taken = memoryTaken(made);
    const std::string page = html(made);
    for (std::size_t i = 0; i < taken.size(); ++i) {
        for (const MemoryTaken& each : taken[i]) {
            const PlanResource &image = made.resources[each.image], &from = made.resources[each.from];
            EXPECT_EQ(image.firstPass, i);
            EXPECT_LT(from.lastPass, i);
            EXPECT_LT(std::max(image.heapOffset, from.heapOffset),
                      std::min(image.heapOffset + image.heapBytes, from.heapOffset + from.heapBytes));
            EXPECT_NE(page.find(image.name + " takes bytes of " + from.name), std::string::npos);
            ++handovers;
        }
    }
    // Less than each image would take for itself, so bytes change hands.
    EXPECT_LT(made.heapBytes, made.naiveBytes);
    EXPECT_GT(handovers, 0U);
}

TEST(Page, SharesAreOfTheWholeFrame) {
    const Plan made = plan(wholeGrammar(), host());
    ASSERT_GE(made.passes.size(), 2U);
    PageOptions options{.title = "t", .barriers = 17, .device = "a & b"};
    options.measured = {{.name = made.passes[0].name, .gpuMilliseconds = 3, .fragments = 4711, .draws = 5},
                        {.name = made.passes[1].name, .gpuMilliseconds = 1, .cpuMilliseconds = 2}};
    const std::string page = html(made, options);
    for (const char* part : {">75 %<", ">25 %<", ">100 %<", ">4711<", "17 barriers", "a &amp; b"}) {
        EXPECT_NE(page.find(part), std::string::npos) << part;
    }
}

TEST(Page, WaitsAreWhatDataNeeds) {
    // Two passes that read one image do not wait for each other, and both wait for its writer.
    const Plan made = plan(
        R"({ "format": "pelage.passtree/1", "name": "Waits",
             "attachments": { "A": { "format": "RGBA8Unorm", "size": { "frame": 1 } },
                              "B": { "format": "RGBA8Unorm", "size": { "frame": 1 } },
                              "C": { "format": "RGBA8Unorm", "size": { "frame": 1 } } },
             "passes": [
               { "name": "Make", "kind": "fullscreen", "shader": "a.frag",
                 "slots": { "out": { "access": "write", "as": "color" } }, "connect": { "out": "att.A" } },
               { "name": "One", "kind": "fullscreen", "shader": "a.frag",
                 "slots": { "in": { "access": "read", "as": "sampled", "bind": "u" },
                            "out": { "access": "write", "as": "color" } },
                 "connect": { "in": "Make.out", "out": "att.B" } },
               { "name": "Two", "kind": "fullscreen", "shader": "a.frag", "after": ["One"],
                 "slots": { "in": { "access": "read", "as": "sampled", "bind": "u" },
                            "out": { "access": "write", "as": "color" } },
                 "connect": { "in": "Make.out", "out": "att.C" } },
               { "name": "Over", "kind": "fullscreen", "shader": "a.frag", "after": ["Two"],
                 "slots": { "out": { "access": "readWrite", "as": "color" } }, "connect": { "out": "Make.out" } }],
             "exports": { "B": { "from": "One.out" }, "C": { "from": "Two.out" }, "A": { "from": "Over.out" } } })",
        {.extent = {8, 8, 1}});
    ASSERT_EQ(passNames(made), (std::vector<std::string>{"Make", "One", "Two", "Over"}));
    const auto waits = waitsOf(made);
    EXPECT_TRUE(waits[0].empty());
    ASSERT_EQ(waits[1].size(), 1U);
    EXPECT_EQ(waits[1][0].after, 0U);
    EXPECT_EQ(waits[1][0].from, SlotUse::Color);
    EXPECT_TRUE(waits[2].empty()) << "it finds the image as One left it";
    ASSERT_EQ(waits[3].size(), 1U);
    EXPECT_EQ(waits[3][0].after, 2U) << "nobody may read any more";
}

}  // namespace
}  // namespace pelage::passes::test
