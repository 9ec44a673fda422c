// SPDX-License-Identifier: MIT
// Bounds, cameras and lights for scenes that come without them.
#include <pelage/hair/scene.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pelage::hair {

bool boundsOf(const Object& object, glm::vec3& low, glm::vec3& high) {
    if (!boundsOf(object.geometry, low, high)) return false;
    const MovedPoints& moved = object.moved;
    if (!moved.given() || strandsOf(object.geometry) == nullptr) return true;
    if (moved.boundsMin != moved.boundsMax) {
        low = moved.boundsMin;
        high = moved.boundsMax;
    } else if (!moved.points.empty()) {
        low = high = moved.points.front();
        for (const glm::vec3& p : moved.points) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    }
    return true;
}

void bounds(const Scene& scene, bool hairOnly, glm::vec3& low, glm::vec3& high) {
    low = glm::vec3(std::numeric_limits<float>::max());
    high = -low;
    bool found = false;
    for (const Object& object : scene.objects) {
        glm::vec3 from, to;
        if ((hairOnly && !isHair(object.geometry)) || !boundsOf(object, from, to)) continue;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 local = {(corner & 1) != 0 ? to.x : from.x, (corner & 2) != 0 ? to.y : from.y,
                                     (corner & 4) != 0 ? to.z : from.z};
            const glm::vec3 world = glm::vec3(object.transform * glm::vec4(local, 1.0F));
            low = glm::min(low, world);
            high = glm::max(high, world);
            found = true;
        }
    }
    if (found) return;
    if (hairOnly) return bounds(scene, false, low, high);
    low = glm::vec3(-0.5F);
    high = glm::vec3(0.5F);
}

Camera frameBox(const glm::vec3& low, const glm::vec3& high, const glm::vec3& direction, float aspect,
                float verticalFov) {
    Camera camera;
    camera.verticalFov = verticalFov;
    camera.target = 0.5F * (low + high);
    const glm::vec3 half = glm::max(0.5F * (high - low), glm::vec3(1e-4F));
    const glm::vec3 back = glm::normalize(direction);
    camera.up = std::abs(back.y) > 0.98F ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    const glm::vec3 right = glm::normalize(glm::cross(camera.up, back)), up = glm::cross(back, right);
    // The nearest eye from which every corner of the box is inside the picture, with a margin.
    const float tangent = std::tan(0.5F * verticalFov) / 1.06F;
    float distance = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 c =
            half * glm::vec3((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1);
        const float sideways =
            std::max(std::abs(glm::dot(c, up)), std::abs(glm::dot(c, right)) / std::max(aspect, 0.1F));
        distance = std::max(distance, sideways / tangent + glm::dot(c, back));
    }
    camera.eye = camera.target + back * distance;
    const float radius = glm::length(half);
    camera.nearPlane = std::max(0.01F * radius, 0.5F * (distance - 2.0F * radius));
    camera.farPlane = distance + 20.0F * radius;
    return camera;
}

std::vector<Light> portraitLights(const glm::vec3& low, const glm::vec3& high) {
    const glm::vec3 center = 0.5F * (low + high);
    const float radius = std::max(0.5F * glm::length(high - low), 1e-3F);
    const auto point = [&](const glm::vec3& towards, float distance, const glm::vec3& color, float irradiance,
                           bool shadow) {
        Light light;
        light.kind = Light::Kind::Point;
        light.position = center + glm::normalize(towards) * (distance * radius);
        light.color = color;
        light.intensity = irradiance * (distance * radius) * (distance * radius);
        light.castsShadow = shadow;
        return light;
    };
    return {point({0.75F, 0.85F, 1.0F}, 5.0F, {1.0F, 0.95F, 0.88F}, 7.0F, true),
            point({-1.0F, 0.25F, 0.6F}, 6.0F, {0.75F, 0.85F, 1.0F}, 2.2F, true),
            point({-0.55F, 0.75F, -1.0F}, 5.0F, {1.0F, 0.97F, 0.92F}, 7.0F, true)};
}

}  // namespace pelage::hair
