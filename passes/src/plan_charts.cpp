// SPDX-License-Identifier: MIT
#include "plan_charts.hpp"
#include "check.hpp"

#include <algorithm>
#include <cstdio>

namespace pelage::passes {
namespace {

constexpr double labelWidth = 250, columnWidth = 132, rowHeight = 46, headHeight = 66, meterHeight = 20;

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.1f", value);
    return text;
}

std::string attribute(const char* name, double value) {
    return std::string(" ") + name + "=\"" + number(value) + "\"";
}

std::string box(double x, double y, double width, double height, const char* style, const std::string& tip = {}) {
    return "<rect" + attribute("x", x) + attribute("y", y) + attribute("width", std::max(width, 0.5)) +
           attribute("height", std::max(height, 0.5)) + " rx=\"3\" class=\"" + style + "\">" +
           (tip.empty() ? "" : "<title>" + escaped(tip) + "</title>") + "</rect>\n";
}

std::string words(double x, double y, const char* style, const std::string& text) {
    return "<text" + attribute("x", x) + attribute("y", y) + " class=\"" + style + "\">" + escaped(text) + "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2, const char* style) {
    return "<line" + attribute("x1", x1) + attribute("y1", y1) + attribute("x2", x2) + attribute("y2", y2) +
           " class=\"" + style + "\"/>\n";
}

std::string opened(const Plan& plan, double height, const char* what) {
    const double width = labelWidth + columnWidth * static_cast<double>(plan.passes.size()) + 4;
    return "<svg" + attribute("width", width) + attribute("height", height) +
           " xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"" + what + "\">\n";
}

double column(std::size_t pass) {
    return labelWidth + columnWidth * static_cast<double>(pass);
}

// So much of a text as fits a column; the whole is in the tip.
std::string cut(const std::string& text, std::size_t most) {
    return text.size() <= most ? text : text.substr(0, most - 2) + "..";
}

const char* kindStyle(const PlanResource& resource) {
    static constexpr const char* styles[] = {"transient", "history", "import", "constant"};
    return styles[static_cast<std::size_t>(resource.kind)];
}

// What a pass cost, with the same index as the plan's; a pass that was not measured has nothing.
std::vector<PassReport> reportsOf(const Plan& plan, const std::vector<PassReport>& measured) {
    std::vector<PassReport> reports(plan.passes.size());
    for (std::size_t i = 0; i < reports.size(); ++i) {
        for (const PassReport& report : measured) {
            if (report.name == plan.passes[i].name) reports[i] = report;
        }
    }
    return reports;
}

class LifeChart {
public:
    LifeChart(const Plan& plan, const PageOptions& options)
        : plan_(plan), reports_(reportsOf(plan, options.measured)), measured_(!options.measured.empty()) {
        top_ = headHeight + (measured_ ? 4 * meterHeight + 8 : 0);
    }

    std::string text() {
        const double height = top_ + rowHeight * static_cast<double>(plan_.resources.size()) + 6;
        std::string out = opened(plan_, height, "passes and the lives of images");
        for (std::size_t i = 0; i < plan_.passes.size(); ++i) out += head(i, height);
        if (measured_) out += meters();
        for (std::size_t i = 0; i < plan_.resources.size(); ++i) out += row(i);
        return out + "</svg>\n";
    }

private:
    std::string head(std::size_t index, double height) const {
        const PlanPass& pass = plan_.passes[index];
        const double x = column(index);
        const auto views = plan_.viewCounts.find(pass.view);
        std::string kind(word(pass.kind));
        if (pass.forEachLayer && views != plan_.viewCounts.end()) kind += ", " + std::to_string(views->second) + "x";
        return line(x, 0, x, height, "rule") +
               box(x + 3, 2, columnWidth - 6, headHeight - 10, kind.substr(0, 4).c_str()) +
               words(x + 10, 20, "name", cut(std::to_string(index + 1) + ". " + pass.name, 17)) +
               words(x + 10, 35, "small", kind) + words(x + 10, 49, "small", cut(workText(pass), 20));
    }

    std::string meters() const {
        double gpu = 0, cpu = 0;
        for (const PassReport& report : reports_) gpu += report.gpuMilliseconds, cpu += report.cpuMilliseconds;
        std::string out;
        const char* labels[] = {"share of the GPU's time", "share of the recording CPU's time", "draws or dispatches",
                                "fragments shaded"};
        for (int i = 0; i < 4; ++i) out += words(8, headHeight + meterHeight * i + 14, "label", labels[i]);
        for (std::size_t i = 0; i < reports_.size(); ++i) {
            const PassReport& report = reports_[i];
            out += meter(i, 0, report.gpuMilliseconds, gpu, "gpu") + meter(i, 1, report.cpuMilliseconds, cpu, "cpu");
            out += words(column(i) + 10, headHeight + 2 * meterHeight + 14, "value", std::to_string(report.draws));
            out += words(column(i) + 10, headHeight + 3 * meterHeight + 14, "value", std::to_string(report.fragments));
        }
        return out;
    }

    static std::string meter(std::size_t pass, int row, double part, double whole, const char* style) {
        const double y = headHeight + meterHeight * row;
        const double width = whole > 0 ? (columnWidth - 8) * part / whole : 0;
        return box(column(pass) + 4, y + 2, width, meterHeight - 4, style) +
               words(column(pass) + 10, y + 14, "value", shareText(part, whole));
    }

    std::string row(std::size_t index) const {
        const PlanResource& resource = plan_.resources[index];
        const double y = top_ + rowHeight * static_cast<double>(index);
        std::string about = shapeText(resource);
        const bool own = resource.kind == PlanResource::Kind::Transient || resource.kind == PlanResource::Kind::History;
        std::string size = own ? byteText(resource.bytes)
                               : (resource.kind == PlanResource::Kind::Import ? "lent by the host" : "stand-in");
        for (const auto& [name, of] : plan_.exports) {
            if (of == index) size += ", exported as " + name;
        }
        std::string out = line(0, y, column(plan_.passes.size()), y, "rule") + words(8, y + 15, "name", resource.name) +
                          words(8, y + 28, "small", about) + words(8, y + 41, "small", cut(size, 40));
        const double from = column(resource.firstPass), to = column(resource.lastPass + 1);
        if (!plan_.passes.empty()) out += box(from + 3, y + 4, to - from - 6, rowHeight - 8, kindStyle(resource));
        for (std::size_t i = 0; i < plan_.passes.size(); ++i) {
            double offset = 0;
            for (const PlanSlot& slot : plan_.passes[i].slots) {
                if (slot.resource != index) continue;
                out += use(slot, column(i), y, offset);
                offset += 6;  // two slots on one image lie a little apart
            }
        }
        return out;
    }

    static std::string use(const PlanSlot& slot, double x, double y, double offset) {
        const bool reads = slot.access == SlotAccess::Read;
        const std::string how = std::string(word(slot.use)) + " " + versionText(slot);
        const std::string verb = reads ? "reads " : slot.access == SlotAccess::Write ? "writes " : "changes ";
        const std::string loads = loadStoreText(slot);
        return box(x + 7 + offset, y + 7 + offset, columnWidth - 14, rowHeight - 14, reads ? "reads" : "writes",
                   slot.name + ": " + verb + how + (loads.empty() ? "" : ", " + loads)) +
               words(x + 13 + offset, y + 21 + offset, reads ? "useread" : "usewrite", cut(verb + how, 20)) +
               words(x + 13 + offset, y + 34 + offset, reads ? "useread" : "usewrite",
                     cut(loads.empty() ? slot.name : loads, 20));
    }

    const Plan& plan_;
    std::vector<PassReport> reports_;
    bool measured_;
    double top_ = 0;
};

}  // namespace

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                // Control characters may not stand in a document at all.
                if (static_cast<unsigned char>(c) >= 0x20 || c == '\n') out += c;
        }
    }
    return out;
}

std::string shareText(double part, double whole) {
    if (whole <= 0) return "-";
    char text[16];
    std::snprintf(text, sizeof(text), part / whole < 0.0995 ? "%.1f %%" : "%.0f %%", 100 * part / whole);
    return text;
}

std::string lifeChart(const Plan& plan, const PageOptions& options) {
    return LifeChart(plan, options).text();
}

std::string heapChart(const Plan& plan) {
    constexpr double top = 22, height = 260, foot = 44;
    std::string out = opened(plan, top + height + foot, "the heap of transient images");
    if (plan.heapBytes == 0) return out + words(8, 16, "label", "no image is placed in a heap") + "</svg>\n";
    const double scale = height / static_cast<double>(plan.heapBytes);
    for (std::size_t i = 0; i < plan.passes.size(); ++i) {
        out += line(column(i), 0, column(i), top + height + foot, "rule") +
               words(column(i) + 10, 15, "label", cut(std::to_string(i + 1) + ". " + plan.passes[i].name, 18));
    }
    for (int i = 0; i <= 4; ++i) {
        const double y = top + height * i / 4;
        out += line(0, y, column(plan.passes.size()), y, "rule") +
               words(8, i == 4 ? y - 4 : y + 13, "label", byteText(plan.heapBytes * static_cast<std::uint64_t>(i) / 4));
    }
    for (const PlanResource& resource : plan.resources) {
        if (resource.heapOffset == notPlaced) continue;
        const double y = top + scale * static_cast<double>(resource.heapOffset);
        const double tall = scale * static_cast<double>(resource.heapBytes);
        const double x = column(resource.firstPass) + 3, width = column(resource.lastPass + 1) - x - 3;
        const std::string range =
            byteText(resource.heapOffset) + " to " + byteText(resource.heapOffset + resource.heapBytes);
        const bool wide = width > 2 * columnWidth - 10;
        out += box(x, y + 1, width, tall - 2, "transient", resource.name + ": " + range);
        if (tall < 13) continue;
        out +=
            words(x + 7, y + 13, "heapname", cut(wide ? resource.name + ", " + range : resource.name, wide ? 60 : 18));
        if (!wide && tall >= 28) out += words(x + 7, y + 26, "small", cut(range, 24));
    }
    out += words(8, top + height + 18, "label", "alive in each pass");
    for (std::uint32_t i = 0; i < plan.passes.size(); ++i) {
        std::uint64_t alive = 0;
        for (const PlanResource& resource : plan.resources) {
            if (resource.heapOffset != notPlaced && resource.firstPass <= i && i <= resource.lastPass)
                alive += resource.heapBytes;
        }
        const bool peak = i == plan.peakPass;
        out += words(column(i) + 10, top + height + 18, peak ? "name" : "value", byteText(alive));
        if (peak) out += words(column(i) + 10, top + height + 33, "small", "the most at once");
    }
    return out + "</svg>\n";
}

}  // namespace pelage::passes
