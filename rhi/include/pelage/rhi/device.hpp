// SPDX-License-Identifier: MIT
// Instance, Adapter, Device, Queue, Surface. No global state: two instances in one process do not know each other.
#pragma once

#include <pelage/rhi/encoder.hpp>

#include <functional>

namespace pelage::rhi {

namespace detail {
struct InstanceObject;
struct AdapterObject;
struct DeviceObject;
struct SurfaceObject;
}  // namespace detail

struct Message {
    LogLevel level = LogLevel::Info;
    std::string id = {};  // of the Vulkan validation layer ("VUID-…", "SYNC-HAZARD-…"), or ours ("adapter", …)
    std::string text = {};
};
using MessageCallback = std::function<void(const Message&)>;

struct InstanceDescriptor {
    std::string label = "pelage";
    /// Loads the Khronos validation layer with synchronization validation; its messages come to `onMessage`.
    bool validation = false;
    /// Instance extensions for a window system, for example from glfwGetRequiredInstanceExtensions().
    std::vector<std::string> surfaceExtensions = {};
    MessageCallback onMessage = {};  // may be called from any thread
};

struct AdapterInfo {
    std::string name = {}, driver = {};  // driver: name, version and info
    AdapterType type = AdapterType::Unknown;
    std::uint32_t vendorId = 0, deviceId = 0;
    Feature features = Feature::None;
    Limits limits = {};
};

/// Where a device keeps what its driver made of pipelines, so that the next start need not make it again. The key names
/// the driver and its version. Both functions may be empty; they are called from the thread that opens or ends the
/// device, or calls Device::storePipelines().
struct BlobCache {
    std::function<std::vector<std::byte>(const std::string& key)> load = {};
    std::function<void(const std::string& key, std::span<const std::byte> bytes)> store = {};
};
/// One file for each key in a directory, which is made when needed. What cannot be read or written is left out.
BlobCache fileCache(const std::string& directory);

/// Switches a workaround for a driver's fault (the names are in Device::toggles() and in the error for an unknown one).
struct Toggle {
    std::string name = {};
    bool on = true;
};

struct DeviceDescriptor {
    std::string label = "device";
    Feature requiredFeatures = Feature::None;  // absent ones are an error that names them all
    /// At least these (alignments: at most); the defaults are what every device has. All that falls short is one error.
    Limits requiredLimits = {};
    Feature optionalFeatures = Feature::WideLines | Feature::PipelineStatistics | Feature::Timestamps;
    BlobCache pipelines = {};
    std::vector<Toggle> toggles = {};  // those that are not to be as the driver asks for
    /// Errors that no error scope caught. Default: written to the instance's onMessage as an Error. May be called
    /// inside a lock of the device: do not call it from there.
    std::function<void(const Diagnostic&)> onUncapturedError = {};
    /// Called once, with the first error that says so, maybe inside a lock of the device: do not call it from there.
    /// Submissions and writes afterwards fail with DeviceLost and do nothing.
    std::function<void(const Diagnostic&)> onDeviceLost = {};
};

/// A point on the queue's timeline; ordered.
struct Submission {
    std::uint64_t value = 0;
};

class Device;

class Queue {
public:
    Queue() = default;
    /// A submission that the driver refuses, for whatever reason, loses the device: what its command buffers would have
    /// changed is no longer known.
    Result<Submission> submit(std::span<const CommandBuffer> commandBuffers);
    Result<Submission> submit(const CommandBuffer& commandBuffer) { return submit(std::span(&commandBuffer, 1)); }
    /// Copies the bytes now (staging); visible to everything submitted afterwards.
    Result<void> writeBuffer(const Buffer& buffer, std::uint64_t offset, std::span<const std::byte> data);
    Result<void> writeTexture(const TexelCopyTextureInfo& destination, std::span<const std::byte> data,
                              const TexelCopyBufferLayout& layout, const Extent3D& size);
    bool isDone(Submission submission) const;
    /// Waits until the work is done. Device loss is an error, a time-out (ns) gives false.
    Result<bool> wait(Submission submission, std::uint64_t timeoutNs = ~0ULL) const;

private:
    friend class Device;
    explicit Queue(std::shared_ptr<detail::DeviceObject> device) : device_(std::move(device)) {}
    std::shared_ptr<detail::DeviceObject> device_;
};

/// Shares ownership, like every handle. Creation may be called from any thread.
class Device : public Handle<detail::DeviceObject> {
public:
    using Handle::Handle;
    const AdapterInfo& info() const;  // features: those granted
    const Limits& limits() const { return info().limits; }
    bool has(Feature feature) const { return contains(info().features, feature); }
    bool supports(TextureFormat format, TextureUsage usage, std::uint32_t sampleCount = 1) const;

    Result<Buffer> createBuffer(const BufferDescriptor& descriptor) const;
    Result<Texture> createTexture(const TextureDescriptor& descriptor) const;
    /// Memory for textures that are placed in it; what a texture would need there is memoryRequirements().
    Result<TransientHeap> createTransientHeap(const TransientHeapDescriptor& descriptor) const;
    Result<MemoryRequirements> memoryRequirements(const TextureDescriptor& descriptor) const;
    Result<Sampler> createSampler(const SamplerDescriptor& descriptor) const;
    Result<BindGroupLayout> createBindGroupLayout(const BindGroupLayoutDescriptor& descriptor) const;
    Result<BindGroup> createBindGroup(const BindGroupDescriptor& descriptor) const;
    Result<PipelineLayout> createPipelineLayout(const PipelineLayoutDescriptor& descriptor) const;
    Result<ShaderModule> createShaderModule(const ShaderModuleDescriptor& descriptor) const;
    /// Cached: equal descriptors (labels aside) give the same pipeline.
    Result<RenderPipeline> createRenderPipeline(const RenderPipelineDescriptor& descriptor) const;
    Result<ComputePipeline> createComputePipeline(const ComputePipelineDescriptor& descriptor) const;
    Result<QuerySet> createQuerySet(const QuerySetDescriptor& descriptor) const;
    CommandEncoder createCommandEncoder(std::string label = "encoder") const;

    Queue queue() const;
    /// Destroys objects that have no handle left and that no running submission uses. Called by submit(); a host may
    /// call it when idle.
    void collect() const;
    Result<void> waitIdle() const;

    void pushErrorScope() const;
    /// The first error since the matching pushErrorScope, if any.
    std::optional<Diagnostic> popErrorScope() const;

    /// Names of the workarounds that are on.
    std::vector<std::string> toggles() const;
    /// Gives new pipelines to DeviceDescriptor::pipelines; done by itself when the device ends.
    void storePipelines() const;

    struct MemoryStatistics {
        std::uint64_t allocatedBytes = 0, usedBytes = 0;  // taken from the driver; bound to live resources
        std::uint32_t allocations = 0, blocks = 0, liveBuffers = 0, liveTextures = 0, livePipelines = 0;
        /// Pipelines that the driver was asked for, and those that it had in its cache (as far as it says).
        std::uint32_t pipelinesMade = 0, pipelinesCached = 0;
    };
    MemoryStatistics memoryStatistics() const;
};

struct SurfaceConfiguration {
    Extent3D size = {};
    bool vsync = true;
    TextureUsage usage = TextureUsage::RenderAttachment | TextureUsage::CopyDst;
};
/// A window to present to. Made from a host's VkSurfaceKHR in <pelage/rhi/vulkan.hpp>.
class Surface : public Handle<detail::SurfaceObject> {
public:
    using Handle::Handle;
    Result<void> configure(const Device& device, const SurfaceConfiguration& configuration) const;
    TextureFormat format() const;  // after configure(): BGRA8Unorm, RGBA8Unorm or their Srgb forms
    Extent3D size() const;
    /// The next texture to draw on; an empty handle when the surface must be configured again (resized).
    Result<Texture> getCurrentTexture() const;
    /// False when the surface must be configured again.
    Result<bool> present() const;
};

struct AdapterOptions {
    PowerPreference powerPreference = PowerPreference::HighPerformance;
    bool allowCPU = true;           // a CPU device is chosen when there is nothing better, and said so in a message
    std::string nameContains = {};  // choose by name, for example "llvmpipe"
    Surface compatibleSurface = {};
};

class Adapter : public Handle<detail::AdapterObject> {
public:
    using Handle::Handle;
    const AdapterInfo& info() const;
    Result<Device> requestDevice(const DeviceDescriptor& descriptor = {}) const;
};

class Instance : public Handle<detail::InstanceObject> {
public:
    using Handle::Handle;
    static Result<Instance> create(const InstanceDescriptor& descriptor = {});
    std::vector<Adapter> enumerateAdapters() const;
    Result<Adapter> requestAdapter(const AdapterOptions& options = {}) const;
};

}  // namespace pelage::rhi
