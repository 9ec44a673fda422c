// SPDX-License-Identifier: MIT
#include <pelage/base/condition.hpp>

#include <gtest/gtest.h>

#include <utility>

using namespace pelage;
using json::Condition;
using json::ConditionNames;

namespace {

const ConditionNames names{.names = {{"a.on", ConditionNames::Type::Bool},
                                     {"a.count", ConditionNames::Type::Number},
                                     {"a.size", ConditionNames::Type::Number, {}, true},
                                     {"a.mode", ConditionNames::Type::Word, {"off", "soft", "hard"}},
                                     {"a.color", ConditionNames::Type::Other}},
                           .function = {"host.has", "import", {"Sky", "Depth"}}};

// On, 3, a float of 0.1, soft; the host has no Sky but has Depth.
double value(std::size_t index) {
    const double all[] = {1, 3, static_cast<double>(0.1F), 1, -1, 0, 1};
    return all[index];
}

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
                                                      {"a.size in [0.5, 0.1]", true},
                                                      {"a.count == 3.0000001", false},
                                                      {"host.has('Depth')", true},
                                                      {"!host.has('Sky') && host.has('Depth') == a.on", true},
                                                      {"host.has('Sky') || a.mode == 'hard'", false},
                                                      {"false || a.count == 3", true}};
    for (const auto& [text, expected] : rows) {
        const auto condition = Condition::parse(text, names);
        ASSERT_TRUE(condition) << text << ": " << condition.error().text();
        EXPECT_EQ(condition->evaluate(value), expected) << text;
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
        {"host.hass('Sky')", "E002", 1, "did you mean 'host.has'?"},
        {"host.has('Sly')", "E002", 10, "did you mean 'Sky'?"},
        {"host.has(Sky)", "E001", 10, ""},
        {"host.has('Sky'", "E001", 15, ""},
        {"host.has", "E001", 9, ""},
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
        const auto condition = Condition::parse(row.text, names);
        ASSERT_FALSE(condition) << row.text;
        EXPECT_EQ(condition.error().first().code.text(), row.code)
            << row.text << ": " << condition.error().first().text;
        EXPECT_EQ(condition.error().first().column, row.column) << row.text << ": " << condition.error().first().text;
        EXPECT_EQ(condition.error().first().hint, row.hint) << row.text;
    }
}

TEST(Condition, SaysWhatItReads) {
    const auto condition = Condition::parse("a.count > 1 && (a.mode == 'off' || host.has('Depth')) && true", names);
    ASSERT_TRUE(condition);
    EXPECT_EQ(condition->reads(), (std::vector<std::size_t>{1, 3, 6}));
    EXPECT_TRUE(Condition().evaluate(value)) << "never parsed";
    EXPECT_TRUE(Condition().reads().empty());
}

TEST(Condition, WithoutAFunctionNothingCanBeCalled) {
    const auto condition = Condition::parse("host.has('Sky')", {.names = names.names});
    ASSERT_FALSE(condition);
    EXPECT_EQ(condition.error().first().code, Code("E002"));
}

TEST(Condition, HostileTextsEnd) {
    EXPECT_FALSE(Condition::parse(std::string(1000, '('), names));
    EXPECT_FALSE(Condition::parse(std::string(1000, '!') + "a.on", names));
    EXPECT_FALSE(Condition::parse(std::string(100000, ' '), names));
    EXPECT_FALSE(Condition::parse("a.count == 1e999", names));
    std::string chain = "a.on";
    while (chain.size() < 1000) chain += "||a.on";
    EXPECT_TRUE(Condition::parse(chain, names));
}
