// SPDX-License-Identifier: MIT
// Our enumerations in Vulkan's words.
#pragma once

#include <pelage/rhi/resources.hpp>

#include "vk.hpp"

namespace pelage::rhi::detail {

enum class NumericClass : std::uint8_t { Float, Uint, Sint, Depth };

struct FormatInfo {
    TextureFormat format;
    std::string_view name;
    VkFormat vk;
    std::uint32_t bytes;  // per texel; 0: cannot be copied as plain bytes
    NumericClass numeric;
    std::uint32_t components;
};
const FormatInfo& formatInfo(TextureFormat format);
TextureFormat fromVk(VkFormat format);
VkImageAspectFlags aspectsOf(TextureFormat format);

VkFormat toVk(TextureFormat format);
VkFormat toVk(VertexFormat format);
std::uint32_t vertexFormatBytes(VertexFormat format);
NumericClass numericClass(VertexFormat format);
std::string_view name(VertexFormat format);
VkBufferUsageFlags toVk(BufferUsage usage);
VkImageUsageFlags toVk(TextureUsage usage, TextureFormat format);
VkImageViewType toVk(TextureViewDimension dimension);
std::string_view name(TextureViewDimension dimension);
VkSamplerAddressMode toVk(AddressMode mode);
VkFilter toVk(FilterMode mode);
VkCompareOp toVk(CompareFunction function);
VkShaderStageFlags toVk(ShaderStage stages);
VkPipelineStageFlags2 pipelineStages(ShaderStage stages);
VkDescriptorType toVk(BindingType type, bool dynamic);
VkPrimitiveTopology toVk(PrimitiveTopology topology);
VkCullModeFlags toVk(CullMode mode);
VkBlendFactor toVk(BlendFactor factor);
VkBlendOp toVk(BlendOperation operation);
bool isBuffer(BindingType type);
bool isSampler(BindingType type);
/// Types that one Vulkan descriptor serves alike: depth and colour textures; plain and comparison samplers.
BindingType canonical(BindingType type);
/// "BufferUsage::CopyDst"
std::string usageNames(BufferUsage usage);
std::string usageNames(TextureUsage usage);
std::string_view name(ShaderStage stage);
std::string featureNames(Feature features);

}  // namespace pelage::rhi::detail
