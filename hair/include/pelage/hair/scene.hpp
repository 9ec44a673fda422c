// SPDX-License-Identifier: MIT
// What is rendered: objects (geometry, material, transform), lights, environment, camera. Plain values.
// Units: metres; scene-linear Rec.709 RGB; W/m2 for directional lights, W/sr for point lights, radiance (W/sr/m2) for
// the environment.
#pragma once

#include <pelage/hair/geometry.hpp>
#include <pelage/materials/material.hpp>
#include <pelage/rhi/resources.hpp>

#include <glm/glm.hpp>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pelage::hair {

struct Camera {
    glm::vec3 eye = {0, 1.6F, 1.2F}, target = {0, 1.6F, 0}, up = {0, 1, 0};
    float verticalFov = 0.45F;                  // rad, 0.01..3
    float nearPlane = 0.02F, farPlane = 50.0F;  // m
};

struct Light {
    /// The kinds of light_kinds.def.
    enum class Kind : std::uint8_t {
#define PELAGE_LIGHT_KIND(number, word, name, traits, power) name = number,
#include <pelage/hair/light_kinds.def>
#undef PELAGE_LIGHT_KIND
    } kind = Kind::Directional;
    glm::vec3 position = {};           // m; of kinds that have one
    glm::vec3 direction = {0, -1, 0};  // the way the light travels; of kinds that have one
    glm::vec3 color = {1, 1, 1};       // scene-linear, times
    float intensity = 3.14159265F;     // W/m2 (Directional) or W/sr (Point)
    bool castsShadow = true;
};

struct LightKindInfo {
    Light::Kind kind = Light::Kind::Directional;
    std::string_view word = {};  ///< in scene files
    bool hasPosition = false, hasDirection = false;
    std::string_view power = {};  ///< what color times intensity is, with its unit
};
/// All kinds, in the order of their numbers.
std::span<const LightKindInfo> lightKinds();
const LightKindInfo& lightKind(Light::Kind kind);

/// Distant radiance as 9 spherical-harmonics coefficients (real basis, bands 0..2), from which irradiance is exact to
/// about 1 % (Ramamoorthi and Hanrahan 2001).
struct Environment {
    std::array<glm::vec3, 9> radiance = {};
    float intensity = 1.0F;
    bool enabled() const { return intensity > 0.0F; }
    /// A soft studio: bright dome above, warm key side, dim floor. Mean radiance about 0.35.
    static Environment studio();
    static Environment uniform(const glm::vec3& radiance);
    static Environment none() { return {.radiance = {}, .intensity = 0.0F}; }
    /// Projects an equirectangular image (rows from the top, +Y up, RGB floats) onto the basis.
    static Environment fromEquirect(std::uint32_t width, std::uint32_t height, std::span<const float> rgb);
    glm::vec3 irradiance(const glm::vec3& normal) const;  // W/m2
    glm::vec3 meanRadiance() const;
    /// The same environment turned by a rotation.
    Environment rotated(const glm::mat3& rotation) const;
};

/// This frame's points of an object of strands, in place of those of its geometry: from a simulation, an animation, a
/// deformer. Widths, colours and ids stay those of the geometry. The renderer keeps those of the frame before on the
/// device. At most one of `points` and `buffer` is given; neither means that the object is at rest.
struct MovedPoints {
    /// m, object space; as many as the geometry has, in its order. Read by Renderer::encode(), which copies them.
    std::span<const glm::vec3> points = {};
    /// Or a buffer that a host lends, float3 at a stride of 12 bytes, with BufferUsage::CopySrc. It is read on the
    /// device when the frame runs. What the CPU must know of points is then known of the geometry's alone: the order of
    /// alpha blending, and the bounds unless they are given below.
    rhi::Buffer buffer = {};
    /// Where in `buffer` each strand lies: its first point and one past its last, as many as the strand has in the
    /// geometry. Empty: as in the geometry. Read by encode().
    std::span<const glm::uvec2> ranges = {};
    /// m, object space; both zero: those of `points`, or of the geometry for `buffer`. Shadow maps cover them.
    glm::vec3 boundsMin = {}, boundsMax = {};

    bool given() const { return !points.empty() || buffer; }
};

struct Object {
    std::string name = {};
    Geometry geometry = {};
    materials::Material material;
    glm::mat4 transform = glm::mat4(1.0F);  // widths of strands grow with it (its mean scale across the strand)
    MovedPoints moved = {};                 // strands only
};

/// Object-space bounds as drawn in this frame; false when there is nothing to draw.
bool boundsOf(const Object& object, glm::vec3& low, glm::vec3& high);

struct Scene {
    std::vector<Object> objects = {};
    std::vector<Light> lights = {};  // at most maxLights
    Environment environment = Environment::studio();
    Camera camera = {};
    glm::vec3 background = {0.05F, 0.055F, 0.06F};  // scene-linear, behind everything in the display picture
    float exposure = 1.0F;                          // multiplies before the display transform
};
inline constexpr std::uint32_t maxLights = 8;

/// World bounds of all hair (or of everything when `hairOnly` is false or there is no hair).
void bounds(const Scene& scene, bool hairOnly, glm::vec3& low, glm::vec3& high);

/// A camera that frames the box from `direction` (pointing from the box to the eye).
Camera frameBox(const glm::vec3& low, const glm::vec3& high, const glm::vec3& direction, float aspect,
                float verticalFov = 0.45F);

/// Key, fill and rim light for a box of this size, the rim from behind.
std::vector<Light> portraitLights(const glm::vec3& low, const glm::vec3& high);

}  // namespace pelage::hair
