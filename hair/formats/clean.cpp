// SPDX-License-Identifier: MIT
#include "clean.hpp"

#include "reading.hpp"

#include <algorithm>
#include <limits>

namespace pelage::hair::reading {
namespace {

struct Box {
    glm::vec3 low = glm::vec3(std::numeric_limits<float>::max()), high = -low;
    void add(const glm::vec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    void add(const Box& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
};

class Cleaner {
public:
    explicit Cleaner(Strands& strands) : strands_(strands), withWidths_(!strands.widths.empty()) {}

    void run() {
        std::size_t begin = 0, kept = 0;  // of points
        std::uint32_t keptStrands = 0;
        seen_ = strands_.strandCount();
        for (std::uint32_t s = 0; s < seen_; ++s) {
            const std::size_t end = strands_.first[s + 1];
            const std::size_t after = keep(begin, end, kept);
            begin = end;
            if (after == kept) continue;
            kept = after;
            strands_.first[++keptStrands] = static_cast<std::uint32_t>(kept);
        }
        strands_.points.resize(kept);
        if (withWidths_) strands_.widths.resize(kept);
        strands_.first.resize(std::size_t{keptStrands} + 1);
        if (keptStrands == 0) return;
        strands_.boundsMin = all_.low;
        strands_.boundsMax = all_.high;
        // A merged point may have stuck out by a millionth.
        if (mergedPoints_ > 0) strands_.updateBounds();
    }

    std::uint64_t seen_ = 0, notFinite_ = 0, tooShort_ = 0, noLength_ = 0, mergedPoints_ = 0, badWidths_ = 0;

private:
    /// Moves the points [begin, end) that can be used to `to`; returns where they end, `to` for a strand to be dropped.
    std::size_t keep(std::size_t begin, std::size_t end, std::size_t to) {
        if (end < begin + 2) {
            ++tooShort_;
            return to;
        }
        glm::vec3* const points = strands_.points.data();
        Box box;
        bool good = true;
        for (std::size_t i = begin; i < end; ++i) {
            good = good && usable(points[i]);
            box.add(points[i]);
        }
        if (!good) {
            ++notFinite_;
            return to;
        }
        // Points closer than a millionth of the strand are one point: the direction between them is only rounding.
        const glm::dvec3 size = glm::dvec3(box.high) - glm::dvec3(box.low);
        const double extent2 = glm::dot(size, size);
        if (!(extent2 > 1e-24)) {
            ++noLength_;
            return to;
        }
        const std::size_t first = to;
        for (std::size_t i = begin; i < end; ++i) {
            if (to > first) {
                const glm::dvec3 step = glm::dvec3(points[i]) - glm::dvec3(points[to - 1]);
                if (glm::dot(step, step) <= 1e-12 * extent2) {
                    ++mergedPoints_;
                    continue;
                }
            }
            points[to] = points[i];
            if (withWidths_) {
                const float width = strands_.widths[i];
                const bool fine = isWidth(width);
                if (!fine) ++badWidths_;
                strands_.widths[to] = fine ? width : strands_.width;
            }
            ++to;
        }
        all_.add(box);
        return to;
    }

    Strands& strands_;
    bool withWidths_;
    Box all_;
};

}  // namespace

bool isWidth(float width) {
    return usable(width) && width > 0;
}

Result<Strands> cleaned(Strands&& read, char family, Diagnostics& notes) {
    Cleaner cleaner(read);
    cleaner.run();
    const auto code = [&](const char* number) { return Code::find(family + std::string(number)).value_or(Code()); };
    const std::string all = " of " + std::to_string(cleaner.seen_) + " strands";
    if (read.strandCount() == 0) {
        return fault(code("006"), read.name,
                     "no strand can be used: " + std::to_string(cleaner.notFinite_) +
                         " with points that are not finite, " + std::to_string(cleaner.tooShort_) +
                         " with fewer than 2 points, " + std::to_string(cleaner.noLength_) +
                         " without length, out of " + std::to_string(cleaner.seen_) + "; expected at least 1",
                     "export the groom again");
    }
    const auto warn = [&](const char* number, std::uint64_t count, const std::string& text, const char* hint) {
        if (count == 0) return;
        notes.add(remark(Severity::Warning, code(number), read.name, std::to_string(count) + text, hint));
    };
    const char* again = "if they matter, export the groom again";
    warn("101", cleaner.notFinite_, all + " have points that are not finite numbers and were dropped", again);
    warn("102", cleaner.tooShort_, all + " have fewer than 2 points and were dropped", again);
    warn("103", cleaner.noLength_, all + " have no length (all points equal) and were dropped", again);
    warn("104", cleaner.mergedPoints_, " points repeat the point before them and were merged",
         "nothing needs to be done");
    warn("105", cleaner.badWidths_, " widths are not positive finite numbers and became the default width",
         "check the thickness channel of the groom");
    return std::move(read);
}

}  // namespace pelage::hair::reading
