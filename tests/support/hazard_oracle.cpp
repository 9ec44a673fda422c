// SPDX-License-Identifier: MIT
#include "hazard_oracle.hpp"

#include <algorithm>
#include <bit>

namespace pelage::test {

namespace {

constexpr VkAccessFlags2 allWrites = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
                                     VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT |
                                     VK_ACCESS_2_HOST_WRITE_BIT;
constexpr VkAccessFlags2 allReads =
    VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_2_INDEX_READ_BIT | VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT |
    VK_ACCESS_2_UNIFORM_READ_BIT | VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT |
    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
    VK_ACCESS_2_TRANSFER_READ_BIT | VK_ACCESS_2_HOST_READ_BIT;

constexpr VkPipelineStageFlags2 transferStages = VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_RESOLVE_BIT |
                                                 VK_PIPELINE_STAGE_2_BLIT_BIT | VK_PIPELINE_STAGE_2_CLEAR_BIT;
constexpr VkPipelineStageFlags2 graphicsStages =
    VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT |
    VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT | VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT |
    VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT |
    VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;

VkPipelineStageFlags2 expand(VkPipelineStageFlags2 stages) {
    VkPipelineStageFlags2 out = stages & ~(VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_2_ALL_GRAPHICS_BIT |
                                           VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT);
    if ((stages & VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT) != 0)
        out |= graphicsStages | transferStages | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    if ((stages & VK_PIPELINE_STAGE_2_ALL_GRAPHICS_BIT) != 0) out |= graphicsStages;
    if ((stages & VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT) != 0) out |= transferStages;
    return out;
}

VkAccessFlags2 expandAccess(VkAccessFlags2 access) {
    VkAccessFlags2 out = access;
    if ((access & VK_ACCESS_2_MEMORY_READ_BIT) != 0) out |= allReads;
    if ((access & VK_ACCESS_2_MEMORY_WRITE_BIT) != 0) out |= allWrites;
    if ((access & VK_ACCESS_2_SHADER_READ_BIT) != 0)
        out |= VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
    if ((access & VK_ACCESS_2_SHADER_WRITE_BIT) != 0) out |= VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    return out;
}

template <class Visit>
void eachStage(VkPipelineStageFlags2 stages, Visit visit) {
    for (; stages != 0; stages &= stages - 1) visit(static_cast<std::size_t>(std::countr_zero(stages)));
}

}  // namespace

void HazardOracle::hazard(std::string text) {
    if (hazards_.size() < 100) hazards_.push_back(std::move(text));
}

void HazardOracle::addBuffer(std::uint64_t id, std::uint64_t size, std::string name) {
    Resource r;
    r.name = std::move(name);
    r.spans.emplace(0, Span{size, {}});
    resources_[id] = std::move(r);
}

void HazardOracle::addImage(std::uint64_t id, std::uint32_t mips, std::uint32_t layers, std::string name) {
    Resource r;
    r.image = true;
    r.name = std::move(name);
    r.mips = mips;
    r.layers = layers;
    r.cells.resize(std::size_t{mips} * layers);
    resources_[id] = std::move(r);
}

void HazardOracle::bindImage(std::uint64_t id, std::uint64_t memory, std::uint64_t offset, std::uint64_t bytes) {
    auto& r = resources_[id];
    r.memory = memory;
    r.offset = offset;
    r.bytes = bytes;
}

void HazardOracle::rename(std::uint64_t id, std::string name) {
    if (const auto found = resources_.find(id); found != resources_.end()) found->second.name = std::move(name);
}

void HazardOracle::remove(std::uint64_t id) {
    resources_.erase(id);
}

void HazardOracle::access(Cell& cell, const Touch& t, const std::string& what, const std::string& command) {
    const auto report = [&](const char* kind, const std::string& other) {
        hazard(std::string(kind) + ": " + command + " on " + what + " is not ordered after " + other);
    };
    if (t.layout != VK_IMAGE_LAYOUT_UNDEFINED && t.layout != cell.layout)
        hazard("layout: " + command + " wants " + what + " in layout " + std::to_string(t.layout) + ", it is in " +
               std::to_string(cell.layout));
    if (t.needsContents && !cell.written) hazard("undefined: " + command + " reads " + what + ", which nobody wrote");
    const Write& w = cell.write;
    const auto together = [&](std::uint64_t other) { return t.scope != 0 && t.scope == other; };
    if (w.any && !together(w.scope)) {
        bool seen = w.available;
        eachStage(t.stages, [&](std::size_t s) { seen = seen && (t.access & ~w.visible[s]) == 0; });
        if (!seen) report(t.write ? "write after write" : "read after write", w.by);
    }
    if (t.write) {
        for (const Read& r : cell.reads)
            if ((t.stages & ~r.chain) != 0 && !together(r.scope)) report("write after read", r.by);
        cell.write = {true, false, t.stages, 0, t.access & allWrites, {}, command, t.scope};
        cell.reads.clear();
        cell.written = true;
    } else if (cell.reads.empty() || cell.reads.back().stages != t.stages || cell.reads.back().chain != 0) {
        cell.reads.push_back({t.stages, 0, command, t.scope});
    }
}

void HazardOracle::touch(const Touch& wanted, const std::string& command) {
    const auto found = resources_.find(wanted.object);
    if (found == resources_.end()) {
        hazard("destroyed: " + command + " uses an object that is gone");
        return;
    }
    Touch t = wanted;
    t.stages = expand(t.stages);
    t.access = expandAccess(t.access);
    Resource& r = found->second;
    if (r.image) {
        const std::uint64_t mipEnd = std::min<std::uint64_t>(std::uint64_t{t.mip} + t.mips, r.mips);
        const std::uint64_t layerEnd = std::min<std::uint64_t>(std::uint64_t{t.layer} + t.layers, r.layers);
        for (std::uint32_t m = t.mip; m < mipEnd; ++m)
            for (std::uint32_t l = t.layer; l < layerEnd; ++l)
                access(r.cells[l + std::size_t{m} * r.layers], t,
                       r.name + " mip " + std::to_string(m) + " layer " + std::to_string(l), command);
        return;
    }
    const auto split = [&](std::uint64_t at) {
        auto after = r.spans.upper_bound(at);
        auto span = std::prev(after);
        if (span->first == at || span->second.end <= at) return;
        Span right = span->second;
        span->second.end = at;
        r.spans.emplace_hint(after, at, std::move(right));
    };
    const std::uint64_t end = std::min(t.end, r.spans.rbegin()->second.end);
    if (t.begin >= end) return;
    split(t.begin);
    split(end);
    for (auto i = r.spans.find(t.begin); i != r.spans.end() && i->first < end; ++i)
        access(i->second.cell, t, r.name, command);
}

void HazardOracle::apply(Cell& cell, const std::vector<Scope>& scopes) {
    Write& w = cell.write;
    const VkPipelineStageFlags2 before = w.chain;
    const bool wasAvailable = w.available;
    for (const Scope& s : scopes) {
        if (w.any && ((w.stages & ~s.from) == 0 || (before & s.from) != 0)) {
            w.chain |= s.to;
            const bool available = wasAvailable || ((w.stages & ~s.from) == 0 && (w.access & ~s.made) == 0);
            if (available) {
                w.available = true;
                eachStage(s.to, [&](std::size_t stage) { w.visible[stage] |= s.seen; });
            }
        }
    }
    for (Read& r : cell.reads) {
        const VkPipelineStageFlags2 chain = r.chain;
        for (const Scope& s : scopes)
            if ((r.stages & ~s.from) == 0 || (chain & s.from) != 0) r.chain |= s.to;
    }
}

void HazardOracle::transition(Resource& resource, Cell& cell, const VkImageMemoryBarrier2& barrier, const Scope& scope,
                              const std::vector<Scope>& memory, const std::string& where) {
    if (barrier.oldLayout != VK_IMAGE_LAYOUT_UNDEFINED && barrier.oldLayout != cell.layout)
        hazard("layout: " + where + " moves " + resource.name + " from layout " + std::to_string(barrier.oldLayout) +
               ", it is in " + std::to_string(cell.layout));
    // The transition writes the image: it must come after what was done before, by its own scopes or by those that
    // stand beside it.
    const auto waitsFor = [&](VkPipelineStageFlags2 stages, VkPipelineStageFlags2 chain) {
        return (stages & ~scope.from) == 0 || (chain & scope.from) != 0;
    };
    const Write& w = cell.write;
    if (w.any) {
        bool available = w.available || ((w.stages & ~scope.from) == 0 && (w.access & ~scope.made) == 0);
        for (const Scope& s : memory) available = available || ((w.stages & ~s.from) == 0 && (w.access & ~s.made) == 0);
        if (!waitsFor(w.stages, w.chain))
            hazard("transition after write: " + where + " on " + resource.name + " after " + w.by);
        if (!available && barrier.oldLayout != VK_IMAGE_LAYOUT_UNDEFINED)
            hazard("transition loses a write: " + where + " on " + resource.name + " after " + w.by);
    }
    for (const Read& r : cell.reads)
        if (!waitsFor(r.stages, r.chain))
            hazard("transition after read: " + where + " on " + resource.name + " after " + r.by);
    Write made;
    made.any = made.available = true;
    made.stages = 1ULL << 39;  // no barrier names it: only what waits for the transition counts
    made.chain = scope.to;
    made.by = "the transition in " + where;
    eachStage(scope.to, [&](std::size_t stage) { made.visible[stage] = scope.seen; });
    cell.write = std::move(made);
    cell.reads.clear();
    if (barrier.oldLayout == VK_IMAGE_LAYOUT_UNDEFINED) cell.written = false;
    cell.layout = barrier.newLayout;
}

void HazardOracle::takeOver(std::uint64_t id, Resource& taker, const Scope& scope, const std::string& where) {
    // Everything that was done through another image of these bytes must be over, and its writes available. The memory
    // barriers of this call have been applied to it already; an image barrier speaks of its own image alone, but as an
    // execution dependency it holds for all.
    for (auto& [other, resource] : resources_) {
        if (other == id || !resource.image || resource.memory == 0 || resource.memory != taker.memory) continue;
        if (resource.offset >= taker.offset + taker.bytes || taker.offset >= resource.offset + resource.bytes) continue;
        for (Cell& cell : resource.cells) {
            const auto waited = [&](VkPipelineStageFlags2 stages, VkPipelineStageFlags2 chain) {
                return (stages & ~scope.from) == 0 || (chain & scope.from) != 0;
            };
            if (cell.write.any && cell.write.access != 0 &&
                (!cell.write.available || !waited(cell.write.stages, cell.write.chain)))
                hazard("alias: " + where + " takes the memory of " + resource.name + " for " + taker.name + " before " +
                       cell.write.by + " is over");
            for (const Read& r : cell.reads)
                if (!waited(r.stages, r.chain))
                    hazard("alias: " + where + " takes the memory of " + resource.name + " for " + taker.name +
                           " before " + r.by + " is over");
            cell = {};
        }
    }
}

void HazardOracle::barrier(const VkDependencyInfo& info, const std::string& where) {
    const auto scopeOf = [](const auto& b) {
        return Scope{expand(b.srcStageMask), expand(b.dstStageMask), expandAccess(b.srcAccessMask),
                     expandAccess(b.dstAccessMask)};
    };
    std::vector<Scope> memory;
    for (std::uint32_t i = 0; i < info.memoryBarrierCount; ++i) memory.push_back(scopeOf(info.pMemoryBarriers[i]));
    const auto coversCell = [&](const VkImageMemoryBarrier2& b, const Resource& r, std::size_t index) {
        const auto& s = b.subresourceRange;
        const auto mip = static_cast<std::uint32_t>(index / r.layers),
                   layer = static_cast<std::uint32_t>(index % r.layers);
        return mip >= s.baseMipLevel &&
               (s.levelCount == VK_REMAINING_MIP_LEVELS || mip < s.baseMipLevel + s.levelCount) &&
               layer >= s.baseArrayLayer &&
               (s.layerCount == VK_REMAINING_ARRAY_LAYERS || layer < s.baseArrayLayer + s.layerCount);
    };
    // All scopes of one call hold at once: an access is judged by what it was before the call.
    for (auto& [id, resource] : resources_) {
        for (auto& [begin, span] : resource.spans) apply(span.cell, memory);
        for (std::size_t c = 0; c < resource.cells.size(); ++c) {
            const VkImageMemoryBarrier2* moved = nullptr;
            auto scopes = memory;
            for (std::uint32_t i = 0; i < info.imageMemoryBarrierCount; ++i) {
                const auto& b = info.pImageMemoryBarriers[i];
                if (reinterpret_cast<std::uint64_t>(b.image) != id || !coversCell(b, resource, c)) continue;
                if (b.oldLayout != b.newLayout)
                    moved = &b;
                else
                    scopes.push_back(scopeOf(b));
            }
            if (moved != nullptr)
                transition(resource, resource.cells[c], *moved, scopeOf(*moved), memory, where);
            else
                apply(resource.cells[c], scopes);
        }
    }
    for (std::uint32_t i = 0; i < info.imageMemoryBarrierCount; ++i) {
        const auto& b = info.pImageMemoryBarriers[i];
        if (b.oldLayout != VK_IMAGE_LAYOUT_UNDEFINED) continue;
        const auto id = reinterpret_cast<std::uint64_t>(b.image);
        const auto found = resources_.find(id);
        if (found == resources_.end())
            hazard("destroyed: " + where + " moves an image that is gone");
        else if (found->second.memory != 0)
            takeOver(id, found->second, scopeOf(b), where);
    }
}

void HazardOracle::hostReads(std::uint64_t buffer) {
    const auto found = resources_.find(buffer);
    if (found == resources_.end()) return;
    for (auto& [begin, span] : found->second.spans) {
        const Write& w = span.cell.write;
        if (!w.any) continue;
        const auto host = static_cast<std::size_t>(std::countr_zero(VK_PIPELINE_STAGE_2_HOST_BIT));
        if (!w.available || (w.visible[host] & VK_ACCESS_2_HOST_READ_BIT) == 0)
            hazard("host read: " + found->second.name + " was written by " + w.by + " and the host does not see it");
    }
}

}  // namespace pelage::test
