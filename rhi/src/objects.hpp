// SPDX-License-Identifier: MIT
// The objects behind the handles. Each child of a device keeps the device alive; when it goes, the device keeps its
// Vulkan objects until the timeline has reached the value of their last use, and then destroys them.
#pragma once

#include <pelage/rhi/device.hpp>

#include <atomic>
#include <functional>
#include <mutex>
#include <unordered_map>

#include "convert.hpp"
#include "memory.hpp"
#include "text.hpp"
#include "tracking.hpp"

namespace pelage::rhi::detail {

struct DeviceObject;
struct TextureViewObject;
struct TransientHeapObject;

struct Object {
    Object(std::shared_ptr<DeviceObject> owner, std::string_view kindName, std::string objectLabel);
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;
    virtual ~Object() = default;
    /// The object, and what it stands for, is used by the submission with this value.
    virtual void markUsed(std::uint64_t value) { lastUse.store(value, std::memory_order_relaxed); }
    /// `[Buffer "lights"]`
    std::string describe() const { return cat('[', kind, " \"", label, "\"]"); }

    std::shared_ptr<DeviceObject> device;
    std::string_view kind;
    std::string label;
    std::uint64_t id = 0;  // never used twice in one device, so it may stand in cache keys
    std::atomic<std::uint64_t> lastUse{0};
    std::atomic<std::uint64_t> keptBy{0};  // the recording that asked last
};

struct BufferObject final : Object {
    using Object::Object;
    ~BufferObject() override;
    BufferDescriptor descriptor;
    VkBuffer handle = VK_NULL_HANDLE;
    Allocation allocation;
    bool ownsBuffer = true;  // false: a host's
    std::function<void()> onRelease;
    AccessState state;  // under the queue's mutex
};

struct TextureObject final : Object, std::enable_shared_from_this<TextureObject> {
    using Object::Object;
    ~TextureObject() override;
    std::uint32_t layers() const {
        return descriptor.dimension == TextureDimension::E3D ? 1 : descriptor.size.depthOrArrayLayers;
    }
    Extent3D mipSize(std::uint32_t mip) const;
    void markUsed(std::uint64_t value) override;
    TextureDescriptor descriptor;
    VkImage handle = VK_NULL_HANDLE;
    Allocation allocation;  // none when it is placed in a heap
    std::uint64_t bytes = 0;
    std::function<void()> onRelease;
    bool ownsImage = true;  // false: a swapchain's or a host's
    // Under the queue's mutex. Shared, because a heap must still know how a texture was used when the texture is gone.
    std::shared_ptr<TextureState> state = std::make_shared<TextureState>();
    std::shared_ptr<TransientHeapObject> heap;
    std::mutex viewMutex;
    // A view keeps its texture, so the cache must not keep the view.
    std::vector<std::pair<TextureViewDescriptor, std::weak_ptr<TextureViewObject>>> views;
};

struct TextureViewObject final : Object {
    using Object::Object;
    ~TextureViewObject() override;
    void markUsed(std::uint64_t value) override {
        Object::markUsed(value);
        texture->markUsed(value);
    }
    std::shared_ptr<TextureObject> texture;
    TextureViewDescriptor descriptor;
    Range range;
    Extent3D size;  // of the base mip
    VkImageView handle = VK_NULL_HANDLE;
};

struct SamplerObject final : Object {
    using Object::Object;
    ~SamplerObject() override;
    SamplerDescriptor descriptor;
    VkSampler handle = VK_NULL_HANDLE;
};

struct BindGroupLayoutObject final : Object {
    using Object::Object;
    ~BindGroupLayoutObject() override;
    const BindGroupLayoutEntry* find(std::uint32_t binding) const;
    /// Would a group made for `other` serve here? Names do not matter; sizes are checked against what is bound.
    bool fits(const BindGroupLayoutObject& other) const;
    std::vector<BindGroupLayoutEntry> entries;
    std::uint32_t dynamicCount = 0;
    VkDescriptorSetLayout handle = VK_NULL_HANDLE;
};

/// One resource of a scope or a bind group.
struct Use {
    Object* object = nullptr;  // a BufferObject or a TextureObject
    bool texture = false;
    UseKind kind = UseKind::UniformBuffer;
    Range range = {};
    Access access = {};
    std::int32_t group = -1, binding = -1;  // where it is bound, for messages
    std::int32_t next = -1;                 // the next use of the same object in the scope
};

struct BindGroupObject final : Object {
    using Object::Object;
    ~BindGroupObject() override;
    void markUsed(std::uint64_t value) override;
    std::shared_ptr<BindGroupLayoutObject> layout;
    VkDescriptorSet set = VK_NULL_HANDLE;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    std::vector<Use> uses;
    std::vector<std::shared_ptr<Object>> resources;
    struct Bound {
        std::uint64_t offset = 0, size = 0, bufferSize = 0;
    };
    std::vector<Bound> bound;  // beside layout->entries
};

struct PipelineLayoutObject final : Object {
    using Object::Object;
    ~PipelineLayoutObject() override;
    std::vector<std::shared_ptr<BindGroupLayoutObject>> sets;  // null: an empty set
    std::uint32_t pushConstantsSize = 0;
    VkShaderStageFlags pushStages = 0;
    VkPipelineLayout handle = VK_NULL_HANDLE;
};

struct ShaderModuleObject final : Object {
    using Object::Object;
    ~ShaderModuleObject() override;
    ShaderReflection reflection;
    std::vector<std::uint32_t> code;
    bool writesStorage = false, usesInt64Atomics = false;
    VkShaderModule handle = VK_NULL_HANDLE;
};

struct PipelineObject : Object {
    using Object::Object;
    ~PipelineObject() override;
    void markUsed(std::uint64_t value) override {
        Object::markUsed(value);
        layout->markUsed(value);
        for (const auto& set : layout->sets)
            if (set) set->markUsed(value);
    }
    std::shared_ptr<PipelineLayoutObject> layout;
    std::string key;
    VkPipeline handle = VK_NULL_HANDLE;
};
struct RenderPipelineObject final : PipelineObject {
    using PipelineObject::PipelineObject;
    std::vector<TextureFormat> colorFormats;
    TextureFormat depthFormat = TextureFormat::Undefined;
    bool writesDepth = false;
    std::uint32_t sampleCount = 1;
    struct VertexSlot {
        bool used = false;
        VertexStepMode stepMode = VertexStepMode::Vertex;
        std::uint32_t stride = 0, lastByte = 0;  // one element reaches this far
    };
    std::vector<VertexSlot> vertexSlots;
};
struct ComputePipelineObject final : PipelineObject {
    using PipelineObject::PipelineObject;
};

struct QuerySetObject final : Object {
    using Object::Object;
    ~QuerySetObject() override;
    QuerySetDescriptor descriptor;
    VkQueryPool handle = VK_NULL_HANDLE;
    std::vector<bool> written;  // under the queue's mutex; a query that was never written resolves to zero
};

/// The object of a handle, or an error that says which argument was empty.
template <class H>
Result<void> needHandle(const H& handle, std::string_view what) {
    if (!handle) return invalid(ErrorCode::InvalidHandle, cat("An empty handle was given for ", what, "."));
    return {};
}
/// The checks of a texture's descriptor that hold for a host's image as well.
Result<void> checkDescriptor(const TextureObject& texture);
Result<void> needSameDevice(const Object& object, const DeviceObject& device);

}  // namespace pelage::rhi::detail
