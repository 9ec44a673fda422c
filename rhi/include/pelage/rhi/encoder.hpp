// SPDX-License-Identifier: MIT
// Recording. Encoders write a packet stream of our own; Vulkan is spoken when the command buffer is submitted. Barriers
// are the library's: uses are merged per scope (a render pass; each dispatch of a compute pass; each copy), conflicts
// inside a scope are errors, and at most one vkCmdPipelineBarrier2 stands at each scope boundary.
// Errors are sticky: the first is kept with its context and comes out of finish().
#pragma once

#include <pelage/rhi/resources.hpp>

#include <functional>

namespace pelage::rhi {

namespace detail {
struct EncoderObject;
}

struct RenderPassColorAttachment {
    TextureView view = {};
    TextureView resolveTarget = {};
    LoadOp loadOp = LoadOp::Clear;
    StoreOp storeOp = StoreOp::Store;
    Color clearValue = {};
};
struct RenderPassDepthStencilAttachment {
    TextureView view = {};
    LoadOp depthLoadOp = LoadOp::Clear;
    StoreOp depthStoreOp = StoreOp::Store;
    float depthClearValue = 1;
    bool depthReadOnly = false;  // may then be sampled in the same pass; loadOp and storeOp are ignored
};
struct TimestampWrites {
    QuerySet querySet = {};
    std::optional<std::uint32_t> beginningOfPassWriteIndex = {}, endOfPassWriteIndex = {};
};
struct RenderPassDescriptor {
    std::string label = {};
    std::vector<RenderPassColorAttachment> colorAttachments = {};
    std::optional<RenderPassDepthStencilAttachment> depthStencilAttachment = {};
    std::optional<TimestampWrites> timestampWrites = {};
    /// A PipelineStatistics query around the whole pass.
    QuerySet statistics = {};
    std::uint32_t statisticsIndex = 0;
};
struct ComputePassDescriptor {
    std::string label = {};
    std::optional<TimestampWrites> timestampWrites = {};
};

/// Valid between beginRenderPass() and end(). Viewport and scissor cover the attachments at the start.
class RenderPassEncoder {
public:
    RenderPassEncoder() = default;
    void setPipeline(const RenderPipeline& pipeline);
    void setBindGroup(std::uint32_t index, const BindGroup& group, std::span<const std::uint32_t> dynamicOffsets = {});
    void setVertexBuffer(std::uint32_t slot, const Buffer& buffer, std::uint64_t offset = 0);
    void setIndexBuffer(const Buffer& buffer, IndexFormat format, std::uint64_t offset = 0);
    void setPushConstants(std::uint32_t offset, std::span<const std::byte> bytes);
    void setViewport(float x, float y, float width, float height, float minDepth = 0, float maxDepth = 1);
    void setScissorRect(std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height);
    /// Pixels; clamped to what the device can do (1 without Feature::WideLines).
    void setLineWidth(float width);
    void draw(std::uint32_t vertexCount, std::uint32_t instanceCount = 1, std::uint32_t firstVertex = 0,
              std::uint32_t firstInstance = 0);
    void drawIndexed(std::uint32_t indexCount, std::uint32_t instanceCount = 1, std::uint32_t firstIndex = 0,
                     std::int32_t baseVertex = 0, std::uint32_t firstInstance = 0);
    /// The arguments of draw() as four u32 at a multiple of 4 in a buffer with BufferUsage::Indirect. How far the
    /// vertices reach is known only on the device and is not checked; firstInstance must be 0.
    void drawIndirect(const Buffer& buffer, std::uint64_t offset = 0);
    /// The arguments of drawIndexed() as five 32-bit words.
    void drawIndexedIndirect(const Buffer& buffer, std::uint64_t offset = 0);
    void pushDebugGroup(std::string_view label);
    void popDebugGroup();
    void end();

private:
    friend class CommandEncoder;
    explicit RenderPassEncoder(std::shared_ptr<detail::EncoderObject> encoder) : encoder_(std::move(encoder)) {}
    std::shared_ptr<detail::EncoderObject> encoder_;
};

/// Valid between beginComputePass() and end(). Each dispatch is a scope of its own.
class ComputePassEncoder {
public:
    ComputePassEncoder() = default;
    void setPipeline(const ComputePipeline& pipeline);
    void setBindGroup(std::uint32_t index, const BindGroup& group, std::span<const std::uint32_t> dynamicOffsets = {});
    void setPushConstants(std::uint32_t offset, std::span<const std::byte> bytes);
    void dispatchWorkgroups(std::uint32_t x, std::uint32_t y = 1, std::uint32_t z = 1);
    /// The three counts as u32 at a multiple of 4 in a buffer with BufferUsage::Indirect.
    void dispatchWorkgroupsIndirect(const Buffer& buffer, std::uint64_t offset = 0);
    void pushDebugGroup(std::string_view label);
    void popDebugGroup();
    void end();

private:
    friend class CommandEncoder;
    explicit ComputePassEncoder(std::shared_ptr<detail::EncoderObject> encoder) : encoder_(std::move(encoder)) {}
    std::shared_ptr<detail::EncoderObject> encoder_;
};

struct TexelCopyBufferLayout {
    std::uint64_t offset = 0;
    std::uint32_t bytesPerRow = 0;   // 0: tightly packed
    std::uint32_t rowsPerImage = 0;  // 0: tightly packed
};
struct TexelCopyBufferInfo {
    Buffer buffer = {};
    TexelCopyBufferLayout layout = {};
};
struct TexelCopyTextureInfo {
    Texture texture = {};
    std::uint32_t mipLevel = 0;
    Origin3D origin = {};  // z: array layer or depth
    TextureAspect aspect = TextureAspect::All;
};

/// Single use. One encoder belongs to one thread at a time; different encoders may record on different threads.
class CommandBuffer : public Handle<detail::CommandBufferObject> {
public:
    using Handle::Handle;
    /// vkCmdPipelineBarrier2 calls that replaying it issues, draws and dispatches: work counters without a clock.
    /// `barriers` depends on what ran before and is known once the buffer is submitted; 0 until then.
    struct Counters {
        std::uint32_t barriers = 0, draws = 0, dispatches = 0, copies = 0, renderPasses = 0;
    };
    const Counters& counters() const;
};

class CommandEncoder {
public:
    CommandEncoder() = default;
    RenderPassEncoder beginRenderPass(const RenderPassDescriptor& descriptor);
    ComputePassEncoder beginComputePass(const ComputePassDescriptor& descriptor = {});
    void copyBufferToBuffer(const Buffer& source, std::uint64_t sourceOffset, const Buffer& destination,
                            std::uint64_t destinationOffset, std::uint64_t size);
    void copyBufferToTexture(const TexelCopyBufferInfo& source, const TexelCopyTextureInfo& destination,
                             const Extent3D& size);
    void copyTextureToBuffer(const TexelCopyTextureInfo& source, const TexelCopyBufferInfo& destination,
                             const Extent3D& size);
    void copyTextureToTexture(const TexelCopyTextureInfo& source, const TexelCopyTextureInfo& destination,
                              const Extent3D& size);
    void clearBuffer(const Buffer& buffer, std::uint64_t offset = 0, std::uint64_t size = 0);  // size 0: to the end
    void writeTimestamp(const QuerySet& set, std::uint32_t index);
    /// Timestamps: u64 ticks (Limits::timestampPeriod ns each). Statistics: rhi::PipelineStatistics each.
    void resolveQuerySet(const QuerySet& set, std::uint32_t first, std::uint32_t count, const Buffer& destination,
                         std::uint64_t destinationOffset);
    void pushDebugGroup(std::string_view label);
    void popDebugGroup();
    Result<CommandBuffer> finish();

private:
    friend class Device;
    explicit CommandEncoder(std::shared_ptr<detail::EncoderObject> encoder) : encoder_(std::move(encoder)) {}
    std::shared_ptr<detail::EncoderObject> encoder_;
};

}  // namespace pelage::rhi
