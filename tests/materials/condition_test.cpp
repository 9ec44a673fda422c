// SPDX-License-Identifier: MIT
#include "condition.hpp"
#include "support.hpp"

using namespace pelage;
using namespace pelage::materials;

namespace {

Property make(std::string id, ValueType type, std::vector<std::string> words = {}) {
    Property property;
    property.id = std::move(id);
    property.type = type;
    property.words = std::move(words);
    return property;
}

const std::vector<Property> properties{
    make("a.on", ValueType::Bool), make("a.count", ValueType::Int), make("a.size", ValueType::Float),
    make("a.mode", ValueType::Enum, {"off", "soft", "hard"}), make("a.color", ValueType::Color)};
const std::vector<Value> values{Value::boolean(true),
                                Value::int32(3),
                                Value::scalar(0.1F),
                                {ValueType::Enum, {}, 1, "soft"},
                                Value::color(1, 1, 1)};

}  // namespace

TEST(Condition, EvaluatesWithTheUsualPrecedence) {
    const std::pair<std::string_view, bool> rows[] = {{"a.on", true},
                                                      {"!a.on", false},
                                                      {"!!a.on", true},
                                                      {"a.on == false", false},
                                                      {"a.on != false", true},
                                                      {"a.count > 2", true},
                                                      {"a.count >= 3 && a.count <= 3", true},
                                                      {"a.count < -1", false},
                                                      {"3 == a.count", true},
                                                      {"a.size == 0.1", true},
                                                      {"a.size < 0.1", false},
                                                      {"a.mode == 'soft'", true},
                                                      {"'hard' != a.mode", true},
                                                      {"a.mode in ['off', 'hard']", false},
                                                      {"a.mode in ['off','soft']", true},
                                                      {"a.count in [1, 2, 3]", true},
                                                      {"a.on || a.on && !a.on", true},
                                                      {"(a.on || a.on) && !a.on", false},
                                                      {"true", true},
                                                      {"false || a.count == 3", true}};
    for (const auto& [text, expected] : rows) {
        const auto condition = Condition::parse(text, properties);
        ASSERT_TRUE(condition) << text << ": " << toString(condition.error());
        EXPECT_EQ(condition->evaluate(values), expected) << text;
    }
}

TEST(Condition, FaultsHaveCodeAndColumn) {
    struct Row {
        std::string_view text, code;
        std::uint32_t column;
        std::string_view hint;
    };
    const Row rows[] = {
        {"", "E001", 1, ""},
        {"a.on &&", "E001", 8, ""},
        {"(a.on", "E001", 6, ""},
        {"a.on a.on", "E001", 6, ""},
        {"a.on & a.on", "E001", 6, ""},
        {"a.mode == 'soft", "E001", 11, ""},
        {"a.mode in 'soft'", "E001", 11, ""},
        {"a.mode in ['soft'", "E001", 18, ""},
        {"a.count in []", "E001", 13, ""},
        {"a.count + 1 == 2", "E001", 9, ""},
        {"a.onn", "E002", 1, "did you mean 'a.on'?"},
        {"!a.cuont", "E002", 2, "did you mean 'a.count'?"},
        {"a.mode == 'sotf'", "E003", 11, "did you mean 'soft'?"},
        {"a.mode in ['off', 'x']", "E003", 19, "known: hard, off, soft"},
        {"a.mode", "E004", 1, "compare it: == 'word'"},
        {"a.count", "E004", 1, ""},
        {"a.count == 'soft'", "E004", 12, ""},
        {"a.on < true", "E004", 1, "use == or !="},
        {"a.color == 1", "E004", 1, "only bool, enum and single numbers can be compared"},
        {"'a' == 'a'", "E004", 1, ""},
        {"a.mode == a.mode", "E004", 1, ""},
        {"a.mode in [1]", "E004", 12, ""},
        {"a.on in [1]", "E004", 1, ""},
        {"a.count && a.on", "E004", 1, ""},
        {"!a.count", "E004", 2, ""},
    };
    for (const Row& row : rows) {
        const auto condition = Condition::parse(row.text, properties);
        ASSERT_FALSE(condition) << row.text;
        EXPECT_EQ(condition.error().code, row.code) << row.text << ": " << condition.error().text;
        EXPECT_EQ(condition.error().column, row.column) << row.text << ": " << condition.error().text;
        EXPECT_EQ(condition.error().hint, row.hint) << row.text;
    }
}

TEST(Condition, HostileTextsEnd) {
    EXPECT_FALSE(Condition::parse(std::string(1000, '('), properties));
    EXPECT_FALSE(Condition::parse(std::string(1000, '!') + "a.on", properties));
    EXPECT_FALSE(Condition::parse(std::string(100000, ' '), properties));
    EXPECT_FALSE(Condition::parse("a.count == 1e999", properties));
    std::string chain = "a.on";
    while (chain.size() < 1000) chain += "||a.on";
    EXPECT_TRUE(Condition::parse(chain, properties));
}
