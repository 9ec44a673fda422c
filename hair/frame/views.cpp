// SPDX-License-Identifier: MIT
#include "views.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace pelage::hair {
namespace {

glm::vec3 unit(const glm::vec3& v, const glm::vec3& fallback) {
    const float length = glm::length(v);
    return length > 1e-12F && std::isfinite(length) ? v / length : fallback;
}

glm::vec3 anyUp(const glm::vec3& forward) {
    return std::abs(forward.y) > 0.95F ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
}

// The view of a light onto the sphere that holds everything.
struct LightView {
    glm::mat4 matrix = glm::mat4(1.0F);
    glm::vec3 eye = {}, forward = {};
    float nearPlane = 0, farPlane = 1, pixelScale = 0, pixelConstant = 0;
    bool perspective = false;
};

LightView lightView(const Light& light, const glm::vec3& center, float radius, float mapSize) {
    LightView view;
    const float distance = glm::length(center - light.position);
    const bool hasPosition = lightKind(light.kind).hasPosition;
    if (hasPosition && distance > 1.02F * radius) {
        view.perspective = true;
        view.eye = light.position;
        view.forward = (center - light.position) / distance;
        view.nearPlane = std::max(distance - radius, 0.02F * radius);
        view.farPlane = distance + radius;
        const float fov = 2.0F * std::asin(std::min(radius / distance, 0.97F));
        view.matrix = perspectiveReversed(fov, 1.0F, view.nearPlane, view.farPlane);
        view.pixelScale = 2.0F * std::tan(0.5F * fov) / mapSize;
    } else {
        // A light without a position, or one so near that one frustum cannot hold the scene: parallel rays.
        view.forward = unit(hasPosition ? center - light.position : light.direction, {0, -1, 0});
        view.eye = center - view.forward * (2.0F * radius);
        view.nearPlane = 0.9F * radius;
        view.farPlane = 3.1F * radius;
        view.matrix = orthographicReversed(radius, radius, view.nearPlane, view.farPlane);
        view.pixelConstant = 2.0F * radius / mapSize;
    }
    view.matrix = view.matrix * glm::lookAt(view.eye, view.eye + view.forward, anyUp(view.forward));
    return view;
}

// A host's matrices in our conventions: reversed depth, clip-space +Y up.
void setHostView(FrameBlock& block, const HostView& host) {
    glm::mat4 projection = host.projection;
    for (int column = 0; column < 4; ++column) {
        if (host.clipYDown) projection[column][1] = -projection[column][1];
        if (host.depth == passes::DepthConvention::Conventional)
            projection[column][2] = projection[column][3] - projection[column][2];
    }
    block.viewProjection = projection * host.view;
    const glm::mat4 fromView = glm::inverse(host.view);
    block.eye = glm::vec3(fromView[3]);
    block.viewForward = unit(-glm::vec3(fromView[2]), {0, 0, -1});
    // Height of a pixel: at one metre in perspective, everywhere in a parallel projection.
    const float height = 2.0F / (std::max(std::abs(projection[1][1]), 1e-12F) * block.viewport.y);
    const bool perspective = projection[2][3] != 0.0F;
    block.pixelScale = perspective ? height : 0.0F;
    block.pixelConstant = perspective ? 0.0F : height;
}

}  // namespace

glm::mat4 perspectiveReversed(float verticalFov, float aspect, float nearPlane, float farPlane) {
    const float f = 1.0F / std::tan(0.5F * verticalFov), range = farPlane - nearPlane;
    glm::mat4 m(0.0F);
    m[0][0] = f / aspect;
    m[1][1] = f;
    m[2][2] = nearPlane / range;
    m[2][3] = -1.0F;
    m[3][2] = nearPlane * farPlane / range;
    return m;
}

glm::mat4 orthographicReversed(float halfWidth, float halfHeight, float nearPlane, float farPlane) {
    glm::mat4 m(1.0F);
    m[0][0] = 1.0F / halfWidth;
    m[1][1] = 1.0F / halfHeight;
    m[2][2] = 1.0F / (farPlane - nearPlane);
    m[3][2] = farPlane / (farPlane - nearPlane);
    return m;
}

void makeViews(FrameViews& views, const Scene& scene, const FrameSettings& settings, std::uint32_t shadowSize,
               std::uint32_t shadowLights) {
    views.main = {};
    views.shadows.clear();
    FrameBlock& main = views.main;
    const Camera& camera = scene.camera;
    const glm::vec3 forward = unit(camera.target - camera.eye, {0, 0, -1});
    glm::vec3 up = unit(camera.up, {0, 1, 0});
    if (std::abs(glm::dot(up, forward)) > 0.999F) up = anyUp(forward);
    const float w = static_cast<float>(settings.width), h = static_cast<float>(settings.height);
    main.viewport = {w, h};
    main.pixelSize = 1.0F / main.viewport;
    main.frameIndex = settings.frameIndex;
    if (settings.view) {
        setHostView(main, *settings.view);
    } else {
        main.viewProjection = perspectiveReversed(camera.verticalFov, w / h, camera.nearPlane, camera.farPlane) *
                              glm::lookAt(camera.eye, camera.eye + forward, up);
        main.eye = camera.eye;
        main.pixelScale = 2.0F * std::tan(0.5F * camera.verticalFov) / h;
        main.viewForward = forward;
    }
    main.inverseViewProjection = glm::inverse(main.viewProjection);

    glm::vec3 low, high;
    bounds(scene, true, low, high);
    const glm::vec3 center = 0.5F * (low + high);
    const float radius = std::max(0.52F * glm::length(high - low), 1e-4F);
    if (scene.environment.enabled()) main.ambient = scene.environment.meanRadiance();
    const float size = static_cast<float>(shadowSize);
    views.lights = lightOptions(scene, shadowLights);
    for (std::uint32_t i = 0; i < views.lights.count; ++i) {
        const Light& light = scene.lights[i];
        LightBlock& block = main.lights[i];
        block.position = light.position;
        block.toLight = -unit(light.direction, {0, -1, 0});
        block.power = light.color * light.intensity;
        if ((views.lights.shadows >> i & 1U) == 0) continue;
        const LightView view = lightView(light, center, radius, size);
        block.shadowLayer = static_cast<std::int32_t>(views.shadows.size());
        block.worldToShadow = view.matrix;
        block.shadowNear = view.nearPlane;
        block.shadowFar = view.farPlane;
        block.shadowCentral = view.perspective ? 1.0F : 0.0F;
        block.shadowTexel = 1.0F / size;
        FrameBlock shadow;
        shadow.viewProjection = view.matrix;
        shadow.eye = view.eye;
        shadow.viewForward = view.forward;
        shadow.viewport = glm::vec2(size);
        shadow.pixelSize = 1.0F / shadow.viewport;
        shadow.pixelScale = view.pixelScale;
        shadow.pixelConstant = view.pixelConstant;
        shadow.frameIndex = settings.frameIndex;
        views.shadows.push_back(shadow);
    }
}

}  // namespace pelage::hair
