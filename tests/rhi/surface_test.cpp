// SPDX-License-Identifier: MIT
// A window, when there is a display to put it on (for example under xvfb-run).
#include <pelage/rhi/vulkan.hpp>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "common.hpp"

extern "C" VkResult glfwCreateWindowSurface(VkInstance, GLFWwindow*, const VkAllocationCallbacks*, VkSurfaceKHR*);

namespace pelage::test {
namespace {

TEST(SurfaceTest, AWindowIsDrawnPresentedAndConfiguredAgain) {
    if (glfwInit() == GLFW_FALSE) GTEST_SKIP() << "no display";
    if (glfwVulkanSupported() == GLFW_FALSE) {
        glfwTerminate();
        GTEST_SKIP() << "no Vulkan for windows";
    }
    Messages messages;
    {
        std::uint32_t count = 0;
        const char** names = glfwGetRequiredInstanceExtensions(&count);
        auto instance = value(Instance::create({.label = "window",
                                                .validation = true,
                                                .surfaceExtensions = {names, names + count},
                                                .onMessage = [&](const Message& m) { messages.add(m); }}));
        glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
        GLFWwindow* window = glfwCreateWindow(64, 48, "pelage", nullptr, nullptr);
        ASSERT_NE(window, nullptr);
        VkSurfaceKHR raw = VK_NULL_HANDLE;
        ASSERT_EQ(glfwCreateWindowSurface(vulkan::instance(instance), window, nullptr, &raw), VK_SUCCESS);
        auto surface = vulkan::adoptSurface(instance, raw);
        const auto adapter = value(instance.requestAdapter({.compatibleSurface = surface}));
        const auto device = value(adapter.requestDevice());
        for (const std::uint32_t width : {64U, 80U}) {
            glfwSetWindowSize(window, static_cast<int>(width), 48);
            for (int i = 0; i < 5; ++i) {
                glfwPollEvents();
                glfwWaitEventsTimeout(0.02);
            }
            succeed(surface.configure(device, {.size = {width, 48, 1}, .vsync = false}));
            EXPECT_NE(surface.format(), TextureFormat::Undefined);
            for (int frame = 0; frame < 8; ++frame) {
                const auto texture = value(surface.getCurrentTexture());
                if (!texture) break;
                EXPECT_EQ(texture.size().width, surface.size().width);
                auto encoder = device.createCommandEncoder("frame");
                encoder
                    .beginRenderPass({.label = "clear",
                                      .colorAttachments = {{.view = value(texture.createView()),
                                                            .clearValue = {0.1 * frame, 0, 0, 1}}}})
                    .end();
                value(device.queue().submit(value(encoder.finish())));
                value(surface.present());
                // A frame in which nothing was drawn is presented as well.
                if (frame == 3 && value(surface.getCurrentTexture())) value(surface.present());
            }
        }
        succeed(device.waitIdle());
        surface = {};
        glfwDestroyWindow(window);
    }
    glfwTerminate();
    for (const auto& m : messages.takeLayer()) ADD_FAILURE() << "validation layer: " << m.id << '\n' << m.text;
}

}  // namespace
}  // namespace pelage::test
