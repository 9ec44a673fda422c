// SPDX-License-Identifier: MIT
#include "device_object.hpp"

#include <iomanip>

namespace pelage::rhi {

std::string toString(const Error& error) {
    std::ostringstream out;
    out << 'R' << std::setw(3) << std::setfill('0') << static_cast<unsigned>(error.code) << ": " << error.message;
    for (std::size_t i = error.context.size(); i-- > 0;)
        out << (i + 1 == error.context.size() ? " While validating " : " > ") << error.context[i]
            << (i == 0 ? "." : "");
    return out.str();
}

namespace detail {

const char* resultName(VkResult result) {
    switch (result) {
        case VK_ERROR_OUT_OF_HOST_MEMORY:
            return "VK_ERROR_OUT_OF_HOST_MEMORY";
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            return "VK_ERROR_OUT_OF_DEVICE_MEMORY";
        case VK_ERROR_OUT_OF_POOL_MEMORY:
            return "VK_ERROR_OUT_OF_POOL_MEMORY";
        case VK_ERROR_INITIALIZATION_FAILED:
            return "VK_ERROR_INITIALIZATION_FAILED";
        case VK_ERROR_DEVICE_LOST:
            return "VK_ERROR_DEVICE_LOST";
        case VK_ERROR_MEMORY_MAP_FAILED:
            return "VK_ERROR_MEMORY_MAP_FAILED";
        case VK_ERROR_LAYER_NOT_PRESENT:
            return "VK_ERROR_LAYER_NOT_PRESENT";
        case VK_ERROR_EXTENSION_NOT_PRESENT:
            return "VK_ERROR_EXTENSION_NOT_PRESENT";
        case VK_ERROR_FEATURE_NOT_PRESENT:
            return "VK_ERROR_FEATURE_NOT_PRESENT";
        case VK_ERROR_INCOMPATIBLE_DRIVER:
            return "VK_ERROR_INCOMPATIBLE_DRIVER";
        case VK_ERROR_TOO_MANY_OBJECTS:
            return "VK_ERROR_TOO_MANY_OBJECTS";
        case VK_ERROR_FORMAT_NOT_SUPPORTED:
            return "VK_ERROR_FORMAT_NOT_SUPPORTED";
        case VK_ERROR_FRAGMENTED_POOL:
            return "VK_ERROR_FRAGMENTED_POOL";
        case VK_ERROR_SURFACE_LOST_KHR:
            return "VK_ERROR_SURFACE_LOST_KHR";
        case VK_ERROR_NATIVE_WINDOW_IN_USE_KHR:
            return "VK_ERROR_NATIVE_WINDOW_IN_USE_KHR";
        case VK_ERROR_OUT_OF_DATE_KHR:
            return "VK_ERROR_OUT_OF_DATE_KHR";
        case VK_ERROR_INVALID_SHADER_NV:
            return "VK_ERROR_INVALID_SHADER_NV";
        case VK_TIMEOUT:
            return "VK_TIMEOUT";
        case VK_NOT_READY:
            return "VK_NOT_READY";
        default:
            return "VK_ERROR_UNKNOWN";
    }
}

Error vulkanError(VkResult result, std::string_view call, std::string_view object) {
    const auto text = cat(call, " for ", object, " failed with ", resultName(result), ".");
    switch (result) {
        case VK_ERROR_OUT_OF_HOST_MEMORY:
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        case VK_ERROR_OUT_OF_POOL_MEMORY:
        case VK_ERROR_FRAGMENTED_POOL:
        case VK_ERROR_TOO_MANY_OBJECTS:
            return {ErrorKind::OutOfMemory, ErrorCode::OutOfMemory, text, {}};
        case VK_ERROR_DEVICE_LOST:
            return {ErrorKind::DeviceLost, ErrorCode::DeviceLost, text, {}};
        case VK_ERROR_SURFACE_LOST_KHR:
        case VK_ERROR_NATIVE_WINDOW_IN_USE_KHR:
            return {ErrorKind::Internal, ErrorCode::Surface, text, {}};
        default:
            return {ErrorKind::Internal, ErrorCode::DriverCall, text, {}};
    }
}

void DeviceObject::report(const Error& error) {
    if (error.kind == ErrorKind::DeviceLost) loseDevice(error);
    {
        const std::lock_guard lock(scopeMutex);
        if (!scopes.empty()) {
            if (!scopes.back()) scopes.back() = error;
            return;
        }
    }
    if (onUncapturedError) {
        onUncapturedError(error);
        return;
    }
    std::ostringstream id;
    id << 'R' << std::setw(3) << std::setfill('0') << static_cast<unsigned>(error.code);
    adapter->instance->message(LogLevel::Error, id.str(), toString(error));
}

void DeviceObject::loseDevice(const Error& error) {
    if (!lost.exchange(true) && onDeviceLost) onDeviceLost(error);
}

}  // namespace detail

void Device::pushErrorScope() const {
    if (!object_) return;
    const std::lock_guard lock(object_->scopeMutex);
    object_->scopes.emplace_back();
}

std::optional<Error> Device::popErrorScope() const {
    if (!object_) return std::nullopt;
    const std::lock_guard lock(object_->scopeMutex);
    if (object_->scopes.empty()) return std::nullopt;
    auto error = std::move(object_->scopes.back());
    object_->scopes.pop_back();
    return error;
}

}  // namespace pelage::rhi
