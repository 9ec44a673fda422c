// SPDX-License-Identifier: MIT
#include "device_object.hpp"

namespace pelage::rhi {
namespace detail {

QuerySetObject::~QuerySetObject() {
    if (handle == VK_NULL_HANDLE) return;
    device->bury(lastUse,
                 [pool = handle](DeviceObject& d) { d.functions.vkDestroyQueryPool(d.handle, pool, d.allocator); });
}

namespace {
Result<QuerySet> makeQuerySet(const std::shared_ptr<DeviceObject>& device, const QuerySetDescriptor& d) {
    auto object = std::make_shared<QuerySetObject>(device, "QuerySet", d.label);
    object->descriptor = d;
    const auto feature = d.type == QueryType::Timestamp ? Feature::Timestamps : Feature::PipelineStatistics;
    if (!contains(device->info.features, feature))
        return fail(ErrorKind::Unsupported, ErrorCode::MissingFeature,
                    cat(object->describe(), " needs Feature::", name(feature), ", which [Device \"", device->label,
                        "\"] was not granted."));
    if (d.count == 0)
        return invalid(ErrorCode::InvalidSize, cat(object->describe(), " has no queries; 1 is the least."));
    VkQueryPoolCreateInfo info = {VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = d.type == QueryType::Timestamp ? VK_QUERY_TYPE_TIMESTAMP : VK_QUERY_TYPE_PIPELINE_STATISTICS;
    info.queryCount = d.count;
    if (d.type == QueryType::PipelineStatistics)  // results come in the order of these bits, which is our struct's
        info.pipelineStatistics = VK_QUERY_PIPELINE_STATISTIC_INPUT_ASSEMBLY_VERTICES_BIT |
                                  VK_QUERY_PIPELINE_STATISTIC_VERTEX_SHADER_INVOCATIONS_BIT |
                                  VK_QUERY_PIPELINE_STATISTIC_CLIPPING_PRIMITIVES_BIT |
                                  VK_QUERY_PIPELINE_STATISTIC_FRAGMENT_SHADER_INVOCATIONS_BIT |
                                  VK_QUERY_PIPELINE_STATISTIC_COMPUTE_SHADER_INVOCATIONS_BIT;
    if (const auto r = device->functions.vkCreateQueryPool(device->handle, &info, device->allocator, &object->handle);
        r != VK_SUCCESS)
        return forward(vulkanError(r, "vkCreateQueryPool", object->describe()));
    object->written.resize(d.count);
    device->nameObject(VK_OBJECT_TYPE_QUERY_POOL, object->handle, d.label);
    return QuerySet(std::move(object));
}
}  // namespace
}  // namespace detail

Result<QuerySet> Device::createQuerySet(const QuerySetDescriptor& descriptor) const {
    if (auto ok = detail::needHandle(*this, "the device"); !ok) return detail::forward(ok.error());
    return object_->reported(detail::makeQuerySet(object_, descriptor));
}
QueryType QuerySet::type() const {
    return object_->descriptor.type;
}
std::uint32_t QuerySet::count() const {
    return object_->descriptor.count;
}

}  // namespace pelage::rhi
