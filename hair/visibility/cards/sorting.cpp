// SPDX-License-Identifier: MIT
#include "sorting.hpp"

#include <algorithm>
#include <numeric>

namespace pelage::hair {

void BackToFront::sort() {
    order_.resize(depth_.size());
    std::iota(order_.begin(), order_.end(), 0U);
    // std::stable_sort would take memory at every call.
    std::sort(order_.begin(), order_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return depth_[a] != depth_[b] ? depth_[a] > depth_[b] : a < b; });
}

std::span<const std::uint32_t> BackToFront::triangles(const Mesh& mesh, const glm::mat4& model,
                                                      const glm::vec3& forward) {
    const glm::vec3 axis = glm::transpose(glm::mat3(model)) * forward;
    const std::size_t count = mesh.indices.size() / 3;
    depth_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        float sum = 0;
        for (std::size_t c = 0; c < 3; ++c) sum += glm::dot(axis, mesh.vertices[mesh.indices[i * 3 + c]].position);
        depth_[i] = sum;
    }
    sort();
    indices_.resize(count * 3);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t c = 0; c < 3; ++c) indices_[i * 3 + c] = mesh.indices[order_[i] * 3 + c];
    }
    return indices_;
}

std::span<const glm::uvec2> BackToFront::segments(const Strands& strands, std::span<const glm::vec3> points,
                                                  const glm::mat4& model, const glm::vec3& forward) {
    const glm::vec3 axis = glm::transpose(glm::mat3(model)) * forward;
    segments_.clear();
    depth_.clear();
    for (std::uint32_t s = 0; s < strands.strandCount(); ++s) {
        const std::uint32_t begin = strands.first[s], end = strands.first[s + 1];
        for (std::uint32_t i = begin; i + 1 < end; ++i) {
            segments_.emplace_back(s, i - begin);
            depth_.push_back(glm::dot(axis, points[i]) + glm::dot(axis, points[i + 1]));
        }
    }
    sort();
    sorted_.resize(segments_.size());
    for (std::size_t i = 0; i < segments_.size(); ++i) sorted_[i] = segments_[order_[i]];
    return sorted_;
}

}  // namespace pelage::hair
