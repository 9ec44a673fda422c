// SPDX-License-Identifier: MIT
#include "hair.hpp"

#include "scene.hpp"

#include <pelage/hair/generate.hpp>
#include <pelage/hair/library.hpp>
#include <pelage/hair/renderer.hpp>
#include <pelage/rhi/vulkan.hpp>

namespace host {
namespace {

using namespace pelage;
namespace vulkan = rhi::vulkan;

template <class T>
auto need(T result) {
    if (!result) fatal(result.error().text().c_str());
    if constexpr (!std::is_void_v<typename T::value_type>) return std::move(*result);
}

// --- From here to the end of this class: what a host writes to add hair.
class Hair {
public:
    explicit Hair(const std::string& data) : library_(data) {}

    DeviceWishes wishes(VkInstance instance, VkPhysicalDevice device) {
        needs_ = need(vulkan::needs(vkGetInstanceProcAddr, instance, device, {}, rhi::Feature::WideLines));
        return {needs_.deviceExtensions, needs_.chain()};
    }
    void start(const Context& c) {
        vulkan::AdoptDescriptor host = {.getInstanceProcAddr = vkGetInstanceProcAddr, .instance = c.instance};
        host.physicalDevice = c.physicalDevice, host.device = c.device;
        host.queue = c.queue, host.queueFamily = c.queueFamily;
        host.enabledInstanceExtensions = c.instanceExtensions, host.enabledDeviceExtensions = c.deviceExtensions;
        host.enabledFeatures = static_cast<const VkPhysicalDeviceFeatures2*>(c.features);
        host.optionalFeatures = rhi::Feature::WideLines;
        host.queueLock = {[&c] { c.queueMutex->lock(); }, [&c] { c.queueMutex->unlock(); }};
        device_ = need(vulkan::adopt(host));
        rhi::TextureDescriptor image = {.label = "color", .size = {c.extent.width, c.extent.height, 1}};
        image.format = rhi::TextureFormat::RGBA16Float, image.usage = rhi::TextureUsage::RenderAttachment;
        color_ = need(vulkan::wrapImage(device_, c.color, image));
        image.format = rhi::TextureFormat::Depth32Float, image.usage = rhi::TextureUsage::TextureBinding;
        depth_ = need(vulkan::wrapImage(device_, c.depth, image));
        renderer_ = need(hair::Renderer::create({device_, need(library_.passTree("hair_host"))}));
        auto groom = hair::makeGroom({.style = hair::Style::Wavy});
        auto strands = std::make_shared<hair::Strands>(std::move(groom));
        scene_.objects.push_back({"hair", strands, need(library_.material("brown")).material});
        settings_ = {.width = c.extent.width, .height = c.extent.height};
        settings_.imports = {{"SceneColor", color_}, {"SceneDepth", depth_}};
        depthRange_ = c.reversedDepth ? passes::DepthConvention::Reversed : passes::DepthConvention::Conventional;
    }
    void draw(const Frame& frame) {
        settings_.view = {frame.view, frame.projection, depthRange_};
        scene_.lights = {{.direction = -frame.toLight}};
        auto encoder = device_.createCommandEncoder("hair");
        need(renderer_.encode(scene_, settings_, encoder));
        const auto commands = need(encoder.finish());
        const vulkan::ImageState drawn = {VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        const vulkan::ImageState tested = {VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL};
        const vulkan::SharedTexture shared[] = {{color_, drawn, drawn}, {depth_, tested, tested}};
        tickets_[frame.slot] = need(vulkan::encodeInto(device_, frame.commands, {&commands, 1}, shared));
    }
    void done(std::uint32_t slot) { vulkan::finished(device_, tickets_[slot]); }

private:
    hair::Library library_;
    vulkan::Needs needs_;
    rhi::Device device_;
    rhi::Texture color_, depth_;
    hair::Renderer renderer_;
    hair::Scene scene_;
    hair::FrameSettings settings_;
    vulkan::Ticket tickets_[framesInFlight] = {};
    passes::DepthConvention depthRange_ = {};
};
// --- To here.

}  // namespace

Guest hairGuest(const std::string& dataDirectory) {
    auto hair = std::make_shared<std::unique_ptr<Hair>>(std::make_unique<Hair>(dataDirectory));
    return {.wishes = [hair](auto instance, auto device) { return (*hair)->wishes(instance, device); },
            .start = [hair](const Context& context) { (*hair)->start(context); },
            .draw = [hair](const Frame& frame) { (*hair)->draw(frame); },
            .done = [hair](std::uint32_t slot) { (*hair)->done(slot); },
            .stop = [hair] { hair->reset(); }};
}

}  // namespace host
