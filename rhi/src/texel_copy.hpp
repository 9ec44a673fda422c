// SPDX-License-Identifier: MIT
// What the encoder's copies and the queue's uploads both check.
#pragma once

#include "objects.hpp"

namespace pelage::rhi::detail {

/// Checks a copy between bytes and texels against both and gives the region for Vulkan.
Result<VkBufferImageCopy> texelCopy(const TexelCopyTextureInfo& info, const TexelCopyBufferLayout& layout,
                                    const Extent3D& size, std::uint64_t bufferSize, const std::string& buffer);
VkImageSubresourceLayers subresource(const TexelCopyTextureInfo& info, const Extent3D& size);
VkOffset3D offsetOf(const TexelCopyTextureInfo& info);
Use copyUse(TextureObject& texture, const VkImageSubresourceLayers& part, UseKind kind);
Use copyUse(BufferObject& buffer, UseKind kind);
Result<void> needUsage(const BufferObject& object, BufferUsage usage, std::string_view what);
Result<void> needUsage(const TextureObject& object, TextureUsage usage, std::string_view what);

}  // namespace pelage::rhi::detail
