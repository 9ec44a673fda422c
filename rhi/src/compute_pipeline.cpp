// SPDX-License-Identifier: MIT
#include "pipeline.hpp"
#include "pipeline_cache.hpp"

namespace pelage::rhi {
namespace detail {
namespace {

Result<ComputePipeline> makeComputePipeline(const std::shared_ptr<DeviceObject>& device,
                                            const ComputePipelineDescriptor& d) {
    auto object = std::make_shared<ComputePipelineObject>(device, "ComputePipeline", d.label);
    auto stage = makeStage(*device, d.compute, ShaderStage::Compute, object->describe());
    if (!stage) return forward(stage.error());
    auto layout = layoutFor(device, d.layout, std::span(&*stage, 1), d.label, object->describe());
    if (!layout) return forward(layout.error());
    object->layout = *layout;
    const auto key = cat("compute;", keyOf(*stage), object->layout->id);
    if (auto known = findPipeline(*device, key))
        return ComputePipeline(std::static_pointer_cast<ComputePipelineObject>(known));
    VkComputePipelineCreateInfo info = {VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage = stage->create();
    info.layout = object->layout->handle;
    CreationFeedback feedback;
    info.pNext = feedback.chain(nullptr);
    if (const auto r = device->functions.vkCreateComputePipelines(device->handle, device->pipelineCache, 1, &info,
                                                                  device->allocator, &object->handle);
        r != VK_SUCCESS)
        return forward(vulkanError(r, "vkCreateComputePipelines", object->describe()));
    feedback.count(*device);
    object->key = key;
    ++device->livePipelines;
    device->nameObject(VK_OBJECT_TYPE_PIPELINE, object->handle, d.label);
    return ComputePipeline(std::static_pointer_cast<ComputePipelineObject>(enterPipeline(*device, std::move(object))));
}

}  // namespace
}  // namespace detail

Result<ComputePipeline> Device::createComputePipeline(const ComputePipelineDescriptor& descriptor) const {
    if (auto ok = detail::needHandle(*this, "the device"); !ok) return detail::forward(ok.error());
    return object_->reported(detail::makeComputePipeline(object_, descriptor));
}
const std::string& ComputePipeline::label() const {
    return object_->label;
}
BindGroupLayout ComputePipeline::bindGroupLayout(std::uint32_t group) const {
    if (!object_ || group >= object_->layout->sets.size()) return {};
    const auto& set = object_->layout->sets[group];
    return set->entries.empty() ? BindGroupLayout() : BindGroupLayout(set);
}

}  // namespace pelage::rhi
