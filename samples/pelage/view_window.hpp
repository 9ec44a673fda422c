// SPDX-License-Identifier: MIT
// A window with what was done to it since the last look. GLFW and Vulkan are seen in view_window.cpp only.
#pragma once

#include "failure.hpp"

#include <pelage/rhi/device.hpp>

#include <memory>
#include <string>
#include <vector>

namespace pelage::app {

struct WindowInput {
    float dragX = 0, dragY = 0;  // pixels with the left button held
    float wheel = 0;             // steps, positive: away from the user
    bool reset = false, save = false, refresh = false;
    bool any() const { return dragX != 0 || dragY != 0 || wheel != 0 || reset || save || refresh; }
};

class Window {
public:
    static Result<Window> open(const std::string& title, std::uint32_t width, std::uint32_t height);

    /// What Instance::create must be told.
    std::vector<std::string> surfaceExtensions() const;
    Result<rhi::Surface> createSurface(const rhi::Instance& instance) const;

    /// Waits at most so long for events; returns what happened.
    WindowInput poll(double seconds);
    bool closed() const;
    rhi::Extent3D size() const;  // pixels; 0 x 0 while minimised

    struct State;

private:
    std::shared_ptr<State> state_;
};

}  // namespace pelage::app
