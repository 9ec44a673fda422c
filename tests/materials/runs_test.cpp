// SPDX-License-Identifier: MIT
// Which functors run, and how often: counted by functors registered from outside the library.
#include "support.hpp"

#include <limits>

using namespace pelage;
using namespace pelage::materials;
using namespace pelage::materials::test;

namespace {

// "a" feeds one functor, "b" both, "c" the other, "d" goes to its input directly.
constexpr std::string_view typeText = R"({
"format": "pelage.materialtype/1", "version": 1, "name": "Counted",
"groups": [{ "name": "g", "properties": [
  { "name": "a", "type": "float", "default": 0, "min": -1, "max": 1 },
  { "name": "b", "type": "float", "default": 0 },
  { "name": "c", "type": "float", "default": 0, "visibleWhen": "g.a > 0" },
  { "name": "d", "type": "float3", "default": [0, 0, 0], "enabledWhen": "g.a > 0 && g.b == 0.1",
    "connect": { "input": "d" } }
] }],
"inputs": { "ab": "float", "bc": "float", "d": "float3" },
"shaders": { "main": { "drawList": "forward", "vertex": "a.vert" } },
"functors": [
  { "id": "ab", "type": "Sum", "in": { "x": "g.a", "y": "g.b" }, "out": { "sum": "input.ab" } },
  { "id": "bc", "type": "Product", "in": { "x": "g.b", "y": "g.c" }, "out": { "product": "input.bc" } }
] })";

class Counted : public ::testing::Test {
protected:
    void SetUp() override {
        FunctorRegistry registry = FunctorRegistry::standard();
        const auto add = [&](const char* name, const char* out, int& runs, auto&& combine) {
            FunctorType type;
            type.name = name;
            type.in = {{"x"}, {"y"}};
            type.out = {{out}};
            type.run = [&runs, combine](std::span<const Value> in, FunctorOutputs& outputs) {
                ++runs;
                outputs.set(0, Value::scalar(combine(in[0].number[0], in[1].number[0])));
            };
            return registry.add(std::move(type));
        };
        ASSERT_TRUE(add("Sum", "sum", sums, [](float x, float y) { return x + y; }));
        ASSERT_TRUE(add("Product", "product", products, [](float x, float y) { return x * y; }));
        const auto type = MaterialType::parse(typeText, "T", registry);
        ASSERT_TRUE(type) << type.error().text();
        material.emplace(*type);
        sums = products = 0;  // reading a type tries each functor once
    }

    // Runs of Sum and Product in a compile() after this change.
    std::pair<int, int> runsAfter(std::string_view id, const Value& value) {
        material->set(id, value);
        return runs();
    }
    std::pair<int, int> runs() {
        const int sumsBefore = sums, productsBefore = products;
        material->compile();
        return {sums - sumsBefore, products - productsBefore};
    }

    int sums = 0, products = 0;
    std::optional<Material> material;
};

using Runs = std::pair<int, int>;

TEST_F(Counted, EachRunsOnceAtFirstAndNothingRunsAgain) {
    EXPECT_EQ(runs(), Runs(1, 1));
    for (int i = 0; i < 3; ++i) EXPECT_EQ(runs(), Runs(0, 0));
    EXPECT_EQ(material->compile().functorRuns, 2U);
}

TEST_F(Counted, AChangeRunsItsReadersOnly) {
    runs();
    EXPECT_EQ(runsAfter("g.a", Value::scalar(0.5F)), Runs(1, 0));
    EXPECT_EQ(runsAfter("g.b", Value::scalar(0.25F)), Runs(1, 1));
    EXPECT_EQ(runsAfter("g.c", Value::scalar(4)), Runs(0, 1));
    EXPECT_EQ(runsAfter("g.d", Value::float3(1, 2, 3)), Runs(0, 0)) << "connected without a functor";
    EXPECT_EQ(number(material->compile(), "ab"), 0.75F);
    EXPECT_EQ(number(material->compile(), "bc"), 1.0F);
    EXPECT_EQ(number(material->compile(), "d", 2), 3.0F);
}

TEST_F(Counted, WhatIsNoChangeRunsNothing) {
    runs();
    EXPECT_EQ(runsAfter("g.a", Value::scalar(0)), Runs(0, 0)) << "the same value";
    EXPECT_EQ(runsAfter("g.none", Value::scalar(1)), Runs(0, 0));
    EXPECT_EQ(runsAfter("g.a", Value::scalar(std::numeric_limits<float>::quiet_NaN())), Runs(0, 0)) << "refused";
    EXPECT_EQ(runsAfter("g.a", Value::scalar(7)), Runs(1, 0)) << "clamped to 1";
    EXPECT_EQ(runsAfter("g.a", Value::scalar(9)), Runs(0, 0)) << "clamped to 1 again";
    EXPECT_EQ(number(material->compile(), "ab"), 1.0F);
}

TEST_F(Counted, SeveralChangesRunAReaderOnce) {
    runs();
    material->set("g.a", Value::scalar(0.5F));
    material->set("g.b", Value::scalar(0.5F));
    material->set("g.b", Value::scalar(0.75F));
    EXPECT_EQ(runs(), Runs(1, 1));
    material->reset();
    EXPECT_EQ(runs(), Runs(1, 1));
    material->reset();
    EXPECT_EQ(runs(), Runs(0, 0));
}

TEST_F(Counted, ANumberThatIsNotFiniteNeverLeavesAFunctor) {
    runs();
    const float largest = std::numeric_limits<float>::max();
    EXPECT_EQ(runsAfter("g.b", Value::scalar(largest)), Runs(1, 1));
    const CompiledMaterial before = material->compile();
    EXPECT_EQ(runsAfter("g.c", Value::scalar(largest)), Runs(0, 1));
    EXPECT_EQ(number(material->compile(), "bc"), 0.0F) << "the last good value stays";
    EXPECT_EQ(material->compile().inputs, before.inputs);
}

TEST_F(Counted, ConditionsFollowTheValuesWithoutCompiling) {
    EXPECT_FALSE(material->isVisible("g.c"));
    EXPECT_TRUE(material->isVisible("g.d"));
    EXPECT_FALSE(material->isEnabled("g.d"));
    material->set("g.a", Value::scalar(0.5F));
    material->set("g.b", Value::scalar(0.1F));
    EXPECT_TRUE(material->isVisible("g.c"));
    EXPECT_TRUE(material->isEnabled("g.d"));
    EXPECT_EQ(sums + products, 0);
}

TEST(FunctorRegistry, ANameIsGivenOnce) {
    FunctorRegistry registry = FunctorRegistry::standard();
    FunctorType again;
    again.name = "TexturedColor";
    EXPECT_FALSE(registry.add(again));
}

}  // namespace
