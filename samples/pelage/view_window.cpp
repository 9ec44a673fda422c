// SPDX-License-Identifier: MIT
#include "view_window.hpp"

#include <pelage/rhi/vulkan.hpp>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <utility>

namespace pelage::app {

struct Window::State {
    GLFWwindow* window = nullptr;
    WindowInput input = {};
    double lastX = 0, lastY = 0;

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        if (window) glfwDestroyWindow(window);
        glfwTerminate();
    }
};

namespace {

Window::State& stateOf(GLFWwindow* window) {
    return *static_cast<Window::State*>(glfwGetWindowUserPointer(window));
}

std::string glfwReason() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "GLFW gives no reason";
}

void listen(GLFWwindow* window) {
    glfwSetScrollCallback(
        window, [](GLFWwindow* from, double, double y) { stateOf(from).input.wheel += static_cast<float>(y); });
    glfwSetCursorPosCallback(window, [](GLFWwindow* from, double x, double y) {
        Window::State& state = stateOf(from);
        if (glfwGetMouseButton(from, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS) {
            state.input.dragX += static_cast<float>(x - state.lastX);
            state.input.dragY += static_cast<float>(y - state.lastY);
        }
        state.lastX = x;
        state.lastY = y;
    });
    glfwSetKeyCallback(window, [](GLFWwindow* from, int key, int, int action, int) {
        if (action != GLFW_PRESS) return;
        if (key == GLFW_KEY_ESCAPE) glfwSetWindowShouldClose(from, GLFW_TRUE);
        if (key == GLFW_KEY_R) stateOf(from).input.reset = true;
        if (key == GLFW_KEY_S) stateOf(from).input.save = true;
    });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* from) { stateOf(from).input.refresh = true; });
}

}  // namespace

Result<Window> Window::open(const std::string& title, std::uint32_t width, std::uint32_t height) {
    if (glfwInit() != GLFW_TRUE) {
        return tl::unexpected(failure("A080", "no window can be opened: " + glfwReason() +
                                                  "; without a display use pelage render or pelage gallery"));
    }
    Window made;
    made.state_ = std::make_shared<State>();
    if (glfwVulkanSupported() != GLFW_TRUE) {
        return tl::unexpected(failure("A081", "the windows of this display cannot show Vulkan: " + glfwReason()));
    }
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    made.state_->window =
        glfwCreateWindow(static_cast<int>(width), static_cast<int>(height), title.c_str(), nullptr, nullptr);
    if (!made.state_->window) return tl::unexpected(failure("A082", "the window cannot be made: " + glfwReason()));
    glfwSetWindowUserPointer(made.state_->window, made.state_.get());
    listen(made.state_->window);
    return made;
}

std::vector<std::string> Window::surfaceExtensions() const {
    std::uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    return names ? std::vector<std::string>(names, names + count) : std::vector<std::string>();
}

Result<rhi::Surface> Window::createSurface(const rhi::Instance& instance) const {
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    const VkResult made = glfwCreateWindowSurface(rhi::vulkan::instance(instance), state_->window, nullptr, &surface);
    if (made != VK_SUCCESS) {
        return tl::unexpected(failure("A083", "the window's surface cannot be made: " + glfwReason()));
    }
    return rhi::vulkan::adoptSurface(instance, surface);
}

WindowInput Window::poll(double seconds) {
    if (seconds > 0) {
        glfwWaitEventsTimeout(seconds);
    } else {
        glfwPollEvents();
    }
    return std::exchange(state_->input, {});
}

bool Window::closed() const {
    return glfwWindowShouldClose(state_->window) == GLFW_TRUE;
}

rhi::Extent3D Window::size() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(state_->window, &width, &height);
    return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), 1};
}

}  // namespace pelage::app
