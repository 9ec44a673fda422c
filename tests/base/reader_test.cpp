// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <pelage/base/json.hpp>

#include <cstdio>
#include <fstream>
#include <limits>

using namespace pelage;

namespace {

struct Fault {
    std::string_view text;
    std::string_view line;  // as printed, without the severity word
};

std::string first(const Diagnostics& diagnostics) {
    return diagnostics.empty() ? std::string("nothing") : toString(diagnostics.items().front());
}

const json::Value& at(const json::Value& object, std::string_view key) {
    const json::Value* found = object.find(key);
    static const json::Value none;
    return found ? *found : none;
}

}  // namespace

TEST(Reader, EveryFaultHasPlaceCodeAndHint) {
    const Fault faults[] = {
        // J001: what was expected, what stands there, and where the comma goes
        {"{\"a\":1\n\"b\":2}", "T:2:1: error J001: expected ',' or '}' here, found '\"'; hint: add ',' at 1:7"},
        {"{\n  \"a\": \"x\" \"b\": 1}",
         "T:2:12: error J001: expected ',' or '}' here, found '\"'; hint: add ',' at 2:11"},
        {"[1 2]", "T:1:4: error J001: expected ',' or ']' here, found '2'; hint: add ',' at 1:3"},
        {"[1 /* one */ 2]", "T:1:14: error J001: expected ',' or ']' here, found '2'; hint: add ',' at 1:3"},
        {"{\"a\":1,}", "T:1:8: error J001: expected a key in double quotes, found '}'; hint: remove the ',' at 1:7"},
        {"[1,]", "T:1:4: error J001: expected a value, found ']'; hint: remove the ',' at 1:3"},
        {"[,1]", "T:1:2: error J001: expected a value or ']', found ','"},
        {"{\"a\":1,,\"b\":2}",
         "T:1:8: error J001: expected a key in double quotes, found ','; hint: remove the ',' at 1:7"},
        {"{a:1}", "T:1:2: error J001: expected a key in double quotes or '}', found 'a'; hint: put \" around the word"},
        {"['a']", "T:1:2: error J001: expected a value or ']', found '''; hint: use \" instead of '"},
        {"[True]", "T:1:2: error J001: expected a value or ']', found 'True'; hint: write true"},
        {"{\"a\" 1}", "T:1:6: error J001: expected ':' after the key, found '1'; hint: add ':' at 1:5"},
        {"{\"a\":}", "T:1:6: error J001: expected a value, found '}'"},
        {"{\"a\":1",
         "T:1:7: error J001: expected ',' or '}' here, found the end of the text; "
         "hint: add '}' for the '{' at 1:1"},
        {"[1}", "T:1:3: error J001: expected ',' or ']' here, found '}'; hint: the '[' at 1:1 is closed by ']'"},
        {"[1] 2", "T:1:5: error J001: expected the end of the text, found '2'"},
        {"[1] ]", "T:1:5: error J001: expected the end of the text, found ']'"},
        {"[1, /* x", "T:1:5: error J001: this comment is never closed; hint: add */"},
        // J002: what is not text
        {"[\"\xff\"]", "T:1:3: error J002: the text is not UTF-8 here; hint: save the file as UTF-8"},
        {"[\"\xed\xa0\x80\"]", "T:1:3: error J002: the text is not UTF-8 here; hint: save the file as UTF-8"},
        {"// \xc0\xaf\n1", "T:1:4: error J002: the text is not UTF-8 here; hint: save the file as UTF-8"},
        {std::string_view("[\0]", 3), "T:1:2: error J002: the text holds a NUL byte; hint: is this a text file?"},
        {"[\"\\u0000\"]", "T:1:2: error J002: the string holds a NUL character; hint: remove \\u0000"},
        {"", "T:1:1: error J003: the text is empty; hint: start with {"},
        {"\n // nothing\n", "T:3:1: error J003: the text is empty; hint: start with {"},
        {"{\"a\":1,\n \"a\":2}", "T:2:2: error J004: key \"a\" given twice in one object; hint: first at 1:2"},
        {"{\"a\":{\"b\":1},\"\\u0061\":2}",
         "T:1:14: error J004: key \"a\" given twice in one object; hint: first at 1:2"},
        // J005: nearly numbers
        {"{\"a\":.35}", "T:1:6: error J005: '.35' is not a JSON number; hint: write 0.35"},
        {"[-.5]", "T:1:2: error J005: '-.5' is not a JSON number; hint: write -0.5"},
        {"[1.]", "T:1:2: error J005: '1.' is not a JSON number; hint: write 1.0"},
        {"[007]", "T:1:2: error J005: '007' is not a JSON number; hint: write 7"},
        {"[+1]", "T:1:2: error J005: '+1' is not a JSON number; hint: write 1"},
        {"[1.0f]", "T:1:2: error J005: '1.0f' is not a JSON number; hint: remove the 'f'"},
        {"[0x10]",
         "T:1:2: error J005: '0x10' is not a JSON number; hint: use plain decimal digits, such as 0.35 or 1.5e-3"},
        {"[NaN]", "T:1:2: error J005: 'NaN' is not a JSON number; hint: numbers must be finite"},
        {"[-Infinity]", "T:1:2: error J005: '-Infinity' is not a JSON number; hint: numbers must be finite"},
        {"[1e999]",
         "T:1:2: error J006: the number 1e999 does not fit in double precision; hint: write a number below 1e308"},
        {"[\"a\nb\"]",
         "T:1:2: error J008: faulty string: it has no closing quotation mark on its line; "
         "hint: add \" at the end of the string"},
        {"[\"a]",
         "T:1:2: error J008: faulty string: it has no closing quotation mark on its line; "
         "hint: add \" at the end of the string"},
        {"[\"C:\\dir\"]",
         "T:1:2: error J008: faulty string: unknown escape after a backslash; "
         "hint: write \\\\ for one backslash"},
        {"[\"\\ud800\"]",
         "T:1:2: error J008: faulty string: half of a \\u surrogate pair; "
         "hint: write \\\\ for one backslash"},
        {"[\"a\tb\"]", "T:1:2: error J008: faulty string: a control character inside it; hint: write \\t for a tab"},
    };
    for (const Fault& fault : faults) {
        const auto result = json::parse(fault.text, "T");
        ASSERT_FALSE(result) << fault.text;
        EXPECT_EQ(first(result.error()), fault.line);
        EXPECT_EQ(result.error().items().size(), 1U);
    }
}

TEST(Reader, DeepNestingIsRefusedWithoutRecursion) {
    EXPECT_TRUE(json::parse(std::string(64, '[') + std::string(64, ']'), "T"));
    const auto deep = json::parse(std::string(65, '[') + std::string(65, ']'), "T");
    ASSERT_FALSE(deep);
    EXPECT_EQ(first(deep.error()), "T:1:65: error J007: nested deeper than 64 levels; hint: flatten the text");
    EXPECT_FALSE(json::parse(std::string(1000000, '['), "T"));
}

TEST(Reader, KeepsPlacesOrderAndKinds) {
    const auto document = json::parse(
        "// head\n{ \"b\": [1, 2.0, -3e2],\r\n\t\"a\": { \"x\": null }, /* t */ \"t\": true, \"s\":\"\\u00e9\\n\" }",
        "T");
    ASSERT_TRUE(document) << first(document.error());
    const json::Value& root = document->root;
    ASSERT_EQ(root.members.size(), 4U);
    EXPECT_EQ(root.members[0].key, "b");
    EXPECT_EQ(root.place.line, 2U);
    EXPECT_EQ(root.place.column, 1U);
    EXPECT_EQ(root.members[1].place.line, 3U);
    EXPECT_EQ(root.members[1].place.column, 2U);
    EXPECT_EQ(root.members[1].value.place.column, 7U);
    EXPECT_EQ(root.members[2].place.column, 30U);
    EXPECT_EQ(root.members[2].value.place.column, 35U);
    const json::Value& list = at(root, "b");
    ASSERT_EQ(list.elements.size(), 3U);
    EXPECT_TRUE(list.elements[0].isInteger);
    EXPECT_FALSE(list.elements[1].isInteger);
    EXPECT_FALSE(list.elements[2].isInteger);
    EXPECT_EQ(list.elements[2].number, -300.0);
    EXPECT_EQ(list.elements[2].place.column, 17U);
    EXPECT_EQ(at(root, "s").string, "\xC3\xA9\n");
    EXPECT_TRUE(at(root, "t").boolean);
    EXPECT_EQ(root.find("none"), nullptr);
    EXPECT_EQ(list.find("b"), nullptr);
}

TEST(Reader, NumbersAreExact) {
    const auto document =
        json::parse("[0.1, 5e-324, 1.7976931348623157e308, 9007199254740993, -0, 0.30000000000000004]", "T");
    ASSERT_TRUE(document) << first(document.error());
    const auto& numbers = document->root.elements;
    EXPECT_EQ(numbers[0].number, 0.1);
    EXPECT_EQ(numbers[1].number, std::numeric_limits<double>::denorm_min());
    EXPECT_EQ(numbers[2].number, std::numeric_limits<double>::max());
    EXPECT_EQ(numbers[3].number, 9007199254740992.0);
    EXPECT_EQ(numbers[5].number, 0.30000000000000004);
}

TEST(Reader, ByteOrderMarkIsSkippedAndNotCounted) {
    const auto good = json::parse("\xEF\xBB\xBF{}", "T");
    ASSERT_TRUE(good);
    EXPECT_EQ(good->root.place.column, 1U);
    const auto bad = json::parse("\xEF\xBB\xBF[}", "T");
    ASSERT_FALSE(bad);
    EXPECT_EQ(bad.error().items()[0].column, 2U);
}

TEST(Reader, FilesThatCannotBeReadSayWhy) {
    const auto missing = json::parseFile("no/such/file.json");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().items()[0].code, Code("F001"));
    EXPECT_EQ(first(missing.error()), "no/such/file.json: error F001: cannot open the file; hint: check the path");

    const std::string path = testing::TempDir() + "pelage_large.json";
    std::ofstream(path, std::ios::binary) << std::string((std::size_t{4} << 20U) + 1, ' ');
    const auto large = json::parseFile(path);
    ASSERT_FALSE(large);
    EXPECT_EQ(large.error().items()[0].code, Code("F002"));
    std::ofstream(path, std::ios::binary) << "{\"a\": 1}";
    EXPECT_TRUE(json::parseFile(path));
    std::remove(path.c_str());
    EXPECT_FALSE(json::parseFile(testing::TempDir()));
}
