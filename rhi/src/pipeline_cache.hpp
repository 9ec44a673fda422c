// SPDX-License-Identifier: MIT
// What a driver keeps of its pipelines, between runs of a program.
#pragma once

#include <pelage/rhi/device.hpp>

#include "vk.hpp"

namespace pelage::rhi::detail {

struct DeviceObject;

/// Makes the device's cache, from what was stored for this very driver if that is whole.
Result<void> openPipelineCache(DeviceObject& device, const BlobCache& blobs);
/// Asks the driver whether it had a pipeline already; count() once it is made.
class CreationFeedback {
public:
    const void* chain(const void* next) {
        info_.pNext = next;
        info_.pPipelineCreationFeedback = &feedback_;
        return &info_;
    }
    void count(DeviceObject& device) const;

private:
    VkPipelineCreationFeedback feedback_ = {};
    VkPipelineCreationFeedbackCreateInfo info_ = {VK_STRUCTURE_TYPE_PIPELINE_CREATION_FEEDBACK_CREATE_INFO};
};
/// Stores it when pipelines were made since.
void storePipelineCache(DeviceObject& device);

}  // namespace pelage::rhi::detail
