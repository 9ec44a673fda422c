// SPDX-License-Identifier: MIT
#include "app_fixture.hpp"

namespace pelage::test {

namespace {

class Graph : public App {
protected:
    static std::string tree(const char* name) {
        return std::string(PELAGE_SOURCE_DIR) + "/hair/data/frames/" + name + ".pass.json";
    }
};

TEST_F(Graph, OnePageThatNeedsNothingElse) {
    const RunResult result = run({"graph", tree("hair_frame"), "-o", path("a.html"), "-o", path("a.dot")});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.err, "");
    const std::string page = read(path("a.html"));
    EXPECT_EQ(page.rfind("<!DOCTYPE html>", 0), 0U);
    for (const char* outside : {"<script", "<link", "<img", "src=", "href=", "@import", "url("}) {
        EXPECT_EQ(page.find(outside), std::string::npos) << outside;
    }
    EXPECT_EQ(read(path("a.dot")).rfind("digraph", 0), 0U);
    EXPECT_EQ(page.find("share of the GPU"), std::string::npos) << "nothing was measured";
}

TEST_F(Graph, ShippedTreesByNameAndDotOnStandardOutput) {
    const RunResult named = run({"graph", "hair_host"});
    EXPECT_EQ(named.exitCode, 0) << named.err;
    EXPECT_EQ(named.out, run({"graph", tree("hair_host")}).out);
    EXPECT_EQ(named.out.rfind("digraph", 0), 0U);
}

TEST_F(Graph, SizeAndSettingsAreHeard) {
    const auto page = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments{"graph", "hair_frame", "-o", path("a.html")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        EXPECT_EQ(run(arguments).exitCode, 0);
        return read(path("a.html"));
    };
    EXPECT_NE(page({"--size", "321x123"}).find("321 x 123"), std::string::npos);
    EXPECT_NE(page({"--setting", "msaa=1"}).find("msaa = 1"), std::string::npos);
    EXPECT_NE(page({"--setting", "shadowLights=0"}).find("Shadow: switched off"), std::string::npos);
}

TEST_F(Graph, WhatCannotBeDone) {
    expectRefusal({"graph", "hair_frame", "-o", path("a.pdf")}, "A120");
    expectRefusal({"graph", "hair_frme", "-o", path("a.html")}, "hair_frame");
    expectRefusal({"graph", path("gone.pass.json"), "-o", path("a.html")}, "gone.pass.json");
    expectRefusal({"graph", "hair_frame", "--setting", "msaa=3", "-o", path("a.html")}, "msaa");
    expectRefusal({"graph", "hair_frame", "--size", "0x4", "-o", path("a.html")}, "--size");
    expectRefusal({"graph", "hair_frame", "--measure", "no_such_scene", "-o", path("a.html")}, "no_such_scene");
    expectRefusal({"graph", "hair_frame", "-o", path("no/a.html")}, "A094");
}

}  // namespace

}  // namespace pelage::test
