// SPDX-License-Identifier: MIT
// What strands and meshes have in common.
#include <pelage/hair/geometry.hpp>

namespace pelage::hair {

void Mesh::updateBounds() {
    boundsMin = boundsMax = vertices.empty() ? glm::vec3(0) : vertices.front().position;
    for (const Vertex& v : vertices) {
        boundsMin = glm::min(boundsMin, v.position);
        boundsMax = glm::max(boundsMax, v.position);
    }
}

const Strands* strandsOf(const Geometry& geometry) {
    const auto* strands = std::get_if<std::shared_ptr<const Strands>>(&geometry);
    return strands != nullptr ? strands->get() : nullptr;
}

const Mesh* meshOf(const Geometry& geometry) {
    const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&geometry);
    return mesh != nullptr ? mesh->get() : nullptr;
}

bool isHair(const Geometry& geometry) {
    const Mesh* mesh = meshOf(geometry);
    return mesh != nullptr ? mesh->isHair : strandsOf(geometry) != nullptr;
}

bool isEmpty(const Geometry& geometry) {
    if (const Strands* strands = strandsOf(geometry)) return strands->points.size() < 2 || strands->strandCount() == 0;
    const Mesh* mesh = meshOf(geometry);
    return mesh == nullptr || mesh->indices.empty();
}

const std::string& nameOf(const Geometry& geometry) {
    static const std::string none;
    if (const Strands* strands = strandsOf(geometry)) return strands->name;
    const Mesh* mesh = meshOf(geometry);
    return mesh != nullptr ? mesh->name : none;
}

bool boundsOf(const Geometry& geometry, glm::vec3& low, glm::vec3& high) {
    if (isEmpty(geometry)) return false;
    const auto take = [&](const auto& held) {
        low = held.boundsMin;
        high = held.boundsMax;
        return true;
    };
    if (const Strands* strands = strandsOf(geometry)) return take(*strands);
    const Mesh* mesh = meshOf(geometry);
    return mesh != nullptr && take(*mesh);
}

}  // namespace pelage::hair
