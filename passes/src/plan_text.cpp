// SPDX-License-Identifier: MIT
#include "plan_text.hpp"

#include <cstdio>

namespace pelage::passes {

std::string shapeText(const PlanResource& resource) {
    if (resource.isBuffer) return "buffer";
    std::string text = std::to_string(resource.extent.width) + " x " + std::to_string(resource.extent.height);
    if (resource.is3D) text += " x " + std::to_string(resource.extent.depthOrArrayLayers);
    if (resource.layers > 1) text += " x " + std::to_string(resource.layers);
    text += " " + std::string(rhi::name(resource.format));
    if (resource.is3D) text += " 3D";
    if (resource.mipLevels > 1) text += ", " + std::to_string(resource.mipLevels) + " levels";
    if (resource.samples > 1) text += ", " + std::to_string(resource.samples) + " samples";
    return text;
}

std::string workText(const PlanPass& pass) {
    const bool own = !pass.passClass.empty() && pass.passClass != drawListClass;
    if (!pass.drawList.empty()) return "list " + pass.drawList + (own ? ", class " + pass.passClass : "");
    return own ? "class " + pass.passClass : pass.shader;
}

std::string byteText(std::uint64_t bytes) {
    static constexpr const char* units[] = {"B", "KiB", "MiB", "GiB"};
    std::size_t unit = 0;
    auto value = static_cast<double>(bytes);
    while (value >= 1024 && unit + 1 < std::size(units)) value /= 1024, ++unit;
    char text[32];
    // Two digits behind the point, unless they are zeros.
    const bool whole = value == static_cast<double>(static_cast<std::uint64_t>(value));
    std::snprintf(text, sizeof(text), whole ? "%.0f %s" : "%.2f %s", value, units[unit]);
    return text;
}

std::string versionText(const PlanSlot& slot) {
    const auto version = [](std::uint32_t number) { return "v" + std::to_string(number); };
    const std::string level = slot.level == ~0U ? "" : " level " + std::to_string(slot.level);
    if (slot.access == SlotAccess::Read) return (slot.reads == ~0U ? "as lent" : version(slot.reads)) + level;
    if (slot.makes == ~0U) return "as lent" + level;
    if (slot.access == SlotAccess::Write || slot.reads == ~0U) return version(slot.makes) + level;
    return version(slot.reads) + "-" + version(slot.makes) + level;
}

std::string loadStoreText(const PlanSlot& slot) {
    if (slot.access == SlotAccess::Read) return {};
    static constexpr std::string_view loads[] = {"load", "clear", "dontCare"};
    return std::string(loads[static_cast<std::size_t>(slot.load)]) +
           (slot.store == rhi::StoreOp::Discard ? ", discard" : ", store");
}

std::vector<std::vector<PlanWait>> waitsOf(const Plan& plan) {
    struct Last {
        std::uint32_t pass = ~0U;  // the last that used it
        SlotUse use = SlotUse::Color;
        bool read = false;  // it only read
    };
    std::vector<Last> last(plan.resources.size());
    std::vector<std::vector<PlanWait>> waits(plan.passes.size());
    for (std::uint32_t i = 0; i < plan.passes.size(); ++i) {
        const PlanPass& pass = plan.passes[i];
        for (std::uint32_t s = 0; s < pass.slots.size(); ++s) {
            const PlanSlot& slot = pass.slots[s];
            if (slot.resource >= plan.resources.size()) continue;
            const PlanResource& resource = plan.resources[slot.resource];
            Last& before = last[slot.resource];
            const bool reads = slot.access == SlotAccess::Read;
            const bool sameLayout = resource.isBuffer || before.use == slot.use;
            // Two passes that only read wait for each other when the image must change its layout between them.
            const bool free = before.pass == ~0U || before.pass == i || (reads && before.read && sameLayout);
            if (!free) waits[i].push_back({s, before.pass, before.use});
            before = {i, slot.use, reads};
        }
    }
    return waits;
}

std::vector<std::vector<MemoryTaken>> memoryTaken(const Plan& plan) {
    std::vector<std::vector<MemoryTaken>> taken(plan.passes.size());
    for (std::uint32_t i = 0; i < plan.resources.size(); ++i) {
        const PlanResource& image = plan.resources[i];
        if (image.heapOffset == notPlaced) continue;
        for (std::uint32_t k = 0; k < plan.resources.size(); ++k) {
            const PlanResource& before = plan.resources[k];
            if (before.heapOffset == notPlaced || before.lastPass >= image.firstPass) continue;
            const bool meet = before.heapOffset < image.heapOffset + image.heapBytes &&
                              image.heapOffset < before.heapOffset + before.heapBytes;
            if (meet) taken[image.firstPass].push_back({i, k});
        }
    }
    return taken;
}

}  // namespace pelage::passes
