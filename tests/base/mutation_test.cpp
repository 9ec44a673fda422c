// SPDX-License-Identifier: MIT
// The reader and the schema on damaged texts: every answer is a value or one diagnostic with a place inside the text.
#include <gtest/gtest.h>
#include <pelage/base/json.hpp>

#include <algorithm>
#include <fstream>
#include <random>
#include <sstream>

using namespace pelage;

TEST(Mutation, DamagedBytesGiveAPlaceInsideTheText) {
    std::stringstream stream;
    stream << std::ifstream(PELAGE_SOURCE_DIR "/hair/data/types/hair.materialtype.json").rdbuf();
    const std::string original = stream.str();
    ASSERT_GT(original.size(), 1000U);
    const auto schemaText = [] {
        std::stringstream text;
        text << std::ifstream(PELAGE_SOURCE_DIR "/materials/data/materialtype.schema.json").rdbuf();
        return text.str();
    }();
    const auto schema = json::Schema::parse(schemaText, "schema");
    ASSERT_TRUE(schema);

    std::mt19937 random(7);
    const std::string pieces[] = {
        "{", "}", "[", "]", ",", ":", "\"", "\\", "1e9", "/*", "//", "\n", "\xff", std::string(1, '\0'), "null", "-"};
    int parsed = 0, refused = 0;
    for (int round = 0; round < 1500; ++round) {
        std::string text = original;
        const int edits = 1 + static_cast<int>(random() % 3);
        for (int edit = 0; edit < edits; ++edit) {
            const std::size_t at = random() % text.size();
            switch (random() % 4) {
                case 0:
                    text[at] = static_cast<char>(random());
                    break;
                case 1:
                    text.erase(at, 1 + random() % 20);
                    break;
                case 2:
                    text.insert(at, pieces[random() % std::size(pieces)]);
                    break;
                default:
                    text.resize(at + 1);
                    break;
            }
        }
        const auto result = json::parse(text, "T");
        if (result) {
            ++parsed;
            schema->validate(*result);
            continue;
        }
        ++refused;
        ASSERT_EQ(result.error().items().size(), 1U);
        const Diagnostic& fault = result.error().items()[0];
        const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
        ASSERT_GE(fault.line, 1U);
        ASSERT_LE(fault.line, lines);
        ASSERT_GE(fault.column, 1U);
        ASSERT_FALSE(fault.text.empty());
        ASSERT_EQ(toString(fault).find('\n'), std::string::npos);
    }
    EXPECT_GT(refused, 500);
    EXPECT_GT(parsed, 50);
}
