// SPDX-License-Identifier: MIT
// Every function that the library calls (rhi/src/functions.def), as members that may see inside a NullDriver.
#pragma once

#include "null_driver.hpp"

#define PELAGE_NULL_FUNCTIONS(F)                                                                                       \
    F(vkEnumerateInstanceVersion)                                                                                      \
    F(vkEnumerateInstanceLayerProperties)                                                                              \
    F(vkEnumerateInstanceExtensionProperties)                                                                          \
    F(vkCreateInstance)                                                                                                \
    F(vkDestroyInstance)                                                                                               \
    F(vkEnumeratePhysicalDevices)                                                                                      \
    F(vkGetPhysicalDeviceProperties2)                                                                                  \
    F(vkGetPhysicalDeviceFeatures2)                                                                                    \
    F(vkGetPhysicalDeviceMemoryProperties)                                                                             \
    F(vkGetPhysicalDeviceQueueFamilyProperties)                                                                        \
    F(vkGetPhysicalDeviceFormatProperties2)                                                                            \
    F(vkGetPhysicalDeviceImageFormatProperties2)                                                                       \
    F(vkEnumerateDeviceExtensionProperties)                                                                            \
    F(vkCreateDevice)                                                                                                  \
    F(vkGetDeviceProcAddr)                                                                                             \
    F(vkDestroyDevice)                                                                                                 \
    F(vkGetDeviceQueue)                                                                                                \
    F(vkDeviceWaitIdle)                                                                                                \
    F(vkQueueWaitIdle)                                                                                                 \
    F(vkQueueSubmit2)                                                                                                  \
    F(vkAllocateMemory) F(vkFreeMemory) F(vkMapMemory) F(vkCreateBuffer) F(vkDestroyBuffer) F(                         \
        vkGetBufferMemoryRequirements2) F(vkBindBufferMemory2) F(vkCreateImage) F(vkDestroyImage)                      \
        F(vkGetDeviceImageMemoryRequirements) F(vkBindImageMemory2) F(vkCreateImageView) F(vkDestroyImageView) F(      \
            vkCreateSampler) F(vkDestroySampler) F(vkCreateShaderModule) F(vkDestroyShaderModule)                      \
            F(vkCreateDescriptorSetLayout) F(vkDestroyDescriptorSetLayout) F(vkCreateDescriptorPool) F(                \
                vkDestroyDescriptorPool) F(vkAllocateDescriptorSets) F(vkFreeDescriptorSets) F(vkUpdateDescriptorSets) \
                F(vkCreatePipelineLayout) F(vkDestroyPipelineLayout) F(vkCreatePipelineCache)                          \
                    F(vkDestroyPipelineCache) F(vkGetPipelineCacheData) F(vkCreateGraphicsPipelines)                   \
                        F(vkCreateComputePipelines) F(vkDestroyPipeline) F(vkCreateQueryPool) F(vkDestroyQueryPool) F( \
                            vkCreateSemaphore) F(vkDestroySemaphore) F(vkGetSemaphoreCounterValue) F(vkWaitSemaphores) \
                            F(vkCreateCommandPool) F(vkDestroyCommandPool) F(vkResetCommandPool)                       \
                                F(vkAllocateCommandBuffers) F(vkBeginCommandBuffer) F(vkEndCommandBuffer)              \
                                    F(vkCmdPipelineBarrier2) F(vkCmdBeginRendering) F(vkCmdEndRendering)               \
                                        F(vkCmdBindPipeline) F(vkCmdBindDescriptorSets) F(vkCmdPushConstants)          \
                                            F(vkCmdBindVertexBuffers) F(vkCmdBindIndexBuffer) F(vkCmdSetViewport) F(   \
                                                vkCmdSetScissor) F(vkCmdSetLineWidth) F(vkCmdDraw) F(vkCmdDrawIndexed) \
                                                F(vkCmdDispatch) F(vkCmdDrawIndirect) F(vkCmdDrawIndexedIndirect)      \
                                                    F(vkCmdDispatchIndirect) F(vkCmdCopyBuffer)                        \
                                                        F(vkCmdCopyBufferToImage) F(vkCmdCopyImageToBuffer)            \
                                                            F(vkCmdCopyImage) F(vkCmdFillBuffer)                       \
                                                                F(vkCmdResetQueryPool) F(vkCmdWriteTimestamp2)         \
                                                                    F(vkCmdBeginQuery) F(vkCmdEndQuery)                \
                                                                        F(vkCmdCopyQueryPoolResults)                   \
                                                                            F(vkSetDebugUtilsObjectNameEXT)            \
                                                                                F(vkCmdBeginDebugUtilsLabelEXT)        \
                                                                                    F(vkCmdEndDebugUtilsLabelEXT)

namespace pelage::test {

struct NullDriver::Functions {
    static PFN_vkVoidFunction find(const char* name);
    static std::uint64_t hashStage(const NullDriver& d, const VkPipelineShaderStageCreateInfo& stage,
                                   std::uint64_t seed);
    static void compile(NullDriver& d, VkPipelineCache cache, std::uint64_t hash, const void* chain);
    static void addPipeline(NullDriver& d, std::uint64_t pipeline, const VkPipelineShaderStageCreateInfo& stage);
    /// What the bound sets let a pipeline touch.
    static std::vector<Touch> bindings(const Commands& c, VkPipelineBindPoint point);
    static void drawn(Commands& c, const char* word, std::initializer_list<Touch> more);

    static VKAPI_ATTR VkResult VKAPI_CALL vkEnumerateInstanceVersion(std::uint32_t*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkEnumerateInstanceLayerProperties(std::uint32_t*, VkLayerProperties*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkEnumerateInstanceExtensionProperties(const char*, std::uint32_t*,
                                                                                 VkExtensionProperties*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkCreateInstance(const VkInstanceCreateInfo*, const VkAllocationCallbacks*,
                                                           VkInstance*);
    static VKAPI_ATTR void VKAPI_CALL vkDestroyInstance(VkInstance, const VkAllocationCallbacks*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkEnumeratePhysicalDevices(VkInstance, std::uint32_t*, VkPhysicalDevice*);
    static VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceProperties2(VkPhysicalDevice, VkPhysicalDeviceProperties2*);
    static VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceFeatures2(VkPhysicalDevice, VkPhysicalDeviceFeatures2*);
    static VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceMemoryProperties(VkPhysicalDevice,
                                                                          VkPhysicalDeviceMemoryProperties*);
    static VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceQueueFamilyProperties(VkPhysicalDevice, std::uint32_t*,
                                                                               VkQueueFamilyProperties*);
    static VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceFormatProperties2(VkPhysicalDevice, VkFormat,
                                                                           VkFormatProperties2*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkGetPhysicalDeviceImageFormatProperties2(
        VkPhysicalDevice, const VkPhysicalDeviceImageFormatInfo2*, VkImageFormatProperties2*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkEnumerateDeviceExtensionProperties(VkPhysicalDevice, const char*,
                                                                               std::uint32_t*, VkExtensionProperties*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkCreateDevice(VkPhysicalDevice, const VkDeviceCreateInfo*,
                                                         const VkAllocationCallbacks*, VkDevice*);
    static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetDeviceProcAddr(VkDevice, const char*);
    static VKAPI_ATTR void VKAPI_CALL vkDestroyDevice(VkDevice, const VkAllocationCallbacks*);
    static VKAPI_ATTR void VKAPI_CALL vkGetDeviceQueue(VkDevice, std::uint32_t, std::uint32_t, VkQueue*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkDeviceWaitIdle(VkDevice);
    static VKAPI_ATTR VkResult VKAPI_CALL vkQueueWaitIdle(VkQueue);
    static VKAPI_ATTR VkResult VKAPI_CALL vkQueueSubmit2(VkQueue, std::uint32_t, const VkSubmitInfo2*, VkFence);
    static VKAPI_ATTR VkResult VKAPI_CALL vkAllocateMemory(VkDevice, const VkMemoryAllocateInfo*,
                                                           const VkAllocationCallbacks*, VkDeviceMemory*);
    static VKAPI_ATTR void VKAPI_CALL vkFreeMemory(VkDevice, VkDeviceMemory, const VkAllocationCallbacks*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkMapMemory(VkDevice, VkDeviceMemory, VkDeviceSize, VkDeviceSize,
                                                      VkMemoryMapFlags, void**);
    static VKAPI_ATTR VkResult VKAPI_CALL vkCreateBuffer(VkDevice, const VkBufferCreateInfo*,
                                                         const VkAllocationCallbacks*, VkBuffer*);
    static VKAPI_ATTR void VKAPI_CALL vkDestroyBuffer(VkDevice, VkBuffer, const VkAllocationCallbacks*);
    static VKAPI_ATTR void VKAPI_CALL vkGetBufferMemoryRequirements2(VkDevice, const VkBufferMemoryRequirementsInfo2*,
                                                                     VkMemoryRequirements2*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkBindBufferMemory2(VkDevice, std::uint32_t, const VkBindBufferMemoryInfo*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkCreateImage(VkDevice, const VkImageCreateInfo*,
                                                        const VkAllocationCallbacks*, VkImage*);
    static VKAPI_ATTR void VKAPI_CALL vkDestroyImage(VkDevice, VkImage, const VkAllocationCallbacks*);
    static VKAPI_ATTR void VKAPI_CALL vkGetDeviceImageMemoryRequirements(VkDevice,
                                                                         const VkDeviceImageMemoryRequirements*,
                                                                         VkMemoryRequirements2*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkBindImageMemory2(VkDevice, std::uint32_t, const VkBindImageMemoryInfo*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkCreateImageView(VkDevice, const VkImageViewCreateInfo*,
                                                            const VkAllocationCallbacks*, VkImageView*);
    static VKAPI_ATTR void VKAPI_CALL vkDestroyImageView(VkDevice, VkImageView, const VkAllocationCallbacks*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkCreateSampler(VkDevice, const VkSamplerCreateInfo*,
                                                          const VkAllocationCallbacks*, VkSampler*);
    static VKAPI_ATTR void VKAPI_CALL vkDestroySampler(VkDevice, VkSampler, const VkAllocationCallbacks*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkCreateShaderModule(VkDevice, const VkShaderModuleCreateInfo*,
                                                               const VkAllocationCallbacks*, VkShaderModule*);
    static VKAPI_ATTR void VKAPI_CALL vkDestroyShaderModule(VkDevice, VkShaderModule, const VkAllocationCallbacks*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkCreateDescriptorSetLayout(VkDevice, const VkDescriptorSetLayoutCreateInfo*,
                                                                      const VkAllocationCallbacks*,
                                                                      VkDescriptorSetLayout*);
    static VKAPI_ATTR void VKAPI_CALL vkDestroyDescriptorSetLayout(VkDevice, VkDescriptorSetLayout,
                                                                   const VkAllocationCallbacks*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkCreateDescriptorPool(VkDevice, const VkDescriptorPoolCreateInfo*,
                                                                 const VkAllocationCallbacks*, VkDescriptorPool*);
    static VKAPI_ATTR void VKAPI_CALL vkDestroyDescriptorPool(VkDevice, VkDescriptorPool, const VkAllocationCallbacks*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkAllocateDescriptorSets(VkDevice, const VkDescriptorSetAllocateInfo*,
                                                                   VkDescriptorSet*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkFreeDescriptorSets(VkDevice, VkDescriptorPool, std::uint32_t,
                                                               const VkDescriptorSet*);
    static VKAPI_ATTR void VKAPI_CALL vkUpdateDescriptorSets(VkDevice, std::uint32_t, const VkWriteDescriptorSet*,
                                                             std::uint32_t, const VkCopyDescriptorSet*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkCreatePipelineLayout(VkDevice, const VkPipelineLayoutCreateInfo*,
                                                                 const VkAllocationCallbacks*, VkPipelineLayout*);
    static VKAPI_ATTR void VKAPI_CALL vkDestroyPipelineLayout(VkDevice, VkPipelineLayout, const VkAllocationCallbacks*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkCreatePipelineCache(VkDevice, const VkPipelineCacheCreateInfo*,
                                                                const VkAllocationCallbacks*, VkPipelineCache*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkGetPipelineCacheData(VkDevice, VkPipelineCache, std::size_t*, void*);
    static VKAPI_ATTR void VKAPI_CALL vkDestroyPipelineCache(VkDevice, VkPipelineCache, const VkAllocationCallbacks*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkCreateGraphicsPipelines(VkDevice, VkPipelineCache, std::uint32_t,
                                                                    const VkGraphicsPipelineCreateInfo*,
                                                                    const VkAllocationCallbacks*, VkPipeline*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkCreateComputePipelines(VkDevice, VkPipelineCache, std::uint32_t,
                                                                   const VkComputePipelineCreateInfo*,
                                                                   const VkAllocationCallbacks*, VkPipeline*);
    static VKAPI_ATTR void VKAPI_CALL vkDestroyPipeline(VkDevice, VkPipeline, const VkAllocationCallbacks*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkCreateQueryPool(VkDevice, const VkQueryPoolCreateInfo*,
                                                            const VkAllocationCallbacks*, VkQueryPool*);
    static VKAPI_ATTR void VKAPI_CALL vkDestroyQueryPool(VkDevice, VkQueryPool, const VkAllocationCallbacks*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkCreateSemaphore(VkDevice, const VkSemaphoreCreateInfo*,
                                                            const VkAllocationCallbacks*, VkSemaphore*);
    static VKAPI_ATTR void VKAPI_CALL vkDestroySemaphore(VkDevice, VkSemaphore, const VkAllocationCallbacks*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkGetSemaphoreCounterValue(VkDevice, VkSemaphore, std::uint64_t*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkWaitSemaphores(VkDevice, const VkSemaphoreWaitInfo*, std::uint64_t);
    static VKAPI_ATTR VkResult VKAPI_CALL vkCreateCommandPool(VkDevice, const VkCommandPoolCreateInfo*,
                                                              const VkAllocationCallbacks*, VkCommandPool*);
    static VKAPI_ATTR void VKAPI_CALL vkDestroyCommandPool(VkDevice, VkCommandPool, const VkAllocationCallbacks*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkResetCommandPool(VkDevice, VkCommandPool, VkCommandPoolResetFlags);
    static VKAPI_ATTR VkResult VKAPI_CALL vkAllocateCommandBuffers(VkDevice, const VkCommandBufferAllocateInfo*,
                                                                   VkCommandBuffer*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkBeginCommandBuffer(VkCommandBuffer, const VkCommandBufferBeginInfo*);
    static VKAPI_ATTR VkResult VKAPI_CALL vkEndCommandBuffer(VkCommandBuffer);
    static VKAPI_ATTR void VKAPI_CALL vkCmdPipelineBarrier2(VkCommandBuffer, const VkDependencyInfo*);
    static VKAPI_ATTR void VKAPI_CALL vkCmdBeginRendering(VkCommandBuffer, const VkRenderingInfo*);
    static VKAPI_ATTR void VKAPI_CALL vkCmdEndRendering(VkCommandBuffer);
    static VKAPI_ATTR void VKAPI_CALL vkCmdBindPipeline(VkCommandBuffer, VkPipelineBindPoint, VkPipeline);
    static VKAPI_ATTR void VKAPI_CALL vkCmdBindDescriptorSets(VkCommandBuffer, VkPipelineBindPoint, VkPipelineLayout,
                                                              std::uint32_t, std::uint32_t, const VkDescriptorSet*,
                                                              std::uint32_t, const std::uint32_t*);
    static VKAPI_ATTR void VKAPI_CALL vkCmdPushConstants(VkCommandBuffer, VkPipelineLayout, VkShaderStageFlags,
                                                         std::uint32_t, std::uint32_t, const void*);
    static VKAPI_ATTR void VKAPI_CALL vkCmdBindVertexBuffers(VkCommandBuffer, std::uint32_t, std::uint32_t,
                                                             const VkBuffer*, const VkDeviceSize*);
    static VKAPI_ATTR void VKAPI_CALL vkCmdBindIndexBuffer(VkCommandBuffer, VkBuffer, VkDeviceSize, VkIndexType);
    static VKAPI_ATTR void VKAPI_CALL vkCmdSetViewport(VkCommandBuffer, std::uint32_t, std::uint32_t,
                                                       const VkViewport*);
    static VKAPI_ATTR void VKAPI_CALL vkCmdSetScissor(VkCommandBuffer, std::uint32_t, std::uint32_t, const VkRect2D*);
    static VKAPI_ATTR void VKAPI_CALL vkCmdSetLineWidth(VkCommandBuffer, float);
    static VKAPI_ATTR void VKAPI_CALL vkCmdDraw(VkCommandBuffer, std::uint32_t, std::uint32_t, std::uint32_t,
                                                std::uint32_t);
    static VKAPI_ATTR void VKAPI_CALL vkCmdDrawIndexed(VkCommandBuffer, std::uint32_t, std::uint32_t, std::uint32_t,
                                                       int32_t, std::uint32_t);
    static VKAPI_ATTR void VKAPI_CALL vkCmdDispatch(VkCommandBuffer, std::uint32_t, std::uint32_t, std::uint32_t);
    static VKAPI_ATTR void VKAPI_CALL vkCmdDrawIndirect(VkCommandBuffer, VkBuffer, VkDeviceSize, std::uint32_t,
                                                        std::uint32_t);
    static VKAPI_ATTR void VKAPI_CALL vkCmdDrawIndexedIndirect(VkCommandBuffer, VkBuffer, VkDeviceSize, std::uint32_t,
                                                               std::uint32_t);
    static VKAPI_ATTR void VKAPI_CALL vkCmdDispatchIndirect(VkCommandBuffer, VkBuffer, VkDeviceSize);
    static VKAPI_ATTR void VKAPI_CALL vkCmdCopyBuffer(VkCommandBuffer, VkBuffer, VkBuffer, std::uint32_t,
                                                      const VkBufferCopy*);
    static VKAPI_ATTR void VKAPI_CALL vkCmdCopyBufferToImage(VkCommandBuffer, VkBuffer, VkImage, VkImageLayout,
                                                             std::uint32_t, const VkBufferImageCopy*);
    static VKAPI_ATTR void VKAPI_CALL vkCmdCopyImageToBuffer(VkCommandBuffer, VkImage, VkImageLayout, VkBuffer,
                                                             std::uint32_t, const VkBufferImageCopy*);
    static VKAPI_ATTR void VKAPI_CALL vkCmdCopyImage(VkCommandBuffer, VkImage, VkImageLayout, VkImage, VkImageLayout,
                                                     std::uint32_t, const VkImageCopy*);
    static VKAPI_ATTR void VKAPI_CALL vkCmdFillBuffer(VkCommandBuffer, VkBuffer, VkDeviceSize, VkDeviceSize,
                                                      std::uint32_t);
    static VKAPI_ATTR void VKAPI_CALL vkCmdResetQueryPool(VkCommandBuffer, VkQueryPool, std::uint32_t, std::uint32_t);
    static VKAPI_ATTR void VKAPI_CALL vkCmdWriteTimestamp2(VkCommandBuffer, VkPipelineStageFlags2, VkQueryPool,
                                                           std::uint32_t);
    static VKAPI_ATTR void VKAPI_CALL vkCmdBeginQuery(VkCommandBuffer, VkQueryPool, std::uint32_t, VkQueryControlFlags);
    static VKAPI_ATTR void VKAPI_CALL vkCmdEndQuery(VkCommandBuffer, VkQueryPool, std::uint32_t);
    static VKAPI_ATTR void VKAPI_CALL vkCmdCopyQueryPoolResults(VkCommandBuffer, VkQueryPool, std::uint32_t,
                                                                std::uint32_t, VkBuffer, VkDeviceSize, VkDeviceSize,
                                                                VkQueryResultFlags);
    static VKAPI_ATTR VkResult VKAPI_CALL vkSetDebugUtilsObjectNameEXT(VkDevice, const VkDebugUtilsObjectNameInfoEXT*);
    static VKAPI_ATTR void VKAPI_CALL vkCmdBeginDebugUtilsLabelEXT(VkCommandBuffer, const VkDebugUtilsLabelEXT*);
    static VKAPI_ATTR void VKAPI_CALL vkCmdEndDebugUtilsLabelEXT(VkCommandBuffer);
};

}  // namespace pelage::test
