// SPDX-License-Identifier: MIT
#include "convert.hpp"

#include "text.hpp"

namespace pelage::rhi {
namespace detail {

namespace {
using enum TextureFormat;
constexpr FormatInfo formats[] = {
    {Undefined, "Undefined", VK_FORMAT_UNDEFINED, 0, NumericClass::Float, 0},
    {R8Unorm, "R8Unorm", VK_FORMAT_R8_UNORM, 1, NumericClass::Float, 1},
    {RG8Unorm, "RG8Unorm", VK_FORMAT_R8G8_UNORM, 2, NumericClass::Float, 2},
    {RGBA8Unorm, "RGBA8Unorm", VK_FORMAT_R8G8B8A8_UNORM, 4, NumericClass::Float, 4},
    {RGBA8UnormSrgb, "RGBA8UnormSrgb", VK_FORMAT_R8G8B8A8_SRGB, 4, NumericClass::Float, 4},
    {BGRA8Unorm, "BGRA8Unorm", VK_FORMAT_B8G8R8A8_UNORM, 4, NumericClass::Float, 4},
    {BGRA8UnormSrgb, "BGRA8UnormSrgb", VK_FORMAT_B8G8R8A8_SRGB, 4, NumericClass::Float, 4},
    {RGB10A2Unorm, "RGB10A2Unorm", VK_FORMAT_A2B10G10R10_UNORM_PACK32, 4, NumericClass::Float, 4},
    {R8Uint, "R8Uint", VK_FORMAT_R8_UINT, 1, NumericClass::Uint, 1},
    {R16Float, "R16Float", VK_FORMAT_R16_SFLOAT, 2, NumericClass::Float, 1},
    {RG16Float, "RG16Float", VK_FORMAT_R16G16_SFLOAT, 4, NumericClass::Float, 2},
    {RGBA16Float, "RGBA16Float", VK_FORMAT_R16G16B16A16_SFLOAT, 8, NumericClass::Float, 4},
    {RG11B10Ufloat, "RG11B10Ufloat", VK_FORMAT_B10G11R11_UFLOAT_PACK32, 4, NumericClass::Float, 3},
    {R32Float, "R32Float", VK_FORMAT_R32_SFLOAT, 4, NumericClass::Float, 1},
    {RG32Float, "RG32Float", VK_FORMAT_R32G32_SFLOAT, 8, NumericClass::Float, 2},
    {RGBA32Float, "RGBA32Float", VK_FORMAT_R32G32B32A32_SFLOAT, 16, NumericClass::Float, 4},
    {R32Uint, "R32Uint", VK_FORMAT_R32_UINT, 4, NumericClass::Uint, 1},
    {RG32Uint, "RG32Uint", VK_FORMAT_R32G32_UINT, 8, NumericClass::Uint, 2},
    {RGBA32Uint, "RGBA32Uint", VK_FORMAT_R32G32B32A32_UINT, 16, NumericClass::Uint, 4},
    {Depth32Float, "Depth32Float", VK_FORMAT_D32_SFLOAT, 4, NumericClass::Depth, 1},
    {Depth24PlusStencil8, "Depth24PlusStencil8", VK_FORMAT_D24_UNORM_S8_UINT, 0, NumericClass::Depth, 1},
    {Depth32FloatStencil8, "Depth32FloatStencil8", VK_FORMAT_D32_SFLOAT_S8_UINT, 0, NumericClass::Depth, 1},
};
}  // namespace

const FormatInfo& formatInfo(TextureFormat format) {
    return formats[static_cast<std::size_t>(format)];
}

TextureFormat fromVk(VkFormat format) {
    for (const auto& f : formats)
        if (f.vk == format) return f.format;
    return Undefined;
}

VkImageAspectFlags aspectsOf(TextureFormat format) {
    if (format == Depth24PlusStencil8 || format == Depth32FloatStencil8)
        return VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;
    return isDepth(format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

VkFormat toVk(TextureFormat format) {
    return formatInfo(format).vk;
}

namespace {
struct VertexFormatInfo {
    std::string_view name;
    VkFormat vk;
    std::uint32_t bytes;
    NumericClass numeric;
};
constexpr VertexFormatInfo vertexFormats[] = {
    {"Float32", VK_FORMAT_R32_SFLOAT, 4, NumericClass::Float},
    {"Float32x2", VK_FORMAT_R32G32_SFLOAT, 8, NumericClass::Float},
    {"Float32x3", VK_FORMAT_R32G32B32_SFLOAT, 12, NumericClass::Float},
    {"Float32x4", VK_FORMAT_R32G32B32A32_SFLOAT, 16, NumericClass::Float},
    {"Uint32", VK_FORMAT_R32_UINT, 4, NumericClass::Uint},
    {"Unorm8x4", VK_FORMAT_R8G8B8A8_UNORM, 4, NumericClass::Float},
    {"Uint32x2", VK_FORMAT_R32G32_UINT, 8, NumericClass::Uint},
    {"Uint32x3", VK_FORMAT_R32G32B32_UINT, 12, NumericClass::Uint},
    {"Uint32x4", VK_FORMAT_R32G32B32A32_UINT, 16, NumericClass::Uint},
    {"Sint32", VK_FORMAT_R32_SINT, 4, NumericClass::Sint},
    {"Sint32x2", VK_FORMAT_R32G32_SINT, 8, NumericClass::Sint},
    {"Sint32x3", VK_FORMAT_R32G32B32_SINT, 12, NumericClass::Sint},
    {"Sint32x4", VK_FORMAT_R32G32B32A32_SINT, 16, NumericClass::Sint},
};
const VertexFormatInfo& info(VertexFormat format) {
    return vertexFormats[static_cast<std::size_t>(format)];
}
}  // namespace

VkFormat toVk(VertexFormat format) {
    return info(format).vk;
}
std::uint32_t vertexFormatBytes(VertexFormat format) {
    return info(format).bytes;
}
NumericClass numericClass(VertexFormat format) {
    return info(format).numeric;
}
std::string_view name(VertexFormat format) {
    return info(format).name;
}

VkBufferUsageFlags toVk(BufferUsage usage) {
    VkBufferUsageFlags flags = 0;
    if (contains(usage, BufferUsage::CopySrc)) flags |= VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
    if (any(usage & (BufferUsage::CopyDst | BufferUsage::QueryResolve))) flags |= VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    if (contains(usage, BufferUsage::Index)) flags |= VK_BUFFER_USAGE_INDEX_BUFFER_BIT;
    if (contains(usage, BufferUsage::Vertex)) flags |= VK_BUFFER_USAGE_VERTEX_BUFFER_BIT;
    if (contains(usage, BufferUsage::Uniform)) flags |= VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT;
    if (contains(usage, BufferUsage::Storage)) flags |= VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    if (contains(usage, BufferUsage::Indirect)) flags |= VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
    // MapRead and MapWrite alone have no Vulkan usage, and a buffer must have one.
    return flags != 0 ? flags : VkBufferUsageFlags{VK_BUFFER_USAGE_TRANSFER_SRC_BIT};
}

VkImageUsageFlags toVk(TextureUsage usage, TextureFormat format) {
    VkImageUsageFlags flags = 0;
    if (contains(usage, TextureUsage::CopySrc)) flags |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    if (contains(usage, TextureUsage::CopyDst)) flags |= VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    if (contains(usage, TextureUsage::TextureBinding)) flags |= VK_IMAGE_USAGE_SAMPLED_BIT;
    if (contains(usage, TextureUsage::StorageBinding)) flags |= VK_IMAGE_USAGE_STORAGE_BIT;
    if (contains(usage, TextureUsage::RenderAttachment))
        flags |= isDepth(format) ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    return flags;
}

VkImageViewType toVk(TextureViewDimension dimension) {
    constexpr VkImageViewType types[] = {VK_IMAGE_VIEW_TYPE_2D, VK_IMAGE_VIEW_TYPE_2D_ARRAY, VK_IMAGE_VIEW_TYPE_CUBE,
                                         VK_IMAGE_VIEW_TYPE_3D};
    return types[static_cast<std::size_t>(dimension)];
}
std::string_view name(TextureViewDimension dimension) {
    constexpr std::string_view names[] = {"2D", "2D array", "cube", "3D"};
    return names[static_cast<std::size_t>(dimension)];
}
VkSamplerAddressMode toVk(AddressMode mode) {
    constexpr VkSamplerAddressMode modes[] = {
        VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT,
        VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER};
    return modes[static_cast<std::size_t>(mode)];
}
VkFilter toVk(FilterMode mode) {
    return mode == FilterMode::Linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
}
VkCompareOp toVk(CompareFunction function) {
    constexpr VkCompareOp ops[] = {
        VK_COMPARE_OP_ALWAYS,        VK_COMPARE_OP_NEVER,   VK_COMPARE_OP_LESS,      VK_COMPARE_OP_EQUAL,
        VK_COMPARE_OP_LESS_OR_EQUAL, VK_COMPARE_OP_GREATER, VK_COMPARE_OP_NOT_EQUAL, VK_COMPARE_OP_GREATER_OR_EQUAL,
        VK_COMPARE_OP_ALWAYS};
    return ops[static_cast<std::size_t>(function)];
}
VkShaderStageFlags toVk(ShaderStage stages) {
    VkShaderStageFlags flags = 0;
    if (contains(stages, ShaderStage::Vertex)) flags |= VK_SHADER_STAGE_VERTEX_BIT;
    if (contains(stages, ShaderStage::Fragment)) flags |= VK_SHADER_STAGE_FRAGMENT_BIT;
    if (contains(stages, ShaderStage::Compute)) flags |= VK_SHADER_STAGE_COMPUTE_BIT;
    return flags;
}
VkPipelineStageFlags2 pipelineStages(ShaderStage stages) {
    VkPipelineStageFlags2 flags = 0;
    if (contains(stages, ShaderStage::Vertex)) flags |= VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT;
    if (contains(stages, ShaderStage::Fragment)) flags |= VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    if (contains(stages, ShaderStage::Compute)) flags |= VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    return flags;
}
VkDescriptorType toVk(BindingType type, bool dynamic) {
    switch (type) {
        case BindingType::UniformBuffer:
            return dynamic ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC : VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
        case BindingType::StorageBuffer:
        case BindingType::ReadOnlyStorageBuffer:
            return dynamic ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        case BindingType::Sampler:
        case BindingType::ComparisonSampler:
            return VK_DESCRIPTOR_TYPE_SAMPLER;
        case BindingType::StorageTexture:
        case BindingType::ReadOnlyStorageTexture:
            return VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
        default:
            return VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
    }
}
VkPrimitiveTopology toVk(PrimitiveTopology topology) {
    constexpr VkPrimitiveTopology topologies[] = {VK_PRIMITIVE_TOPOLOGY_POINT_LIST, VK_PRIMITIVE_TOPOLOGY_LINE_LIST,
                                                  VK_PRIMITIVE_TOPOLOGY_LINE_STRIP, VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST,
                                                  VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP};
    return topologies[static_cast<std::size_t>(topology)];
}
VkCullModeFlags toVk(CullMode mode) {
    constexpr VkCullModeFlags modes[] = {VK_CULL_MODE_NONE, VK_CULL_MODE_FRONT_BIT, VK_CULL_MODE_BACK_BIT};
    return modes[static_cast<std::size_t>(mode)];
}
VkBlendFactor toVk(BlendFactor factor) {
    constexpr VkBlendFactor factors[] = {VK_BLEND_FACTOR_ZERO,      VK_BLEND_FACTOR_ONE,
                                         VK_BLEND_FACTOR_SRC_COLOR, VK_BLEND_FACTOR_ONE_MINUS_SRC_COLOR,
                                         VK_BLEND_FACTOR_SRC_ALPHA, VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
                                         VK_BLEND_FACTOR_DST_COLOR, VK_BLEND_FACTOR_ONE_MINUS_DST_COLOR,
                                         VK_BLEND_FACTOR_DST_ALPHA, VK_BLEND_FACTOR_ONE_MINUS_DST_ALPHA};
    return factors[static_cast<std::size_t>(factor)];
}
VkBlendOp toVk(BlendOperation operation) {
    constexpr VkBlendOp ops[] = {VK_BLEND_OP_ADD, VK_BLEND_OP_SUBTRACT, VK_BLEND_OP_REVERSE_SUBTRACT, VK_BLEND_OP_MIN,
                                 VK_BLEND_OP_MAX};
    return ops[static_cast<std::size_t>(operation)];
}
bool isBuffer(BindingType type) {
    return type == BindingType::UniformBuffer || type == BindingType::StorageBuffer ||
           type == BindingType::ReadOnlyStorageBuffer;
}
bool isSampler(BindingType type) {
    return type == BindingType::Sampler || type == BindingType::ComparisonSampler;
}
BindingType canonical(BindingType type) {
    if (type == BindingType::DepthTexture) return BindingType::SampledTexture;
    return type == BindingType::ComparisonSampler ? BindingType::Sampler : type;
}

namespace {
template <class Flags, std::size_t N>
std::string flagNames(Flags flags, std::string_view prefix, const std::pair<Flags, std::string_view> (&all)[N]) {
    std::string text;
    for (const auto& [flag, word] : all)
        if (contains(flags, flag)) text += cat(text.empty() ? "" : " | ", prefix, word);
    return text.empty() ? cat(prefix, "None") : text;
}
}  // namespace

std::string usageNames(BufferUsage usage) {
    using enum BufferUsage;
    constexpr std::pair<BufferUsage, std::string_view> all[] = {{MapRead, "MapRead"},   {MapWrite, "MapWrite"},
                                                                {CopySrc, "CopySrc"},   {CopyDst, "CopyDst"},
                                                                {Index, "Index"},       {Vertex, "Vertex"},
                                                                {Uniform, "Uniform"},   {Storage, "Storage"},
                                                                {Indirect, "Indirect"}, {QueryResolve, "QueryResolve"}};
    return flagNames(usage, "BufferUsage::", all);
}
std::string usageNames(TextureUsage usage) {
    using enum TextureUsage;
    constexpr std::pair<TextureUsage, std::string_view> all[] = {{CopySrc, "CopySrc"},
                                                                 {CopyDst, "CopyDst"},
                                                                 {TextureBinding, "TextureBinding"},
                                                                 {StorageBinding, "StorageBinding"},
                                                                 {RenderAttachment, "RenderAttachment"}};
    return flagNames(usage, "TextureUsage::", all);
}
std::string_view name(ShaderStage stage) {
    if (stage == ShaderStage::Vertex) return "vertex";
    return stage == ShaderStage::Fragment ? "fragment" : "compute";
}
std::string featureNames(Feature features) {
    std::string text;
    for (std::uint32_t bit = 1; bit != 0; bit <<= 1) {
        if (!contains(features, static_cast<Feature>(bit))) continue;
        const auto known = bit <= static_cast<std::uint32_t>(Feature::FragmentStores);
        text += cat(text.empty() ? "" : ", ", known ? name(static_cast<Feature>(bit)) : cat("feature bit ", bit));
    }
    return text.empty() ? "none" : text;
}

}  // namespace detail

std::uint32_t bytesPerTexel(TextureFormat format) {
    return detail::formatInfo(format).bytes;
}
bool isDepth(TextureFormat format) {
    return detail::formatInfo(format).numeric == detail::NumericClass::Depth;
}
std::string_view name(TextureFormat format) {
    return detail::formatInfo(format).name;
}
TextureFormat textureFormatFromName(std::string_view word) {
    for (const auto& f : detail::formats)
        if (f.name == word) return f.format;
    return TextureFormat::Undefined;
}

std::string_view name(BindingType type) {
    constexpr std::string_view names[] = {
        "UniformBuffer",  "StorageBuffer",       "ReadOnlyStorageBuffer", "Sampler",        "ComparisonSampler",
        "SampledTexture", "MultisampledTexture", "DepthTexture",          "StorageTexture", "ReadOnlyStorageTexture"};
    return names[static_cast<std::size_t>(type)];
}

std::string_view name(Feature feature) {
    switch (feature) {
        case Feature::None:
            return "None";
        case Feature::WideLines:
            return "WideLines";
        case Feature::PipelineStatistics:
            return "PipelineStatistics";
        case Feature::Timestamps:
            return "Timestamps";
        case Feature::Int64BufferAtomics:
            return "Int64BufferAtomics";
        case Feature::FillModeNonSolid:
            return "FillModeNonSolid";
        case Feature::AnisotropicFiltering:
            return "AnisotropicFiltering";
        case Feature::FragmentStores:
            return "FragmentStores";
    }
    return "an unknown feature";
}

}  // namespace pelage::rhi
