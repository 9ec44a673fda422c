// SPDX-License-Identifier: MIT
// The compiled graph as text for Graphviz: boxes are passes in their order, ovals are images.
#include "check.hpp"
#include "plan_text.hpp"

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
               lines({std::to_string(i + 1) + ". " + pass.name, std::string(word(pass.kind)), workText(pass), times}) +
               "];\n";
    }
    for (std::size_t i = 0; i < resources.size(); ++i) {
        const PlanResource& resource = resources[i];
        const bool own = resource.kind == PlanResource::Kind::Transient || resource.kind == PlanResource::Kind::History;
        const std::string life =
            "passes " + std::to_string(resource.firstPass + 1) + ".." + std::to_string(resource.lastPass + 1);
        const std::string place = resource.heapOffset == notPlaced
                                      ? ""
                                      : "heap " + std::to_string(resource.heapOffset) + ".." +
                                            std::to_string(resource.heapOffset + resource.heapBytes);
        out += "    " + quoted(resource.name) + " [shape=" + (own ? "oval" : "hexagon") + ", label=" +
               lines({resource.name, shapeText(resource), own ? byteText(resource.bytes) : "", life, place}) + "];\n";
    }
    for (const PlanPass& pass : passes) {
        for (const PlanSlot& slot : pass.slots) {
            if (slot.resource >= resources.size()) continue;
            const std::string passNode = quoted("pass " + pass.name);
            const std::string imageNode = quoted(resources[slot.resource].name);
            const auto version = [](std::uint32_t number) {
                return number == ~0U ? std::string() : "v" + std::to_string(number);
            };
            if (slot.access != SlotAccess::Write && slot.load == rhi::LoadOp::Load) {
                out += "    " + imageNode + " -> " + passNode +
                       " [label=" + lines({slot.name, version(slot.reads), std::string(word(slot.use))}) + "];\n";
            }
            if (slot.access != SlotAccess::Read) {
                out += "    " + passNode + " -> " + imageNode +
                       " [label=" + lines({slot.name, version(slot.makes), loadStoreText(slot)}) + "];\n";
            }
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
