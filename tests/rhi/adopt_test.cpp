// SPDX-License-Identifier: MIT
// A host with a device of its own, made here by hand: what it must enable, what adopting it promises, and what happens
// to its images, buffers and command buffers.
#include <pelage/rhi/vulkan.hpp>

#include "common.hpp"

namespace pelage::test {
namespace {

namespace vk = rhi::vulkan;

/// A raw device beside the tests' own, under the same validation layer.
struct HostDevice {
    PFN_vkGetInstanceProcAddr entry = nullptr;
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    vk::Needs needs;
    PFN_vkGetDeviceProcAddr getDeviceProcAddr = nullptr;

    template <class F>
    F load(const char* name) const {
        return reinterpret_cast<F>(getDeviceProcAddr(device, name));
    }
    explicit HostDevice(Gpu& gpu) {
        entry = vk::getInstanceProcAddr(gpu.instance);
        instance = vk::instance(gpu.instance);
        physical = vk::physicalDevice(gpu.adapter);
        needs = value(vk::needs(entry, instance, physical));
        const float priority = 1;
        VkDeviceQueueCreateInfo queues = {VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
        queues.queueCount = 1;
        queues.pQueuePriorities = &priority;
        VkDeviceCreateInfo info = {VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, needs.chain()};
        info.queueCreateInfoCount = 1;
        info.pQueueCreateInfos = &queues;
        info.enabledExtensionCount = static_cast<std::uint32_t>(needs.deviceExtensions.size());
        info.ppEnabledExtensionNames = needs.deviceExtensions.data();
        const auto create = reinterpret_cast<PFN_vkCreateDevice>(entry(instance, "vkCreateDevice"));
        EXPECT_EQ(create(physical, &info, nullptr, &device), VK_SUCCESS);
        getDeviceProcAddr = reinterpret_cast<PFN_vkGetDeviceProcAddr>(entry(instance, "vkGetDeviceProcAddr"));
        load<PFN_vkGetDeviceQueue>("vkGetDeviceQueue")(device, 0, 0, &queue);
    }
    HostDevice(const HostDevice&) = delete;
    HostDevice& operator=(const HostDevice&) = delete;
    ~HostDevice() { load<PFN_vkDestroyDevice>("vkDestroyDevice")(device, nullptr); }

    vk::AdoptDescriptor descriptor() {
        return {.label = "adopted",
                .getInstanceProcAddr = entry,
                .instance = instance,
                .physicalDevice = physical,
                .device = device,
                .queue = queue,
                .enabledDeviceExtensions = needs.deviceExtensions,
                .enabledFeatures = needs.features.link(!needs.deviceExtensions.empty()),
                .singleThreaded = true};
    }
};

/// A host's buffer, command buffer and submission.
struct HostFrame {
    HostDevice& host;
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    explicit HostFrame(HostDevice& h) : host(h) {
        VkCommandPoolCreateInfo info = {VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
        EXPECT_EQ(host.load<PFN_vkCreateCommandPool>("vkCreateCommandPool")(host.device, &info, nullptr, &pool),
                  VK_SUCCESS);
        VkCommandBufferAllocateInfo allocate = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        allocate.commandPool = pool;
        allocate.commandBufferCount = 1;
        host.load<PFN_vkAllocateCommandBuffers>("vkAllocateCommandBuffers")(host.device, &allocate, &commands);
        VkCommandBufferBeginInfo begin = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        host.load<PFN_vkBeginCommandBuffer>("vkBeginCommandBuffer")(commands, &begin);
    }
    HostFrame(const HostFrame&) = delete;
    HostFrame& operator=(const HostFrame&) = delete;
    ~HostFrame() { host.load<PFN_vkDestroyCommandPool>("vkDestroyCommandPool")(host.device, pool, nullptr); }
    void submitAndWait() {
        host.load<PFN_vkEndCommandBuffer>("vkEndCommandBuffer")(commands);
        VkCommandBufferSubmitInfo info = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
        info.commandBuffer = commands;
        VkSubmitInfo2 submit = {VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
        submit.commandBufferInfoCount = 1;
        submit.pCommandBufferInfos = &info;
        EXPECT_EQ(host.load<PFN_vkQueueSubmit2>("vkQueueSubmit2")(host.queue, 1, &submit, VK_NULL_HANDLE), VK_SUCCESS);
        host.load<PFN_vkDeviceWaitIdle>("vkDeviceWaitIdle")(host.device);
    }
};

class Adopt : public GpuTest {
protected:
    Diagnostic refused(const vk::AdoptDescriptor& d) {
        auto result = vk::adopt(d);
        EXPECT_FALSE(result.has_value());
        return result ? Diagnostic{} : result.error().first();
    }
};

TEST_F(Adopt, EveryGapIsNamedAtOnce) {
    HostDevice host(gpu);
    auto d = host.descriptor();
    const VkPhysicalDeviceFeatures2 nothing = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    d.enabledFeatures = &nothing;
    d.singleThreaded = false;
    d.apiVersion = VK_API_VERSION_1_2;
    d.queueFamily = 99;
    const auto error = refused(d);
    EXPECT_EQ(error.code, ErrorCode::MissingFeature);
    for (const char* word : {"API version 1.3", "dynamicRendering", "synchronization2", "maintenance4",
                             "timelineSemaphore", "independentBlend", "family 99", "queue lock"})
        EXPECT_NE(error.text.find(word), std::string::npos) << word << " is not in: " << error.text;
}

TEST_F(Adopt, OneMissingFeatureIsOneGap) {
    HostDevice host(gpu);
    auto d = host.descriptor();
    auto chain = host.needs.features;
    chain.f12.timelineSemaphore = VK_FALSE;
    d.enabledFeatures = chain.link(!host.needs.deviceExtensions.empty());
    const auto text = refused(d).text;
    EXPECT_NE(text.find("it lacks feature timelineSemaphore."), std::string::npos) << text;
}

TEST_F(Adopt, FeaturesCountWhicheverStructureEnablesThem) {
    HostDevice host(gpu);
    auto d = host.descriptor();
    // As a host written before Vulkan 1.3 would say it.
    const auto& needs = host.needs.features;
    auto lines = needs.lines;
    VkPhysicalDeviceDynamicRenderingFeatures rendering = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES};
    VkPhysicalDeviceSynchronization2Features sync = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES};
    VkPhysicalDeviceMaintenance4Features four = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES};
    VkPhysicalDeviceTimelineSemaphoreFeatures timeline = {
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES};
    VkPhysicalDeviceShaderTerminateInvocationFeatures terminate = {
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_TERMINATE_INVOCATION_FEATURES};
    VkPhysicalDeviceShaderDemoteToHelperInvocationFeatures demote = {
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_DEMOTE_TO_HELPER_INVOCATION_FEATURES};
    rendering.dynamicRendering = sync.synchronization2 = four.maintenance4 = timeline.timelineSemaphore = VK_TRUE;
    terminate.shaderTerminateInvocation = needs.f13.shaderTerminateInvocation;
    demote.shaderDemoteToHelperInvocation = needs.f13.shaderDemoteToHelperInvocation;
    VkPhysicalDeviceFeatures2 first = needs.f10;
    first.pNext = &rendering;
    rendering.pNext = &sync;
    sync.pNext = &four;
    four.pNext = &timeline;
    timeline.pNext = &terminate;
    terminate.pNext = &demote;
    demote.pNext = &lines;
    lines.pNext = nullptr;
    d.enabledFeatures = &first;
    EXPECT_TRUE(vk::adopt(d).has_value());
    timeline.timelineSemaphore = VK_FALSE;
    EXPECT_NE(refused(d).text.find("it lacks feature timelineSemaphore."), std::string::npos);
}

TEST_F(Adopt, EmptyHandlesAreNamed) {
    HostDevice host(gpu);
    auto d = host.descriptor();
    d.queue = VK_NULL_HANDLE;
    EXPECT_NE(refused(d).text.find("AdoptDescriptor::queue"), std::string::npos);
    EXPECT_FALSE(vk::needs(host.entry, VK_NULL_HANDLE, host.physical));
    EXPECT_FALSE(vk::createInstance({}, nullptr));
}

TEST_F(Adopt, SubmissionsHoldTheHostsLockAndTheEndIsTold) {
    HostDevice host(gpu);
    auto d = host.descriptor();
    int held = 0, taken = 0, released = 0;
    d.singleThreaded = false;
    d.queueLock = {[&] { ++held, ++taken; }, [&] { --held; }};
    d.onRelease = [&] { ++released; };
    {
        const auto device = value(vk::adopt(d));
        const auto b = value(device.createBuffer({.label = "b", .size = 64, .usage = BufferUsage::CopyDst}));
        auto encoder = device.createCommandEncoder();
        encoder.clearBuffer(b);
        const auto sent = value(device.queue().submit(value(encoder.finish())));
        EXPECT_EQ(taken, 1);
        EXPECT_TRUE(value(device.queue().wait(sent)));
        EXPECT_EQ(released, 0);
    }
    EXPECT_EQ(held, 0);
    EXPECT_EQ(released, 1);
    HostFrame still(host);  // the host's device works on
    still.submitAndWait();
}

TEST_F(Adopt, WrappedImagesComeAndGoInTheStatedLayouts) {
    HostDevice host(gpu);
    const auto device = value(vk::adopt(host.descriptor()));
    // An image of the adopted device stands for the host's: only its handle is used.
    const TextureDescriptor what = {
        .label = "host color",
        .size = {8, 8, 1},
        .usage = TextureUsage::RenderAttachment | TextureUsage::CopySrc | TextureUsage::TextureBinding};
    const auto owner = value(device.createTexture(what));
    int released = 0;
    {
        const auto wrapped = value(vk::wrapImage(device, vk::image(owner), what, [&] { ++released; }));
        const auto to = value(
            device.createBuffer({.label = "to", .size = 256, .usage = BufferUsage::CopyDst | BufferUsage::MapRead}));
        auto encoder = device.createCommandEncoder("hair");
        auto pass = encoder.beginRenderPass(
            {.label = "clear",
             .colorAttachments = {{.view = value(wrapped.createView()), .clearValue = {1, 0, 1, 1}}}});
        pass.end();
        encoder.copyTextureToBuffer({.texture = wrapped}, {.buffer = to}, {8, 8, 1});
        const auto commands = value(encoder.finish());
        HostFrame frame(host);
        const vk::SharedTexture shared[] = {
            {wrapped,
             {},
             {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
              VK_ACCESS_2_SHADER_SAMPLED_READ_BIT}}};
        const auto ticket = value(vk::encodeInto(device, frame.commands, {&commands, 1}, shared));
        EXPECT_EQ(commands.counters().barriers, 2U) << "into the attachment, and on to the copy";
        // The validation layer knows the layout in which the image is now; a wrong word here would be a message.
        VkImageMemoryBarrier2 next = {VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
        next.srcStageMask = next.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        next.oldLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
        next.newLayout = VK_IMAGE_LAYOUT_GENERAL;
        next.srcQueueFamilyIndex = next.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        next.image = vk::image(owner);
        next.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        VkDependencyInfo info = {VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
        info.imageMemoryBarrierCount = 1;
        info.pImageMemoryBarriers = &next;
        host.load<PFN_vkCmdPipelineBarrier2>("vkCmdPipelineBarrier2")(frame.commands, &info);
        frame.submitAndWait();
        vk::finished(device, ticket);
        EXPECT_EQ(std::to_integer<int>(to.mapped()[0]), 255);
        EXPECT_EQ(std::to_integer<int>(to.mapped()[1]), 0);
    }
    device.collect();
    EXPECT_EQ(released, 1);
}

TEST_F(Adopt, NothingIsDestroyedBeforeTheHostSaysThatItsFrameIsFinished) {
    HostDevice host(gpu);
    const auto device = value(vk::adopt(host.descriptor()));
    auto b = value(device.createBuffer({.label = "b", .size = 1 << 20, .usage = BufferUsage::CopyDst}));
    HostFrame frame(host);
    auto encoder = device.createCommandEncoder();
    encoder.clearBuffer(b);
    const auto commands = value(encoder.finish());
    const auto ticket = value(vk::encodeInto(device, frame.commands, {&commands, 1}));
    b = {};
    // A submission of our own that is done does not finish the host's frame before it.
    const auto c = value(device.createBuffer({.label = "c", .size = 64, .usage = BufferUsage::CopyDst}));
    frame.submitAndWait();
    auto later = device.createCommandEncoder();
    later.clearBuffer(c);
    EXPECT_TRUE(value(device.queue().wait(value(device.queue().submit(value(later.finish()))))));
    device.collect();
    const auto before = device.memoryStatistics().usedBytes;
    EXPECT_GE(before, std::uint64_t{1} << 20);
    vk::finished(device, ticket);
    EXPECT_LT(device.memoryStatistics().usedBytes, std::uint64_t{1} << 20);
}

TEST_F(Adopt, TheHostsWriteOfThisFrameIsWaitedForInEveryFrame) {
    HostDevice host(gpu);
    const auto device = value(vk::adopt(host.descriptor()));
    const auto usage = BufferUsage::CopyDst | BufferUsage::CopySrc;
    const auto owner = value(device.createBuffer({.label = "owner", .size = 64, .usage = usage}));
    const auto wrapped =
        value(vk::wrapBuffer(device, vk::buffer(owner), {.label = "host's", .size = 64, .usage = usage}));
    const auto to = value(device.createBuffer({.label = "to", .size = 64, .usage = usage}));
    for (int i = 0; i < 3; ++i) {
        auto encoder = device.createCommandEncoder();
        encoder.copyBufferToBuffer(wrapped, 0, to, 0, 64);
        const auto commands = value(encoder.finish());
        HostFrame frame(host);
        host.load<PFN_vkCmdFillBuffer>("vkCmdFillBuffer")(frame.commands, vk::buffer(owner), 0, 64, 5);
        // A barrier of an earlier frame must not be taken for one that stands after this fill.
        const vk::SharedBuffer buffers[] = {
            {wrapped, {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT}, {}}};
        const auto ticket = value(vk::encodeInto(device, frame.commands, {&commands, 1}, {}, buffers));
        frame.submitAndWait();
        vk::finished(device, ticket);
        EXPECT_EQ(commands.counters().barriers, 1U) << "frame " << i;
    }
}

TEST_F(Adopt, WrittenBytesTravelInTheHostsCommandBuffer) {
    HostDevice host(gpu);
    const auto device = value(vk::adopt(host.descriptor()));
    const auto usage = BufferUsage::CopyDst | BufferUsage::CopySrc | BufferUsage::Storage;
    const auto owner = value(device.createBuffer({.label = "owner", .size = 64, .usage = usage}));
    const auto shared =
        value(vk::wrapBuffer(device, vk::buffer(owner), {.label = "host's", .size = 64, .usage = usage}));
    const std::vector<std::uint32_t> data(16, 7);
    succeed(device.queue().writeBuffer(shared, 0, std::as_bytes(std::span(data))));
    HostFrame frame(host);
    const vk::SharedBuffer buffers[] = {{shared, {}, {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT}}};
    const auto ticket = value(vk::encodeInto(device, frame.commands, {}, {}, buffers));
    frame.submitAndWait();
    vk::finished(device, ticket);
    EXPECT_FALSE(vk::wrapBuffer(device, VK_NULL_HANDLE, {.label = "none", .size = 4, .usage = usage}));
    const auto to =
        value(device.createBuffer({.label = "to", .size = 64, .usage = BufferUsage::CopyDst | BufferUsage::MapRead}));
    auto encoder = device.createCommandEncoder();
    encoder.copyBufferToBuffer(owner, 0, to, 0, 64);
    EXPECT_TRUE(value(device.queue().wait(value(device.queue().submit(value(encoder.finish()))))));
    EXPECT_EQ(std::to_integer<int>(to.mapped()[60]), 7);
}

}  // namespace
}  // namespace pelage::test
