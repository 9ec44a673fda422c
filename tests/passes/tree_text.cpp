// SPDX-License-Identifier: MIT
#include "tree_text.hpp"

#include <gtest/gtest.h>
#include <fstream>
#include <iterator>

namespace pelage::passes::test {

std::string shippedText(const std::string& file) {
    std::ifstream in(std::string(PELAGE_FRAMES) + "/" + file, std::ios::binary);
    EXPECT_TRUE(in) << file;
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string wholeGrammar() {
    return R"json({
  "$schema": "./passtree.schema.json",
  "format": "pelage.passtree/1",
  "name": "Whole",
  "settings": {
    "size":    { "type": "uint", "default": 256, "min": 64, "max": 4096, "multipleOf": 64 },
    "lights":  { "type": "uint", "default": 2, "min": 0, "max": 4 },
    "msaa":    { "type": "enum", "values": ["1", "4"], "default": "4" },
    "look":    { "type": "enum", "values": ["soft", "hard"], "default": "soft" },
    "overlay": { "type": "bool", "default": true }
  },
  "imports": {
    "Scene":   { "kind": "image", "access": "read", "formats": ["RGBA16Float"], "samples": [1] },
    "Screen":  { "kind": "image", "access": "readWrite", "optional": true },
    "Sky":     { "kind": "imageCube", "access": "read", "optional": true },
    "Lights":  { "kind": "buffer", "access": "read" }
  },
  "views": { "main": { "count": 1 }, "shadow": { "count": { "setting": "lights" } } },
  "drawLists": ["hair.shadow", "hair.forward"],
  "attachments": {
    "Map":   { "format": "Depth32Float", "size": { "square": { "setting": "size" } }, "layers": { "view": "shadow" } },
    "Depth": { "format": "Depth32Float", "size": { "like": "att.Hair" }, "samples": { "setting": "msaa" } },
    "Hair":  { "format": "RGBA16Float", "formatFallbacks": ["RGBA32Float"], "size": { "frame": 1 }, "samples": { "setting": "msaa" } },
    "Half":  { "format": "RGBA16Float", "size": { "like": "host.Scene", "scale": 0.5 } },
    "Blur":  { "format": "RGBA16Float", "size": { "like": "att.Half" } },
    "Table": { "format": "R32Float", "size": { "fixed": [16, 8] } },
    "Final": { "format": "RGBA8Unorm", "size": { "frame": 1 } },
    "Kept":  { "format": "RGBA8Unorm", "size": { "frame": 1 } }
  },
  "templates": {
    "Screenwide": {
      "kind": "fullscreen",
      "slots": { "source": { "access": "read", "as": "sampled", "bind": "u_source" }, "color": { "access": "write", "as": "color" } }
    }
  },
  "passes": [
    {
      "name": "Shadow", "kind": "raster", "view": "shadow", "forEachView": "layer", "drawList": "hair.shadow",
      "enabledWhen": "lights > 0",
      "slots": { "map": { "access": "write", "as": "depth", "clear": { "depth": "far" } } },
      "connect": { "map": "att.Map" },
      "whenDisabled": { "map": "const.depthFarArray" }
    },
    {
      "name": "Count", "kind": "compute", "shader": "count.comp", "dispatchLike": "table", "threads": [8, 4, 1],
      "slots": { "table": { "access": "write", "as": "storage", "bind": "i_table" } },
      "connect": { "table": "att.Table" }
    },
    {
      "name": "Hair", "kind": "raster", "view": "main", "drawList": "hair.forward",
      "slots": {
        "map":    { "access": "read", "as": "sampled", "bind": "u_map" },
        "sky":    { "access": "read", "as": "sampled", "bind": "u_sky", "optional": true },
        "table":  { "access": "read", "as": "sampled", "bind": "u_table" },
        "lights": { "access": "read", "as": "storage", "bind": "b_lights" },
        "depth":  { "access": "write", "as": "depth", "clear": { "depth": "far" } },
        "color":  { "access": "write", "as": "color", "clear": [0, 0, 0, 0] }
      },
      "connect": {
        "map": "Shadow.map", "sky": "host.Sky", "table": "Count.table", "lights": "host.Lights",
        "depth": "att.Depth", "color": "att.Hair"
      }
    },
    {
      "name": "Glass", "kind": "raster", "view": "main", "drawList": "hair.forward",
      "enabledWhen": "overlay && look in ['soft', 'hard']",
      "slots": { "depth": { "access": "read", "as": "depth" }, "color": { "access": "readWrite", "as": "color" } },
      "connect": { "depth": "Hair.depth", "color": "Hair.color" }
    },
    {
      "name": "Resolve", "template": "Screenwide",
      "shader": { "when": "msaa == '1'", "then": "copy.frag", "else": "resolve.frag" },
      "slots": { "scene": { "access": "read", "as": "sampled", "bind": "u_scene" } },
      "connect": { "source": ["Glass.color", "Hair.color"], "scene": "host.Scene", "color": "att.Half" },
      "constants": { "look": { "setting": "look" }, "gain": 1.5, "overlay": { "setting": "overlay" } }
    },
    {
      "name": "Blur", "template": "Screenwide", "shader": "blur.frag",
      "connect": { "source": "Resolve.color", "color": "att.Blur" }
    },
    {
      "name": "Final", "template": "Screenwide", "shader": "final.frag", "after": ["Count"],
      "connect": { "source": "Blur.color", "color": "att.Final" }
    },
    {
      "name": "Keep", "kind": "copy",
      "slots": { "from": { "access": "read", "as": "copy" }, "to": { "access": "write", "as": "copy" } },
      "connect": { "from": "Final.color", "to": "att.Kept" }
    },
    {
      "name": "Present", "template": "Screenwide", "shader": "present.frag", "enabledWhen": "host.has('Screen')",
      "connect": { "source": "Final.color", "color": "host.Screen" }
    }
  ],
  "exports": {
    "Color":  { "from": "Final.color" },
    "Kept":   { "from": "Keep.to" },
    "Screen": { "from": "Present.color", "optional": true }
  }
}
)json";
}

std::string moreGrammar() {
    return R"json({
  "format": "pelage.passtree/1",
  "name": "More",
  "settings": {
    "strands": { "type": "uint", "default": 100, "min": 1, "max": 1000000 },
    "style":   { "type": "enum", "values": ["soft", "hard"], "default": "hard" },
    "cells":   { "type": "uint", "default": 8, "min": 4, "max": 64 },
    "glow":    { "type": "bool", "default": true }
  },
  "imports": { "Shape": { "kind": "buffer", "access": "read" } },
  "views": { "main": { "count": 1 } },
  "drawLists": ["hair.forward"],
  "attachments": {
    "Points": { "kind": "buffer", "bytes": { "setting": "strands", "times": 16 }, "history": 1 },
    "Args":   { "kind": "buffer", "bytes": 12 },
    "Grid":   { "format": "R32Float", "size": { "square": { "setting": "cells" }, "depth": { "setting": "cells" } }, "mipLevels": "full" },
    "Lit":    { "format": "RGBA16Float", "size": { "like": "att.Grid", "scale": 0.5 }, "mipLevels": 2 },
    "Heads":  { "kind": "buffer", "bytes": { "perPixel": 4, "like": "att.Drawn" } },
    "Copied": { "kind": "buffer", "bytes": { "setting": "strands", "times": 16 } },
    "Accum":  { "format": "RGBA16Float", "size": { "frame": 1 }, "history": 1 },
    "Drawn":  { "format": "RGBA16Float", "size": { "frame": 1 } }
  },
  "passes": [
    {
      "name": "Count", "kind": "compute", "shader": "count.comp",
      "slots": {
        "shape": { "access": "read", "as": "storage", "bind": "b_shape" },
        "args":  { "access": "write", "as": "storage", "bind": "b_args", "clear": 0 }
      },
      "connect": { "shape": "host.Shape", "args": "att.Args" }
    },
    {
      "name": "Move", "kind": "compute", "shader": "move.comp", "dispatchIndirect": { "slot": "args", "offset": 4 },
      "slots": {
        "args":   { "access": "read", "as": "indirect" },
        "before": { "access": "read", "as": "storage", "bind": "b_before" },
        "points": { "access": "write", "as": "storage", "bind": "b_points" }
      },
      "connect": { "args": "Count.args", "before": "history.Points", "points": "att.Points" }
    },
    {
      "name": "Fill", "kind": "compute", "shader": "fill.comp", "dispatchLike": "grid", "threads": [4, 4, 4],
      "slots": { "points": { "access": "read", "as": "storage", "bind": "b_points" },
                 "grid": { "access": "write", "as": "storage", "bind": "i_grid" } },
      "connect": { "points": "Move.points", "grid": "att.Grid" }
    },
    {
      "name": "Half", "kind": "compute", "shader": "half.comp", "dispatchLike": "coarse", "threads": [4, 4, 4],
      "slots": { "fine": { "access": "read", "as": "sampled", "bind": "u_fine", "level": 0 },
                 "coarse": { "access": "readWrite", "as": "storage", "bind": "i_coarse", "level": 1 } },
      "connect": { "fine": "Fill.grid", "coarse": "Fill.grid" }
    },
    {
      "name": "Shade", "class": "Shade", "drawList": "hair.forward",
      "slots": { "grid": { "access": "read", "as": "sampled", "bind": "u_grid", "level": 1 },
                 "lit": { "access": "write", "as": "storage", "bind": "i_lit" } },
      "connect": { "grid": "Half.coarse", "lit": "att.Lit" },
      "constants": { "steps": 16 }
    },
    {
      "name": "Draw", "kind": "raster", "view": "main", "drawList": "hair.forward",
      "slots": {
        "points": { "access": "read", "as": "vertex" },
        "heads":  { "access": "readWrite", "as": "storage", "bind": "b_heads", "clear": 0 },
        "lit":    { "access": "read", "as": "sampled", "bind": "u_lit", "level": 0 },
        "color":  { "access": "write", "as": "color", "clear": [0, 0, 0, 0] }
      },
      "connect": { "points": "Move.points", "heads": "att.Heads", "lit": "Shade.lit", "color": "att.Drawn" }
    },
    {
      "name": "Blend", "class": "Blend",
      "slots": {
        "drawn": { "access": "read", "as": "sampled", "bind": "u_drawn" },
        "last":  { "access": "read", "as": "sampled", "bind": "u_last" },
        "heads": { "access": "read", "as": "storage", "bind": "b_heads" },
        "color": { "access": "write", "as": "color", "clear": [0.25, 0, 0, 1] }
      },
      "connect": { "drawn": "Draw.color", "last": "history.Accum", "heads": "Draw.heads", "color": "att.Accum" },
      "parameters": { "weight": 0.25, "style": { "setting": "style" }, "glow": { "setting": "glow" } }
    },
    {
      "name": "Keep", "kind": "copy",
      "slots": { "from": { "access": "read", "as": "copy" }, "to": { "access": "write", "as": "copy" } },
      "connect": { "from": "Move.points", "to": "att.Copied" }
    }
  ],
  "exports": { "Color": { "from": "Blend.color" }, "Points": { "from": "Keep.to" } }
}
)json";
}

HostDescription moreHost() {
    HostDescription made{.extent = {64, 48, 1}};
    made.imports["Shape"] = {true};
    using Type = ParameterInfo::Type;
    made.classes.push_back({.name = "Blend",
                            .kind = PassKind::Raster,
                            .parameters = {{.name = "weight", .min = 0, .max = 1, .required = true},
                                           {.name = "style", .type = Type::Word, .words = {"soft", "hard"}},
                                           {.name = "glow", .type = Type::Bool},
                                           {.name = "gain", .min = 1, .max = 4, .defaultNumber = 2}}});
    made.classes.push_back({.name = "Shade", .kind = PassKind::Compute});
    return made;
}

std::string edited(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    if (at == std::string::npos) {
        ADD_FAILURE() << "not in the text: " << from;
        return text;
    }
    return text.replace(at, from.size(), to);
}

json::Place placeOf(const std::string& text, const std::string& needle) {
    const std::size_t at = text.find(needle);
    if (at == std::string::npos) {
        ADD_FAILURE() << "not in the text: " << needle;
        return {};
    }
    json::Place place{1, 1};
    for (std::size_t i = 0; i < at; ++i) {
        ++place.column;
        if (text[i] == '\n') place = {place.line + 1, 1};
    }
    return place;
}

namespace {

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + "\"";
}

}  // namespace

std::string write(const json::Value& value, int indent) {
    const std::string pad(static_cast<std::size_t>(indent) + 1, ' ');
    switch (value.kind) {
        case json::Kind::Null:
            return "null";
        case json::Kind::Bool:
            return value.boolean ? "true" : "false";
        case json::Kind::String:
            return quoted(value.string);
        case json::Kind::Number: {
            if (value.number == static_cast<double>(static_cast<long long>(value.number)))
                return std::to_string(static_cast<long long>(value.number));
            return std::to_string(value.number);
        }
        case json::Kind::Array: {
            std::string out = "[";
            for (const json::Value& each : value.elements)
                out += (out.size() > 1 ? ",\n" : "\n") + pad + write(each, indent + 1);
            return out + "]";
        }
        case json::Kind::Object: {
            std::string out = "{";
            for (const json::Member& each : value.members)
                out += (out.size() > 1 ? ",\n" : "\n") + pad + quoted(each.key) + ": " + write(each.value, indent + 1);
            return out + "}";
        }
    }
    return "null";
}

json::Value readJson(const std::string& text) {
    auto document = json::parse(text, "text");
    if (!document) {
        ADD_FAILURE() << document.error().text();
        return {};
    }
    return std::move(document->root);
}

void forEachValue(json::Value& root, const std::function<void(json::Value&, std::size_t)>& use) {
    const std::size_t count = root.isArray() ? root.elements.size() : root.isObject() ? root.members.size() : 0;
    for (std::size_t i = 0; i < count; ++i) {
        use(root, i);
        forEachValue(root.isArray() ? root.elements[i] : root.members[i].value, use);
    }
}

HostDescription host() {
    HostDescription made;
    made.extent = {64, 48, 1};
    made.imports["Scene"] = {true, rhi::TextureFormat::RGBA16Float, {64, 48, 1}, 1};
    made.imports["Lights"] = {true};
    return made;
}

SettingValue flag(bool value) {
    return {SettingValue::Type::Bool, value ? 1U : 0U, {}};
}
SettingValue whole(std::uint32_t value) {
    return {SettingValue::Type::Uint, value, {}};
}
SettingValue word(std::string value) {
    return {SettingValue::Type::Enum, 0, std::move(value)};
}

std::string codes(const Diagnostics& diagnostics) {
    std::string out;
    for (const Diagnostic& each : diagnostics.items()) out += (out.empty() ? "" : " ") + std::string(each.code.text());
    return out;
}

std::vector<std::string> passNames(const Plan& plan) {
    std::vector<std::string> names;
    for (const PlanPass& pass : plan.passes) names.push_back(pass.name);
    return names;
}

const PlanResource* resource(const Plan& plan, const std::string& name) {
    for (const PlanResource& each : plan.resources) {
        if (each.name == name) return &each;
    }
    return nullptr;
}

const PlanSlot* slot(const Plan& plan, const std::string& pass, const std::string& name) {
    for (const PlanPass& each : plan.passes) {
        for (const PlanSlot& one : each.slots) {
            if (each.name == pass && one.name == name) return &one;
        }
    }
    return nullptr;
}

}  // namespace pelage::passes::test
