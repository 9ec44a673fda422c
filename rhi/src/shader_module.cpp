// SPDX-License-Identifier: MIT
#include "device_object.hpp"
#include "reflect.hpp"

namespace pelage::rhi {
namespace detail {

ShaderModuleObject::~ShaderModuleObject() {
    if (handle == VK_NULL_HANDLE) return;
    device->bury(lastUse, [module = handle](DeviceObject& d) {
        d.functions.vkDestroyShaderModule(d.handle, module, d.allocator);
    });
}

namespace {
Result<ShaderModule> makeShaderModule(const std::shared_ptr<DeviceObject>& device, const ShaderModuleDescriptor& d) {
    auto object = std::make_shared<ShaderModuleObject>(device, "ShaderModule", d.label);
    auto reflected = reflect(d.code, object->describe());
    if (!reflected) return forward(reflected.error());
    object->reflection = std::move(reflected->reflection);
    object->writesStorage = reflected->writesStorage;
    object->usesInt64Atomics = reflected->usesInt64Atomics;
    object->code = d.code;
    const auto features = device->info.features;
    const auto lacking = [&](Feature feature, std::string_view why) {
        return fail(ErrorKind::Unsupported, ErrorCode::MissingFeature,
                    cat(object->describe(), ' ', why, ", which needs Feature::", name(feature), "; [Device \"",
                        device->label, "\"] was not granted it."));
    };
    if (object->writesStorage && object->reflection.stage != ShaderStage::Compute &&
        !contains(features, Feature::FragmentStores))
        return lacking(Feature::FragmentStores,
                       cat("is a ", name(object->reflection.stage), " shader with writable storage"));
    if (object->usesInt64Atomics && !contains(features, Feature::Int64BufferAtomics))
        return lacking(Feature::Int64BufferAtomics, "uses 64-bit atomics");
    VkShaderModuleCreateInfo info = {VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = d.code.size() * 4;
    info.pCode = d.code.data();
    if (const auto r =
            device->functions.vkCreateShaderModule(device->handle, &info, device->allocator, &object->handle);
        r != VK_SUCCESS)
        return forward(vulkanError(r, "vkCreateShaderModule", object->describe()));
    device->nameObject(VK_OBJECT_TYPE_SHADER_MODULE, object->handle, d.label);
    return ShaderModule(std::move(object));
}
}  // namespace
}  // namespace detail

Result<ShaderModule> Device::createShaderModule(const ShaderModuleDescriptor& descriptor) const {
    if (auto ok = detail::needHandle(*this, "the device"); !ok) return detail::forward(ok.error());
    return object_->reported(detail::makeShaderModule(object_, descriptor));
}
const std::string& ShaderModule::label() const {
    return object_->label;
}
const ShaderReflection& ShaderModule::reflection() const {
    return object_->reflection;
}
const std::vector<std::uint32_t>& ShaderModule::code() const {
    return object_->code;
}

}  // namespace pelage::rhi
