// SPDX-License-Identifier: MIT
// A bind group is checked once, when it is made; its list of uses then serves every scope that binds it.
#include "device_object.hpp"

namespace pelage::rhi {
namespace detail {

BindGroupObject::~BindGroupObject() {
    if (set == VK_NULL_HANDLE) return;
    device->bury(lastUse, [s = set, p = pool](DeviceObject& d) { d.freeSet(s, p); });
}

void BindGroupObject::markUsed(std::uint64_t value) {
    Object::markUsed(value);
    layout->markUsed(value);
    for (const auto& resource : resources) resource->markUsed(value);
}

namespace {

struct Writer {
    DeviceObject& device;
    BindGroupObject& group;
    std::vector<VkDescriptorBufferInfo> buffers;
    std::vector<VkDescriptorImageInfo> images;
    std::vector<VkWriteDescriptorSet> writes;

    std::string where(const BindGroupLayoutEntry& e) const {
        return cat("which binding ", e.binding, " \"", e.name, "\" of ", group.describe(), " needs");
    }
    Result<void> buffer(const BindGroupLayoutEntry& e, const BufferBinding& b, BindGroupObject::Bound& bound);
    Result<void> texture(const BindGroupLayoutEntry& e, const TextureView& view);
    Result<void> sampler(const BindGroupLayoutEntry& e, const Sampler& sampler);
    void write(const BindGroupLayoutEntry& e, const VkDescriptorBufferInfo* b, const VkDescriptorImageInfo* i) {
        VkWriteDescriptorSet w = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
        w.dstSet = group.set;
        w.dstBinding = e.binding;
        w.descriptorCount = 1;
        w.descriptorType = toVk(e.type, e.hasDynamicOffset);
        w.pBufferInfo = b;
        w.pImageInfo = i;
        writes.push_back(w);
    }
    void use(const BindGroupLayoutEntry& e, Object* object, bool isTexture, UseKind kind, Range range, bool depth) {
        Use u;
        u.object = object;
        u.texture = isTexture;
        u.kind = kind;
        u.range = range;
        u.access = accessOf(kind, pipelineStages(e.visibility), depth);
        u.binding = static_cast<std::int32_t>(e.binding);
        group.uses.push_back(u);
    }
};

Result<void> Writer::buffer(const BindGroupLayoutEntry& e, const BufferBinding& b, BindGroupObject::Bound& bound) {
    const auto& object = *b.buffer.get();
    if (auto ok = needSameDevice(object, device); !ok) return ok;
    const bool uniform = e.type == BindingType::UniformBuffer;
    const auto usage = uniform ? BufferUsage::Uniform : BufferUsage::Storage;
    if (!contains(object.descriptor.usage, usage))
        return invalid(ErrorCode::InvalidUsage,
                       cat(object.describe(), " was created without ", usageNames(usage), ", ", where(e), '.'));
    const auto& limits = device.info.limits;
    const std::uint32_t alignment =
        uniform ? limits.minUniformBufferOffsetAlignment : limits.minStorageBufferOffsetAlignment;
    const std::uint64_t total = object.descriptor.size;
    if (b.offset % alignment != 0)
        return invalid(ErrorCode::OutOfRange,
                       cat(group.describe(), " binds ", object.describe(), " at offset ", b.offset, " to binding ",
                           e.binding, " \"", e.name, "\"; a multiple of ", alignment, " is needed."));
    if (b.offset >= total || b.size > total - b.offset)
        return invalid(ErrorCode::OutOfRange, cat(group.describe(), " binds the range ", b.offset, " … ",
                                                  b.offset + b.size, " of ", object.describe(), " to binding ",
                                                  e.binding, " \"", e.name, "\"; the buffer has ", total, " bytes."));
    const std::uint64_t size = b.size != 0 ? b.size : total - b.offset;
    if (size < e.minBindingSize)
        return invalid(ErrorCode::OutOfRange,
                       cat(group.describe(), " binds ", size, " bytes of ", object.describe(), " to binding ",
                           e.binding, " \"", e.name, "\"; the shader needs ", e.minBindingSize, '.'));
    const std::uint64_t limit = uniform ? limits.maxUniformBufferBindingSize : limits.maxStorageBufferBindingSize;
    if (size > limit)
        return invalid(ErrorCode::OutOfRange,
                       cat(group.describe(), " binds ", size, " bytes of ", object.describe(), " to binding ",
                           e.binding, " \"", e.name, "\"; the device allows ", limit, '.'));
    bound = {b.offset, size, total};
    buffers.push_back({object.handle, b.offset, size});
    write(e, &buffers.back(), nullptr);
    const auto kind = uniform                                        ? UseKind::UniformBuffer
                      : e.type == BindingType::ReadOnlyStorageBuffer ? UseKind::StorageBufferRead
                                                                     : UseKind::StorageBufferWrite;
    use(e, b.buffer.get(), false, kind, {}, false);
    group.resources.push_back(b.buffer.shared());
    return {};
}

Result<void> Writer::texture(const BindGroupLayoutEntry& e, const TextureView& handle) {
    const auto& view = *handle.get();
    const auto& t = view.texture->descriptor;
    if (auto ok = needSameDevice(view, device); !ok) return ok;
    const bool storage = e.type == BindingType::StorageTexture || e.type == BindingType::ReadOnlyStorageTexture;
    const auto usage = storage ? TextureUsage::StorageBinding : TextureUsage::TextureBinding;
    if (!contains(t.usage, usage))
        return invalid(ErrorCode::InvalidUsage,
                       cat(view.texture->describe(), " was created without ", usageNames(usage), ", ", where(e), '.'));
    if (*view.descriptor.dimension != e.viewDimension)
        return invalid(ErrorCode::BindingMismatch,
                       cat(view.describe(), " is a ", name(*view.descriptor.dimension), " view; binding ", e.binding,
                           " \"", e.name, "\" of ", group.describe(), " needs a ", name(e.viewDimension), " view."));
    const bool multisampled = e.type == BindingType::MultisampledTexture;
    if (multisampled != (t.sampleCount > 1) && !storage)
        return invalid(ErrorCode::SampleCount,
                       cat(view.texture->describe(), " has ", t.sampleCount,
                           t.sampleCount == 1 ? " sample" : " samples", "; binding ", e.binding, " \"", e.name,
                           "\" of ", group.describe(), " needs ", multisampled ? "more than 1." : "1."));
    if (storage && view.range.mips != 1)
        return invalid(ErrorCode::BindingMismatch,
                       cat(view.describe(), " has ", view.range.mips, " mip levels; the storage texture of binding ",
                           e.binding, " \"", e.name, "\" of ", group.describe(), " needs a view of 1."));
    const bool depth = isDepth(t.format);
    const auto kind = !storage                                        ? UseKind::Sampled
                      : e.type == BindingType::ReadOnlyStorageTexture ? UseKind::StorageTextureRead
                                                                      : UseKind::StorageTextureWrite;
    images.push_back({VK_NULL_HANDLE, view.handle, accessOf(kind, 0, depth).layout});
    write(e, nullptr, &images.back());
    use(e, view.texture.get(), true, kind, view.range, depth);
    group.resources.push_back(handle.shared());
    return {};
}

Result<void> Writer::sampler(const BindGroupLayoutEntry& e, const Sampler& handle) {
    const auto& sampler = *handle.get();
    if (auto ok = needSameDevice(sampler, device); !ok) return ok;
    // Reflection cannot tell the two kinds of sampler apart, so only a stated wish for comparison is held against it.
    if (e.type == BindingType::ComparisonSampler && sampler.descriptor.compare == CompareFunction::Undefined)
        return invalid(ErrorCode::BindingMismatch,
                       cat(sampler.describe(), " has no compare function, ", where(e), '.'));
    images.push_back({sampler.handle, VK_NULL_HANDLE, VK_IMAGE_LAYOUT_UNDEFINED});
    write(e, nullptr, &images.back());
    group.resources.push_back(handle.shared());
    return {};
}

std::string_view resourceName(const BindGroupEntry& entry) {
    constexpr std::string_view names[] = {"a buffer", "a texture view", "a sampler"};
    return names[entry.resource.index()];
}

Result<BindGroup> makeBindGroup(const std::shared_ptr<DeviceObject>& device, const BindGroupDescriptor& d) {
    auto object = std::make_shared<BindGroupObject>(device, "BindGroup", d.label);
    if (auto ok = needHandle(d.layout, cat("the layout of ", object->describe())); !ok) return forward(ok.error());
    if (auto ok = needSameDevice(*d.layout.get(), *device); !ok) return forward(ok.error());
    object->layout = d.layout.shared();
    const auto& entries = object->layout->entries;
    for (const auto& given : d.entries)
        if (object->layout->find(given.binding) == nullptr)
            return invalid(ErrorCode::BindingMismatch,
                           cat(object->describe(), " has an entry for binding ", given.binding, ", which ",
                               object->layout->describe(), " does not have."));
    // Checked in full before a set is taken, so that nothing has to be undone.
    std::vector<const BindGroupEntry*> chosen;
    for (const auto& e : entries) {
        const BindGroupEntry* found = nullptr;
        for (const auto& given : d.entries) {
            if (given.binding != e.binding) continue;
            if (found != nullptr)
                return invalid(ErrorCode::BindingMismatch, cat(object->describe(), " has two entries for binding ",
                                                               e.binding, " \"", e.name, "\"."));
            found = &given;
        }
        if (found == nullptr)
            return invalid(ErrorCode::BindingMismatch, cat(object->describe(), " has no entry for binding ", e.binding,
                                                           " \"", e.name, "\" (", name(e.type), ")."));
        const std::size_t wanted = isBuffer(e.type) ? 0 : isSampler(e.type) ? 2 : 1;
        if (found->resource.index() != wanted)
            return invalid(ErrorCode::BindingMismatch,
                           cat(object->describe(), " gives ", resourceName(*found), " to binding ", e.binding, " \"",
                               e.name, "\", which is a ", name(e.type), '.'));
        const bool empty = std::visit(
            [](const auto& r) {
                if constexpr (requires { r.buffer; })
                    return !r.buffer;
                else
                    return !r;
            },
            found->resource);
        if (empty)
            return invalid(ErrorCode::InvalidHandle, cat("An empty handle was given for binding ", e.binding, " \"",
                                                         e.name, "\" of ", object->describe(), '.'));
        chosen.push_back(found);
    }
    Writer writer{*device, *object, {}, {}, {}};
    writer.buffers.reserve(entries.size());  // the writes point into these
    writer.images.reserve(entries.size());
    object->bound.resize(entries.size());
    for (std::size_t i = 0; i < entries.size(); ++i) {
        Result<void> ok;
        if (const auto* b = std::get_if<BufferBinding>(&chosen[i]->resource))
            ok = writer.buffer(entries[i], *b, object->bound[i]);
        else if (const auto* v = std::get_if<TextureView>(&chosen[i]->resource))
            ok = writer.texture(entries[i], *v);
        else
            ok = writer.sampler(entries[i], std::get<Sampler>(chosen[i]->resource));
        if (!ok) return forward(ok.error());
    }
    auto set = device->allocateSet(object->layout->handle, object->describe());
    if (!set) return forward(set.error());
    std::tie(object->set, object->pool) = *set;
    for (auto& w : writer.writes) w.dstSet = object->set;
    device->functions.vkUpdateDescriptorSets(device->handle, static_cast<std::uint32_t>(writer.writes.size()),
                                             writer.writes.data(), 0, nullptr);
    device->nameObject(VK_OBJECT_TYPE_DESCRIPTOR_SET, object->set, d.label);
    return BindGroup(std::move(object));
}

}  // namespace
}  // namespace detail

Result<BindGroup> Device::createBindGroup(const BindGroupDescriptor& descriptor) const {
    if (auto ok = detail::needHandle(*this, "the device"); !ok) return detail::forward(ok.error());
    return object_->reported(detail::makeBindGroup(object_, descriptor));
}
const std::string& BindGroup::label() const {
    return object_->label;
}
BindGroupLayout BindGroup::layout() const {
    return BindGroupLayout(object_->layout);
}

}  // namespace pelage::rhi
