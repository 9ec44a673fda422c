// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <pelage/json/diagnostic.hpp>

using namespace pelage;

TEST(Diagnostic, IsOneLineWhateverTheTextHolds) {
    EXPECT_EQ(toString({Severity::Error, "J010", "a.json", 3, 7, "unknown key \"x\"", "did you mean 'y'?"}),
              "a.json:3:7: error J010: unknown key \"x\"; hint: did you mean 'y'?");
    EXPECT_EQ(toString({Severity::Warning, "V005", "", 1, 2, "a\nb\x01", ""}), "1:2: warning V005: a\\nb\\x01");
    EXPECT_EQ(toString({Severity::Note, "V007", "f", 0, 0, "t", ""}), "f: note V007: t");
}

TEST(Diagnostics, SortsByPlaceAndKnowsErrors) {
    Diagnostics list;
    list.add({Severity::Warning, "B", "f", 2, 1, "", ""});
    list.add({Severity::Warning, "A", "f", 1, 9, "", ""});
    EXPECT_FALSE(list.hasErrors());
    list.add({Severity::Error, "C", "f", 1, 2, "", ""});
    EXPECT_TRUE(list.hasErrors());
    list.sortByPlace();
    EXPECT_EQ(list.items()[0].code, "C");
    EXPECT_EQ(list.items()[2].code, "B");
    list.append(list);
    EXPECT_EQ(list.items().size(), 6U);
    EXPECT_EQ(list.text().substr(0, 18), "f:1:2: error C: \nf");
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
