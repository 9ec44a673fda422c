// SPDX-License-Identifier: MIT
// Bind group layouts and pipeline layouts: deduplicated by what Vulkan would call "identically defined".
#include "device_object.hpp"

#include <algorithm>

namespace pelage::rhi {
namespace detail {

BindGroupLayoutObject::~BindGroupLayoutObject() {
    if (handle == VK_NULL_HANDLE) return;
    device->bury(lastUse, [layout = handle](DeviceObject& d) {
        d.functions.vkDestroyDescriptorSetLayout(d.handle, layout, d.allocator);
    });
}

PipelineLayoutObject::~PipelineLayoutObject() {
    if (handle == VK_NULL_HANDLE) return;
    device->bury(lastUse, [layout = handle](DeviceObject& d) {
        d.functions.vkDestroyPipelineLayout(d.handle, layout, d.allocator);
    });
}

const BindGroupLayoutEntry* BindGroupLayoutObject::find(std::uint32_t binding) const {
    for (const auto& e : entries)
        if (e.binding == binding) return &e;
    return nullptr;
}

bool BindGroupLayoutObject::fits(const BindGroupLayoutObject& other) const {
    return std::equal(entries.begin(), entries.end(), other.entries.begin(), other.entries.end(),
                      [](const BindGroupLayoutEntry& a, const BindGroupLayoutEntry& b) {
                          return a.binding == b.binding && canonical(a.type) == canonical(b.type) &&
                                 a.viewDimension == b.viewDimension && a.hasDynamicOffset == b.hasDynamicOffset &&
                                 a.visibility == b.visibility;
                      });
}

Result<std::shared_ptr<BindGroupLayoutObject>> makeBindGroupLayout(const std::shared_ptr<DeviceObject>& device,
                                                                   const BindGroupLayoutDescriptor& descriptor) {
    auto object = std::make_shared<BindGroupLayoutObject>(device, "BindGroupLayout", descriptor.label);
    object->entries = descriptor.entries;
    auto& entries = object->entries;
    std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.binding < b.binding; });
    std::string key;
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const auto& e = entries[i];
        if (i > 0 && entries[i - 1].binding == e.binding)
            return invalid(ErrorCode::BindingMismatch,
                           cat(object->describe(), " has two entries for binding ", e.binding, ": \"",
                               entries[i - 1].name, "\" and \"", e.name, "\"."));
        if (!any(e.visibility))
            return invalid(ErrorCode::BindingMismatch,
                           cat(object->describe(), " entry \"", e.name, "\" is visible to no shader stage."));
        if (e.hasDynamicOffset && !isBuffer(e.type))
            return invalid(ErrorCode::BindingMismatch,
                           cat(object->describe(), " entry \"", e.name, "\" has a dynamic offset and is of the type ",
                               name(e.type), "; only buffers have dynamic offsets."));
        if (e.hasDynamicOffset) ++object->dynamicCount;
        VkDescriptorSetLayoutBinding b = {};
        b.binding = e.binding;
        b.descriptorType = toVk(e.type, e.hasDynamicOffset);
        b.descriptorCount = 1;
        b.stageFlags = toVk(e.visibility);
        bindings.push_back(b);
        key += cat(e.binding, ',', static_cast<int>(e.type), ',', static_cast<int>(e.viewDimension), ',',
                   e.hasDynamicOffset, ',', e.minBindingSize, ',', static_cast<std::uint32_t>(e.visibility), ';');
    }
    const std::lock_guard lock(device->cacheMutex);
    auto& cached = device->layoutCache[key];
    if (auto known = cached.lock()) return known;
    VkDescriptorSetLayoutCreateInfo info = {VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    info.bindingCount = static_cast<std::uint32_t>(bindings.size());
    info.pBindings = bindings.data();
    if (const auto r =
            device->functions.vkCreateDescriptorSetLayout(device->handle, &info, device->allocator, &object->handle);
        r != VK_SUCCESS)
        return forward(vulkanError(r, "vkCreateDescriptorSetLayout", object->describe()));
    device->nameObject(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, object->handle, descriptor.label);
    cached = object;
    return object;
}

Result<std::shared_ptr<PipelineLayoutObject>> makePipelineLayout(
    const std::shared_ptr<DeviceObject>& device, const std::string& label,
    std::vector<std::shared_ptr<BindGroupLayoutObject>> sets, std::uint32_t pushConstantsSize) {
    auto object = std::make_shared<PipelineLayoutObject>(device, "PipelineLayout", label);
    const auto& limits = device->info.limits;
    if (sets.size() > limits.maxBindGroups)
        return invalid(ErrorCode::OutOfRange, cat(object->describe(), " has ", sets.size(),
                                                  " bind groups; the device allows ", limits.maxBindGroups, '.'));
    pushConstantsSize = (pushConstantsSize + 3) & ~3U;
    if (pushConstantsSize > limits.maxPushConstantsSize)
        return invalid(ErrorCode::PushConstantRange,
                       cat(object->describe(), " has ", pushConstantsSize,
                           " bytes of push constants; the device allows ", limits.maxPushConstantsSize, '.'));
    while (!sets.empty() && !sets.back()) sets.pop_back();
    std::string key = cat(pushConstantsSize, ':');
    std::vector<VkDescriptorSetLayout> handles;
    for (auto& set : sets) {
        if (!set) {  // Vulkan 1.3 has no null layouts: a gap is an empty one
            auto empty = makeBindGroupLayout(device, {.label = "empty"});
            if (!empty) return forward(empty.error());
            set = *empty;
        }
        if (auto ok = needSameDevice(*set, *device); !ok) return forward(ok.error());
        key += cat(set->id, ',');
        handles.push_back(set->handle);
    }
    object->sets = std::move(sets);
    object->pushConstantsSize = pushConstantsSize;
    object->pushStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT;
    const std::lock_guard lock(device->cacheMutex);
    auto& cached = device->pipelineLayoutCache[key];
    if (auto known = cached.lock()) return known;
    const VkPushConstantRange range = {object->pushStages, 0, pushConstantsSize};
    VkPipelineLayoutCreateInfo info = {VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    info.setLayoutCount = static_cast<std::uint32_t>(handles.size());
    info.pSetLayouts = handles.data();
    info.pushConstantRangeCount = pushConstantsSize > 0 ? 1 : 0;
    info.pPushConstantRanges = &range;
    if (const auto r =
            device->functions.vkCreatePipelineLayout(device->handle, &info, device->allocator, &object->handle);
        r != VK_SUCCESS)
        return forward(vulkanError(r, "vkCreatePipelineLayout", object->describe()));
    device->nameObject(VK_OBJECT_TYPE_PIPELINE_LAYOUT, object->handle, label);
    cached = object;
    return object;
}

}  // namespace detail

Result<BindGroupLayout> Device::createBindGroupLayout(const BindGroupLayoutDescriptor& descriptor) const {
    if (auto ok = detail::needHandle(*this, "the device"); !ok) return detail::forward(ok.error());
    return object_->reported(
        detail::makeBindGroupLayout(object_, descriptor).map([](auto o) { return BindGroupLayout(std::move(o)); }));
}

Result<PipelineLayout> Device::createPipelineLayout(const PipelineLayoutDescriptor& descriptor) const {
    if (auto ok = detail::needHandle(*this, "the device"); !ok) return detail::forward(ok.error());
    std::vector<std::shared_ptr<detail::BindGroupLayoutObject>> sets;
    for (const auto& layout : descriptor.bindGroupLayouts) sets.push_back(layout.shared());
    return object_->reported(
        detail::makePipelineLayout(object_, descriptor.label, std::move(sets), descriptor.pushConstantsSize)
            .map([](auto o) { return PipelineLayout(std::move(o)); }));
}

const std::vector<BindGroupLayoutEntry>& BindGroupLayout::entries() const {
    return object_->entries;
}
const BindGroupLayoutEntry* BindGroupLayout::find(std::string_view word) const {
    if (!object_) return nullptr;
    for (const auto& e : object_->entries)
        if (e.name == word) return &e;
    return nullptr;
}

}  // namespace pelage::rhi
