// SPDX-License-Identifier: MIT
#include <pelage/hair/geometry.hpp>

namespace pelage::hair {

std::span<const glm::vec3> Strands::strand(std::uint32_t s) const {
    const std::size_t begin = first[s], end = first[s + 1];
    if (end > points.size() || end < begin) return {};
    return std::span(points).subspan(begin, end - begin);
}

void Strands::updateBounds() {
    boundsMin = boundsMax = points.empty() ? glm::vec3(0) : points.front();
    for (const glm::vec3& p : points) {
        boundsMin = glm::min(boundsMin, p);
        boundsMax = glm::max(boundsMax, p);
    }
}

glm::vec3 middleOfRoots(const Strands& strands) {
    glm::dvec3 sum(0);
    double count = 0;
    for (std::uint32_t s = 0; s < strands.strandCount(); ++s) {
        const auto points = strands.strand(s);
        if (points.empty()) continue;
        sum += glm::dvec3(points.front());
        count += 1;
    }
    return count > 0 ? glm::vec3(sum / count) : glm::vec3(0);
}

}  // namespace pelage::hair
