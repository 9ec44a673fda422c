// SPDX-License-Identifier: MIT
#include "device_object.hpp"

#include <algorithm>

namespace pelage::rhi {
namespace detail {

SamplerObject::~SamplerObject() {
    if (handle == VK_NULL_HANDLE) return;
    device->bury(lastUse,
                 [sampler = handle](DeviceObject& d) { d.functions.vkDestroySampler(d.handle, sampler, d.allocator); });
}

namespace {
Result<Sampler> makeSampler(const std::shared_ptr<DeviceObject>& device, const SamplerDescriptor& d) {
    auto object = std::make_shared<SamplerObject>(device, "Sampler", d.label);
    object->descriptor = d;
    if (!(d.lodMinClamp >= 0 && d.lodMaxClamp >= d.lodMinClamp))
        return invalid(ErrorCode::OutOfRange,
                       cat(object->describe(), " clamps its level of detail to ", d.lodMinClamp, " … ", d.lodMaxClamp,
                           "; 0 <= lodMinClamp <= lodMaxClamp is needed."));
    if (!(d.maxAnisotropy >= 1))
        return invalid(ErrorCode::OutOfRange,
                       cat(object->describe(), " has maxAnisotropy ", d.maxAnisotropy, "; at least 1 is needed."));
    VkSamplerCreateInfo info = {VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    info.magFilter = toVk(d.magFilter);
    info.minFilter = toVk(d.minFilter);
    info.mipmapMode =
        d.mipmapFilter == FilterMode::Linear ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
    info.addressModeU = toVk(d.addressModeU);
    info.addressModeV = toVk(d.addressModeV);
    info.addressModeW = toVk(d.addressModeW);
    info.minLod = d.lodMinClamp;
    info.maxLod = d.lodMaxClamp;
    const bool one = d.addressModeU == AddressMode::ClampToBorderOne ||
                     d.addressModeV == AddressMode::ClampToBorderOne || d.addressModeW == AddressMode::ClampToBorderOne;
    info.borderColor = one ? VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE : VK_BORDER_COLOR_FLOAT_TRANSPARENT_BLACK;
    info.compareEnable = d.compare != CompareFunction::Undefined;
    info.compareOp = toVk(d.compare);
    info.anisotropyEnable = d.maxAnisotropy > 1 && contains(device->info.features, Feature::AnisotropicFiltering);
    info.maxAnisotropy = std::min(d.maxAnisotropy, 16.0F);  // every device with the feature has at least 16
    if (const auto r = device->functions.vkCreateSampler(device->handle, &info, device->allocator, &object->handle);
        r != VK_SUCCESS)
        return forward(vulkanError(r, "vkCreateSampler", object->describe()));
    device->nameObject(VK_OBJECT_TYPE_SAMPLER, object->handle, d.label);
    return Sampler(std::move(object));
}
}  // namespace
}  // namespace detail

Result<Sampler> Device::createSampler(const SamplerDescriptor& descriptor) const {
    if (auto ok = detail::needHandle(*this, "the device"); !ok) return detail::forward(ok.error());
    return object_->reported(detail::makeSampler(object_, descriptor));
}
const std::string& Sampler::label() const {
    return object_->label;
}

}  // namespace pelage::rhi
