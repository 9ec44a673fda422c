// SPDX-License-Identifier: MIT
// One malformed text for each code. A text is the whole-grammar tree with one edit; it must give that code and no
// other, at the place of `at` in the edited text.
#include "tree_text.hpp"

#include <gtest/gtest.h>

#include <set>

namespace pelage::passes::test {
namespace {

enum class When { Parse, ParseWarning, Compile, CompileWarning };

struct Case {
    std::string code;
    When when;
    std::string from, to, at;
    std::size_t offset = 0;                // of the place behind the beginning of `at`
    std::string says = {};                 // a part of the text or hint
    std::string again = {}, instead = {};  // a second edit
    bool more = false;                     // of the other tree
};

const std::vector<Case>& cases() {
    static const std::vector<Case> all{
        {
            "J010",
            When::Parse,
            R"("connect": { "map": "att.Map")",
            R"("conect": { "map": "att.Map")",
            "\"conect\"",
            0,
            "connect",
        },
        {"J020", When::Parse, "pelage.passtree/1", "pelage.passtree/9", "\"pelage.passtree/9\"", 0,
         "pelage.passtree/1"},
        {"P001", When::Parse, R"("name": "Keep")", R"("name": "host")", "\"host\"", 0, "reserved", "\"Keep.to\"",
         "\"Final.color\""},
        {"P002", When::Parse, R"("name": "Keep")", R"("name": "Blur")", "\"Blur\", \"kind\"", 0, "first at",
         "\"Keep.to\"", "\"Final.color\""},
        {"P003", When::Parse, R"("template": "Screenwide", "shader": "blur.frag")",
         R"("template": "Screenwide", "kind": "fullscreen", "shader": "blur.frag")", "{\n      \"name\": \"Blur\"", 0,
         "exactly one"},
        {"P004", When::Parse, R"("template": "Screenwide", "shader": "present.frag")",
         R"("template": "Screenwid", "shader": "present.frag")", "\"Screenwid\"", 0, "Screenwide",
         R"("Screen": { "from": "Present.color")", R"("Screen": { "from": "Final.color")"},
        {"P005", When::Parse, R"("default": 256)", R"("default": 255)", "255", 0, "multiple of 64"},
        {"P005", When::Parse, R"("default": "soft")", R"("default": "sofd")", "\"sofd\"", 0, "'soft'"},
        {"P005", When::Parse, R"("type": "bool", "default": true)", R"("type": "bool", "default": 1)",
         "1 }\n  },\n  \"imports\"", 0, "true or false"},
        {"P006", When::Parse, R"("min": 64)", R"("min": 5000)", "5000", 0, "above max"},
        {"P007", When::Parse, R"("values": ["soft", "hard"], )", "", "{ \"type\": \"enum\", \"default\": \"soft\"", 0,
         "values"},
        {"P008", When::Parse, R"("slots": { "scene": {)",
         R"("slots": { "source": { "access": "read", "as": "sampled", "bind": "u_x" }, "scene": {)",
         "\"source\": { \"access\": \"read\", \"as\": \"sampled\", \"bind\": \"u_x\"", 0, "template"},
        {"P010", When::Parse, R"( "drawList": "hair.shadow",)", "", "{\n      \"name\": \"Shadow\"", 0, "drawList"},
        {"P011", When::Parse, R"("drawList": "hair.forward", "sort")", R"("drawList": "hair.foward", "sort")",
         "\"hair.foward\"", 0, "hair.forward"},
        {"P012", When::Parse, R"(, "shader": "blur.frag")", "", "{\n      \"name\": \"Blur\"", 0, "no \"shader\""},
        {"P013", When::Parse, R"("table": "Count.table", "lights")", R"("lights")", "\"table\":  {", 0,
         "not connected"},
        {"P014", When::Parse, R"("connect": { "source": "Blur.color", "color")",
         R"("connect": { "source": "Blur.color", "colour")", "\"colour\"", 0, "color",
         R"("slots": { "source": { "access": "read", "as": "sampled", "bind": "u_source" }, "color": { "access": "write", "as": "color" })",
         R"("slots": { "source": { "access": "read", "as": "sampled", "bind": "u_source" }, "color": { "access": "write", "as": "color", "optional": true })"},
        {"P015", When::Parse, R"("from": "Keep.to")", R"("from": "Keep")", "\"Keep\" },", 0, "Pass.slot"},
        {"P016", When::Parse, R"("source": "Blur.color")", R"("source": "Blr.color")", "\"Blr.color\"", 0, "'Blur'"},
        {"P016", When::Parse, R"("source": "Blur.color")", R"("source": "Blur.colour")", "\"Blur.colour\"", 0,
         "'color'"},
        {"P016", When::Parse, R"("sky": "host.Sky")", R"("sky": "host.Skye")", "\"host.Skye\"", 0, "'host.Sky'"},
        {"P016", When::Parse, R"("color": "att.Blur")", R"("color": "att.Blurr")", "\"att.Blurr\"", 0, "'att.Blur'"},
        {"P016", When::Parse, R"("after": ["Count"])", R"("after": ["Cout"])", "\"Cout\"", 0, "'Count'"},
        {"P017", When::Parse, R"("color": "att.Half")", R"("color": "host.Scene")",
         "\"host.Scene\", \"color\": \"host.Scene\"", 23, "read-only"},
        {"P018", When::Parse, R"(, "bind": "u_sky", "optional": true)", R"(, "bind": "u_sky")", "\"host.Sky\"", 0,
         "may be absent"},
        {
            "P019",
            When::Parse,
            R"("source": "Resolve.color")",
            R"("source": "att.Half")",
            "\"att.Half\", \"color\": \"att.Blur\"",
            0,
            "'Resolve.color'",
        },
        {"P020", When::Parse, R"(, "bind": "u_map")", "", "\"map\":    {", 0, "no \"bind\""},
        {"P020", When::Parse, R"("as": "color", "clear")", R"("as": "color", "bind": "u_x", "clear")", "\"u_x\"", 0,
         "remove"},
        {"P021", When::Parse, R"(, "clear": [0, 0, 0, 0])", "", "\"color\":  {", 0, "dontCare"},
        {"P022", When::Parse, R"("source": "Blur.color", "color": "att.Final")",
         R"("source": "Blur.color", "color": "Keep.to")", "\"Keep.to\"", 0, "readWrite"},
        {"P023", When::Parse, R"("access": "write", "as": "storage", "bind")",
         R"("access": "write", "as": "color", "clear": [0,0,0,0], "bind")", "\"table\": { \"access\": \"write\"", 0,
         "compute"},
        {"P024", When::Parse, R"("view": "shadow", "forEachView": "layer", )", "", "{\n      \"name\": \"Shadow\"", 0,
         "no \"view\""},
        {"P025", When::Parse, R"({ "fixed": [16, 8] })", R"({ "fixed": [16, 8], "frame": 1 })",
         "{ \"fixed\": [16, 8], \"frame\"", 0, "exactly one"},
        {"P026", When::Parse, R"("formatFallbacks": ["RGBA32Float"])", R"("formatFallbacks": ["Depth32Float"])",
         "\"Depth32Float\"], \"size\"", 0, "stand in"},
        {"P027", When::Parse, R"("clear": [0, 0, 0, 0])", R"("clear": { "depth": "far" })",
         "{ \"depth\": \"far\" } }\n      },", 0, "[r, g, b, a]"},
        {"P027", When::Parse, R"("clear": { "depth": "far" } } },
      "connect": { "map")",
         R"("clear": { "depth": "fat" } } },
      "connect": { "map")",
         "\"fat\"", 0, "'far'"},
        {"P028", When::Parse, R"("dispatchLike": "table", "threads")", R"("threads")", "\"threads\"", 0,
         "dispatchLike"},
        {"P028", When::Parse, R"("threads": [8, 4, 1])", R"("dispatch": [1, 1, 1])", "\"table\", \"dispatch\"", 0,
         "both"},
        {"P029", When::Parse, R"("layers": { "view": "shadow" })", R"("layers": { "view": "shadw" })", "\"shadw\"", 0,
         "'shadow'"},
        {"P030", When::Parse, R"("Final": { "format": "RGBA8Unorm")", R"("Final": { "format": "RGBA8Unrm")",
         "\"RGBA8Unrm\"", 0, "RGBA8Unorm"},
        {"P031", When::Parse, R"("like": "host.Scene")", R"("like": "host.Scne")", "\"host.Scne\"", 0, "'host.Scene'"},
        {"P032", When::Parse, R"("size": { "like": "host.Scene", "scale": 0.5 })", R"("size": { "like": "att.Blur" })",
         "\"att.Blur\" } },\n    \"Blur\"", 0, "circle"},
        {"P033", When::CompileWarning, R"(["Glass.color", "Hair.color"])", R"("Hair.color")",
         "\"Hair.color\", \"scene\"", 0, "'Glass.color'", R"("exports": {)",
         R"("exports": { "Glass": { "from": "Glass.color", "optional": true },)"},
        {"P034", When::Compile, R"("color": "att.Blur")", R"("color": "att.Half")",
         "\"att.Half\" }\n    },\n    {\n      \"name\": \"Final\"", 0, "'Resolve.color'",
         R"("Blur":  { "format": "RGBA16Float", "size": { "like": "att.Half" } },)", ""},
        {"P035", When::Parse, R"("source": "Blur.color", "color": "att.Final")",
         R"("source": "Final.color", "color": "att.Final")", "\"Final.color\", \"color\": \"att.Final\"", 0, "itself"},
        {"P036", When::Parse, R"("source": "Blur.color", "color": "att.Final")",
         R"("source": "Blur.source", "color": "att.Final")", "\"Blur.source\"", 0, "'Resolve.color'"},
        {"P037", When::Compile, R"("Final": { "format": "RGBA8Unorm")", R"("Final": { "format": "Depth32Float")",
         "\"att.Final\" }", 0, "Depth32Float", R"("Kept":  { "format": "RGBA8Unorm")",
         R"("Kept":  { "format": "Depth32Float")"},
        {"P038", When::Compile,
         R"("Depth": { "format": "Depth32Float", "size": { "like": "att.Hair" }, "samples": { "setting": "msaa" } })",
         R"("Depth": { "format": "Depth32Float", "size": { "like": "att.Hair" } })", "\"att.Hair\"\n      }", 0,
         "samples", "overlay &&", "!overlay &&"},
        {"P039", When::Compile, R"("view": "shadow", "forEachView": "layer", )", R"("view": "shadow", )", "\"att.Map\"",
         0, "forEachView"},
        {"P039", When::Compile, R"("Kept":  { "format": "RGBA8Unorm", "size": { "frame": 1 } })",
         R"("Kept":  { "format": "RGBA8Unorm", "size": { "frame": 2 } })", "\"att.Kept\"", 0, "equal images"},
        {"P040", When::Parse, R"("type": "bool", "default": true)", R"("type": "bool", "default": true, "min": 0)",
         "\"min\": 0 }\n  },", 0, "remove"},
        {"P041", When::Parse, R"("square": { "setting": "size" })", R"("square": { "setting": "sizes" })", "\"sizes\"",
         0, "'size'"},
        {"P042", When::Compile, R"("scene": "host.Scene", "color": "att.Half")",
         R"("scene": ["host.Screen", "host.Scene"], "color": ["host.Screen", "att.Half"])",
         "\"host.Screen\", \"host.Scene\"", 0, "at once", "host.has('Screen')", "!host.has('Screen')"},
        {"P042", When::Compile, R"({ "fixed": [16, 8] })", R"({ "fixed": [16, 8] }, "samples": 4)", "\"att.Table\"", 0,
         "4 samples"},
        {"P043", When::Parse,
         R"("Hair":  { "format": "RGBA16Float", "formatFallbacks": ["RGBA32Float"], "size": { "frame": 1 }, "samples": { "setting": "msaa" } })",
         R"("Hair":  { "format": "RGBA16Float", "size": { "frame": 1 }, "samples": { "setting": "look" } })",
         "\"look\" } },", 0, "\"1\", \"2\", \"4\", \"8\""},
        {"P044", When::Parse, R"(,
      "whenDisabled": { "map": "const.depthFarArray" })",
         "", "\"Shadow.map\"", 0, "can be disabled"},
        {"P044", When::Parse, R"("name": "Keep", )", R"("name": "Keep", "enabled": false, )", "\"Keep.to\"", 0,
         "mark the export optional"},
        {"P045", When::Parse, R"("whenDisabled": { "map": "const.depthFarArray" })",
         R"("whenDisabled": { "map": "const.white" })", "\"const.white\"", 0, "stand in"},
        {"P046", When::Compile, R"("name": "Shadow", "kind")", R"("after": ["Final"], "name": "Shadow", "kind")",
         "\"Final\", \"template\"", 0, "wait for each other"},
        {"P047", When::ParseWarning, R"("Final": { "format": "RGBA8Unorm")",
         R"("Spare": { "format": "RGBA8Unorm", "size": { "frame": 1 } }, "Final": { "format": "RGBA8Unorm")",
         "\"Spare\"", 0, "never used"},
        {"P048", When::CompileWarning, R"("Kept":   { "from": "Keep.to" },)", "", "\"Keep\"", 0, "no export"},
        {"P049", When::ParseWarning, R"(["Glass.color", "Hair.color"])", R"(["Glas.color", "Hair.color"])",
         "\"Glas.color\"", 0, "'Glass'"},
        {"P050", When::Parse, R"("bind": "u_scene")", R"("bind": "u_source")", "\"u_source\" } },\n      \"connect\"",
         0, "same resource"},
        {"P051", When::Parse, R"("color":  { "access": "write", "as": "color", "clear": [0, 0, 0, 0] })",
         R"("color":  { "access": "write", "as": "depth", "clear": { "depth": "near" } })",
         "{\n      \"name\": \"Hair\"", 0, "more than one depth"},
        {"P052", When::Parse, R"("to": { "access": "write", "as": "copy" })",
         R"("to": { "access": "write", "as": "copy" }, "also": { "access": "read", "as": "copy", "optional": true })",
         "{\n      \"name\": \"Keep\"", 0, "one slot that reads"},
        {"P003", When::Parse, R"("class": "Blend")", R"("class": "Blend", "kind": "raster")",
         "{\n      \"name\": \"Blend\"", 0, "exactly one", "", "", true},
        {"P014", When::Parse, R"("dispatchIndirect": "args")", R"("dispatchIndirect": "arg")", "\"arg\"", 0, "'args'",
         "", "", true},
        {"P017", When::Parse, R"("points": "att.Points")", R"("points": "history.Points")", "\"history.Points\" }\n", 0,
         "'att.Points'", "", "", true},
        {"P023", When::Parse, R"("dispatchIndirect": "args")", R"("dispatchIndirect": "before")", "\"before\",\n", 0,
         "indirect", "", "", true},
        {"P023", When::Parse, R"("points": { "access": "read", "as": "vertex" })",
         R"("points": { "access": "readWrite", "as": "vertex" })", "\"points\": { \"access\": \"readWrite\"", 0,
         "only be read", "", "", true},
        {"P023", When::Compile, R"("heads": { "access": "read", "as": "storage", "bind": "b_heads" })",
         R"("heads": { "access": "read", "as": "copy" })", "\"heads\": { \"access\": \"read\"", 0, "class 'Blend'", "",
         "", true},
        {"P024", When::Parse, R"("class": "Blend",)", R"("class": "Blend", "drawList": "hair.forward",)",
         "\"hair.forward\",\n      \"slots\": {\n        \"drawn\"", 0, "its class records it", "", "", true},
        {"P027", When::Parse, R"("clear": [0.25, 0, 0, 1])", R"("clear": 0)",
         "0 }\n      },\n      \"connect\": { \"drawn\"", 0, "[r, g, b, a]", "", "", true},
        {"P028", When::Parse, R"("dispatchIndirect": "args")", R"("dispatch": [1, 1, 1], "dispatchIndirect": "args")",
         "\"args\",\n      \"slots\"", 0, "both", "", "", true},
        {"P031", When::Parse, R"("like": "att.Drawn")", R"("like": "att.Points")", "\"att.Points\" } },", 0, "image",
         "", "", true},
        {"P037", When::Parse, R"("drawn": "Draw.color")", R"("drawn": "host.Shape")", "\"host.Shape\", \"last\"", 0,
         "a buffer", "", "", true},
        {"P037", When::Compile, R"("drawn": "Draw.color")", R"("drawn": "Move.points")", "\"Move.points\", \"last\"", 0,
         "a buffer", "", "", true},
        {"P039", When::Compile, R"("Copied": { "kind": "buffer", "bytes": { "setting": "strands", "times": 16 } })",
         R"("Copied": { "kind": "buffer", "bytes": { "setting": "strands", "times": 8 } })", "\"att.Copied\"", 0,
         "size", "", "", true},
        {"P041", When::Parse, R"({ "setting": "glow" })", R"({ "setting": "glw" })", "\"glw\"", 0, "'glow'", "", "",
         true},
        {"P047", When::ParseWarning, R"("Drawn":  { "format": "RGBA16Float",)",
         R"("Drawn":  { "history": 1, "format": "RGBA16Float",)", "\"Drawn\":", 0, "history", "", "", true},
        {"P053", When::Compile, R"("class": "Blend")", R"("class": "Blnd")", "\"Blnd\"", 0, "'Blend'", "", "", true},
        {"P054", When::Compile, R"("weight": 0.25)", R"("weight": 0.25, "gian": 2)", "\"gian\"", 0, "'gain'", "", "",
         true},
        {"P054", When::Compile, R"("weight": 0.25, )", "", "\"Blend\",\n      \"slots\"", 0, "0..1", "", "", true},
        {"P054", When::Parse, R"("name": "Move", "kind": "compute",)",
         R"("name": "Move", "kind": "compute", "parameters": { "x": 1 },)", "\"parameters\": { \"x\"", 0, "no class",
         "", "", true},
        {"P055", When::Compile, R"("weight": 0.25)", R"("weight": 1.5)", "1.5", 0, "0..1", "", "", true},
        {"P055", When::Compile, R"("weight": 0.25)", R"("weight": true)", "true, \"style\"", 0, "a number", "", "",
         true},
        {"P055", When::Compile, R"("style": { "setting": "style" })", R"("style": "sof")", "\"sof\"", 0, "'soft'",
         R"("style":   { "type": "enum", "values": ["soft", "hard"], "default": "hard" },)", "", true},
        {"P056", When::Parse, R"("kind": "buffer", "bytes": 12)", R"("kind": "buffer", "bytes": 12, "samples": 4)",
         "\"samples\"", 0, "a buffer", "", "", true},
        {"P056", When::Parse, R"("kind": "buffer", "bytes": 12)", R"("kind": "buffer", "bytes": { "times": 2 })",
         "{ \"times\"", 0, "exactly one", "", "", true},
        {"J011", When::Parse, R"("kind": "buffer", "bytes": 12)", R"("kind": "buffer")", "{ \"kind\": \"buffer\" }", 0,
         "bytes", "", "", true},
        {"D002", When::Compile, R"("default": 100, "min": 1)", R"("default": 0, "min": 0)",
         "{ \"setting\": \"strands\", \"times\": 16 } },\n    \"Accum\"", 0, "1..4294967296",
         R"("Points": { "kind": "buffer", "bytes": { "setting": "strands", "times": 16 })",
         R"("Points": { "kind": "buffer", "bytes": 16)", true},
        {"P060", When::Parse, R"("size": { "frame": 1 }, "history": 1 })", R"("size": { "frame": 1 } })",
         "\"history.Accum\"", 0, "\"history\": 1", "", "", true},
        {"P016", When::Parse, R"("last": "history.Accum")", R"("last": "history.Acum")", "\"history.Acum\"", 0,
         "'history.Accum'", "", "", true},
        {"E001", When::Parse, "lights > 0", "lights >", "\"lights >\"", 9, "expected"},
        {"E002", When::Parse, "lights > 0", "light > 0", "\"light > 0\"", 1, "'lights'"},
        {"E002", When::Parse, "host.has('Screen')", "host.has('Scren')", "'Scren'", 0, "'Screen'"},
        {"E003", When::Parse, "msaa == '1'", "msaa == '2'", "'2'", 0, "known: 1, 4"},
        {"E004", When::Parse, "lights > 0", "lights == 'two'", "'two'", 0, "compare"},
    };
    return all;
}

Diagnostics outcome(const Case& test, const std::string& text) {
    const auto tree = PassTree::parse(text, "tree.pass.json");
    if (test.when == When::Parse) return tree ? Diagnostics{} : tree.error();
    if (!tree) {
        ADD_FAILURE() << test.code << " stopped earlier: " << tree.error().text();
        return {};
    }
    if (test.when == When::ParseWarning) return (*tree)->warnings();
    HostDescription lent = test.more ? moreHost() : host();
    if (!test.more) lent.imports["Screen"] = {true, rhi::TextureFormat::RGBA16Float, {32, 24, 1}, 1};
    auto plan = (*tree)->compile(lent);
    if (test.when == When::Compile) return plan ? Diagnostics{} : plan.error();
    if (!plan) {
        ADD_FAILURE() << test.code << " is an error: " << plan.error().text();
        return {};
    }
    return plan->warnings;
}

TEST(Diagnostics, TheUneditedTextHasNoFault) {
    for (const bool more : {false, true}) {
        const auto tree = PassTree::parse(more ? moreGrammar() : wholeGrammar(), "tree.pass.json");
        ASSERT_TRUE(tree) << tree.error().text();
        EXPECT_TRUE((*tree)->warnings().empty()) << (*tree)->warnings().text();
        const auto plan = (*tree)->compile(more ? moreHost() : host());
        ASSERT_TRUE(plan) << plan.error().text();
        EXPECT_TRUE(plan->warnings.empty()) << plan->warnings.text();
    }
}

TEST(Diagnostics, EachFaultIsOneLineWithItsCodeAtItsPlace) {
    for (const Case& test : cases()) {
        SCOPED_TRACE(test.code + ": " + test.from + " -> " + test.to);
        std::string text = edited(test.more ? moreGrammar() : wholeGrammar(), test.from, test.to);
        if (!test.again.empty()) text = edited(text, test.again, test.instead);
        const Diagnostics found = outcome(test, text);
        EXPECT_EQ(codes(found), test.code) << found.text();
        if (found.items().size() != 1) continue;
        const Diagnostic& item = found.items().front();
        json::Place place = placeOf(text, test.at);
        place.column += static_cast<std::uint32_t>(test.offset);
        EXPECT_EQ(item.line, place.line) << found.text();
        EXPECT_EQ(item.column, place.column) << found.text();
        EXPECT_EQ(item.file, "tree.pass.json");
        EXPECT_NE((item.text + " " + item.hint).find(test.says), std::string::npos) << found.text();
    }
}

TEST(Diagnostics, SeveralFaultsComeAtOnceInTheOrderOfTheText) {
    std::string text =
        edited(wholeGrammar(), R"("drawList": "hair.forward", "sort")", R"("drawList": "hair.foward", "sort")");
    text = edited(text, R"("source": "Blur.color")", R"("source": "Blr.color")");
    text = edited(text, "lights > 0", "lights >");
    // Conditions are read with the file; names are looked at only when it could be read.
    EXPECT_EQ(codes(PassTree::parse(text, "t").error()), "E001");
    text = edited(text, "lights >", "lights > 1");
    EXPECT_EQ(codes(PassTree::parse(text, "t").error()), "P011 P016");
}

TEST(Diagnostics, WhatTheHostDoesWrong) {
    const auto tree = PassTree::parse(wholeGrammar(), "tree.pass.json");
    ASSERT_TRUE(tree) << tree.error().text();
    const auto failing = [&](auto change) {
        HostDescription lent = host();
        change(lent);
        const auto plan = (*tree)->compile(lent);
        return plan ? std::string("no error") : codes(plan.error());
    };
    EXPECT_EQ(failing([](auto& h) { h.imports.erase("Scene"); }), "P080");
    EXPECT_EQ(failing([](auto& h) { h.imports.erase("Lights"); }), "P080");
    EXPECT_EQ(failing([](auto& h) { h.imports["Scene"].format = rhi::TextureFormat::RGBA8Unorm; }), "P081");
    EXPECT_EQ(failing([](auto& h) { h.imports["Scene"].samples = 4; }), "P081");
    EXPECT_EQ(failing([](auto& h) { h.settings["size"] = whole(300); }), "P082");
    EXPECT_EQ(failing([](auto& h) { h.settings["size"] = flag(true); }), "P082");
    EXPECT_EQ(failing([](auto& h) { h.settings["look"] = word("sofft"); }), "P082");
    EXPECT_EQ(failing([](auto& h) { h.settings["siz"] = whole(256); }), "P082");
    EXPECT_EQ(failing([](auto& h) { h.extent = {0, 48, 1}; }), "P083");
    EXPECT_EQ(failing([](auto& h) {
                  h.supports = [](rhi::TextureFormat f, rhi::TextureUsage, std::uint32_t) {
                      return f != rhi::TextureFormat::Depth32Float;
                  };
              }),
              "D001 D001");
    EXPECT_EQ(failing([](auto& h) { h.extent = {60000, 48, 1}; }), "D002 D002 D002 D002");
    EXPECT_EQ(failing([](auto& h) { h.maxSide = 200; }), "D002") << "the shadow map";
    EXPECT_EQ(failing([](auto& h) { h.maxLayers = 1; }), "D002");
    EXPECT_EQ(failing([](auto& h) { h.maxBytes = 100000; }), "D002");
    HostDescription lent = host();
    lent.imports["Scenery"] = {true};
    EXPECT_EQ(codes((*tree)->compile(lent)->warnings), "P084");
}

TEST(Diagnostics, CodesOfTheTableAreCounted) {
    std::set<std::string> different;
    for (const Case& test : cases()) different.insert(test.code);
    EXPECT_GE(different.size(), 60U);
}

}  // namespace
}  // namespace pelage::passes::test
