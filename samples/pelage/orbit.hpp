// SPDX-License-Identifier: MIT
// A camera on a sphere around its target.
#pragma once

#include <pelage/hair/scene.hpp>

namespace pelage::app {

class Orbit {
public:
    explicit Orbit(const hair::Camera& start) : start_(start) { reset(); }

    void turn(float yaw, float pitch);  // rad
    void approach(float steps);         // positive: nearer
    void reset();
    hair::Camera camera() const;

private:
    hair::Camera start_;
    float yaw_ = 0, pitch_ = 0, distance_ = 1;
};

}  // namespace pelage::app
