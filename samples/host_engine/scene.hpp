// SPDX-License-Identifier: MIT
// The host's meshes and its way to give up.
#pragma once

#include <volk.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/glm.hpp>
#include <vector>

namespace host {

struct Vertex {
    glm::vec3 position = {}, normal = {};
};
struct Push {
    glm::mat4 clip = glm::mat4(1.0F);
    glm::vec4 columns[3] = {}, toLight = {};
};
static_assert(sizeof(Push) == 128);  // what every device has

[[noreturn]] inline void fatal(const char* what) {
    std::fprintf(stderr, "host_engine: error: %s\n", what);
    std::exit(2);
}
inline void check(VkResult result, const char* what) {
    if (result == VK_SUCCESS) return;
    std::fprintf(stderr, "host_engine: error: %s failed with %d\n", what, static_cast<int>(result));
    std::exit(2);
}

/// Of radius 1; triangles.
inline std::vector<Vertex> sphere(int rings) {
    std::vector<Vertex> vertices;
    const auto at = [&](int i, int j) {
        const float theta = 3.14159265F * static_cast<float>(i) / static_cast<float>(rings);
        const float phi = 3.14159265F * static_cast<float>(j) / static_cast<float>(rings);
        const glm::vec3 p = {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
        return Vertex{p, p};
    };
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < 2 * rings; ++j)
            for (const auto& [a, b] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}})
                vertices.push_back(at(i + a, j + b));
    return vertices;
}

/// From -1 to 1; triangles.
inline std::vector<Vertex> box() {
    std::vector<Vertex> vertices;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0F, 1.0F}) {
            glm::vec3 n(0.0F), u(0.0F), v(0.0F);
            n[axis] = side;
            u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1.0F;
            for (const auto& [a, b] :
                 {std::pair{-1.0F, -1.0F}, {1.0F, -1.0F}, {1.0F, 1.0F}, {-1.0F, -1.0F}, {1.0F, 1.0F}, {-1.0F, 1.0F}})
                vertices.push_back({n + a * u + b * v, n});
        }
    return vertices;
}

}  // namespace host
