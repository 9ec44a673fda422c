// SPDX-License-Identifier: MIT
#include "orbit.hpp"

#include <algorithm>
#include <cmath>

namespace pelage::app {

namespace {

// Short of the poles, where "up" would have no meaning.
constexpr float steepest = 1.5F;

}  // namespace

void Orbit::turn(float yaw, float pitch) {
    yaw_ += yaw;
    pitch_ = std::clamp(pitch_ + pitch, -steepest, steepest);
}

void Orbit::approach(float steps) {
    const float near = start_.nearPlane * 2.0F, far = start_.farPlane * 0.5F;
    distance_ = std::clamp(distance_ * std::pow(0.9F, steps), near, far);
}

void Orbit::reset() {
    const glm::vec3 arm = start_.eye - start_.target;
    distance_ = glm::length(arm);
    yaw_ = std::atan2(arm.x, arm.z);
    pitch_ = std::clamp(std::asin(std::clamp(arm.y / distance_, -1.0F, 1.0F)), -steepest, steepest);
}

hair::Camera Orbit::camera() const {
    hair::Camera camera = start_;
    const glm::vec3 arm(std::cos(pitch_) * std::sin(yaw_), std::sin(pitch_), std::cos(pitch_) * std::cos(yaw_));
    camera.eye = camera.target + arm * distance_;
    return camera;
}

}  // namespace pelage::app
