// SPDX-License-Identifier: MIT
// The last phase: where transient images lie in one heap. The largest is placed first, each at the lowest offset where
// no image lies that is alive at the same time. Images that are read after the frame live to its end; those that keep
// their contents from frame to frame, and buffers, are not placed.
#include "link.hpp"

namespace pelage::passes {
namespace {

constexpr std::uint64_t pageBytes = 65536;

MemoryNeed pages(const PlanResource& image) {
    return {(image.bytes + pageBytes - 1) / pageBytes * pageBytes, pageBytes};
}

std::uint64_t aligned(std::uint64_t offset, std::uint64_t alignment) {
    return (offset + alignment - 1) / alignment * alignment;
}

class Placer {
public:
    explicit Placer(Linker& linker) : linker_(linker), plan_(linker.plan) {}

    void run() {
        for (std::uint32_t i = 0; i < plan_.resources.size(); ++i) {
            PlanResource& image = plan_.resources[i];
            if (image.kind != PlanResource::Kind::Transient || image.isBuffer || image.partner != none) continue;
            const MemoryNeed need = linker_.host.memory ? linker_.host.memory(image) : pages(image);
            image.heapBytes = std::max<std::uint64_t>(1, need.size);
            plan_.naiveBytes += image.heapBytes;
            placed_.push_back({i, std::max<std::uint64_t>(1, need.alignment)});
        }
        findPeak();
        // Of equal images the one that begins first: the same plan from the same tree, always.
        std::sort(placed_.begin(), placed_.end(), [this](const Item& a, const Item& b) {
            const PlanResource& left = plan_.resources[a.resource];
            const PlanResource& right = plan_.resources[b.resource];
            if (left.heapBytes != right.heapBytes) return left.heapBytes > right.heapBytes;
            return left.firstPass != right.firstPass ? left.firstPass < right.firstPass : a.resource < b.resource;
        });
        begins_.resize(plan_.passes.size());
        alive_.resize(plan_.passes.size());
        for (const Item& item : placed_) place(item);
        if (plan_.heapBytes > linker_.host.maxBytes) tooMuch();
    }

private:
    struct Item {
        std::uint32_t resource;
        std::uint64_t alignment;
    };
    struct Range {
        std::uint64_t begin, end;
    };

    void tooMuch() {
        const PlanResource& largest = plan_.resources[placed_.front().resource];
        const AttachmentDeclaration* says = nullptr;
        for (const LinkedResource& each : linker_.resources) {
            if (each.index == placed_.front().resource) says = each.attachment;
        }
        linker_.reporter.error(says ? says->place : Place{}, "D002",
                               "the images of '" + linker_.tree.name + "' need " + std::to_string(plan_.heapBytes) +
                                   " bytes, " + std::to_string(linker_.host.maxBytes) +
                                   " are allowed; the largest is '" + largest.name + "' with " +
                                   std::to_string(largest.heapBytes),
                               "lower its size, layers or samples");
    }

    void findPeak() {
        std::vector<std::int64_t> change(plan_.passes.size() + 1, 0);
        for (const Item& item : placed_) {
            const PlanResource& image = plan_.resources[item.resource];
            change[image.firstPass] += static_cast<std::int64_t>(image.heapBytes);
            change[image.lastPass + 1] -= static_cast<std::int64_t>(image.heapBytes);
        }
        std::int64_t alive = 0;
        for (std::uint32_t pass = 0; pass < plan_.passes.size(); ++pass) {
            alive += change[pass];
            if (static_cast<std::uint64_t>(alive) <= plan_.peakBytes) continue;
            plan_.peakBytes = static_cast<std::uint64_t>(alive);
            plan_.peakPass = pass;
        }
    }

    void place(const Item& item) {
        PlanResource& image = plan_.resources[item.resource];
        // Alive at the same time: what is alive when it begins, and what begins while it lives.
        taken_.clear();
        take(alive_[image.firstPass]);
        for (std::uint32_t pass = image.firstPass + 1; pass <= image.lastPass; ++pass) take(begins_[pass]);
        std::sort(taken_.begin(), taken_.end(), [](const Range& a, const Range& b) { return a.begin < b.begin; });
        std::uint64_t offset = 0;
        for (const Range& range : taken_) {
            if (offset + image.heapBytes <= range.begin) break;
            offset = std::max(offset, aligned(range.end, item.alignment));
        }
        image.heapOffset = offset;
        plan_.heapBytes = std::max(plan_.heapBytes, offset + image.heapBytes);
        begins_[image.firstPass].push_back(item.resource);
        for (std::uint32_t pass = image.firstPass; pass <= image.lastPass; ++pass) {
            ++linker_.visits;
            alive_[pass].push_back(item.resource);
        }
    }

    void take(const std::vector<std::uint32_t>& resources) {
        ++linker_.visits;
        for (const std::uint32_t index : resources) {
            ++linker_.visits;
            const PlanResource& other = plan_.resources[index];
            taken_.push_back({other.heapOffset, other.heapOffset + other.heapBytes});
        }
    }

    Linker& linker_;
    Plan& plan_;
    std::vector<Item> placed_ = {};
    std::vector<std::vector<std::uint32_t>> begins_ = {}, alive_ = {};  // by pass; of the placed ones
    std::vector<Range> taken_ = {};
};

}  // namespace

void Linker::place() {
    Placer(*this).run();
}

}  // namespace pelage::passes
