// SPDX-License-Identifier: MIT
#include "check.hpp"
#include "plan_charts.hpp"

namespace pelage::passes {
namespace {

constexpr std::string_view style = R"(<style>
body { font: 14px/1.45 system-ui, sans-serif; margin: 24px; color: #1d2530; background: #fff; }
h1 { font-size: 22px; margin: 0 0 4px; } h2 { font-size: 16px; margin: 26px 0 8px; }
p { margin: 4px 0; max-width: 1100px; } .dim { color: #5b6675; }
.facts { display: flex; flex-wrap: wrap; gap: 10px 26px; margin: 12px 0; }
.facts b { display: block; font-size: 18px; } .facts span { color: #5b6675; font-size: 12px; }
.chart { overflow-x: auto; } svg { display: block; font: 12px system-ui, sans-serif; }
table { border-collapse: collapse; } td, th { text-align: left; vertical-align: top; padding: 4px 14px 4px 0;
border-bottom: 1px solid #e3e7ec; } th { font-size: 12px; color: #5b6675; font-weight: normal; }
.key i { display: inline-block; width: 14px; height: 11px; margin: 0 5px 0 16px; border: 1px solid #8592a3; }
.rule { stroke: #e3e7ec; } text { fill: #1d2530; } .name { font-weight: 600; font-size: 13px; }
.small { font-size: 11px; fill: #5b6675; } .label { font-size: 12px; fill: #5b6675; } .value { font-size: 12px; }
.rast, .full, .comp, .copy { stroke: #8592a3; } .rast { fill: #dbe8fb; } .full { fill: #dff3e2; }
.comp { fill: #fdebd3; } .copy { fill: #eceff3; }
.transient { fill: #cfe6e8; stroke: #6fa9ae; } .history { fill: #e6dcf5; stroke: #9c83c9; }
.import { fill: #f1ecd9; stroke: #b9a86a; } .constant { fill: #eceff3; stroke: #a9b3bf; }
.writes { fill: #1f6d75; stroke: #124b51; } .reads { fill: #fff; stroke: #6f7d8c; }
.usewrite { fill: #fff; font-size: 11px; } .useread { font-size: 11px; } .heapname { font-size: 12px; font-weight: 600; }
.gpu { fill: #f3b27a; } .cpu { fill: #b9c6f2; }
</style>
)";

std::string fact(const std::string& value, const std::string& what) {
    return "<div><b>" + escaped(value) + "</b><span>" + escaped(what) + "</span></div>\n";
}

std::string counted(std::size_t count, const char* one, const char* many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string facts(const Plan& plan, const PageOptions& options) {
    std::size_t waits = 0;
    for (const auto& of : waitsOf(plan)) waits += of.size();
    std::string out = "<div class=\"facts\">\n";
    out += fact(std::to_string(plan.extent.width) + " x " + std::to_string(plan.extent.height), "pixels of the frame");
    out += fact(std::to_string(plan.passes.size()),
                "passes run; " + std::to_string(plan.culled.size()) + " culled or switched off");
    out += fact(byteText(plan.heapBytes), "heap of transient images");
    const std::uint64_t saved = plan.naiveBytes > plan.heapBytes ? plan.naiveBytes - plan.heapBytes : 0;
    out += fact(byteText(saved), "saved by sharing bytes (" +
                                     shareText(static_cast<double>(saved), static_cast<double>(plan.naiveBytes)) +
                                     " of " + byteText(plan.naiveBytes) + ")");
    if (!plan.passes.empty()) {
        out += fact(byteText(plan.peakBytes), "alive at once at the most, in " + plan.passes[plan.peakPass].name);
    }
    out += fact(std::to_string(waits), "waits between passes, by the plan");
    if (!options.measured.empty()) {
        out += fact(std::to_string(options.barriers), "barriers of the whole frame, as recorded");
    }
    return out + "</div>\n";
}

std::string settings(const PageOptions& options) {
    if (options.settings.empty()) return {};
    std::string out = "<p class=\"dim\">Settings asked for:";
    for (const auto& [name, value] : options.settings) out += " " + escaped(name) + " = " + escaped(value) + ";";
    out.back() = '.';
    return out + "</p>\n";
}

std::string slotText(const Plan& plan, const PlanSlot& slot) {
    std::string out = escaped(slot.name) + ": ";
    if (slot.resource >= plan.resources.size()) return out + "<span class=\"dim\">not connected</span>";
    out += escaped(plan.resources[slot.resource].name) + " " + versionText(slot);
    if (slot.producer < plan.passes.size()) out += " of " + escaped(plan.passes[slot.producer].name);
    const std::string loads = loadStoreText(slot);
    return out + " <span class=\"dim\">" + std::string(word(slot.use)) + (loads.empty() ? "" : "; " + loads) +
           "</span>";
}

std::string waitText(const Plan& plan, const PlanPass& pass, const PlanWait& wait) {
    const PlanSlot& slot = pass.slots[wait.slot];
    std::string out = escaped(plan.resources[slot.resource].name) + " after " + escaped(plan.passes[wait.after].name);
    if (wait.from != slot.use) {
        out +=
            " <span class=\"dim\">(" + std::string(word(wait.from)) + " to " + std::string(word(slot.use)) + ")</span>";
    }
    return out;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string out;
    for (const std::string& line : lines) out += (out.empty() ? "" : "<br>") + line;
    return out.empty() ? "<span class=\"dim\">nothing</span>" : out;
}

std::string passTable(const Plan& plan) {
    std::string out = "<table>\n<tr><th>pass</th><th>reads</th><th>writes or changes</th><th>waits for</th></tr>\n";
    const auto waits = waitsOf(plan);
    const auto taken = memoryTaken(plan);
    for (std::size_t i = 0; i < plan.passes.size(); ++i) {
        const PlanPass& pass = plan.passes[i];
        std::vector<std::string> reads, writes, waitsFor;
        for (const PlanSlot& slot : pass.slots)
            (slot.access == SlotAccess::Read ? reads : writes).push_back(slotText(plan, slot));
        for (const PlanWait& wait : waits[i]) waitsFor.push_back(waitText(plan, pass, wait));
        for (const MemoryTaken& each : taken[i]) {
            waitsFor.push_back(escaped(plan.resources[each.image].name) + " takes bytes of " +
                               escaped(plan.resources[each.from].name));
        }
        out += "<tr><td>" + std::to_string(i + 1) + ". <b>" + escaped(pass.name) + "</b></td><td>" + joined(reads) +
               "</td><td>" + joined(writes) + "</td><td>" + joined(waitsFor) + "</td></tr>\n";
    }
    return out + "</table>\n";
}

std::string heapTable(const Plan& plan) {
    std::string out = "<table>\n<tr><th>image</th><th>bytes of the heap</th><th>size</th><th>passes</th></tr>\n";
    for (const PlanResource& resource : plan.resources) {
        if (resource.heapOffset == notPlaced) continue;
        out += "<tr><td>" + escaped(resource.name) + "</td><td>" + std::to_string(resource.heapOffset) + " to " +
               std::to_string(resource.heapOffset + resource.heapBytes) + "</td><td>" + byteText(resource.heapBytes) +
               "</td><td>" + std::to_string(resource.firstPass + 1) + " to " + std::to_string(resource.lastPass + 1) +
               "</td></tr>\n";
    }
    return plan.heapBytes == 0 ? std::string() : out + "</table>\n";
}

std::string list(const std::string& title, const std::vector<std::string>& lines, const char* none) {
    std::string out = "<h2>" + escaped(title) + "</h2>\n";
    if (lines.empty()) return out + "<p class=\"dim\">" + none + "</p>\n";
    out += "<ul>\n";
    for (const std::string& line : lines) out += "<li>" + escaped(line) + "</li>\n";
    return out + "</ul>\n";
}

}  // namespace

std::string html(const Plan& plan, const PageOptions& options) {
    std::string out = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" +
                      escaped(options.title) + "</title>\n" + std::string(style) + "</head>\n<body>\n<h1>" +
                      escaped(options.title) + "</h1>\n" + settings(options);
    if (!options.measured.empty()) out += "<p class=\"dim\">Measured on " + escaped(options.device) + ".</p>\n";
    out += facts(plan, options);
    out +=
        "<h2>Passes, and what lives over them</h2>\n<p class=\"key dim\">dark: writes; white: reads; "
        "vN: a state of the image<i class=\"k\" style=\"background:#cfe6e8\"></i>of the tree"
        "<i style=\"background:#e6dcf5\"></i>of the last frame<i style=\"background:#f1ecd9\"></i>lent"
        "<i style=\"background:#eceff3\"></i>stand-in</p>\n<div class=\"chart\">\n" +
        lifeChart(plan, options) + "</div>\n";
    out +=
        "<h2>Memory: where in the heap, and when</h2>\n<p class=\"dim\">Bytes run downwards. Images whose lives do "
        "not meet share bytes. Buffers, lent images and images with a history are not placed here.</p>\n"
        "<div class=\"chart\">\n" +
        heapChart(plan) + "</div>\n" + heapTable(plan);
    out +=
        "<h2>Each pass</h2>\n<p class=\"dim\">What it waits for is derived from the plan; all waits of a pass are "
        "one barrier on the device";
    out += options.measured.empty() ? ".</p>\n"
                                    : ". Recorded in the whole frame, uploads and reading back included: " +
                                          counted(options.barriers, "barrier", "barriers") +
                                          "; a device does not count them for each pass.</p>\n";
    out += passTable(plan);
    out += list("Not run", plan.culled, "Every pass runs.");
    std::vector<std::string> warnings;
    for (const Diagnostic& warning : plan.warnings.items()) warnings.push_back(toString(warning));
    if (!warnings.empty()) out += list("Warnings", warnings, "");
    return out + "</body>\n</html>\n";
}

}  // namespace pelage::passes
