// SPDX-License-Identifier: MIT
// Whatever a file says, it gives a plan or lines, never an exception. Edits are structural: every value of a tree
// deleted or replaced, words exchanged, and trees put together at random.
#include "tree_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <random>

namespace pelage::passes::test {
namespace {

struct Tally {
    std::size_t edits = 0, unnoticed = 0;
};

void mustBeSaid(const Diagnostics& found, const std::string& text) {
    EXPECT_TRUE(found.hasErrors()) << text;
    for (const Diagnostic& each : found.items()) {
        EXPECT_FALSE(each.code.empty()) << text;
        EXPECT_FALSE(each.text.empty()) << text;
    }
}

void attempt(const json::Value& root, const HostDescription& host, Tally& tally) {
    ++tally.edits;
    const std::string text = write(root);
    try {
        const auto tree = PassTree::parse(text, "fuzz");
        if (!tree) return mustBeSaid(tree.error(), text);
        const auto plan = (*tree)->compile(host);
        if (!plan) return mustBeSaid(plan.error(), text);
        ++tally.unnoticed;
        for (const PlanPass& pass : plan->passes) {
            for (const PlanSlot& slot : pass.slots)
                EXPECT_TRUE(slot.resource == ~0U || slot.resource < plan->resources.size());
        }
        EXPECT_FALSE(plan->dot().empty());
    } catch (...) {
        FAIL() << "an exception for " << text;
    }
}

std::vector<json::Value> replacements() {
    std::vector<json::Value> made;
    for (const char* text : {"null", "[]", "{}", "\"x\"", "1", "-1.5", "true"}) made.push_back(readJson(text));
    return made;
}

void eachEdit(const std::string& text, const HostDescription& host, Tally& tally) {
    const json::Value original = readJson(text);
    std::size_t count = 0;
    {
        json::Value counted = original;
        forEachValue(counted, [&](json::Value&, std::size_t) { ++count; });
    }
    const std::vector<json::Value> others = replacements();
    for (std::size_t at = 0; at < count; ++at) {
        for (std::size_t kind = 0; kind <= others.size(); ++kind) {
            json::Value root = original;
            json::Value* parent = nullptr;
            std::size_t index = 0, seen = 0;
            forEachValue(root, [&](json::Value& p, std::size_t i) {
                if (seen++ == at) parent = &p, index = i;
            });
            if (kind < others.size()) {
                (parent->isArray() ? parent->elements[index] : parent->members[index].value) = others[kind];
            } else if (parent->isArray()) {
                parent->elements.erase(parent->elements.begin() + static_cast<std::ptrdiff_t>(index));
            } else {
                parent->members.erase(parent->members.begin() + static_cast<std::ptrdiff_t>(index));
            }
            attempt(root, host, tally);
        }
    }
}

TEST(Fuzz, EveryValueDeletedOrReplaced) {
    Tally tally;
    HostDescription frame{.extent = {64, 64, 1}};
    frame.imports["DisplayConstants"] = {true};
    eachEdit(std::string(shippedText("hair_frame.pass.json")), frame, tally);
    eachEdit(wholeGrammar(), host(), tally);
    eachEdit(moreGrammar(), moreHost(), tally);
    RecordProperty("edits", static_cast<int>(tally.edits));
    RecordProperty("unnoticed", static_cast<int>(tally.unnoticed));
    std::cout << tally.edits << " edits, " << tally.unnoticed << " still a plan\n";
    EXPECT_GT(tally.edits, 3000U);
    EXPECT_LT(tally.unnoticed * 5, tally.edits) << "most edits must be noticed";
}

TEST(Fuzz, NamesExchangedAtRandom) {
    // References and words are swapped among themselves: still well-formed, mostly nonsense.
    Tally tally;
    const json::Value original = readJson(wholeGrammar());
    for (unsigned seed = 0; seed < 1000; ++seed) {
        std::mt19937 random(seed);
        json::Value root = original;
        std::vector<json::Value*> words;
        forEachValue(root, [&](json::Value& parent, std::size_t i) {
            json::Value& value = parent.isArray() ? parent.elements[i] : parent.members[i].value;
            if (value.isString()) words.push_back(&value);
        });
        for (int edit = 0; edit < 3; ++edit) {
            json::Value* a = words[random() % words.size()];
            json::Value* b = words[random() % words.size()];
            a->string = b->string;
        }
        attempt(root, host(), tally);
    }
    std::cout << tally.edits << " edits, " << tally.unnoticed << " still a plan\n";
}

TEST(Fuzz, RandomTrees) {
    // Passes that read any earlier or later result: many circles, many second writers, some plans.
    Tally tally;
    for (unsigned seed = 0; seed < 1000; ++seed) {
        std::mt19937 random(seed);
        const auto count = static_cast<unsigned>(1 + random() % 12);
        std::string attachments, passes;
        for (unsigned i = 0; i < count; ++i) {
            const std::string n = std::to_string(i);
            attachments +=
                (i ? "," : "") + std::string("\"A") + n + R"(": { "format": "RGBA8Unorm", "size": { "frame": 1 } })";
            // Mostly the next ones, so that some trees are sound.
            const auto any = [&] {
                return std::to_string(random() % 5 ? std::min(i + 1 + random() % 2, count - 1UL) : random() % count);
            };
            const bool last = i + 1 == count;
            const bool continues = !last && random() % 2 == 0;
            const std::string in = last ? "const.black" : "P" + any() + ".out";
            std::string connect = continues ? "\"P" + any() + ".out\"" : "\"att.A" + (random() % 6 ? n : any()) + "\"";
            if (continues && random() % 2) connect = "[" + connect + ", \"att.A" + n + "\"]";
            passes += (i ? "," : "") + std::string(R"({ "name": "P)") + n +
                      R"(", "kind": "fullscreen", "shader": "x.frag",)" +
                      (random() % 9 == 0 ? R"("enabled": false,)" : "") +
                      (random() % 6 == 0 ? R"("after": ["P)" + any() + R"("],)" : "") +
                      R"( "slots": { "in": { "access": "read", "as": "sampled", "bind": "u_in", "optional": )" +
                      (random() % 2 ? "true" : "false") + R"( }, "out": { "access": ")" +
                      (continues ? "readWrite" : "write") +
                      R"(", "as": "color", "clear": [0, 0, 0, 0] } }, "connect": { "in": ")" + in + R"(", "out": )" +
                      connect + "} }";
        }
        const std::string text = R"({ "format": "pelage.passtree/1", "name": "Random", "attachments": {)" +
                                 attachments + R"(}, "passes": [)" + passes +
                                 R"(], "exports": { "Out": { "from": "P0.out", "optional": true } } })";
        attempt(readJson(text), {.extent = {8, 8, 1}}, tally);
    }
    std::cout << tally.edits << " trees, " << tally.unnoticed << " give a plan\n";
    EXPECT_GT(tally.unnoticed, 20U) << "random trees that never work test nothing";
}

TEST(Fuzz, TextCutAnywhere) {
    const std::string text = wholeGrammar();
    for (std::size_t length = 0; length + 3 < text.size(); length += 7) {
        EXPECT_FALSE(PassTree::parse(std::string_view(text).substr(0, length), "cut")) << length;
    }
}

}  // namespace
}  // namespace pelage::passes::test
