// SPDX-License-Identifier: MIT
// Instance, device, targets and the one pipeline of the host.
#define VOLK_IMPLEMENTATION
#include "engine.hpp"

#include "scene.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string_view>

namespace host {

std::span<const std::uint32_t> embeddedShader(std::string_view name);

VKAPI_ATTR VkBool32 VKAPI_CALL Engine::onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                 VkDebugUtilsMessageTypeFlagsEXT,
                                                 const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    std::fprintf(stderr, "validation: %s\n", data->pMessage);
    ++static_cast<Engine*>(user)->messages_;
    return VK_FALSE;
}

Engine::Engine(const Options& options, Guest guest) : options_(options), guest_(std::move(guest)) {
    check(volkInitialize(), "volkInitialize");
    VkApplicationInfo application = {VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.pApplicationName = "host_engine";
    application.apiVersion = VK_API_VERSION_1_3;
    const char* layer = "VK_LAYER_KHRONOS_validation";
    const VkValidationFeatureEnableEXT synchronization = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT checks = {VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
    checks.enabledValidationFeatureCount = 1;
    checks.pEnabledValidationFeatures = &synchronization;
    if (options_.validate)
        context_.instanceExtensions = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    VkInstanceCreateInfo info = {VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pNext = options_.validate ? &checks : nullptr;
    info.pApplicationInfo = &application;
    info.enabledLayerCount = options_.validate ? 1 : 0;
    info.ppEnabledLayerNames = &layer;
    info.enabledExtensionCount = static_cast<std::uint32_t>(context_.instanceExtensions.size());
    info.ppEnabledExtensionNames = context_.instanceExtensions.data();
    check(vkCreateInstance(&info, nullptr, &context_.instance), "vkCreateInstance");
    volkLoadInstance(context_.instance);
    if (options_.validate) {
        VkDebugUtilsMessengerCreateInfoEXT messenger = {VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
        messenger.messageSeverity =
            VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
        messenger.messageType =
            VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
        messenger.pfnUserCallback = onMessage;
        messenger.pUserData = this;
        check(vkCreateDebugUtilsMessengerEXT(context_.instance, &messenger, nullptr, &messenger_), "the messenger");
    }
    createDevice();
    createTargets();
    createPipeline();
    for (auto& slot : slots_) slot = makeSlot();
    if (guest_.start) guest_.start(context_);
}

Engine::~Engine() {
    vkDeviceWaitIdle(context_.device);
    for (std::uint32_t i = 0; i < framesInFlight; ++i) waitFor(slots_[i], i);
    if (guest_.stop) guest_.stop();
    for (const auto& slot : slots_) {
        vkDestroyFence(context_.device, slot.fence, nullptr);
        vkDestroyCommandPool(context_.device, slot.pool, nullptr);
    }
    vkDestroyPipeline(context_.device, pipeline_, nullptr);
    vkDestroyPipelineLayout(context_.device, layout_, nullptr);
    for (const auto* image : {&color_, &depth_}) {
        vkDestroyImageView(context_.device, image->view, nullptr);
        vkDestroyImage(context_.device, image->image, nullptr);
        vkFreeMemory(context_.device, image->memory, nullptr);
    }
    for (const auto* buffer : {&mesh_, &readback_, &streamBuffer_}) {
        vkDestroyBuffer(context_.device, buffer->buffer, nullptr);
        vkFreeMemory(context_.device, buffer->memory, nullptr);
    }
    vkDestroyDevice(context_.device, nullptr);
    if (messenger_ != VK_NULL_HANDLE) vkDestroyDebugUtilsMessengerEXT(context_.instance, messenger_, nullptr);
    vkDestroyInstance(context_.instance, nullptr);
}

void Engine::createDevice() {
    std::uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(context_.instance, &count, nullptr), "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> all(count);
    check(vkEnumeratePhysicalDevices(context_.instance, &count, all.data()), "vkEnumeratePhysicalDevices");
    for (auto* device : all) {
        VkPhysicalDeviceProperties properties;
        vkGetPhysicalDeviceProperties(device, &properties);
        if (context_.physicalDevice == VK_NULL_HANDLE &&
            std::strstr(properties.deviceName, options_.adapter.c_str()) != nullptr)
            context_.physicalDevice = device;
    }
    if (context_.physicalDevice == VK_NULL_HANDLE) fatal("there is no Vulkan device of that name");
    std::vector<VkQueueFamilyProperties> families;
    vkGetPhysicalDeviceQueueFamilyProperties(context_.physicalDevice, &count, nullptr);
    families.resize(count);
    vkGetPhysicalDeviceQueueFamilyProperties(context_.physicalDevice, &count, families.data());
    constexpr VkQueueFlags both = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    while (context_.queueFamily < count && (families[context_.queueFamily].queueFlags & both) != both)
        ++context_.queueFamily;

    VkPhysicalDeviceVulkan13Features own = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    own.dynamicRendering = own.synchronization2 = VK_TRUE;
    VkPhysicalDeviceFeatures2 features = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &own};
    DeviceWishes wishes;
    if (guest_.wishes) wishes = guest_.wishes(context_.instance, context_.physicalDevice);
    context_.features = wishes.features != nullptr ? wishes.features : &features;
    // Vulkan allows each structure once in a chain: where the guest brought one, the engine's bits are set in that.
    for (auto* next = static_cast<VkBaseOutStructure*>(wishes.features); next != nullptr; next = next->pNext)
        if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES) {
            auto& theirs = *reinterpret_cast<VkPhysicalDeviceVulkan13Features*>(next);
            theirs.dynamicRendering = theirs.synchronization2 = VK_TRUE;
        }
    context_.deviceExtensions = wishes.extensions;
    const float priority = 1;
    VkDeviceQueueCreateInfo queue = {VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueFamilyIndex = context_.queueFamily;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo info = {VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, context_.features};
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = static_cast<std::uint32_t>(context_.deviceExtensions.size());
    info.ppEnabledExtensionNames = context_.deviceExtensions.data();
    check(vkCreateDevice(context_.physicalDevice, &info, nullptr, &context_.device), "vkCreateDevice");
    volkLoadDevice(context_.device);
    vkGetDeviceQueue(context_.device, context_.queueFamily, 0, &context_.queue);
    context_.queueMutex = &queueMutex_;
}

std::uint32_t Engine::memoryType(std::uint32_t allowed, VkMemoryPropertyFlags flags) const {
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(context_.physicalDevice, &memory);
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
        if ((allowed >> i & 1) != 0 && (memory.memoryTypes[i].propertyFlags & flags) == flags) return i;
    fatal("no memory type fits");
}

Engine::Image Engine::makeImage(VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect) {
    Image made;
    VkImageCreateInfo info = {VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {options_.width, options_.height, 1};
    info.mipLevels = info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = usage;
    check(vkCreateImage(context_.device, &info, nullptr, &made.image), "vkCreateImage");
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(context_.device, made.image, &needs);
    VkMemoryAllocateInfo memory = {VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size,
                                   memoryType(needs.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT)};
    check(vkAllocateMemory(context_.device, &memory, nullptr, &made.memory), "vkAllocateMemory");
    check(vkBindImageMemory(context_.device, made.image, made.memory, 0), "vkBindImageMemory");
    VkImageViewCreateInfo view = {VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view.image = made.image;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = format;
    view.subresourceRange = {aspect, 0, 1, 0, 1};
    check(vkCreateImageView(context_.device, &view, nullptr, &made.view), "vkCreateImageView");
    return made;
}

Engine::Buffer Engine::makeBuffer(VkDeviceSize size, VkBufferUsageFlags usage) {
    Buffer made;
    VkBufferCreateInfo info = {VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = size;
    info.usage = usage;
    check(vkCreateBuffer(context_.device, &info, nullptr, &made.buffer), "vkCreateBuffer");
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(context_.device, made.buffer, &needs);
    VkMemoryAllocateInfo memory = {
        VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size,
        memoryType(needs.memoryTypeBits, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT)};
    check(vkAllocateMemory(context_.device, &memory, nullptr, &made.memory), "vkAllocateMemory");
    check(vkBindBufferMemory(context_.device, made.buffer, made.memory, 0), "vkBindBufferMemory");
    check(vkMapMemory(context_.device, made.memory, 0, VK_WHOLE_SIZE, 0, &made.mapped), "vkMapMemory");
    return made;
}

void Engine::createTargets() {
    context_.extent = {options_.width, options_.height};
    context_.reversedDepth = options_.reversedDepth;
    context_.colorFormat = VK_FORMAT_R16G16B16A16_SFLOAT;
    context_.depthFormat = VK_FORMAT_D32_SFLOAT;
    color_ = makeImage(context_.colorFormat, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                       VK_IMAGE_ASPECT_COLOR_BIT);
    depth_ = makeImage(context_.depthFormat, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                       VK_IMAGE_ASPECT_DEPTH_BIT);
    context_.color = color_.image;
    context_.depth = depth_.image;
    readback_ = makeBuffer(VkDeviceSize{8} * options_.width * options_.height, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    streamBuffer_ = makeBuffer(65536, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    auto vertices = sphere(48);
    sphereVertices_ = static_cast<std::uint32_t>(vertices.size());
    const auto more = box();
    boxVertices_ = static_cast<std::uint32_t>(more.size());
    vertices.insert(vertices.end(), more.begin(), more.end());
    mesh_ = makeBuffer(vertices.size() * sizeof(Vertex), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    std::memcpy(mesh_.mapped, vertices.data(), vertices.size() * sizeof(Vertex));
}

void Engine::createPipeline() {
    const VkPushConstantRange range = {VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(Push)};
    VkPipelineLayoutCreateInfo layout = {VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layout.pushConstantRangeCount = 1;
    layout.pPushConstantRanges = &range;
    check(vkCreatePipelineLayout(context_.device, &layout, nullptr, &layout_), "vkCreatePipelineLayout");
    VkPipelineShaderStageCreateInfo stages[2] = {};
    VkShaderModule modules[2] = {};
    for (int i = 0; i < 2; ++i) {
        const auto code = embeddedShader(i == 0 ? "solid.vert" : "solid.frag");
        VkShaderModuleCreateInfo module = {VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
        module.codeSize = code.size_bytes();
        module.pCode = code.data();
        check(vkCreateShaderModule(context_.device, &module, nullptr, &modules[i]), "vkCreateShaderModule");
        stages[i] = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
        stages[i].stage = i == 0 ? VK_SHADER_STAGE_VERTEX_BIT : VK_SHADER_STAGE_FRAGMENT_BIT;
        stages[i].module = modules[i];
        stages[i].pName = "main";
    }
    const VkVertexInputBindingDescription binding = {0, sizeof(Vertex), VK_VERTEX_INPUT_RATE_VERTEX};
    const VkVertexInputAttributeDescription attributes[] = {
        {0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, position)},
        {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, normal)}};
    VkPipelineVertexInputStateCreateInfo input = {VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    input.vertexBindingDescriptionCount = 1;
    input.pVertexBindingDescriptions = &binding;
    input.vertexAttributeDescriptionCount = 2;
    input.pVertexAttributeDescriptions = attributes;
    VkPipelineInputAssemblyStateCreateInfo assembly = {VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkPipelineViewportStateCreateInfo viewport = {VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    viewport.viewportCount = viewport.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo raster = {VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    raster.lineWidth = 1;
    VkPipelineMultisampleStateCreateInfo samples = {VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineDepthStencilStateCreateInfo depth = {VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    depth.depthTestEnable = depth.depthWriteEnable = VK_TRUE;
    depth.depthCompareOp = options_.reversedDepth ? VK_COMPARE_OP_GREATER : VK_COMPARE_OP_LESS;
    VkPipelineColorBlendAttachmentState target = {};
    target.colorWriteMask = 15;
    VkPipelineColorBlendStateCreateInfo blend = {VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blend.attachmentCount = 1;
    blend.pAttachments = &target;
    const VkDynamicState dynamics[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamic = {VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
    dynamic.dynamicStateCount = 2;
    dynamic.pDynamicStates = dynamics;
    VkPipelineRenderingCreateInfo rendering = {VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    rendering.colorAttachmentCount = 1;
    rendering.pColorAttachmentFormats = &context_.colorFormat;
    rendering.depthAttachmentFormat = context_.depthFormat;
    VkGraphicsPipelineCreateInfo info = {VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering};
    info.stageCount = 2;
    info.pStages = stages;
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = layout_;
    check(vkCreateGraphicsPipelines(context_.device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_), "the pipeline");
    for (auto* module : modules) vkDestroyShaderModule(context_.device, module, nullptr);
}

Engine::Slot Engine::makeSlot() {
    Slot slot;
    VkCommandPoolCreateInfo pool = {VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.queueFamilyIndex = context_.queueFamily;
    check(vkCreateCommandPool(context_.device, &pool, nullptr, &slot.pool), "vkCreateCommandPool");
    VkCommandBufferAllocateInfo info = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    info.commandPool = slot.pool;
    info.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(context_.device, &info, &slot.commands), "vkAllocateCommandBuffers");
    VkFenceCreateInfo fence = {VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    check(vkCreateFence(context_.device, &fence, nullptr, &slot.fence), "vkCreateFence");
    return slot;
}

}  // namespace host
