// SPDX-License-Identifier: MIT
// Buffers, textures, samplers, bind groups, shaders, pipelines and query sets: descriptors and handles.
// A handle is a small value that shares ownership. When the last one goes, the object is destroyed after the last
// submission that used it has finished. Descriptors are aggregates: every member has a default, `label` comes first.
#pragma once

#include <pelage/rhi/error.hpp>
#include <pelage/rhi/types.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace pelage::rhi {

namespace detail {
struct BufferObject;
struct TextureObject;
struct TextureViewObject;
struct SamplerObject;
struct BindGroupLayoutObject;
struct BindGroupObject;
struct PipelineLayoutObject;
struct ShaderModuleObject;
struct RenderPipelineObject;
struct ComputePipelineObject;
struct QuerySetObject;
struct CommandBufferObject;
struct TransientHeapObject;
}  // namespace detail

/// Shared ownership of one object of the device. Compares by identity.
template <class Object>
class Handle {
public:
    Handle() = default;
    explicit Handle(std::shared_ptr<Object> object) : object_(std::move(object)) {}
    explicit operator bool() const { return object_ != nullptr; }
    bool operator==(const Handle&) const = default;
    Object* get() const { return object_.get(); }
    const std::shared_ptr<Object>& shared() const { return object_; }

protected:
    std::shared_ptr<Object> object_;
};

struct BufferDescriptor {
    std::string label = {};
    std::uint64_t size = 0;  // bytes, > 0
    BufferUsage usage = BufferUsage::None;
    bool mappedAtCreation = false;
};
class Buffer : public Handle<detail::BufferObject> {
public:
    using Handle::Handle;
    const std::string& label() const;
    std::uint64_t size() const;
    BufferUsage usage() const;
    /// The bytes of a buffer with MapRead or MapWrite; persistently mapped and coherent. Read only after the submission
    /// that wrote it is done (Queue::wait). Empty for other buffers.
    std::span<std::byte> mapped() const;
    /// Calls `ready` with mapped() once everything submitted so far that uses the buffer is done: from submit(), wait()
    /// or Device::collect(), on the thread that calls it, maybe at once. With an empty span when the device was lost;
    /// not at all when the last handle went before. NotMapped for a buffer without MapRead and MapWrite.
    Result<void> mapAsync(std::function<void(std::span<std::byte>)> ready) const;
};

/// Memory that several textures share, each at its own place. See TextureDescriptor::heap.
struct TransientHeapDescriptor {
    std::string label = {};
    std::uint64_t size = 0;  // bytes, > 0
};
class TransientHeap : public Handle<detail::TransientHeapObject> {
public:
    using Handle::Handle;
    const std::string& label() const;
    std::uint64_t size() const;
};
/// What Device::memoryRequirements gives: bytes, and what an offset in a heap must be a multiple of.
struct MemoryRequirements {
    std::uint64_t size = 0, alignment = 1;
};

struct TextureDescriptor {
    std::string label = {};
    Extent3D size = {};
    std::uint32_t mipLevelCount = 1, sampleCount = 1;
    TextureDimension dimension = TextureDimension::E2D;
    TextureFormat format = TextureFormat::RGBA8Unorm;
    TextureUsage usage = TextureUsage::None;
    bool cubeCompatible = false;  // 6 layers (or a multiple) that may be viewed as a cube
    /// Places the texture in a heap; empty: memory of its own. Textures of one heap may overlap: the first use of one
    /// in a submission's order takes the bytes over, waits for the uses of those it displaces (the library's barrier),
    /// and finds undefined contents. A frame graph uses it for images whose lifetimes do not overlap.
    TransientHeap heap = {};
    std::uint64_t heapOffset = 0;
};
struct TextureViewDescriptor {
    std::string label = {};
    std::optional<TextureViewDimension> dimension = {};  // default: from the texture
    TextureAspect aspect = TextureAspect::All;           // depth formats are sampled as DepthOnly by default
    std::uint32_t baseMipLevel = 0, mipLevelCount = 0;   // count 0: all that remain
    std::uint32_t baseArrayLayer = 0, arrayLayerCount = 0;
};
class TextureView;
class Texture : public Handle<detail::TextureObject> {
public:
    using Handle::Handle;
    const std::string& label() const;
    const TextureDescriptor& descriptor() const;
    TextureFormat format() const { return descriptor().format; }
    Extent3D size() const { return descriptor().size; }
    std::uint32_t sampleCount() const { return descriptor().sampleCount; }
    /// Views are cached: the same descriptor gives the same view.
    Result<TextureView> createView(const TextureViewDescriptor& descriptor = {}) const;
    /// Bytes of device memory bound to it.
    std::uint64_t memoryBytes() const;
};
class TextureView : public Handle<detail::TextureViewObject> {
public:
    using Handle::Handle;
    Texture texture() const;
    const TextureViewDescriptor& descriptor() const;  // with the defaults filled in
};

struct SamplerDescriptor {
    std::string label = {};
    AddressMode addressModeU = AddressMode::ClampToEdge, addressModeV = AddressMode::ClampToEdge,
                addressModeW = AddressMode::ClampToEdge;
    FilterMode magFilter = FilterMode::Nearest, minFilter = FilterMode::Nearest, mipmapFilter = FilterMode::Nearest;
    float lodMinClamp = 0, lodMaxClamp = 32;
    CompareFunction compare = CompareFunction::Undefined;
    float maxAnisotropy = 1;
};
class Sampler : public Handle<detail::SamplerObject> {
public:
    using Handle::Handle;
    const std::string& label() const;
};

struct BindGroupLayoutEntry {
    std::uint32_t binding = 0;
    std::string name = {};  // as in the shader; BindGroupDescriptor entries may use it
    BindingType type = BindingType::UniformBuffer;
    TextureViewDimension viewDimension = TextureViewDimension::E2D;
    bool hasDynamicOffset = false;
    std::uint64_t minBindingSize = 0;
    ShaderStage visibility = ShaderStage::Vertex | ShaderStage::Fragment | ShaderStage::Compute;
};
struct BindGroupLayoutDescriptor {
    std::string label = {};
    std::vector<BindGroupLayoutEntry> entries = {};
};
/// Layouts are deduplicated: equal entries (names aside) give the same object, so groups fit every pipeline that
/// declares the same bindings.
class BindGroupLayout : public Handle<detail::BindGroupLayoutObject> {
public:
    using Handle::Handle;
    const std::vector<BindGroupLayoutEntry>& entries() const;  // sorted by binding
    const BindGroupLayoutEntry* find(std::string_view name) const;
};

struct BufferBinding {
    Buffer buffer = {};
    std::uint64_t offset = 0, size = 0;  // size 0: to the end
};
struct BindGroupEntry {
    std::uint32_t binding = 0;
    std::variant<BufferBinding, TextureView, Sampler> resource = {};
};
struct BindGroupDescriptor {
    std::string label = {};
    BindGroupLayout layout = {};
    std::vector<BindGroupEntry> entries = {};  // exactly one for each entry of the layout
};
class BindGroup : public Handle<detail::BindGroupObject> {
public:
    using Handle::Handle;
    const std::string& label() const;
    BindGroupLayout layout() const;
};

struct PipelineLayoutDescriptor {
    std::string label = {};
    std::vector<BindGroupLayout> bindGroupLayouts = {};  // index = set; an empty handle is an empty set
    std::uint32_t pushConstantsSize = 0;
};
class PipelineLayout : public Handle<detail::PipelineLayoutObject> {
public:
    using Handle::Handle;
};

struct ShaderModuleDescriptor {
    std::string label = {};
    std::vector<std::uint32_t> code = {};  // SPIR-V with one entry point "main"
};

/// What reflection (SPIRV-Cross) found in a module.
struct SpecConstant {
    std::string name = {};
    std::uint32_t id = 0;
    enum class Type : std::uint8_t { Bool, Int, Uint, Float } type = Type::Int;
    double defaultValue = 0;
};
enum class ScalarType : std::uint8_t { Bool, Int, Uint, Float };
struct BlockMember {
    std::string name = {};
    std::uint32_t offset = 0, size = 0;  // bytes
    ScalarType scalar = ScalarType::Float;
    std::uint32_t components = 1, columns = 1, arrayLength = 1;
};
struct ReflectedBinding {
    std::uint32_t group = 0;
    BindGroupLayoutEntry entry = {};
    std::vector<BlockMember> members = {};  // of a uniform or storage block
    std::uint32_t blockSize = 0;
};
struct ReflectedVariable {
    std::string name = {};
    std::uint32_t location = 0;
    VertexFormat format = VertexFormat::Float32;
};
struct ShaderReflection {
    ShaderStage stage = ShaderStage::None;
    std::vector<ReflectedBinding> bindings = {};
    std::vector<SpecConstant> specConstants = {};
    std::vector<BlockMember> pushConstants = {};
    std::uint32_t pushConstantsSize = 0;
    std::vector<ReflectedVariable> inputs = {}, outputs = {};
    std::array<std::uint32_t, 3> workgroupSize = {1, 1, 1};
};
class ShaderModule : public Handle<detail::ShaderModuleObject> {
public:
    using Handle::Handle;
    const std::string& label() const;
    const ShaderReflection& reflection() const;
    const std::vector<std::uint32_t>& code() const;
};

/// A value for a specialization constant, by its name in the shader.
struct ConstantEntry {
    std::string name = {};
    double value = 0;
    bool operator==(const ConstantEntry&) const = default;
};
struct ProgrammableStage {
    ShaderModule module = {};
    std::vector<ConstantEntry> constants = {};
};
struct VertexAttribute {
    VertexFormat format = VertexFormat::Float32x3;
    std::uint32_t offset = 0, shaderLocation = 0;
};
struct VertexBufferLayout {
    std::uint32_t arrayStride = 0;
    VertexStepMode stepMode = VertexStepMode::Vertex;
    std::vector<VertexAttribute> attributes = {};
};
struct PrimitiveState {
    PrimitiveTopology topology = PrimitiveTopology::TriangleList;
    FrontFace frontFace = FrontFace::CCW;
    CullMode cullMode = CullMode::None;
    bool unclippedDepth = false;
};
struct DepthStencilState {
    TextureFormat format = TextureFormat::Undefined;
    bool depthWriteEnabled = false;
    CompareFunction depthCompare = CompareFunction::Always;
    float depthBias = 0, depthBiasSlopeScale = 0;
};
struct MultisampleState {
    std::uint32_t count = 1;
    std::uint32_t mask = ~0U;
    bool alphaToCoverageEnabled = false;
};
struct ColorTargetState {
    TextureFormat format = TextureFormat::Undefined;
    std::optional<BlendState> blend = {};
    ColorWriteMask writeMask = ColorWriteMask::All;
};
struct RenderPipelineDescriptor {
    std::string label = {};
    PipelineLayout layout = {};  // empty: from reflection ("auto")
    ProgrammableStage vertex = {};
    std::vector<VertexBufferLayout> vertexBuffers = {};
    PrimitiveState primitive = {};
    std::optional<DepthStencilState> depthStencil = {};
    MultisampleState multisample = {};
    std::optional<ProgrammableStage> fragment = {};
    std::vector<ColorTargetState> targets = {};
};
/// Line width is dynamic state: RenderPassEncoder::setLineWidth, 1 at the start of a pass.
class RenderPipeline : public Handle<detail::RenderPipelineObject> {
public:
    using Handle::Handle;
    const std::string& label() const;
    /// Empty handle when the shaders use nothing of that set.
    BindGroupLayout bindGroupLayout(std::uint32_t group) const;
    std::uint32_t bindGroupCount() const;
};
struct ComputePipelineDescriptor {
    std::string label = {};
    PipelineLayout layout = {};
    ProgrammableStage compute = {};
};
class ComputePipeline : public Handle<detail::ComputePipelineObject> {
public:
    using Handle::Handle;
    const std::string& label() const;
    BindGroupLayout bindGroupLayout(std::uint32_t group) const;
};

struct QuerySetDescriptor {
    std::string label = {};
    QueryType type = QueryType::Timestamp;
    std::uint32_t count = 0;
};
class QuerySet : public Handle<detail::QuerySetObject> {
public:
    using Handle::Handle;
    QueryType type() const;
    std::uint32_t count() const;
};

}  // namespace pelage::rhi
