// SPDX-License-Identifier: MIT
// What render and compute pipelines share: specialization, layouts from reflection, the cache.
#pragma once

#include "device_object.hpp"

namespace pelage::rhi::detail {

/// Owns what a VkPipelineShaderStageCreateInfo points to.
struct Stage {
    const ShaderModuleObject* module = nullptr;
    ShaderStage stage = ShaderStage::None;
    std::vector<VkSpecializationMapEntry> map;
    std::vector<std::uint32_t> data;
    VkSpecializationInfo info = {};
    VkPipelineShaderStageCreateInfo create() const;
};
Result<Stage> makeStage(const DeviceObject& device, const ProgrammableStage& stage, ShaderStage expected,
                        const std::string& object);

/// The given layout, checked against the stages, or one made from their reflection.
Result<std::shared_ptr<PipelineLayoutObject>> layoutFor(const std::shared_ptr<DeviceObject>& device,
                                                        const PipelineLayout& given, std::span<const Stage> stages,
                                                        const std::string& label, const std::string& object);

/// The part of a cache key that belongs to a stage.
std::string keyOf(const Stage& stage);

/// A cached pipeline of this key, or null.
std::shared_ptr<PipelineObject> findPipeline(DeviceObject& device, const std::string& key);
/// Enters a new pipeline; another thread's equal one wins when it came first.
std::shared_ptr<PipelineObject> enterPipeline(DeviceObject& device, std::shared_ptr<PipelineObject> made);

}  // namespace pelage::rhi::detail
