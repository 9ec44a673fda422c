// SPDX-License-Identifier: MIT
// Hair and what it grows on, as plain data in memory: cards and other triangle meshes, and strands.
// Units: metres, +Y up, right-handed. The strand direction u always points from root to tip.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace pelage::hair {

/// 8-bit image, rows from the top. Colour textures are sRGB-encoded in RGB and linear in alpha.
struct Image8 {
    std::uint32_t width = 0, height = 0, channels = 4;  // channels: 1, 2 or 4
    bool srgb = false;                                  // RGB is sRGB-encoded
    std::vector<std::uint8_t> texels = {};              // width * height * channels
    bool empty() const { return texels.empty(); }
};

/// One vertex of every kind of drawable; the layout of the vertex buffer (15 floats, 60 bytes).
struct Vertex {
    glm::vec3 position = {};  // m, object space
    glm::vec3 normal = {};    // unit; for strands: away from the scalp, perpendicular to the tangent where possible
    glm::vec3 tangent = {};   // unit strand direction u, root to tip; for a skin mesh: any unit tangent
    glm::vec2 uv = {};        // v grows from root to tip on cards and strands; origin top left
    float strandId = 0;       // 0..1, one value per strand or card island
    float along = 0;          // 0 at the root .. 1 at the tip
    float width = 0;          // m, diameter of the strand at this point; 0 for meshes
    float pad = 0;
};
static_assert(sizeof(Vertex) == 60);

enum class Topology : std::uint8_t { Triangles, Lines };

/// What the renderer draws: an indexed mesh of triangles (cards, skin) or of line segments (strands).
struct Geometry {
    std::string name = {};
    Topology topology = Topology::Triangles;
    bool isHair = true;  // false: skin and other opaque surfaces
    std::vector<Vertex> vertices = {};
    std::vector<std::uint32_t> indices = {};  // 3 per triangle, 2 per segment
    std::uint32_t strandCount = 0;            // strands, or card islands
    Image8 colorMap = {};                     // base colour and, in alpha, opacity; may be empty
    Image8 strandIdMap = {};                  // one channel; may be empty
    glm::vec3 boundsMin = {}, boundsMax = {};

    void updateBounds();
};

/// Strands as read or generated: polylines with 2 points or more, all in one array.
struct Groom {
    std::string name = {};
    std::vector<glm::vec3> points = {};
    std::vector<std::uint32_t> firstPoint =
        {};                          // strandCount + 1 entries: strand s is [firstPoint[s], firstPoint[s+1])
    std::vector<float> widths = {};  // m, diameter per point; empty: `defaultWidth` everywhere
    float defaultWidth = 80e-6F;     // m, a human hair
    std::uint32_t strandCount() const {
        return firstPoint.empty() ? 0 : static_cast<std::uint32_t>(firstPoint.size() - 1);
    }
};

/// Line geometry of a groom: each strand resampled along a uniform Catmull-Rom curve through its points (end points
/// doubled) with `subdivisions` segments per input segment (>= 1; curly grooms need 4).
/// `center` is the point that normals lead away from, usually the middle of the head.
Geometry toLines(const Groom& groom, std::uint32_t subdivisions, const glm::vec3& center);

}  // namespace pelage::hair
