// SPDX-License-Identifier: MIT
// The compiled graph as text for Graphviz: boxes are passes in their order, ovals are images.
#include <pelage/passes/tree.hpp>

#include <algorithm>

namespace pelage::passes {
namespace {

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || (c == '\\')) out += '\\';
        out += c;
    }
    return out + "\"";
}

std::string lines(std::initializer_list<std::string> each) {
    std::string out;
    for (const std::string& line : each) {
        if (!line.empty()) out += (out.empty() ? "" : "\n") + line;
    }
    return quoted(out);
}

std::string image(const PlanResource& resource) {
    if (resource.isBuffer) return "buffer";
    std::string text = std::to_string(resource.extent.width) + " x " + std::to_string(resource.extent.height);
    if (resource.layers > 1) text += " x " + std::to_string(resource.layers);
    text += " " + std::string(rhi::name(resource.format));
    if (resource.samples > 1) text += ", " + std::to_string(resource.samples) + " samples";
    return text;
}

std::string arrow(const PlanSlot& slot, bool writes) {
    if (!writes) return slot.name;
    static constexpr std::string_view loads[] = {"load", "clear", "dontCare"};
    const bool discards = slot.store == rhi::StoreOp::Discard;
    return slot.name + "\n" + std::string(loads[static_cast<std::size_t>(slot.load)]) +
           (discards ? ", discard" : ", store");
}

}  // namespace

std::string Plan::dot() const {
    std::string out =
        "digraph passes {\n    rankdir=LR;\n    node [fontname=\"sans-serif\"];\n    edge [fontname=\"sans-serif\"];\n";
    for (std::size_t i = 0; i < passes.size(); ++i) {
        const PlanPass& pass = passes[i];
        const auto views = viewCounts.find(pass.view);
        const std::string times =
            pass.forEachLayer && views != viewCounts.end() ? std::to_string(views->second) + " layers" : "";
        out += "    " + quoted("pass " + pass.name) + " [shape=box, label=" +
               lines({std::to_string(i + 1) + ". " + pass.name,
                      pass.drawList.empty() ? pass.shader : "list " + pass.drawList, times}) +
               "];\n";
    }
    for (std::size_t i = 0; i < resources.size(); ++i) {
        const PlanResource& resource = resources[i];
        const bool transient = resource.kind == PlanResource::Kind::Transient;
        const std::string life =
            "passes " + std::to_string(resource.firstPass + 1) + ".." + std::to_string(resource.lastPass + 1);
        out +=
            "    " + quoted(resource.name) + " [shape=" + (transient ? "oval" : "hexagon") + ", label=" +
            lines({resource.name, image(resource), transient ? std::to_string(resource.bytes) + " bytes" : "", life}) +
            "];\n";
    }
    for (const PlanPass& pass : passes) {
        for (const PlanSlot& slot : pass.slots) {
            if (slot.resource >= resources.size()) continue;
            const std::string passNode = quoted("pass " + pass.name);
            const std::string imageNode = quoted(resources[slot.resource].name);
            const bool writes = slot.access != SlotAccess::Read;
            if (slot.access != SlotAccess::Write && slot.load == rhi::LoadOp::Load)
                out += "    " + imageNode + " -> " + passNode + " [label=" + quoted(arrow(slot, false)) + "];\n";
            if (writes) out += "    " + passNode + " -> " + imageNode + " [label=" + quoted(arrow(slot, true)) + "];\n";
        }
    }
    for (const auto& [name, resource] : exports) {
        out += "    " + quoted("export " + name) + " [shape=note, label=" + quoted(name) + "];\n";
        out += "    " + quoted(resources[resource].name) + " -> " + quoted("export " + name) + ";\n";
    }
    for (const std::string& text : culled)
        out += "    " + quoted("culled " + text) + " [shape=box, style=dashed, label=" + quoted(text) + "];\n";
    return out + "}\n";
}

}  // namespace pelage::passes
