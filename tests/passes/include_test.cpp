// SPDX-License-Identifier: MIT
// Trees from several files: what is laid together, and that every message names the file it speaks of.
#include "tree_text.hpp"

#include <gtest/gtest.h>

#include <unistd.h>
#include <filesystem>
#include <fstream>

namespace pelage::passes::test {
namespace {

using Texts = std::map<std::string, std::string>;

TextReader reader(const Texts& texts, std::vector<std::string>* asked = nullptr) {
    return [texts, asked](const std::string& path) -> std::optional<std::string> {
        if (asked) asked->push_back(path);
        const auto found = texts.find(path);
        return found == texts.end() ? std::nullopt : std::optional(found->second);
    };
}

// wholeGrammar() in three files: what is declared, the passes with their template, and what is wanted of them.
Texts inThree() {
    const json::Value whole = readJson(wholeGrammar());
    const auto part = [&](std::initializer_list<std::string_view> keys, const std::string& include) {
        std::string text = R"({ "format": "pelage.passtree/1")" + include;
        for (const std::string_view key : keys) {
            text += ",\n\"" + std::string(key) + "\": " + write(*whole.find(key), 1);
        }
        return text + "\n}\n";
    };
    return {{"frames/main.pass.json", part({"name", "exports"}, R"(, "include": ["parts/kit.pass.json"])")},
            {"frames/parts/kit.pass.json",
             part({"templates", "drawLists", "passes"}, R"(, "include": ["declared.pass.json"])")},
            {"frames/parts/declared.pass.json", part({"settings", "imports", "views", "attachments"}, "")}};
}

Result<std::shared_ptr<const PassTree>> parse(const Texts& texts, const std::string& main = "frames/main.pass.json") {
    return PassTree::parse(texts.at(main), main, reader(texts));
}

TEST(Include, ATreeInThreeFilesIsTheTreeInOne) {
    const auto tree = parse(inThree());
    ASSERT_TRUE(tree) << tree.error().text();
    EXPECT_TRUE((*tree)->warnings().empty()) << (*tree)->warnings().text();
    const auto plan = (*tree)->compile(host());
    const auto expected = (*PassTree::parse(wholeGrammar(), "whole"))->compile(host());
    ASSERT_TRUE(plan) << plan.error().text();
    EXPECT_EQ(plan->dot(), expected->dot());
}

TEST(Include, MessagesNameTheFileLineAndColumn) {
    const auto fault = [](const std::string& file, const std::string& from, const std::string& to,
                          const std::string& at) {
        Texts texts = inThree();
        texts[file] = edited(texts[file], from, to);
        const auto tree = parse(texts);
        Diagnostics found = tree ? (*tree)->warnings() : tree.error();
        if (tree && found.empty()) {
            const auto plan = (*tree)->compile(host());
            found = plan ? plan->warnings : plan.error();
        }
        EXPECT_EQ(found.items().size(), 1U) << found.text();
        if (found.items().empty()) return std::string();
        const Diagnostic& item = found.items().front();
        const json::Place place = placeOf(texts[file], at);
        EXPECT_EQ(item.file, file);
        EXPECT_EQ(item.line, place.line) << found.text();
        EXPECT_EQ(item.column, place.column) << found.text();
        return item.code + " " + item.text + "; " + item.hint;
    };
    // Of the schema, of the reader, of the checks, of the linker; in each of the files.
    EXPECT_EQ(fault("frames/parts/declared.pass.json", "\"RGBA8Unorm\"", "\"RGBA8\"", "\"RGBA8\"").substr(0, 4),
              "P030");
    EXPECT_EQ(fault("frames/parts/declared.pass.json", "256", "255", "255").substr(0, 4), "P005");
    EXPECT_EQ(fault("frames/parts/declared.pass.json", "\"host.Scene\"", "\"host.Scne\"", "\"host.Scne\"").substr(0, 4),
              "P031");
    EXPECT_EQ(fault("frames/parts/kit.pass.json", "\"Blur.color\"", "\"Blr.color\"", "\"Blr.color\"").substr(0, 4),
              "P016");
    EXPECT_EQ(
        fault("frames/parts/declared.pass.json", "\"RGBA16Float\"", "\"RGBA8Unorm\"", "\"Scene\": {").substr(0, 4),
        "P081");
    EXPECT_EQ(fault("frames/parts/kit.pass.json", "lights > 0", "light > 0", "light > 0").substr(0, 4), "E002");
    EXPECT_EQ(fault("frames/main.pass.json", "\"Keep.to\"", "\"Kep.to\"", "\"Kep.to\"").substr(0, 4), "P016");
    // A place in a hint that is in another file says which.
    Texts texts = inThree();
    std::string& kit = texts["frames/parts/kit.pass.json"];
    kit = edited(kit, R"("color": "att.Half")", R"("color": "host.Scene")");
    const auto written = parse(texts);
    ASSERT_FALSE(written);
    const json::Place place = placeOf(texts["frames/parts/declared.pass.json"], "\"Scene\": {");
    const std::string at = "frames/parts/declared.pass.json:" + std::to_string(place.line) + ":";
    EXPECT_NE(written.error().text().find(at), std::string::npos) << written.error().text();
}

TEST(Include, PathsAreRelativeToTheFileThatSaysThem) {
    std::vector<std::string> asked;
    const Texts texts = inThree();
    const auto tree =
        PassTree::parse(texts.at("frames/main.pass.json"), "frames/main.pass.json", reader(texts, &asked));
    ASSERT_TRUE(tree) << tree.error().text();
    EXPECT_EQ(asked, (std::vector<std::string>{"frames/parts/kit.pass.json", "frames/parts/declared.pass.json"}));
}

TEST(Include, OneFileIncludedTwiceCountsOnce) {
    Texts texts = inThree();
    texts["frames/main.pass.json"] = edited(texts["frames/main.pass.json"], R"(["parts/kit.pass.json"])",
                                            R"(["parts/kit.pass.json", "parts/declared.pass.json"])");
    const auto tree = parse(texts);
    EXPECT_TRUE(tree) << tree.error().text();
}

TEST(Include, CirclesDoubleNamesAndMissingFilesAreErrors) {
    Texts circle = inThree();
    std::string& declared = circle["frames/parts/declared.pass.json"];
    declared = edited(declared, R"("pelage.passtree/1")", R"("pelage.passtree/1", "include": ["kit.pass.json"])");
    const auto round = parse(circle);
    ASSERT_FALSE(round);
    EXPECT_EQ(codes(round.error()), "P059") << round.error().text();
    EXPECT_EQ(round.error().items().front().file, "frames/parts/declared.pass.json");

    for (const auto& [group, text] : std::map<std::string, std::string>{
             {"settings", R"("settings": { "size": { "type": "bool", "default": true } })"},
             {"views", R"("views": { "main": { "count": 1 } })"},
             {"attachments", R"("attachments": { "Map": { "format": "R32Float", "size": { "frame": 1 } } })"},
             {"drawLists", R"("drawLists": ["hair.shadow"])"}}) {
        Texts twice = inThree();
        twice["frames/main.pass.json"] =
            edited(twice["frames/main.pass.json"], "\"exports\":", text + ",\n\"exports\":");
        const auto tree = parse(twice);
        ASSERT_FALSE(tree) << group;
        EXPECT_EQ(codes(tree.error()), "P058") << tree.error().text();
        EXPECT_EQ(tree.error().items().front().file, "frames/main.pass.json");
        EXPECT_NE(tree.error().items().front().hint.find("frames/parts/"), std::string::npos) << tree.error().text();
    }
    // Passes are a list: a second one of a name is the same fault as in one file, and the hint knows both files.
    Texts pass = inThree();
    pass["frames/main.pass.json"] =
        edited(pass["frames/main.pass.json"],
               "\"exports\":", R"("passes": [{ "name": "Keep", "kind": "copy", "connect": {} }], "exports":)");
    const auto second = parse(pass);
    ASSERT_FALSE(second);
    EXPECT_NE(second.error().text().find("P002"), std::string::npos) << second.error().text();
    EXPECT_NE(second.error().text().find("first at frames/parts/kit.pass.json:"), std::string::npos)
        << second.error().text();

    Texts missing = inThree();
    missing.erase("frames/parts/declared.pass.json");
    const auto absent = parse(missing);
    ASSERT_FALSE(absent);
    EXPECT_EQ(codes(absent.error()), "P057") << absent.error().text();
    EXPECT_EQ(absent.error().items().front().file, "frames/parts/kit.pass.json");
}

TEST(Include, AWholeTreeHasANamePassesAndExports) {
    for (const std::string key : {"name", "passes", "exports"}) {
        json::Value root = readJson(wholeGrammar());
        std::erase_if(root.members, [&](const json::Member& member) { return member.key == key; });
        const auto tree = PassTree::parse(write(root), "t");
        ASSERT_FALSE(tree) << key;
        EXPECT_EQ(codes(tree.error()), "J011") << tree.error().text();
        EXPECT_NE(tree.error().text().find(key), std::string::npos) << tree.error().text();
    }
}

TEST(Include, WhatIsNotBesideTheFileIsLookedForElsewhere) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::temp_directory_path() / ("pelage_elsewhere_" + std::to_string(::getpid()));
    fs::create_directories(folder);
    const std::string mine = (folder / "mine.pass.json").string();
    // The shipped frame, with one more export.
    std::ofstream(mine) << R"({ "format": "pelage.passtree/1", "name": "Mine", "include": ["hair_frame.pass.json"],
             "exports": { "Shadows": { "from": "Shadow.map", "optional": true } } })";
    const auto frames = [](const std::string& name) { return std::string(PELAGE_FRAMES) + "/" + name; };
    const auto tree = PassTree::load(mine, frames);
    ASSERT_TRUE(tree) << tree.error().text();
    EXPECT_EQ((*tree)->name(), "Mine");
    EXPECT_EQ((*tree)->files(), (std::vector<std::string>{mine, frames("hair_frame.pass.json")}));
    HostDescription lent{.extent = {64, 64, 1}};
    lent.imports["DisplayConstants"] = {true};
    const auto plan = (*tree)->compile(lent);
    ASSERT_TRUE(plan) << plan.error().text();
    EXPECT_EQ(plan->exports.count("Shadows"), 1U);
    EXPECT_EQ(plan->exports.count("HdrColor"), 1U);
    const auto alone = PassTree::load(mine);
    ASSERT_FALSE(alone);
    EXPECT_EQ(codes(alone.error()), "P057") << alone.error().text();
    fs::remove_all(folder);
}

TEST(Include, FilesOnDiskAreListedForReload) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::temp_directory_path() / ("pelage_include_" + std::to_string(::getpid()));
    for (const auto& [name, text] : inThree()) {
        fs::create_directories((folder / name).parent_path());
        std::ofstream(folder / name) << text;
    }
    const std::string main = (folder / "frames/main.pass.json").string();
    const auto tree = PassTree::load(main);
    EXPECT_TRUE(tree) << tree.error().text();
    if (tree) {
        const std::string parts = (folder / "frames/parts/").string();
        EXPECT_EQ((*tree)->files(),
                  (std::vector<std::string>{main, parts + "kit.pass.json", parts + "declared.pass.json"}));
    }
    fs::remove_all(folder);
}

}  // namespace
}  // namespace pelage::passes::test
