// SPDX-License-Identifier: MIT
// Copies, fills and queries outside of passes; finish(). Each copy is a scope of its own.
#include "encoder_object.hpp"
#include "texel_copy.hpp"

namespace pelage::rhi {

using detail::cat;
using detail::EncoderObject;
using detail::invalid;
using detail::UseKind;
namespace packet = detail::packet;

namespace detail {

Result<VkBufferImageCopy> texelCopy(const TexelCopyTextureInfo& info, const TexelCopyBufferLayout& layout,
                                    const Extent3D& size, std::uint64_t bufferSize, const std::string& buffer) {
    const auto& texture = *info.texture.get();
    const auto& d = texture.descriptor;
    const auto bad = [&](Code code, auto&&... parts) { return invalid(code, cat(parts...)); };
    const bool volume = d.dimension == TextureDimension::E3D;
    if (d.sampleCount > 1)
        return bad(ErrorCode::SampleCount, texture.describe(), " has ", d.sampleCount,
                   " samples; only textures with 1 are copied to or from buffers.");
    const std::uint32_t texel = bytesPerTexel(d.format);
    if (texel == 0 || info.aspect == TextureAspect::StencilOnly)
        return bad(ErrorCode::FormatUnsupported, texture.describe(), " has the format ", name(d.format),
                   ", which is not copied to or from buffers.");
    if (info.mipLevel >= d.mipLevelCount)
        return bad(ErrorCode::OutOfRange, texture.describe(), " has ", d.mipLevelCount,
                   " mip levels; the copy names level ", info.mipLevel, '.');
    const auto extent = texture.mipSize(info.mipLevel);
    const std::uint32_t depth = volume ? extent.depthOrArrayLayers : texture.layers();
    if (std::uint64_t{info.origin.x} + size.width > extent.width ||
        std::uint64_t{info.origin.y} + size.height > extent.height ||
        std::uint64_t{info.origin.z} + size.depthOrArrayLayers > depth)
        return bad(ErrorCode::OutOfRange, "The copy of ", size.width, 'x', size.height, 'x', size.depthOrArrayLayers,
                   " texels at ", info.origin.x, ", ", info.origin.y, ", ", info.origin.z, " reaches outside ",
                   texture.describe(), ", whose mip level ", info.mipLevel, " is ", extent.width, 'x', extent.height,
                   'x', depth, '.');
    if (size.width == 0 || size.height == 0 || size.depthOrArrayLayers == 0)
        return bad(ErrorCode::InvalidSize, "The copy with ", texture.describe(), " has an extent of 0.");
    const std::uint64_t row = layout.bytesPerRow != 0 ? layout.bytesPerRow : std::uint64_t{size.width} * texel;
    const std::uint64_t rows = layout.rowsPerImage != 0 ? layout.rowsPerImage : size.height;
    if (row < std::uint64_t{size.width} * texel || row % texel != 0 || rows < size.height)
        return bad(ErrorCode::OutOfRange, "The copy with ", texture.describe(), " has ", row, " bytes per row and ",
                   rows, " rows per image; rows hold whole texels and at least ", size.width * texel,
                   " bytes, images at least ", size.height, " rows.");
    const std::uint64_t bytes =
        ((size.depthOrArrayLayers - 1) * rows + size.height - 1) * row + std::uint64_t{size.width} * texel;
    if (layout.offset > bufferSize || bytes > bufferSize - layout.offset)
        return bad(ErrorCode::OutOfRange, "The copy with ", texture.describe(), " needs ", bytes, " bytes at offset ",
                   layout.offset, "; ", buffer, " has ", bufferSize, '.');
    const std::uint64_t alignment = std::max(texel, 4U);
    if (layout.offset % alignment != 0)
        return bad(ErrorCode::OutOfRange, "The copy with ", texture.describe(), " starts at byte ", layout.offset,
                   " of ", buffer, "; a multiple of ", alignment, " is needed.");
    VkBufferImageCopy region = {};
    region.bufferOffset = layout.offset;
    region.bufferRowLength = static_cast<std::uint32_t>(row / texel);
    region.bufferImageHeight = static_cast<std::uint32_t>(rows);
    region.imageSubresource = subresource(info, size);
    region.imageOffset = offsetOf(info);
    region.imageExtent = {size.width, size.height, volume ? size.depthOrArrayLayers : 1};
    return region;
}

VkImageSubresourceLayers subresource(const TexelCopyTextureInfo& info, const Extent3D& size) {
    const auto& d = info.texture.get()->descriptor;
    const bool volume = d.dimension == TextureDimension::E3D;
    return {static_cast<VkImageAspectFlags>(isDepth(d.format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT),
            info.mipLevel, volume ? 0 : info.origin.z, volume ? 1 : size.depthOrArrayLayers};
}

VkOffset3D offsetOf(const TexelCopyTextureInfo& info) {
    const bool volume = info.texture.get()->descriptor.dimension == TextureDimension::E3D;
    return {static_cast<std::int32_t>(info.origin.x), static_cast<std::int32_t>(info.origin.y),
            volume ? static_cast<std::int32_t>(info.origin.z) : 0};
}

Use copyUse(TextureObject& texture, const VkImageSubresourceLayers& part, UseKind kind) {
    Use use;
    use.object = &texture;
    use.texture = true;
    use.kind = kind;
    use.range = {part.mipLevel, 1, part.baseArrayLayer, part.layerCount};
    use.access = accessOf(kind, 0, isDepth(texture.descriptor.format));
    return use;
}

Use copyUse(BufferObject& buffer, UseKind kind) {
    Use use;
    use.object = &buffer;
    use.kind = kind;
    use.access = accessOf(kind, 0, false);
    return use;
}

Result<void> needUsage(const BufferObject& object, BufferUsage usage, std::string_view what) {
    if (contains(object.descriptor.usage, usage)) return {};
    return invalid(ErrorCode::InvalidUsage,
                   cat(object.describe(), " was created without ", usageNames(usage), ", which ", what, " needs."));
}
Result<void> needUsage(const TextureObject& object, TextureUsage usage, std::string_view what) {
    if (contains(object.descriptor.usage, usage)) return {};
    return invalid(ErrorCode::InvalidUsage,
                   cat(object.describe(), " was created without ", usageNames(usage), ", which ", what, " needs."));
}

}  // namespace detail

namespace {

using State = EncoderObject::State;

bool valid(EncoderObject& e, const Result<void>& result) {
    e.check(result);
    return result.has_value();
}

Result<void> range(const detail::BufferObject& b, std::uint64_t offset, std::uint64_t size, std::string_view what) {
    const std::uint64_t total = b.descriptor.size;
    if (offset <= total && size <= total - offset && offset % 4 == 0) return {};
    return invalid(ErrorCode::OutOfRange,
                   cat("The range ", offset, " … ", offset + size, " of ", what, " lies outside ", b.describe(),
                       ", which has ", total, " bytes, or starts off a multiple of 4."));
}

void scoped(EncoderObject& e, std::initializer_list<detail::Use> uses, detail::Packet command) {
    e.scope.clear();
    for (const auto& use : uses)
        if (!e.use(use)) return;
    e.add(e.scope.take(e.recording.uses));
    e.add(std::move(command));
    ++e.counters.copies;
}

}  // namespace

void CommandEncoder::copyBufferToBuffer(const Buffer& source, std::uint64_t sourceOffset, const Buffer& destination,
                                        std::uint64_t destinationOffset, std::uint64_t size) {
    if (!encoder_ || !encoder_->ready(State::Open, "copyBufferToBuffer")) return;
    auto& e = *encoder_;
    if (!e.accept(source, "the source of a copy") || !e.accept(destination, "the destination of a copy")) return;
    auto &from = *source.get(), &to = *destination.get();
    if (!valid(e, needUsage(from, BufferUsage::CopySrc, "the source of a copy")) ||
        !valid(e, needUsage(to, BufferUsage::CopyDst, "the destination of a copy")) ||
        !valid(e, range(from, sourceOffset, size, "the source")) ||
        !valid(e, range(to, destinationOffset, size, "the destination")))
        return;
    if (size == 0) return;
    const auto region = static_cast<std::uint32_t>(e.recording.bufferRegions.size());
    e.recording.bufferRegions.push_back({sourceOffset, destinationOffset, size});
    scoped(e, {detail::copyUse(from, UseKind::CopySource), detail::copyUse(to, UseKind::CopyDestination)},
           packet::CopyBuffer{&from, &to, region});
}

namespace {
void copyBufferTexture(EncoderObject& e, const TexelCopyBufferInfo& buffer, const TexelCopyTextureInfo& texture,
                       const Extent3D& size, bool toTexture) {
    if (!e.accept(buffer.buffer, "the buffer of a copy") || !e.accept(texture.texture, "the texture of a copy")) return;
    auto& b = *buffer.buffer.get();
    auto& t = *texture.texture.get();
    const std::string_view from = "the source of a copy", to = "the destination of a copy";
    if (!valid(e, needUsage(b, toTexture ? BufferUsage::CopySrc : BufferUsage::CopyDst, toTexture ? from : to)) ||
        !valid(e, needUsage(t, toTexture ? TextureUsage::CopyDst : TextureUsage::CopySrc, toTexture ? to : from)))
        return;
    auto region = detail::texelCopy(texture, buffer.layout, size, b.descriptor.size, b.describe());
    if (!region) return e.fail(region.error());
    e.recording.bufferImageRegions.push_back(*region);
    const auto index = static_cast<std::uint32_t>(e.recording.bufferImageRegions.size() - 1);
    scoped(e,
           {detail::copyUse(b, toTexture ? UseKind::CopySource : UseKind::CopyDestination),
            detail::copyUse(t, region->imageSubresource, toTexture ? UseKind::CopyDestination : UseKind::CopySource)},
           packet::CopyBufferImage{&b, &t, index, toTexture});
}
}  // namespace

void CommandEncoder::copyBufferToTexture(const TexelCopyBufferInfo& source, const TexelCopyTextureInfo& destination,
                                         const Extent3D& size) {
    if (encoder_ && encoder_->ready(State::Open, "copyBufferToTexture"))
        copyBufferTexture(*encoder_, source, destination, size, true);
}

void CommandEncoder::copyTextureToBuffer(const TexelCopyTextureInfo& source, const TexelCopyBufferInfo& destination,
                                         const Extent3D& size) {
    if (encoder_ && encoder_->ready(State::Open, "copyTextureToBuffer"))
        copyBufferTexture(*encoder_, destination, source, size, false);
}

void CommandEncoder::copyTextureToTexture(const TexelCopyTextureInfo& source, const TexelCopyTextureInfo& destination,
                                          const Extent3D& size) {
    if (!encoder_ || !encoder_->ready(State::Open, "copyTextureToTexture")) return;
    auto& e = *encoder_;
    if (!e.accept(source.texture, "the source of a copy") ||
        !e.accept(destination.texture, "the destination of a copy"))
        return;
    auto &from = *source.texture.get(), &to = *destination.texture.get();
    if (!valid(e, needUsage(from, TextureUsage::CopySrc, "the source of a copy")) ||
        !valid(e, needUsage(to, TextureUsage::CopyDst, "the destination of a copy")))
        return;
    const auto &f = from.descriptor, &t = to.descriptor;
    const bool sameKind = isDepth(f.format) == isDepth(t.format) && (!isDepth(f.format) || f.format == t.format);
    if (bytesPerTexel(f.format) != bytesPerTexel(t.format) || !sameKind)
        return e.fail(invalid(ErrorCode::FormatUnsupported,
                              cat(from.describe(), " (", name(f.format), ") cannot be copied to ", to.describe(), " (",
                                  name(t.format), "); texels of equal size and kind are needed."))
                          .value());
    if (f.sampleCount != t.sampleCount)
        return e.fail(
            invalid(ErrorCode::SampleCount, cat(from.describe(), " has ", f.sampleCount, " samples and ", to.describe(),
                                                " has ", t.sampleCount, "; a copy needs equal counts."))
                .value());
    const auto inside = [&](const TexelCopyTextureInfo& info) -> Result<void> {
        const auto& object = *info.texture.get();
        if (info.mipLevel < object.descriptor.mipLevelCount) {
            const auto extent = object.mipSize(info.mipLevel);
            const auto depth =
                object.descriptor.dimension == TextureDimension::E3D ? extent.depthOrArrayLayers : object.layers();
            if (size.width > 0 && size.height > 0 && size.depthOrArrayLayers > 0 &&
                std::uint64_t{info.origin.x} + size.width <= extent.width &&
                std::uint64_t{info.origin.y} + size.height <= extent.height &&
                std::uint64_t{info.origin.z} + size.depthOrArrayLayers <= depth)
                return {};
        }
        return invalid(ErrorCode::OutOfRange,
                       cat("The copy of ", size.width, 'x', size.height, 'x', size.depthOrArrayLayers, " texels at ",
                           info.origin.x, ", ", info.origin.y, ", ", info.origin.z, " of mip level ", info.mipLevel,
                           " is empty or reaches outside ", object.describe(), '.'));
    };
    if (!valid(e, inside(source)) || !valid(e, inside(destination))) return;
    VkImageCopy region = {};
    region.srcSubresource = detail::subresource(source, size);
    region.srcOffset = detail::offsetOf(source);
    region.dstSubresource = detail::subresource(destination, size);
    region.dstOffset = detail::offsetOf(destination);
    const bool volume = f.dimension == TextureDimension::E3D || t.dimension == TextureDimension::E3D;
    region.extent = {size.width, size.height, volume ? size.depthOrArrayLayers : 1};
    e.recording.imageRegions.push_back(region);
    scoped(e,
           {detail::copyUse(from, region.srcSubresource, UseKind::CopySource),
            detail::copyUse(to, region.dstSubresource, UseKind::CopyDestination)},
           packet::CopyImage{&from, &to, static_cast<std::uint32_t>(e.recording.imageRegions.size() - 1)});
}

void CommandEncoder::clearBuffer(const Buffer& buffer, std::uint64_t offset, std::uint64_t size) {
    if (!encoder_ || !encoder_->ready(State::Open, "clearBuffer") || !encoder_->accept(buffer, "the buffer to clear"))
        return;
    auto& e = *encoder_;
    auto& b = *buffer.get();
    if (size == 0 && offset < b.descriptor.size) size = (b.descriptor.size - offset) & ~std::uint64_t{3};
    if (!valid(e, needUsage(b, BufferUsage::CopyDst, "clearBuffer()")) || !valid(e, range(b, offset, size, "the fill")))
        return;
    if (size % 4 != 0)
        return e.fail(invalid(ErrorCode::InvalidSize, cat("clearBuffer() of ", b.describe(), " has ", size,
                                                          " bytes; a multiple of 4 is needed."))
                          .value());
    if (size == 0) return;
    scoped(e, {detail::copyUse(b, UseKind::CopyDestination)}, packet::Fill{&b, offset, size});
}

void CommandEncoder::writeTimestamp(const QuerySet& set, std::uint32_t index) {
    if (!encoder_ || !encoder_->ready(State::Open, "writeTimestamp")) return;
    if (encoder_->queryIndex(set, QueryType::Timestamp, index, "writeTimestamp()"))
        encoder_->add(packet::Timestamp{set.get(), index, true});
}

void CommandEncoder::resolveQuerySet(const QuerySet& set, std::uint32_t first, std::uint32_t count,
                                     const Buffer& destination, std::uint64_t destinationOffset) {
    if (!encoder_ || !encoder_->ready(State::Open, "resolveQuerySet")) return;
    auto& e = *encoder_;
    if (!e.accept(set, "the query set") || !e.accept(destination, "the destination of a query resolve")) return;
    auto& q = *set.get();
    auto& b = *destination.get();
    if (std::uint64_t{first} + count > q.descriptor.count)
        return e.fail(
            invalid(ErrorCode::QueryRange, cat(q.describe(), " has ", q.descriptor.count, " queries; the queries ",
                                               first, " … ", std::uint64_t{first} + count, " were to be resolved."))
                .value());
    const std::uint64_t each = q.descriptor.type == QueryType::Timestamp ? 8 : sizeof(PipelineStatistics);
    if (!valid(e, needUsage(b, BufferUsage::QueryResolve, "a query resolve")) ||
        !valid(e, range(b, destinationOffset, each * count, "the results")))
        return;
    if (destinationOffset % 8 != 0)
        return e.fail(invalid(ErrorCode::OutOfRange, cat("Query results go to byte ", destinationOffset, " of ",
                                                         b.describe(), "; a multiple of 8 is needed."))
                          .value());
    if (count == 0) return;
    scoped(e, {detail::copyUse(b, UseKind::QueryResolve)},
           packet::ResolveQueries{&q, &b, destinationOffset, first, count});
}

void CommandEncoder::pushDebugGroup(std::string_view label) {
    if (encoder_ && encoder_->ready(State::Open, "pushDebugGroup")) encoder_->pushDebugGroup(label);
}
void CommandEncoder::popDebugGroup() {
    if (encoder_ && encoder_->ready(State::Open, "popDebugGroup")) encoder_->popDebugGroup();
}

Result<CommandBuffer> CommandEncoder::finish() {
    if (!encoder_) return invalid(ErrorCode::InvalidHandle, "finish() was called on an empty encoder.");
    auto& e = *encoder_;
    if (e.ready(State::Open, "finish") && e.debugGroups != 0)
        e.fail(
            invalid(ErrorCode::EncoderState, cat(e.debugGroups, " debug groups were left open at finish().")).value());
    e.state = State::Finished;
    if (e.error) {
        e.device->giveBack(e.recording);
        e.device->report(*e.error);
        return detail::forward(*e.error);
    }
    auto object = std::allocate_shared<detail::CommandBufferObject>(
        detail::PoolAllocator<detail::CommandBufferObject>(e.device->blocks), e.device, "CommandBuffer", e.label);
    object->recording = std::move(e.recording);
    object->counters = e.counters;
    return CommandBuffer(std::move(object));
}

const CommandBuffer::Counters& CommandBuffer::counters() const {
    return object_->counters;
}

CommandEncoder Device::createCommandEncoder(std::string label) const {
    if (!object_) return {};
    return CommandEncoder(std::allocate_shared<EncoderObject>(detail::PoolAllocator<EncoderObject>(object_->blocks),
                                                              object_, std::move(label)));
}

}  // namespace pelage::rhi
