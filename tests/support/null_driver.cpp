// SPDX-License-Identifier: MIT
// Handles, memory and the calls that make them. What command buffers are told is in null_commands.cpp.
#include "null_driver.hpp"

#include "null_functions.hpp"

#include <algorithm>
#include <cstring>
#include <spirv_cross/spirv_cross.hpp>

namespace pelage::test {

namespace {
NullDriver* current = nullptr;  // for vkCreateInstance, which has no handle to find it by

template <class Handle>
std::uint64_t id(Handle handle) {
    return reinterpret_cast<std::uint64_t>(handle);
}
template <class Handle>
NullDriver& driverOf(Handle handle) {
    return *reinterpret_cast<NullDriver*>(handle);
}
}  // namespace

NullDriver::NullDriver() {
    current = this;
}
NullDriver::~NullDriver() {
    if (current == this) current = nullptr;
}

std::uint64_t NullDriver::make(const char* type) {
    alive_[next_] = type;
    return next_++;
}
void NullDriver::destroy(const char* type, std::uint64_t handle) {
    if (handle == 0) return;
    const auto found = alive_.find(handle);
    if (found == alive_.end() || std::strcmp(found->second, type) != 0)
        misuse_.push_back(std::string(type) + " " + std::to_string(handle) + " is destroyed and does not exist");
    else
        alive_.erase(found);
}
VkResult NullDriver::mayFail(const char* call) {
    if (keepCommands) calls_.emplace_back(call);
    if (failAt_ == 0 || --failAt_ != 0) return VK_SUCCESS;
    failed_ = call;
    return failResult_;
}
void NullDriver::failCall(std::uint64_t n, VkResult result) {
    const std::lock_guard lock(mutex_);
    failAt_ = n;
    failResult_ = result;
    failed_.reset();
}
void NullDriver::releaseSignals() {
    const std::lock_guard lock(mutex_);
    holdSignals = false;
    for (const auto& [semaphore, value] : heldSignals_) semaphores_[semaphore] = value;
    heldSignals_.clear();
}
std::vector<std::string> NullDriver::alive() const {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> all;
    for (const auto& [handle, type] : alive_) all.push_back(std::string(type) + " " + std::to_string(handle));
    std::sort(all.begin(), all.end());
    return all;
}

using F = NullDriver::Functions;

#define PELAGE_NULL_LOCK(handle)      \
    NullDriver& d = driverOf(handle); \
    const std::lock_guard lock(d.mutex_)
#define PELAGE_NULL_FAIL(name) \
    if (const VkResult r = d.mayFail(#name); r != VK_SUCCESS) return r

template <class T>
VkResult listOne(std::uint32_t* count, T* out, const T& one) {
    if (out == nullptr)
        *count = 1;
    else if (*count > 0) {
        *out = one;
        *count = 1;
    }
    return VK_SUCCESS;
}

// --- Instance and device.

VkResult F::vkEnumerateInstanceVersion(std::uint32_t* version) {
    *version = VK_API_VERSION_1_3;
    return VK_SUCCESS;
}
VkResult F::vkEnumerateInstanceLayerProperties(std::uint32_t* count, VkLayerProperties*) {
    *count = 0;
    return VK_SUCCESS;
}
VkResult F::vkEnumerateInstanceExtensionProperties(const char*, std::uint32_t* count, VkExtensionProperties* out) {
    VkExtensionProperties debug = {};
    std::strcpy(debug.extensionName, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    return listOne(count, out, debug);
}
VkResult F::vkCreateInstance(const VkInstanceCreateInfo*, const VkAllocationCallbacks*, VkInstance* out) {
    if (current == nullptr) return VK_ERROR_INCOMPATIBLE_DRIVER;
    NullDriver& d = *current;
    const std::lock_guard lock(d.mutex_);
    PELAGE_NULL_FAIL(vkCreateInstance);
    *out = reinterpret_cast<VkInstance>(&d);
    return VK_SUCCESS;
}
void F::vkDestroyInstance(VkInstance, const VkAllocationCallbacks*) {}
VkResult F::vkEnumeratePhysicalDevices(VkInstance instance, std::uint32_t* count, VkPhysicalDevice* out) {
    return listOne(count, out, reinterpret_cast<VkPhysicalDevice>(instance));
}
void F::vkGetPhysicalDeviceProperties2(VkPhysicalDevice device, VkPhysicalDeviceProperties2* out) {
    auto& p = out->properties;
    p.apiVersion = VK_API_VERSION_1_3;
    p.driverVersion = driverOf(device).driverVersion;
    p.deviceType = VK_PHYSICAL_DEVICE_TYPE_CPU;
    std::strcpy(p.deviceName, "null");
    auto& l = p.limits;
    l.maxImageDimension2D = 16384;
    l.maxImageArrayLayers = 2048;
    l.maxBoundDescriptorSets = 8;
    l.maxColorAttachments = 8;
    l.maxPushConstantsSize = 128;
    l.minUniformBufferOffsetAlignment = l.minStorageBufferOffsetAlignment = 64;
    std::fill(l.maxComputeWorkGroupCount, l.maxComputeWorkGroupCount + 3, 65535U);
    l.maxUniformBufferRange = 65536;
    l.maxStorageBufferRange = 1U << 30;
    l.lineWidthRange[1] = 64;
    l.timestampPeriod = 1;
    for (auto* next = static_cast<VkBaseOutStructure*>(out->pNext); next != nullptr; next = next->pNext) {
        if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES) {
            auto* p12 = reinterpret_cast<VkPhysicalDeviceVulkan12Properties*>(next);
            p12->driverID = driverOf(device).driverId;
            std::strcpy(p12->driverName, "null");
        }
        if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_PROPERTIES)
            reinterpret_cast<VkPhysicalDeviceVulkan13Properties*>(next)->maxBufferSize = 1U << 30;
    }
}
void F::vkGetPhysicalDeviceFeatures2(VkPhysicalDevice, VkPhysicalDeviceFeatures2* out) {
    // A feature structure is a header and words of VkBool32; all of them are on.
    const auto all = [](void* first, void* last) {
        for (auto* word = static_cast<VkBool32*>(first); word <= last; ++word) *word = VK_TRUE;
    };
    all(&out->features.robustBufferAccess, &out->features.inheritedQueries);
    for (auto* next = static_cast<VkBaseOutStructure*>(out->pNext); next != nullptr; next = next->pNext) {
        if (auto* f11 = reinterpret_cast<VkPhysicalDeviceVulkan11Features*>(next);
            next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES)
            all(&f11->storageBuffer16BitAccess, &f11->shaderDrawParameters);
        if (auto* f12 = reinterpret_cast<VkPhysicalDeviceVulkan12Features*>(next);
            next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES)
            all(&f12->samplerMirrorClampToEdge, &f12->subgroupBroadcastDynamicId);
        if (auto* f13 = reinterpret_cast<VkPhysicalDeviceVulkan13Features*>(next);
            next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES)
            all(&f13->robustImageAccess, &f13->maintenance4);
    }
}
void F::vkGetPhysicalDeviceMemoryProperties(VkPhysicalDevice, VkPhysicalDeviceMemoryProperties* out) {
    constexpr VkMemoryPropertyFlags host = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    out->memoryTypeCount = 3;
    out->memoryTypes[0] = {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0};
    out->memoryTypes[1] = {host, 1};
    out->memoryTypes[2] = {host | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, 1};
    out->memoryHeapCount = 2;
    out->memoryHeaps[0] = out->memoryHeaps[1] = {VkDeviceSize{8} << 30, 0};
}
void F::vkGetPhysicalDeviceQueueFamilyProperties(VkPhysicalDevice, std::uint32_t* count, VkQueueFamilyProperties* out) {
    VkQueueFamilyProperties family = {};
    family.queueFlags = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT | VK_QUEUE_TRANSFER_BIT;
    family.queueCount = 1;
    family.timestampValidBits = 64;
    listOne(count, out, family);
}
void F::vkGetPhysicalDeviceFormatProperties2(VkPhysicalDevice, VkFormat, VkFormatProperties2* out) {
    out->formatProperties = {~0U, ~0U, ~0U};
}
VkResult F::vkGetPhysicalDeviceImageFormatProperties2(VkPhysicalDevice, const VkPhysicalDeviceImageFormatInfo2*,
                                                      VkImageFormatProperties2* out) {
    out->imageFormatProperties = {
        {16384, 16384, 2048}, 15, 2048, VK_SAMPLE_COUNT_1_BIT | VK_SAMPLE_COUNT_4_BIT, 1ULL << 32};
    return VK_SUCCESS;
}
VkResult F::vkEnumerateDeviceExtensionProperties(VkPhysicalDevice, const char*, std::uint32_t* count,
                                                 VkExtensionProperties*) {
    *count = 0;
    return VK_SUCCESS;
}
VkResult F::vkCreateDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo*, const VkAllocationCallbacks*,
                           VkDevice* out) {
    PELAGE_NULL_LOCK(physical);
    PELAGE_NULL_FAIL(vkCreateDevice);
    *out = reinterpret_cast<VkDevice>(&d);
    return VK_SUCCESS;
}
void F::vkDestroyDevice(VkDevice, const VkAllocationCallbacks*) {}
void F::vkGetDeviceQueue(VkDevice device, std::uint32_t, std::uint32_t, VkQueue* out) {
    *out = reinterpret_cast<VkQueue>(device);
}
VkResult F::vkDeviceWaitIdle(VkDevice) {
    return VK_SUCCESS;
}
VkResult F::vkQueueWaitIdle(VkQueue) {
    return VK_SUCCESS;
}
VkResult F::vkSetDebugUtilsObjectNameEXT(VkDevice device, const VkDebugUtilsObjectNameInfoEXT* info) {
    PELAGE_NULL_LOCK(device);
    const bool resource = info->objectType == VK_OBJECT_TYPE_BUFFER || info->objectType == VK_OBJECT_TYPE_IMAGE;
    if (d.oracle != nullptr && resource) d.oracle->rename(info->objectHandle, info->pObjectName);
    return VK_SUCCESS;
}

// --- Memory and resources.

VkResult F::vkAllocateMemory(VkDevice device, const VkMemoryAllocateInfo* info, const VkAllocationCallbacks*,
                             VkDeviceMemory* out) {
    PELAGE_NULL_LOCK(device);
    PELAGE_NULL_FAIL(vkAllocateMemory);
    const auto handle = d.make("VkDeviceMemory");
    ++d.memoryAllocations;
    d.memories_[handle] = {info->memoryTypeIndex, info->allocationSize, nullptr};
    *out = reinterpret_cast<VkDeviceMemory>(handle);
    return VK_SUCCESS;
}
void F::vkFreeMemory(VkDevice device, VkDeviceMemory memory, const VkAllocationCallbacks*) {
    PELAGE_NULL_LOCK(device);
    d.destroy("VkDeviceMemory", id(memory));
    d.memories_.erase(id(memory));
}
VkResult F::vkMapMemory(VkDevice device, VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize, VkMemoryMapFlags,
                        void** out) {
    PELAGE_NULL_LOCK(device);
    PELAGE_NULL_FAIL(vkMapMemory);
    auto& m = d.memories_[id(memory)];
    if (!m.bytes) m.bytes = std::make_unique<std::byte[]>(m.size);
    *out = m.bytes.get() + offset;
    return VK_SUCCESS;
}
VkResult F::vkCreateBuffer(VkDevice device, const VkBufferCreateInfo* info, const VkAllocationCallbacks*,
                           VkBuffer* out) {
    PELAGE_NULL_LOCK(device);
    PELAGE_NULL_FAIL(vkCreateBuffer);
    const auto handle = d.make("VkBuffer");
    d.buffers_[handle].size = info->size;
    if (d.oracle != nullptr) d.oracle->addBuffer(handle, info->size, "buffer " + std::to_string(handle));
    *out = reinterpret_cast<VkBuffer>(handle);
    return VK_SUCCESS;
}
void F::vkDestroyBuffer(VkDevice device, VkBuffer buffer, const VkAllocationCallbacks*) {
    PELAGE_NULL_LOCK(device);
    d.destroy("VkBuffer", id(buffer));
    d.buffers_.erase(id(buffer));
    if (d.oracle != nullptr) d.oracle->remove(id(buffer));
}
void F::vkGetBufferMemoryRequirements2(VkDevice device, const VkBufferMemoryRequirementsInfo2* info,
                                       VkMemoryRequirements2* out) {
    PELAGE_NULL_LOCK(device);
    out->memoryRequirements = {(d.buffers_[id(info->buffer)].size + 255) & ~VkDeviceSize{255}, 256, 7};
}
VkResult F::vkBindBufferMemory2(VkDevice device, std::uint32_t count, const VkBindBufferMemoryInfo* infos) {
    PELAGE_NULL_LOCK(device);
    PELAGE_NULL_FAIL(vkBindBufferMemory2);
    for (std::uint32_t i = 0; i < count; ++i) d.buffers_[id(infos[i].buffer)].memory = id(infos[i].memory);
    return VK_SUCCESS;
}

namespace {
VkDeviceSize bytesOf(const VkImageCreateInfo& info) {
    VkDeviceSize bytes = 0;
    for (std::uint32_t m = 0; m < info.mipLevels; ++m)
        bytes += VkDeviceSize{std::max(info.extent.width >> m, 1U)} * std::max(info.extent.height >> m, 1U) *
                 std::max(info.extent.depth >> m, 1U) * info.arrayLayers * info.samples * 8;
    return (bytes + 4095) & ~VkDeviceSize{4095};
}
}  // namespace

VkResult F::vkCreateImage(VkDevice device, const VkImageCreateInfo* info, const VkAllocationCallbacks*, VkImage* out) {
    PELAGE_NULL_LOCK(device);
    PELAGE_NULL_FAIL(vkCreateImage);
    const auto handle = d.make("VkImage");
    d.images_[handle].info = *info;
    if (d.oracle != nullptr)
        d.oracle->addImage(handle, info->mipLevels, info->arrayLayers, "image " + std::to_string(handle));
    *out = reinterpret_cast<VkImage>(handle);
    return VK_SUCCESS;
}
void F::vkDestroyImage(VkDevice device, VkImage image, const VkAllocationCallbacks*) {
    PELAGE_NULL_LOCK(device);
    d.destroy("VkImage", id(image));
    d.images_.erase(id(image));
    if (d.oracle != nullptr) d.oracle->remove(id(image));
}
void F::vkGetDeviceImageMemoryRequirements(VkDevice, const VkDeviceImageMemoryRequirements* info,
                                           VkMemoryRequirements2* out) {
    out->memoryRequirements = {bytesOf(*info->pCreateInfo), 4096, 1};
}
VkResult F::vkBindImageMemory2(VkDevice device, std::uint32_t count, const VkBindImageMemoryInfo* infos) {
    PELAGE_NULL_LOCK(device);
    PELAGE_NULL_FAIL(vkBindImageMemory2);
    for (std::uint32_t i = 0; i < count; ++i)
        if (d.oracle != nullptr)
            d.oracle->bindImage(id(infos[i].image), id(infos[i].memory), infos[i].memoryOffset,
                                bytesOf(d.images_[id(infos[i].image)].info));
    return VK_SUCCESS;
}
VkResult F::vkCreateImageView(VkDevice device, const VkImageViewCreateInfo* info, const VkAllocationCallbacks*,
                              VkImageView* out) {
    PELAGE_NULL_LOCK(device);
    PELAGE_NULL_FAIL(vkCreateImageView);
    const auto handle = d.make("VkImageView");
    d.views_[handle] = {id(info->image), info->subresourceRange};
    *out = reinterpret_cast<VkImageView>(handle);
    return VK_SUCCESS;
}

// --- Shaders, layouts, sets and pipelines.

namespace {
std::uint64_t hashOf(const void* data, std::size_t size, std::uint64_t seed) {
    std::uint64_t h = seed ^ 0xcbf29ce484222325ULL;
    for (std::size_t i = 0; i < size; ++i) h = (h ^ static_cast<const unsigned char*>(data)[i]) * 0x100000001b3ULL;
    return h;
}

/// Which bindings a module reads and writes, found by SPIRV-Cross and not by the library's own reflection.
std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<bool, bool>> usesOf(const VkShaderModuleCreateInfo& info) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<bool, bool>> uses;
    const spirv_cross::Compiler compiler(info.pCode, info.codeSize / 4);
    const auto active = compiler.get_active_interface_variables();
    const auto all = compiler.get_shader_resources(active);
    const auto add = [&](const spirv_cross::Resource& r, bool reads, bool writes) {
        auto& use = uses[{compiler.get_decoration(r.id, spv::DecorationDescriptorSet),
                          compiler.get_decoration(r.id, spv::DecorationBinding)}];
        use.first = use.first || reads;
        use.second = use.second || writes;
    };
    for (const auto& r : all.uniform_buffers) add(r, true, false);
    for (const auto& r : all.separate_images) add(r, true, false);
    for (const auto& r : all.storage_buffers) {
        const auto flags = compiler.get_buffer_block_flags(r.id);
        add(r, !flags.get(spv::DecorationNonReadable), !flags.get(spv::DecorationNonWritable));
    }
    for (const auto& r : all.storage_images)
        add(r, !compiler.has_decoration(r.id, spv::DecorationNonReadable),
            !compiler.has_decoration(r.id, spv::DecorationNonWritable));
    return uses;
}
}  // namespace

VkResult F::vkCreateShaderModule(VkDevice device, const VkShaderModuleCreateInfo* info, const VkAllocationCallbacks*,
                                 VkShaderModule* out) {
    PELAGE_NULL_LOCK(device);
    PELAGE_NULL_FAIL(vkCreateShaderModule);
    const auto handle = d.make("VkShaderModule");
    d.moduleHashes_[handle] = hashOf(info->pCode, info->codeSize, 0);
    auto& uses = d.modules_[handle];
    for (const auto& [place, use] : usesOf(*info)) uses[place] = {0, use.first, use.second};
    *out = reinterpret_cast<VkShaderModule>(handle);
    return VK_SUCCESS;
}
VkResult F::vkCreateDescriptorSetLayout(VkDevice device, const VkDescriptorSetLayoutCreateInfo* info,
                                        const VkAllocationCallbacks*, VkDescriptorSetLayout* out) {
    PELAGE_NULL_LOCK(device);
    PELAGE_NULL_FAIL(vkCreateDescriptorSetLayout);
    const auto handle = d.make("VkDescriptorSetLayout");
    for (std::uint32_t i = 0; i < info->bindingCount; ++i)
        d.setLayouts_[handle][info->pBindings[i].binding] = info->pBindings[i].descriptorType;
    *out = reinterpret_cast<VkDescriptorSetLayout>(handle);
    return VK_SUCCESS;
}
void F::vkDestroyDescriptorPool(VkDevice device, VkDescriptorPool pool, const VkAllocationCallbacks*) {
    PELAGE_NULL_LOCK(device);
    d.destroy("VkDescriptorPool", id(pool));
    for (const auto set : d.poolSets_[id(pool)]) {
        d.destroy("VkDescriptorSet", set);
        d.sets_.erase(set);
    }
    d.poolSets_.erase(id(pool));
}
VkResult F::vkAllocateDescriptorSets(VkDevice device, const VkDescriptorSetAllocateInfo* info, VkDescriptorSet* out) {
    PELAGE_NULL_LOCK(device);
    if (const VkResult r = d.mayFail("vkAllocateDescriptorSets"); r != VK_SUCCESS) return r;
    auto& sets = d.poolSets_[id(info->descriptorPool)];
    if (sets.size() >= 256) return VK_ERROR_OUT_OF_POOL_MEMORY;
    const auto handle = d.make("VkDescriptorSet");
    d.sets_[handle].layout = id(info->pSetLayouts[0]);
    sets.insert(handle);
    *out = reinterpret_cast<VkDescriptorSet>(handle);
    return VK_SUCCESS;
}
VkResult F::vkFreeDescriptorSets(VkDevice device, VkDescriptorPool pool, std::uint32_t count,
                                 const VkDescriptorSet* sets) {
    PELAGE_NULL_LOCK(device);
    for (std::uint32_t i = 0; i < count; ++i) {
        d.destroy("VkDescriptorSet", id(sets[i]));
        d.sets_.erase(id(sets[i]));
        d.poolSets_[id(pool)].erase(id(sets[i]));
    }
    return VK_SUCCESS;
}
void F::vkUpdateDescriptorSets(VkDevice device, std::uint32_t count, const VkWriteDescriptorSet* writes, std::uint32_t,
                               const VkCopyDescriptorSet*) {
    PELAGE_NULL_LOCK(device);
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto& w = writes[i];
        auto& to = d.sets_[id(w.dstSet)].descriptors[w.dstBinding];
        to.type = w.descriptorType;
        if (w.pBufferInfo != nullptr) {
            to.object = id(w.pBufferInfo->buffer);
            to.offset = w.pBufferInfo->offset;
            to.range = w.pBufferInfo->range;
        } else if (w.pImageInfo != nullptr) {
            to.object = id(w.pImageInfo->imageView);
            to.layout = w.pImageInfo->imageLayout;
        }
    }
}
std::uint64_t F::hashStage(const NullDriver& d, const VkPipelineShaderStageCreateInfo& stage, std::uint64_t seed) {
    const std::uint64_t module = d.moduleHashes_.at(id(stage.module));
    seed = hashOf(&module, sizeof module, seed);
    if (const auto* s = stage.pSpecializationInfo; s != nullptr) seed = hashOf(s->pData, s->dataSize, seed);
    return seed;
}
void F::compile(NullDriver& d, VkPipelineCache cache, std::uint64_t hash, const void* chain) {
    const bool hit = !d.caches_[id(cache)].insert(hash).second;
    d.pipelinesCompiled += hit ? 0 : 1;
    for (const auto* next = static_cast<const VkBaseInStructure*>(chain); next != nullptr; next = next->pNext)
        if (next->sType == VK_STRUCTURE_TYPE_PIPELINE_CREATION_FEEDBACK_CREATE_INFO)
            reinterpret_cast<const VkPipelineCreationFeedbackCreateInfo*>(next)->pPipelineCreationFeedback->flags =
                VK_PIPELINE_CREATION_FEEDBACK_VALID_BIT |
                static_cast<VkPipelineCreationFeedbackFlags>(
                    hit ? VK_PIPELINE_CREATION_FEEDBACK_APPLICATION_PIPELINE_CACHE_HIT_BIT : 0);
}
VkResult F::vkCreatePipelineCache(VkDevice device, const VkPipelineCacheCreateInfo* info, const VkAllocationCallbacks*,
                                  VkPipelineCache* out) {
    PELAGE_NULL_LOCK(device);
    PELAGE_NULL_FAIL(vkCreatePipelineCache);
    const auto handle = d.make("VkPipelineCache");
    const auto* first = static_cast<const std::uint64_t*>(info->pInitialData);
    if (info->initialDataSize != 0) d.caches_[handle].insert(first, first + info->initialDataSize / 8);
    *out = reinterpret_cast<VkPipelineCache>(handle);
    return VK_SUCCESS;
}
VkResult F::vkGetPipelineCacheData(VkDevice device, VkPipelineCache cache, std::size_t* size, void* out) {
    PELAGE_NULL_LOCK(device);
    PELAGE_NULL_FAIL(vkGetPipelineCacheData);
    const auto& all = d.caches_[id(cache)];
    const std::vector<std::uint64_t> list(all.begin(), all.end());
    if (out == nullptr)
        *size = list.size() * 8;
    else
        std::memcpy(out, list.data(), std::min(*size, list.size() * 8));
    return VK_SUCCESS;
}
void F::addPipeline(NullDriver& d, std::uint64_t pipeline, const VkPipelineShaderStageCreateInfo& stage) {
    const auto flags = stage.stage == VK_SHADER_STAGE_VERTEX_BIT     ? VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT
                       : stage.stage == VK_SHADER_STAGE_FRAGMENT_BIT ? VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT
                                                                     : VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    for (const auto& [place, use] : d.modules_[id(stage.module)]) {
        auto& to = d.pipelines_[pipeline][place];
        to.stages |= flags;
        to.reads = to.reads || use.reads;
        to.writes = to.writes || use.writes;
    }
    d.pipelines_.try_emplace(pipeline);
}
VkResult F::vkCreateGraphicsPipelines(VkDevice device, VkPipelineCache cache, std::uint32_t,
                                      const VkGraphicsPipelineCreateInfo* info, const VkAllocationCallbacks*,
                                      VkPipeline* out) {
    PELAGE_NULL_LOCK(device);
    PELAGE_NULL_FAIL(vkCreateGraphicsPipelines);
    const auto handle = d.make("VkPipeline");
    ++d.pipelinesCreated;
    std::uint64_t hash = 0;
    for (std::uint32_t i = 0; i < info->stageCount; ++i) {
        addPipeline(d, handle, info->pStages[i]);
        hash = hashStage(d, info->pStages[i], hash);
    }
    compile(d, cache, hash, info->pNext);
    const auto& input = *info->pVertexInputState;
    for (std::uint32_t i = 0; i < input.vertexBindingDescriptionCount; ++i)
        d.vertexBindings_[handle].push_back(input.pVertexBindingDescriptions[i].binding);
    *out = reinterpret_cast<VkPipeline>(handle);
    return VK_SUCCESS;
}
VkResult F::vkCreateComputePipelines(VkDevice device, VkPipelineCache cache, std::uint32_t,
                                     const VkComputePipelineCreateInfo* info, const VkAllocationCallbacks*,
                                     VkPipeline* out) {
    PELAGE_NULL_LOCK(device);
    PELAGE_NULL_FAIL(vkCreateComputePipelines);
    const auto handle = d.make("VkPipeline");
    ++d.pipelinesCreated;
    addPipeline(d, handle, info->stage);
    compile(d, cache, hashStage(d, info->stage, 1), info->pNext);
    *out = reinterpret_cast<VkPipeline>(handle);
    return VK_SUCCESS;
}

// --- Queue.

VkResult F::vkCreateSemaphore(VkDevice device, const VkSemaphoreCreateInfo*, const VkAllocationCallbacks*,
                              VkSemaphore* out) {
    PELAGE_NULL_LOCK(device);
    PELAGE_NULL_FAIL(vkCreateSemaphore);
    const auto handle = d.make("VkSemaphore");
    d.semaphores_[handle] = 0;
    *out = reinterpret_cast<VkSemaphore>(handle);
    return VK_SUCCESS;
}
VkResult F::vkGetSemaphoreCounterValue(VkDevice device, VkSemaphore semaphore, std::uint64_t* value) {
    PELAGE_NULL_LOCK(device);
    PELAGE_NULL_FAIL(vkGetSemaphoreCounterValue);
    *value = d.semaphores_[id(semaphore)];
    return VK_SUCCESS;
}
VkResult F::vkWaitSemaphores(VkDevice device, const VkSemaphoreWaitInfo* info, std::uint64_t) {
    PELAGE_NULL_LOCK(device);
    PELAGE_NULL_FAIL(vkWaitSemaphores);
    return d.semaphores_[id(info->pSemaphores[0])] >= info->pValues[0] ? VK_SUCCESS : VK_TIMEOUT;
}

#define PELAGE_NULL_SIMPLE(Type)                                                                           \
    VkResult F::vkCreate##Type(VkDevice device, const Vk##Type##CreateInfo*, const VkAllocationCallbacks*, \
                               Vk##Type* out) {                                                            \
        PELAGE_NULL_LOCK(device);                                                                          \
        PELAGE_NULL_FAIL(vkCreate##Type);                                                                  \
        *out = reinterpret_cast<Vk##Type>(d.make("Vk" #Type));                                             \
        return VK_SUCCESS;                                                                                 \
    }
PELAGE_NULL_SIMPLE(Sampler)
PELAGE_NULL_SIMPLE(DescriptorPool)
PELAGE_NULL_SIMPLE(PipelineLayout)
PELAGE_NULL_SIMPLE(QueryPool)
#undef PELAGE_NULL_SIMPLE

#define PELAGE_NULL_DESTROY(Type, map)                                                        \
    void F::vkDestroy##Type(VkDevice device, Vk##Type object, const VkAllocationCallbacks*) { \
        PELAGE_NULL_LOCK(device);                                                             \
        d.destroy("Vk" #Type, id(object));                                                    \
        map;                                                                                  \
    }
PELAGE_NULL_DESTROY(ImageView, d.views_.erase(id(object)))
PELAGE_NULL_DESTROY(Sampler, )
PELAGE_NULL_DESTROY(ShaderModule, d.modules_.erase(id(object)))
PELAGE_NULL_DESTROY(DescriptorSetLayout, d.setLayouts_.erase(id(object)))
PELAGE_NULL_DESTROY(PipelineLayout, )
PELAGE_NULL_DESTROY(PipelineCache, )
PELAGE_NULL_DESTROY(Pipeline, d.pipelines_.erase(id(object)))
PELAGE_NULL_DESTROY(QueryPool, )
PELAGE_NULL_DESTROY(Semaphore, d.semaphores_.erase(id(object)))
#undef PELAGE_NULL_DESTROY

PFN_vkVoidFunction F::find(const char* name) {
#define PELAGE_NULL_FUNCTION(f) \
    if (std::strcmp(name, #f) == 0) return reinterpret_cast<PFN_vkVoidFunction>(&F::f);
    PELAGE_NULL_FUNCTIONS(PELAGE_NULL_FUNCTION)
#undef PELAGE_NULL_FUNCTION
    return nullptr;
}
PFN_vkVoidFunction F::vkGetDeviceProcAddr(VkDevice, const char* name) {
    return find(name);
}

namespace {
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getProc(VkInstance, const char* name) {
    return F::find(name);
}
}  // namespace

PFN_vkGetInstanceProcAddr NullDriver::entry() {
    return getProc;
}

}  // namespace pelage::test
