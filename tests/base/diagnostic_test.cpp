// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <pelage/base/diagnostic.hpp>
#include <set>
#include <string_view>

using namespace pelage;

TEST(Diagnostic, IsOneLineWhateverTheTextHolds) {
    EXPECT_EQ(toString({Severity::Error, "J010", "a.json", 3, 7, "unknown key \"x\"", "did you mean 'y'?"}),
              "a.json:3:7: error J010: unknown key \"x\"; hint: did you mean 'y'?");
    EXPECT_EQ(toString({Severity::Warning, "V005", "", 1, 2, "a\nb\x01", ""}), "1:2: warning V005: a\\nb\\x01");
    EXPECT_EQ(toString({Severity::Note, "V007", "f", 0, 0, "t", ""}), "f: note V007: t");
}

TEST(Diagnostic, IsOneLineOfJsonWhateverTheTextHolds) {
    EXPECT_EQ(toJson({Severity::Error, "J004", "a.json", 3, 7, "key \"x\" given twice", "first at 2:5"}),
              R"({"file":"a.json","line":3,"column":7,"severity":"error","code":"J004",)"
              R"("text":"key \"x\" given twice","hint":"first at 2:5",)"
              R"("context":[],"related":[{"file":"a.json","line":2,"column":5}]})");
    const std::string odd =
        toJson({Severity::Note, "V007", "a\\b", 0, 0, "line\nbreak \x01 \xff \xc3\xa9 \xed\xa0\x80", ""});
    EXPECT_EQ(odd,
              "{\"file\":\"a\\\\b\",\"line\":0,\"column\":0,\"severity\":\"note\",\"code\":\"V007\","
              "\"text\":\"line\\u000abreak \\u0001 \\ufffd \xc3\xa9 "
              "\\ufffd\\ufffd\\ufffd\",\"hint\":\"\",\"context\":[],\"related\":[]}");
}

TEST(Diagnostic, PlacesInItsSentencesAreRelated) {
    const auto related = [](const std::string& text, const std::string& hint) {
        const std::string json = toJson({Severity::Error, "P002", "main.json", 9, 1, text, hint});
        const std::size_t at = json.find("\"related\":");
        return json.substr(at + 10, json.size() - at - 11);
    };
    EXPECT_EQ(related("second pass 'A'", "first at parts/kit.pass.json:4:11"),
              R"([{"file":"parts/kit.pass.json","line":4,"column":11}])");
    EXPECT_EQ(related("wrong, see at 1:2", "set access at 16:22 to readWrite, or at 3:4"),
              R"([{"file":"main.json","line":1,"column":2},{"file":"main.json","line":16,"column":22},)"
              R"({"file":"main.json","line":3,"column":4}])");
    for (const char* none :
         {"", "at", "at ", "at most 4", "flat 12:5", "at 0:1", "at 4", "at 4:", "at x.json:", "at 99999999999:1"}) {
        EXPECT_EQ(related(none, ""), "[]") << none;
    }
}

TEST(Diagnostic, SaysWhatWasBeingDoneFromTheOutside) {
    const Diagnostics inner(
        Diagnostic{.code = "R012", .text = "no.", .context = {"draw #3", "RenderPass \"forward\""}});
    const Diagnostics outer = inner.within("frame \"main\"");
    EXPECT_EQ(toString(outer.first()),
              "error R012: no; while validating frame \"main\" > RenderPass \"forward\" > draw #3");
    EXPECT_NE(toJson(outer.first()).find(R"("context":["draw #3","RenderPass \"forward\"","frame \"main\""])"),
              std::string::npos);
}

TEST(Diagnostics, TheFirstErrorStandsForAll) {
    Diagnostics list(Diagnostic{.severity = Severity::Warning, .code = "J001"});
    EXPECT_EQ(list.first().code, Code("J001"));
    list.add({.code = "J002"});
    list.add({.code = "J003"});
    EXPECT_EQ(list.first().code, Code("J002"));
    EXPECT_TRUE(Diagnostics().first().code.empty());
}

TEST(Code, EveryCodeOfTheListIsFoundAndHasOneMeaning) {
    std::set<std::string_view> texts;
    for (const Code& code : Code::all()) {
        EXPECT_TRUE(texts.insert(code.text()).second) << code << " stands in the list twice";
        EXPECT_TRUE(code.meaning().ends_with('.')) << code;
        ASSERT_TRUE(Code::find(code.text())) << code;
        EXPECT_EQ(*Code::find(code.text()), code);
    }
    EXPECT_GT(texts.size(), 200U);
    EXPECT_EQ(Code("J010"), *Code::find("J010"));
    EXPECT_FALSE(Code::find("J999"));
    EXPECT_FALSE(Code::find(""));
}

TEST(Diagnostics, SortsByPlaceAndKnowsErrors) {
    Diagnostics list;
    list.add({Severity::Warning, "J002", "f", 2, 1, "", ""});
    list.add({Severity::Warning, "J001", "f", 1, 9, "", ""});
    EXPECT_FALSE(list.hasErrors());
    list.add({Severity::Error, "J003", "f", 1, 2, "", ""});
    EXPECT_TRUE(list.hasErrors());
    list.sortByPlace();
    EXPECT_EQ(list.items()[0].code, Code("J003"));
    EXPECT_EQ(list.items()[2].code, Code("J002"));
    list.append(list);
    EXPECT_EQ(list.items().size(), 6U);
    EXPECT_EQ(list.text().substr(0, 21), "f:1:2: error J003: \nf");
}

TEST(NearestName, FindsWhatAPersonMeant) {
    const std::vector<std::string> known{
        "connect", "views", "host.SceneColor", "RGBA16Float", "hashedAlpha", "float", "MarschnerLobeShape",
        "opaque",  "a"};
    const std::pair<std::string_view, std::string_view> cases[] = {{"conect", "connect"},
                                                                   {"Views", "views"},
                                                                   {"host.SceneColour", "host.SceneColor"},
                                                                   {"RGBA16F", "RGBA16Float"},
                                                                   {"hashed", "hashedAlpha"},
                                                                   {"flaot", "float"},
                                                                   {"MarschnerLobes", "MarschnerLobeShape"},
                                                                   {"cutout", ""},
                                                                   {"", ""},
                                                                   {"x", ""},
                                                                   {std::string_view("zzzzzzzzzzzz"), ""}};
    for (const auto& [word, expected] : cases) EXPECT_EQ(nearestName(word, known), expected) << word;
    EXPECT_EQ(nearestName(std::string(100000, 'x'), known), "");
    EXPECT_EQ(nearestName("connect", {}), "");
}
