// SPDX-License-Identifier: MIT
#include "sorting.hpp"

#include <algorithm>
#include <numeric>

namespace pelage::hair {

std::vector<std::uint32_t> backToFront(const Geometry& geometry, const glm::mat4& model, const glm::vec3& forward) {
    const std::size_t corners = geometry.topology == Topology::Lines ? 2 : 3;
    const std::size_t count = geometry.indices.size() / corners;
    // Distance along `forward` in object space, up to a constant that sorting does not see.
    const glm::vec3 axis = glm::transpose(glm::mat3(model)) * forward;
    std::vector<float> depth(count);
    for (std::size_t i = 0; i < count; ++i) {
        float sum = 0;
        for (std::size_t c = 0; c < corners; ++c) {
            sum += glm::dot(axis, geometry.vertices[geometry.indices[i * corners + c]].position);
        }
        depth[i] = sum;
    }
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return depth[a] > depth[b]; });
    std::vector<std::uint32_t> indices(count * corners);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t c = 0; c < corners; ++c) indices[i * corners + c] = geometry.indices[order[i] * corners + c];
    }
    return indices;
}

}  // namespace pelage::hair
