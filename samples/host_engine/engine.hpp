// SPDX-License-Identifier: MIT
// A small renderer in raw Vulkan, as an engine might have it: its own instance, device, images and frames in
// flight, a spinning opaque scene, and a second thread that submits to the same queue. It knows nothing of Pelage; hair
// comes in through the four functions of Guest.
#pragma once

#include <volk.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace host {

/// What a guest wants enabled beside what the engine wants itself.
struct DeviceWishes {
    std::vector<const char*> extensions = {};
    void* features = nullptr;  // a pNext chain for VkDeviceCreateInfo; the engine sets its own bits in it
};

struct Context {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    std::uint32_t queueFamily = 0;
    std::vector<const char*> instanceExtensions = {}, deviceExtensions = {};
    const void* features = nullptr;  // what the device was created with
    std::mutex* queueMutex = nullptr;
    VkImage color = VK_NULL_HANDLE, depth = VK_NULL_HANDLE;
    VkFormat colorFormat = VK_FORMAT_UNDEFINED, depthFormat = VK_FORMAT_UNDEFINED;
    VkExtent2D extent = {};
    bool reversedDepth = true;
};

/// Colour and depth are attachments that were written; the guest leaves both in the same layouts.
struct Frame {
    VkCommandBuffer commands = VK_NULL_HANDLE;
    std::uint32_t slot = 0;
    glm::mat4 view = glm::mat4(1.0F), projection = glm::mat4(1.0F);  // clip-space +Y down
    glm::vec3 toLight = {};
};

struct Guest {
    std::function<DeviceWishes(VkInstance, VkPhysicalDevice)> wishes = {};
    std::function<void(const Context&)> start = {};
    std::function<void(const Frame&)> draw = {};
    std::function<void(std::uint32_t slot)> done = {};  // the device has finished what was drawn in this slot
    std::function<void()> stop = {};
};

struct Options {
    std::uint32_t width = 640, height = 640, frames = 4;
    float turn = 0.35F;  // rad; where the box begins its way around the head
    bool reversedDepth = true, validate = false;
    std::string adapter = {};  // part of a name; empty: the first
};

inline constexpr std::uint32_t framesInFlight = 2;

class Engine {
public:
    Engine(const Options& options, Guest guest);
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;
    ~Engine();
    /// Draws the frames; the last one's picture, RGBA8 for an sRGB display, rows from the top.
    std::vector<std::uint8_t> run();
    std::uint32_t validationMessages() const { return messages_; }
    std::uint64_t streamed() const { return streamed_; }  // submissions of the second thread

private:
    struct Image {
        VkImage image = VK_NULL_HANDLE;
        VkDeviceMemory memory = VK_NULL_HANDLE;
        VkImageView view = VK_NULL_HANDLE;
    };
    struct Buffer {
        VkBuffer buffer = VK_NULL_HANDLE;
        VkDeviceMemory memory = VK_NULL_HANDLE;
        void* mapped = nullptr;
    };
    struct Slot {
        VkCommandPool pool = VK_NULL_HANDLE;
        VkCommandBuffer commands = VK_NULL_HANDLE;
        VkFence fence = VK_NULL_HANDLE;
        bool drawn = false;
    };
    void createDevice();
    void createTargets();
    void createPipeline();
    std::uint32_t memoryType(std::uint32_t allowed, VkMemoryPropertyFlags flags) const;
    Image makeImage(VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect);
    Buffer makeBuffer(VkDeviceSize size, VkBufferUsageFlags usage);
    Slot makeSlot();
    void recordScene(const Slot& slot, const Frame& frame, float time);
    void recordReadback(VkCommandBuffer commands);
    void submit(const Slot& slot);
    void waitFor(Slot& slot, std::uint32_t index);
    void stream(const std::atomic<bool>& stop);
    static VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                    VkDebugUtilsMessageTypeFlagsEXT,
                                                    const VkDebugUtilsMessengerCallbackDataEXT*, void*);

    Options options_;
    Guest guest_;
    Context context_;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    std::mutex queueMutex_;
    Image color_, depth_;
    Buffer mesh_, readback_, streamBuffer_;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
    Slot slots_[framesInFlight];
    std::uint32_t sphereVertices_ = 0, boxVertices_ = 0;
    std::atomic<std::uint32_t> messages_{0};
    std::atomic<std::uint64_t> streamed_{0};
};

}  // namespace host
