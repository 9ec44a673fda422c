// SPDX-License-Identifier: MIT
// Whatever a file says, it gives a plan or lines, never an exception. Edits are structural: every value of a tree
// deleted or replaced, words exchanged, and trees put together at random.
#include "tree_text.hpp"

#include <gtest/gtest.h>

#include <pelage/passes/page.hpp>

#include <algorithm>
#include <iostream>
#include <random>
#include <set>
#include <span>

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

enum class Answer { Refused, Warned, Silent };

Answer attempt(const json::Value& root, const HostDescription& host, Tally& tally) {
    ++tally.edits;
    const std::string text = write(root);
    try {
        const auto tree = PassTree::parse(text, "fuzz");
        if (!tree) return mustBeSaid(tree.error(), text), Answer::Refused;
        const auto plan = (*tree)->compile(host);
        if (!plan) return mustBeSaid(plan.error(), text), Answer::Refused;
        ++tally.unnoticed;
        for (const PlanPass& pass : plan->passes) {
            for (const PlanSlot& slot : pass.slots)
                EXPECT_TRUE(slot.resource == ~0U || slot.resource < plan->resources.size());
        }
        EXPECT_FALSE(plan->dot().empty());
        EXPECT_NE(html(*plan).find("</html>"), std::string::npos);
        return (*tree)->warnings().empty() && plan->warnings.empty() ? Answer::Silent : Answer::Warned;
    } catch (...) {
        ADD_FAILURE() << "an exception for " << text;
        return Answer::Refused;
    }
}

constexpr const char* replacements[] = {"null", "[]", "{}", "\"x\"", "1", "-1.5", "true"};

// Where a value stands, with * for names that the file gives and # for places in a list: "passes.#.slots.*.clear.#".
std::string placeOf(const json::Value& root, const std::vector<std::size_t>& path) {
    static const std::set<std::string> named = {"settings",  "imports",    "views",       "attachments",
                                                "templates", "exports",    "slots",       "connect",
                                                "constants", "parameters", "whenDisabled"};
    std::string place;
    const json::Value* value = &root;
    bool names = false;
    for (const std::size_t index : path) {
        if (!place.empty()) place += '.';
        if (value->isArray()) {
            place += '#';
            value = &value->elements[index];
            names = false;
            continue;
        }
        const json::Member& member = value->members[index];
        place += names ? "*" : member.key;
        names = !names && named.count(member.key) != 0;
        value = &member.value;
    }
    return place;
}

void forEachPath(const json::Value& value, std::vector<std::size_t>& path,
                 const std::function<void(const std::vector<std::size_t>&)>& use) {
    const std::size_t count = value.isArray() ? value.elements.size() : value.members.size();
    for (std::size_t i = 0; i < count; ++i) {
        path.push_back(i);
        use(path);
        forEachPath(value.isArray() ? value.elements[i] : value.members[i].value, path, use);
        path.pop_back();
    }
}

json::Value& at(json::Value& root, std::span<const std::size_t> path) {
    json::Value* value = &root;
    for (const std::size_t index : path)
        value = value->isArray() ? &value->elements[index] : &value->members[index].value;
    return *value;
}

/// Every value deleted and replaced; the edits that are taken without a word, by place and replacement.
std::set<std::string> eachEdit(const std::string& text, const HostDescription& host, Tally& tally) {
    const json::Value original = readJson(text);
    const std::string whole = write(original);
    std::set<std::string> silent;
    std::vector<std::size_t> start;
    forEachPath(original, start, [&](const std::vector<std::size_t>& path) {
        const std::string place = placeOf(original, path);
        for (std::size_t kind = 0; kind <= std::size(replacements); ++kind) {
            json::Value root = original;
            json::Value& parent = at(root, std::span(path).first(path.size() - 1));
            const auto index = static_cast<std::ptrdiff_t>(path.back());
            if (kind < std::size(replacements)) {
                at(root, path) = readJson(replacements[kind]);
                if (write(root) == whole) continue;  // it says that already
            } else if (parent.isArray()) {
                parent.elements.erase(parent.elements.begin() + index);
            } else {
                parent.members.erase(parent.members.begin() + index);
            }
            const std::string edit = kind < std::size(replacements) ? replacements[kind] : "deleted";
            if (attempt(root, host, tally) == Answer::Silent) silent.insert(place + " " + edit);
        }
    });
    return silent;
}

// Edits that are taken without a word, and why that is right. Whatever else is taken silently is a fault.
struct Legal {
    const char* place;
    std::vector<const char*> edits;
    const char* why;
};

const std::vector<Legal>& legalEdits() {
    static const std::vector<Legal> all = {
        {"$schema", {"\"x\"", "deleted"}, "for editors"},
        {"name", {"\"x\""}, "another name"},
        {"description", {"\"x\"", "deleted"}, "for people"},
        {"settings.*.description", {"\"x\"", "deleted"}, "for people"},
        {"imports.*.description", {"\"x\"", "deleted"}, "for people"},
        {"passes.#.description", {"\"x\"", "deleted"}, "for people"},
        {"settings.*.default", {"1"}, "another value in range"},
        {"settings.*.min", {"1", "deleted"}, "another range around the default; 0 when absent"},
        {"settings.*.max", {"1", "deleted"}, "another range around the default; the greatest number when absent"},
        {"settings.*.multipleOf", {"1", "deleted"}, "1 when absent"},
        {"settings.*.values.#", {"\"x\"", "deleted"}, "another list of words, none of which is used elsewhere"},
        {"imports.*.formats", {"deleted"}, "any format"},
        {"imports.*.formats.#", {"deleted"}, "fewer formats, that of the host among them"},
        {"imports.*.samples", {"deleted"}, "any number of samples"},
        {"imports.*.optional", {"deleted"}, "an import that the host does lend"},
        {"views.*.count", {"1"}, "another number of views"},
        {"attachments.*.formatFallbacks", {"[]", "deleted"}, "the first format is there"},
        {"attachments.*.formatFallbacks.#", {"deleted"}, "the first format is there"},
        {"attachments.*.layers", {"1", "deleted"}, "one view of the kind, so one layer; 1 when absent"},
        {"attachments.*.size.fixed.#", {"1"}, "another size"},
        {"attachments.*.size.scale", {"1", "deleted"}, "another size; 1 when absent"},
        {"attachments.*.bytes", {"1"}, "another size"},
        {"attachments.*.bytes.like", {"deleted"}, "the frame's pixels"},
        {"attachments.*.bytes.perPixel", {"1"}, "another size"},
        {"exports.*", {"deleted"}, "another export needs the same passes"},
        {"exports.*.optional", {"deleted"}, "an export that there is"},
        {"templates.*.slots.*.bind", {"\"x\""}, "only the shader knows its names (S010)"},
        {"passes.#.slots.*.bind", {"\"x\""}, "only the shader knows its names (S010)"},
        {"passes.#.shader", {"\"x\""}, "only the host knows its shaders (S001)"},
        {"passes.#.shader.then", {"\"x\""}, "only the host knows its shaders (S001)"},
        {"passes.#.shader.else", {"\"x\""}, "only the host knows its shaders (S001)"},
        {"passes.#.constants", {"{}", "deleted"}, "the shader's defaults"},
        {"passes.#.constants.*", {"1", "-1.5", "true", "deleted"}, "only the shader knows their types"},
        {"passes.#.parameters.*", {"1"}, "another value in range"},
        {"passes.#.enabledWhen", {"deleted"}, "always on"},
        {"passes.#.forEachView", {"deleted"}, "one view of the kind"},
        {"passes.#.after", {"[]", "deleted"}, "an order that only the author wanted"},
        {"passes.#.after.#", {"deleted"}, "an order that only the author wanted"},
        {"passes.#.dispatchIndirect", {"deleted"}, "one workgroup when absent"},
        {"passes.#.dispatchIndirect.offset", {"deleted"}, "0 when absent"},
        {"passes.#.drawList", {"deleted"}, "a class that takes no list"},
        {"attachments.*.size.depth", {"1", "deleted"}, "another size; an image that is not 3D"},
        {"attachments.*.size.square", {"1"}, "another size"},
        {"attachments.*.mipLevels", {"1", "deleted"}, "1 when absent"},
        {"passes.#.threads", {"deleted"}, "8 x 8 when absent"},
        {"passes.#.threads.#", {"1"}, "another workgroup"},
        {"passes.#.connect.*", {"deleted"}, "an optional slot"},
        {"passes.#.connect.*.#", {"deleted"}, "another of the list is there"},
        {"passes.#.whenDisabled", {"{}", "deleted"}, "a reader has another source, or is optional"},
        {"passes.#.whenDisabled.*", {"deleted"}, "a reader has another source, or is optional"},
        {"passes.#.slots.*.blend", {"deleted"}, "off when absent"},
        {"passes.#.slots.*.clear", {"deleted"}, "a slot that continues from another pass"},
        {"passes.#.slots.*.clear.#", {"1", "-1.5"}, "another colour, of a float format where it is below 0"},
        {"passes.#.slots.*.clear.depth", {"1"}, "another depth"},
        {"passes.#.slots.*.depthTest", {"deleted"}, "nearerEqual when absent"},
        {"passes.#.slots.*.load", {"deleted"}, "a slot that covers its target"},
    };
    return all;
}

TEST(Fuzz, EveryValueDeletedOrReplaced) {
    Tally tally;
    std::set<std::string> silent;
    HostDescription frame{.extent = {64, 64, 1}};
    frame.imports["DisplayConstants"] = {true};
    HostDescription lent{.extent = {64, 48, 1}};
    lent.imports["SceneColor"] = {true, rhi::TextureFormat::RGBA16Float, {64, 48, 1}, 1};
    lent.imports["SceneDepth"] = {true, rhi::TextureFormat::Depth32Float, {64, 48, 1}, 1};
    lent.imports["FrameConstants"] = {true};
    for (const auto& [text, host] :
         {std::pair(shippedText("hair_frame.pass.json"), frame), std::pair(shippedText("hair_host.pass.json"), lent),
          std::pair(wholeGrammar(), test::host()), std::pair(moreGrammar(), moreHost())}) {
        silent.merge(eachEdit(text, host, tally));
    }
    std::cout << tally.edits << " edits, " << tally.unnoticed << " still a plan\n";
    std::set<std::string> legal;
    for (const Legal& each : legalEdits()) {
        for (const char* edit : each.edits) legal.insert(std::string(each.place) + " " + edit);
    }
    for (const std::string& each : silent) EXPECT_EQ(legal.count(each), 1U) << "taken without a word: " << each;
    for (const std::string& each : legal) EXPECT_EQ(silent.count(each), 1U) << "no longer taken silently: " << each;
    EXPECT_GT(tally.edits, 5815U);
}

// What a validator by structure alone lets through: words in the wrong place, numbers out of what they mean.
TEST(Fuzz, WhatOnlyMeaningForbidsIsRefused) {
    struct Case {
        const char *from, *to, *code;
    };
    const std::string frame = shippedText("hair_frame.pass.json");
    for (const Case& each : {Case{R"("values": ["1", "4"])", R"("values": ["1", "3", "4"])", "P043"},
                             Case{R"("values": ["1", "4"])", R"("values": ["1", "few", "4"])", "P043"},
                             Case{R"("clear": { "depth": "far" })", R"("clear": {})", "J011"},
                             Case{R"("map": "const.depthFarArray")", R"("map": "depthFarArray")", "P015"},
                             Case{R"("map": "const.depthFarArray")", R"("map": "Depth.depth")", "P045"},
                             Case{R"("clear": { "depth": "far" })", R"("clear": { "depth": 1.5 })", "J014"},
                             Case{R"("size": { "frame": 1 } })", R"("size": { "frame": 1, "scale": 2 } })", "P0"}}) {
        const auto tree = PassTree::parse(edited(frame, each.from, each.to), "t");
        ASSERT_FALSE(tree) << each.to;
        EXPECT_EQ(tree.error().items().front().code.text().rfind(each.code, 0), 0U) << each.to << "\n"
                                                                                    << tree.error().text();
    }
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
