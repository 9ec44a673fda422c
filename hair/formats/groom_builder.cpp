// SPDX-License-Identifier: MIT
#include "groom_builder.hpp"

#include "reading.hpp"

#include <algorithm>

namespace pelage::hair {

using reading::fault;
using reading::remark;

void GroomBuilder::reserve(std::size_t strands, std::size_t points, bool withWidths) {
    groom_.firstPoint.reserve(strands + 1);
    groom_.points.reserve(points);
    if (withWidths) groom_.widths.reserve(points);
}

void GroomBuilder::setDefaultWidth(float width) {
    if (reading::usable(width) && width > 0) groom_.defaultWidth = width;
}

void GroomBuilder::add(std::span<const glm::vec3> points, std::span<const float> widths) {
    if (groom_.firstPoint.empty()) groom_.firstPoint.push_back(0);
    ++seen_;
    if (points.size() < 2) {
        ++tooShort_;
        return;
    }
    glm::vec3 low = points[0], high = points[0];
    for (const glm::vec3& p : points) {
        if (!reading::usable(p)) {
            ++notFinite_;
            return;
        }
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    // Points closer than a millionth of the strand are one point: the direction between them is only rounding.
    const double extent = glm::length(glm::dvec3(high) - glm::dvec3(low));
    if (!(extent > 1e-12)) {
        ++noLength_;
        return;
    }
    const std::size_t first = groom_.points.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool duplicate = groom_.points.size() > first &&
                               glm::length(glm::dvec3(points[i]) - glm::dvec3(groom_.points.back())) <= 1e-6 * extent;
        if (duplicate) {
            ++mergedPoints_;
            continue;
        }
        groom_.points.push_back(points[i]);
        if (widths.empty()) continue;
        const bool good = reading::usable(widths[i]) && widths[i] > 0;
        if (!good) ++badWidths_;
        groom_.widths.push_back(good ? widths[i] : groom_.defaultWidth);
    }
    groom_.firstPoint.push_back(static_cast<std::uint32_t>(groom_.points.size()));
}

Result<Groom> GroomBuilder::finish(Diagnostics& notes) {
    const std::string& file = groom_.name;
    const std::string all = " of " + std::to_string(seen_) + " strands";
    if (groom_.strandCount() == 0) {
        return tl::unexpected(fault(code("006"), file,
                                    "no strand can be used: " + std::to_string(notFinite_) +
                                        " with points that are not finite, " + std::to_string(tooShort_) +
                                        " with fewer than 2 points, " + std::to_string(noLength_) +
                                        " without length, out of " + std::to_string(seen_) + "; expected at least 1",
                                    "export the groom again"));
    }
    const auto warn = [&](const char* number, std::uint64_t count, const std::string& text, const char* hint) {
        if (count == 0) return;
        notes.add(remark(Severity::Warning, code(number), file, std::to_string(count) + text, hint));
    };
    const char* again = "if they matter, export the groom again";
    warn("101", notFinite_, all + " have points that are not finite numbers and were dropped", again);
    warn("102", tooShort_, all + " have fewer than 2 points and were dropped", again);
    warn("103", noLength_, all + " have no length (all points equal) and were dropped", again);
    warn("104", mergedPoints_, " points repeat the point before them and were merged", "nothing needs to be done");
    warn("105", badWidths_, " widths are not positive finite numbers and became the default width",
         "check the thickness channel of the groom");
    return std::move(groom_);
}

}  // namespace pelage::hair
