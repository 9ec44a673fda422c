// SPDX-License-Identifier: MIT
#include "device_object.hpp"
#include "transient_heap.hpp"

#include <algorithm>
#include <bit>

namespace pelage::rhi {
namespace detail {

TextureObject::~TextureObject() {
    if (handle != VK_NULL_HANDLE && onRelease)
        device->bury(lastUse, [tell = std::move(onRelease)](DeviceObject&) { tell(); });
    if (handle == VK_NULL_HANDLE || !ownsImage) return;
    --device->liveTextures;
    device->bury(lastUse, [image = handle, memory = allocation](DeviceObject& d) {
        d.functions.vkDestroyImage(d.handle, image, d.allocator);
        d.memory.release(memory);
    });
}

void TextureObject::markUsed(std::uint64_t value) {
    Object::markUsed(value);
    if (heap) heap->markUsed(value);
}

TextureViewObject::~TextureViewObject() {
    if (handle == VK_NULL_HANDLE) return;
    device->bury(lastUse,
                 [view = handle](DeviceObject& d) { d.functions.vkDestroyImageView(d.handle, view, d.allocator); });
}

Extent3D TextureObject::mipSize(std::uint32_t mip) const {
    const auto& s = descriptor.size;
    return {std::max(s.width >> mip, 1U), std::max(s.height >> mip, 1U),
            descriptor.dimension == TextureDimension::E3D ? std::max(s.depthOrArrayLayers >> mip, 1U) : 1U};
}

Result<void> checkDescriptor(const TextureObject& object) {
    const auto& d = object.descriptor;
    const auto& limits = object.device->info.limits;
    const bool volume = d.dimension == TextureDimension::E3D;
    const auto bad = [&](Code code, auto&&... parts) { return invalid(code, cat(object.describe(), parts...)); };
    if (d.size.width == 0 || d.size.height == 0 || d.size.depthOrArrayLayers == 0)
        return bad(ErrorCode::InvalidSize, " has size ", d.size.width, 'x', d.size.height, 'x',
                   d.size.depthOrArrayLayers, "; no extent may be 0.");
    if (d.format == TextureFormat::Undefined) return bad(ErrorCode::FormatUnsupported, " has the format Undefined.");
    if (d.usage == TextureUsage::None) return bad(ErrorCode::InvalidUsage, " has no usage; at least one is needed.");
    const auto largest = std::max(d.size.width, d.size.height);
    if (largest > limits.maxTextureDimension2D && !volume)
        return bad(ErrorCode::InvalidSize, " is ", d.size.width, 'x', d.size.height,
                   " texels, which is above the device's limit of ", limits.maxTextureDimension2D, '.');
    if (!volume && d.size.depthOrArrayLayers > limits.maxTextureArrayLayers)
        return bad(ErrorCode::InvalidSize, " has ", d.size.depthOrArrayLayers,
                   " layers, which is above the device's limit of ", limits.maxTextureArrayLayers, '.');
    const auto levels =
        static_cast<std::uint32_t>(std::bit_width(std::max(largest, volume ? d.size.depthOrArrayLayers : 1U)));
    if (d.mipLevelCount == 0 || d.mipLevelCount > levels)
        return bad(ErrorCode::InvalidSize, " has ", d.mipLevelCount, " mip levels; its size allows 1 to ", levels, '.');
    if (d.sampleCount > 1 && (d.mipLevelCount > 1 || volume))
        return bad(ErrorCode::SampleCount, " has ", d.sampleCount,
                   " samples; a multisampled texture is 2D and has one mip level.");
    if (d.cubeCompatible && (volume || d.size.width != d.size.height || d.size.depthOrArrayLayers % 6 != 0))
        return bad(ErrorCode::InvalidSize, " is ", d.size.width, 'x', d.size.height, " with ",
                   d.size.depthOrArrayLayers, " layers; a cube is square and has 6 layers or a multiple.");
    return {};
}

namespace {

Result<void> checkTexture(const DeviceObject& device, const TextureObject& object, const VkImageCreateInfo& info) {
    if (auto ok = checkDescriptor(object); !ok) return ok;
    const auto& d = object.descriptor;
    const bool volume = d.dimension == TextureDimension::E3D;
    const auto bad = [&](Code code, auto&&... parts) { return invalid(code, cat(object.describe(), parts...)); };
    VkPhysicalDeviceImageFormatInfo2 query = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_IMAGE_FORMAT_INFO_2};
    query.format = info.format;
    query.type = info.imageType;
    query.tiling = info.tiling;
    query.usage = info.usage;
    query.flags = info.flags;
    VkImageFormatProperties2 properties = {VK_STRUCTURE_TYPE_IMAGE_FORMAT_PROPERTIES_2};
    const auto& adapter = *device.adapter;
    const auto r = adapter.instance->vk.vkGetPhysicalDeviceImageFormatProperties2(adapter.handle, &query, &properties);
    if (r == VK_ERROR_FORMAT_NOT_SUPPORTED)
        return fail(ErrorKind::Unsupported, ErrorCode::FormatUnsupported,
                    cat(object.describe(), " has the format ", name(d.format), " and usage ", usageNames(d.usage),
                        ", which [Device \"", device.label, "\"] cannot combine."));
    if (r != VK_SUCCESS) return forward(vulkanError(r, "vkGetPhysicalDeviceImageFormatProperties2", object.describe()));
    const auto& p = properties.imageFormatProperties;
    if (!std::has_single_bit(d.sampleCount) || (p.sampleCounts & d.sampleCount) == 0) {
        std::string counts;
        for (std::uint32_t n = 1; n <= 64; n <<= 1)
            if ((p.sampleCounts & n) != 0) counts += cat(counts.empty() ? "" : ", ", n);
        return bad(ErrorCode::SampleCount, " has ", d.sampleCount, " samples; ", name(d.format), " allows ", counts,
                   '.');
    }
    if (d.size.width > p.maxExtent.width || d.size.height > p.maxExtent.height ||
        (volume && d.size.depthOrArrayLayers > p.maxExtent.depth))
        return bad(ErrorCode::InvalidSize, " is ", d.size.width, 'x', d.size.height, 'x', d.size.depthOrArrayLayers,
                   " texels; the device allows ", p.maxExtent.width, 'x', p.maxExtent.height, 'x', p.maxExtent.depth,
                   " for it.");
    return {};
}

VkImageCreateInfo imageInfo(const TextureDescriptor& d) {
    const bool volume = d.dimension == TextureDimension::E3D;
    VkImageCreateInfo info = {VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.flags = d.cubeCompatible ? VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT : 0;
    info.imageType = volume ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D;
    info.format = toVk(d.format);
    info.extent = {d.size.width, d.size.height, volume ? d.size.depthOrArrayLayers : 1};
    info.mipLevels = d.mipLevelCount;
    info.arrayLayers = volume ? 1 : d.size.depthOrArrayLayers;
    info.samples = static_cast<VkSampleCountFlagBits>(d.sampleCount);
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = toVk(d.usage, d.format);
    info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    return info;
}

VkMemoryRequirements requirements(const DeviceObject& device, const VkImageCreateInfo& info) {
    VkDeviceImageMemoryRequirements query = {VK_STRUCTURE_TYPE_DEVICE_IMAGE_MEMORY_REQUIREMENTS};
    query.pCreateInfo = &info;
    VkMemoryRequirements2 needs = {VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2};
    device.functions.vkGetDeviceImageMemoryRequirements(device.handle, &query, &needs);
    return needs.memoryRequirements;
}

Result<Texture> makeTexture(const std::shared_ptr<DeviceObject>& device, const TextureDescriptor& descriptor) {
    auto object = std::make_shared<TextureObject>(device, "Texture", descriptor.label);
    object->descriptor = descriptor;
    const auto& d = descriptor;
    const auto info = imageInfo(d);
    if (auto ok = checkTexture(*device, *object, info); !ok) return forward(ok.error());
    const auto needs = requirements(*device, info);
    if (auto ok = checkPlace(*object, needs); !ok) return forward(ok.error());
    const auto& vk = device->functions;
    VkImage image = VK_NULL_HANDLE;
    if (const auto r = vk.vkCreateImage(device->handle, &info, device->allocator, &image); r != VK_SUCCESS)
        return forward(vulkanError(r, "vkCreateImage", object->describe()));
    VkBindImageMemoryInfo bind = {VK_STRUCTURE_TYPE_BIND_IMAGE_MEMORY_INFO};
    bind.image = image;
    Allocation own;
    if (d.heap) {
        const auto& shared = d.heap.get()->allocation;
        bind.memory = shared.memory;
        bind.memoryOffset = shared.offset + d.heapOffset;
    } else {
        auto memory = device->memory.allocate(needs, MemoryUse::Device, true, object->describe());
        if (!memory) {
            vk.vkDestroyImage(device->handle, image, device->allocator);
            return forward(memory.error());
        }
        own = *memory;
        bind.memory = own.memory;
        bind.memoryOffset = own.offset;
    }
    if (const auto r = vk.vkBindImageMemory2(device->handle, 1, &bind); r != VK_SUCCESS) {
        vk.vkDestroyImage(device->handle, image, device->allocator);
        device->memory.release(own);
        return forward(vulkanError(r, "vkBindImageMemory2", object->describe()));
    }
    object->handle = image;
    object->allocation = own;
    object->bytes = needs.size;
    object->heap = d.heap.shared();
    object->descriptor.heap = {};  // held once
    object->state->mips = d.mipLevelCount;
    object->state->layers = object->layers();
    object->state->aspects = aspectsOf(d.format);
    object->state->current = !object->heap;
    ++device->liveTextures;
    device->nameObject(VK_OBJECT_TYPE_IMAGE, image, d.label);
    return Texture(std::move(object));
}

/// The descriptor with every default filled in, checked.
Result<TextureViewDescriptor> completeView(const TextureObject& texture, TextureViewDescriptor d) {
    const auto& t = texture.descriptor;
    const std::uint32_t layers = texture.layers();
    const auto bad = [&](Code code, auto&&... parts) {
        return invalid(code, cat("[TextureView \"", d.label, "\"] of ", texture.describe(), parts...));
    };
    if (!d.dimension)
        d.dimension = t.dimension == TextureDimension::E3D                      ? TextureViewDimension::E3D
                      : layers - d.baseArrayLayer > 1 && d.arrayLayerCount != 1 ? TextureViewDimension::E2DArray
                                                                                : TextureViewDimension::E2D;
    if (d.baseMipLevel >= t.mipLevelCount || d.baseArrayLayer >= layers)
        return bad(ErrorCode::OutOfRange, " starts at mip level ", d.baseMipLevel, " and layer ", d.baseArrayLayer,
                   "; the texture has ", t.mipLevelCount, " mip levels and ", layers, " layers.");
    if (d.mipLevelCount == 0) d.mipLevelCount = t.mipLevelCount - d.baseMipLevel;
    if (d.arrayLayerCount == 0)
        d.arrayLayerCount = *d.dimension == TextureViewDimension::E2D    ? 1
                            : *d.dimension == TextureViewDimension::Cube ? 6
                                                                         : layers - d.baseArrayLayer;
    if (d.mipLevelCount > t.mipLevelCount - d.baseMipLevel || d.arrayLayerCount > layers - d.baseArrayLayer)
        return bad(ErrorCode::OutOfRange, " reaches mip level ", d.baseMipLevel + d.mipLevelCount - 1, " and layer ",
                   d.baseArrayLayer + d.arrayLayerCount - 1, "; the texture has ", t.mipLevelCount, " mip levels and ",
                   layers, " layers.");
    const bool volume = t.dimension == TextureDimension::E3D;
    if (volume != (*d.dimension == TextureViewDimension::E3D))
        return bad(ErrorCode::InvalidUsage, " has the dimension ", name(*d.dimension), "; the texture is ",
                   volume ? "3D." : "2D.");
    if (*d.dimension == TextureViewDimension::E2D && d.arrayLayerCount != 1)
        return bad(ErrorCode::OutOfRange, " is 2D and has ", d.arrayLayerCount, " layers; it must have 1.");
    if (*d.dimension == TextureViewDimension::Cube && (!t.cubeCompatible || d.arrayLayerCount != 6))
        return bad(ErrorCode::InvalidUsage, " is a cube with ", d.arrayLayerCount,
                   " layers; a cube has 6 and its texture is created with cubeCompatible.");
    if (d.aspect == TextureAspect::All && isDepth(t.format)) d.aspect = TextureAspect::DepthOnly;
    if ((d.aspect != TextureAspect::All && !isDepth(t.format)) ||
        (d.aspect == TextureAspect::StencilOnly && (aspectsOf(t.format) & VK_IMAGE_ASPECT_STENCIL_BIT) == 0))
        return bad(ErrorCode::FormatUnsupported, " asks for an aspect that ", name(t.format), " does not have.");
    return d;
}

Result<std::shared_ptr<TextureViewObject>> makeView(const std::shared_ptr<TextureObject>& texture,
                                                    const TextureViewDescriptor& wanted) {
    auto complete = completeView(*texture, wanted);
    if (!complete) return forward(complete.error());
    const auto& d = *complete;
    if (texture->handle == VK_NULL_HANDLE)
        return invalid(ErrorCode::Surface,
                       cat(texture->describe(), " belongs to a surface that was configured again since."));
    constexpr auto viewable =
        TextureUsage::TextureBinding | TextureUsage::StorageBinding | TextureUsage::RenderAttachment;
    if (!any(texture->descriptor.usage & viewable))
        return invalid(ErrorCode::InvalidUsage,
                       cat(texture->describe(), " was created with ", usageNames(texture->descriptor.usage),
                           "; a view needs TextureBinding, StorageBinding or RenderAttachment."));
    const std::lock_guard lock(texture->viewMutex);
    std::erase_if(texture->views, [](const auto& v) { return v.second.expired(); });
    for (const auto& [known, weak] : texture->views)
        if (known.dimension == d.dimension && known.aspect == d.aspect && known.baseMipLevel == d.baseMipLevel &&
            known.mipLevelCount == d.mipLevelCount && known.baseArrayLayer == d.baseArrayLayer &&
            known.arrayLayerCount == d.arrayLayerCount)
            if (auto view = weak.lock()) return view;
    const auto& device = texture->device;
    auto view = std::make_shared<TextureViewObject>(device, "TextureView", d.label.empty() ? texture->label : d.label);
    view->texture = texture;
    view->descriptor = d;
    view->range = {d.baseMipLevel, d.mipLevelCount, d.baseArrayLayer, d.arrayLayerCount};
    view->size = texture->mipSize(d.baseMipLevel);
    VkImageViewCreateInfo info = {VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    info.image = texture->handle;
    info.viewType = toVk(*d.dimension);
    info.format = toVk(texture->descriptor.format);
    const VkImageAspectFlags aspect = d.aspect == TextureAspect::All           ? VK_IMAGE_ASPECT_COLOR_BIT
                                      : d.aspect == TextureAspect::StencilOnly ? VK_IMAGE_ASPECT_STENCIL_BIT
                                                                               : VK_IMAGE_ASPECT_DEPTH_BIT;
    info.subresourceRange = {aspect, d.baseMipLevel, d.mipLevelCount, d.baseArrayLayer, d.arrayLayerCount};
    if (const auto r = device->functions.vkCreateImageView(device->handle, &info, device->allocator, &view->handle);
        r != VK_SUCCESS)
        return forward(vulkanError(r, "vkCreateImageView", view->describe()));
    device->nameObject(VK_OBJECT_TYPE_IMAGE_VIEW, view->handle, view->label);
    texture->views.emplace_back(d, view);
    return view;
}

}  // namespace
}  // namespace detail

Result<Texture> Device::createTexture(const TextureDescriptor& descriptor) const {
    if (auto ok = detail::needHandle(*this, "the device"); !ok) return detail::forward(ok.error());
    return object_->reported(detail::makeTexture(object_, descriptor));
}

Result<MemoryRequirements> Device::memoryRequirements(const TextureDescriptor& descriptor) const {
    if (auto ok = detail::needHandle(*this, "the device"); !ok) return detail::forward(ok.error());
    detail::TextureObject object(object_, "Texture", descriptor.label);
    object.descriptor = descriptor;
    const auto info = detail::imageInfo(descriptor);
    if (auto ok = detail::checkTexture(*object_, object, info); !ok)
        return object_->reported<MemoryRequirements>(detail::forward(ok.error()));
    const auto needs = detail::requirements(*object_, info);
    return MemoryRequirements{needs.size, needs.alignment};
}

const std::string& Texture::label() const {
    return object_->label;
}
const TextureDescriptor& Texture::descriptor() const {
    return object_->descriptor;
}
std::uint64_t Texture::memoryBytes() const {
    return object_->bytes;
}
Result<TextureView> Texture::createView(const TextureViewDescriptor& descriptor) const {
    if (auto ok = detail::needHandle(*this, "the texture"); !ok) return detail::forward(ok.error());
    return object_->device->reported(
        detail::makeView(object_, descriptor).map([](auto view) { return TextureView(std::move(view)); }));
}

Texture TextureView::texture() const {
    return Texture(object_->texture);
}
const TextureViewDescriptor& TextureView::descriptor() const {
    return object_->descriptor;
}

}  // namespace pelage::rhi
