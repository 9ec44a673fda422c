// SPDX-License-Identifier: MIT
// Hair and what it grows on, as plain data in memory: strands, and triangle meshes for cards and skin.
// Units: metres, +Y up, right-handed. The strand direction u always points from root to tip.
// This header and hair/geometry/ need nothing but GLM, so that a path tracer or a simulation can share them.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace pelage::hair {

/// 8-bit image, rows from the top. Colour textures are sRGB-encoded in RGB and linear in alpha.
struct Image8 {
    std::uint32_t width = 0, height = 0, channels = 4;  // channels: 1, 2 or 4
    bool srgb = false;                                  // RGB is sRGB-encoded
    std::vector<std::uint8_t> texels = {};              // width * height * channels
    bool empty() const { return texels.empty(); }
};

/// One vertex of a mesh; the layout of its vertex buffer (13 floats, 52 bytes).
struct Vertex {
    glm::vec3 position = {};  // m, object space
    glm::vec3 normal = {};    // unit
    glm::vec3 tangent = {};   // unit strand direction u, root to tip; for skin: any unit tangent
    glm::vec2 uv = {};        // v grows from root to tip on cards; origin top left
    float strandId = 0;       // 0..1, one value per card island
    float along = 0;          // 0 at the root .. 1 at the tip
};
static_assert(sizeof(Vertex) == 52);

/// Triangles: cards that stand for strands, or skin and other opaque surfaces.
struct Mesh {
    std::string name = {};
    bool isHair = true;  // false: skin
    std::vector<Vertex> vertices = {};
    std::vector<std::uint32_t> indices = {};  // 3 per triangle
    std::uint32_t islandCount = 0;            // cards, as islands of connected triangles
    Image8 colorMap = {};                     // base colour and, in alpha, opacity; may be empty
    Image8 strandIdMap = {};                  // one channel; may be empty
    glm::vec3 boundsMin = {}, boundsMax = {};

    void updateBounds();
};

inline constexpr std::uint32_t kMaxSubdivisions = 64;

/// Strands: polylines of 2 points or more, all points in one array. The arrays go to the device as they are; tangents,
/// normals and the curve between the points are computed there (curveAt() says the same on the CPU).
struct Strands {
    std::string name = {};
    std::vector<glm::vec3> points = {};     // m, root first
    std::vector<std::uint32_t> first = {};  // strandCount() + 1 entries: strand s is points [first[s], first[s + 1])
    std::vector<float> widths = {};         // m, diameter at each point; empty: `width` everywhere
    float width = 80e-6F;                   // m, a human hair
    std::vector<glm::vec3> colors = {};     // scene-linear factor of the base colour at each point; empty: 1
    std::vector<float> ids = {};            // 0..1, one a strand, for variation; empty: hashUnit(strand)
    glm::vec3 center = {};                  // m; normals lead away from it: the middle of the head
    std::uint32_t subdivisions = 1;  // drawn segments between two points, 1..kMaxSubdivisions; curly grooms need 4
    glm::vec3 boundsMin = {}, boundsMax = {};  // of the points

    std::uint32_t strandCount() const { return first.empty() ? 0 : static_cast<std::uint32_t>(first.size() - 1); }
    /// The points of one strand; empty when `first` leads outside the points.
    std::span<const glm::vec3> strand(std::uint32_t s) const;
    float widthAt(std::size_t point) const { return point < widths.size() ? widths[point] : width; }
    void updateBounds();
};

/// What an object of a scene is made of.
using Geometry = std::variant<std::shared_ptr<const Mesh>, std::shared_ptr<const Strands>>;

/// Null when the geometry is of the other kind, or none.
const Strands* strandsOf(const Geometry& geometry);
const Mesh* meshOf(const Geometry& geometry);
/// Strands and cards, but not skin.
bool isHair(const Geometry& geometry);
/// Nothing to draw: no geometry, no triangle, no strand.
bool isEmpty(const Geometry& geometry);
const std::string& nameOf(const Geometry& geometry);
/// Object-space bounds; false when there is nothing to bound.
bool boundsOf(const Geometry& geometry, glm::vec3& low, glm::vec3& high);

/// The mean of the roots, which lies inside the head: what normals lead away from when the head's place is not known.
/// A stray strand moves it by its share only, and it turns with the object, unlike the middle of a box around the
/// roots.
glm::vec3 middleOfRoots(const Strands& strands);

/// A uniform Catmull-Rom curve through the points of a strand, the end points doubled. `segment` is
/// 0..points.size() - 2, t 0..1 within it; the curve passes through the points exactly. Points per metre do not matter.
glm::vec3 curveAt(std::span<const glm::vec3> points, std::size_t segment, float t);
/// The derivative by t, m; it may vanish where points coincide.
glm::vec3 curveDerivative(std::span<const glm::vec3> points, std::size_t segment, float t);

}  // namespace pelage::hair
