// SPDX-License-Identifier: MIT
#include "device_object.hpp"

namespace pelage::rhi {

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

Diagnostic vulkanError(VkResult result, std::string_view call, std::string_view object) {
    auto text = cat(call, " for ", object, " failed with ", resultName(result), ".");
    switch (result) {
        case VK_ERROR_OUT_OF_HOST_MEMORY:
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        case VK_ERROR_OUT_OF_POOL_MEMORY:
        case VK_ERROR_FRAGMENTED_POOL:
        case VK_ERROR_TOO_MANY_OBJECTS:
            return {.code = ErrorCode::OutOfMemory, .text = std::move(text), .kind = ErrorKind::OutOfMemory};
        case VK_ERROR_DEVICE_LOST:
            return {.code = ErrorCode::DeviceLost, .text = std::move(text), .kind = ErrorKind::DeviceLost};
        case VK_ERROR_SURFACE_LOST_KHR:
        case VK_ERROR_NATIVE_WINDOW_IN_USE_KHR:
            return {.code = ErrorCode::Surface, .text = std::move(text), .kind = ErrorKind::Internal};
        default:
            return {.code = ErrorCode::DriverCall, .text = std::move(text), .kind = ErrorKind::Internal};
    }
}

void DeviceObject::report(const Diagnostics& errors) {
    const Diagnostic& error = errors.first();
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
    adapter->instance->message(LogLevel::Error, std::string(error.code.text()), toString(error));
}

void DeviceObject::loseDevice(const Diagnostic& error) {
    if (!lost.exchange(true) && onDeviceLost) onDeviceLost(error);
}

}  // namespace detail

void Device::pushErrorScope() const {
    if (!object_) return;
    const std::lock_guard lock(object_->scopeMutex);
    object_->scopes.emplace_back();
}

std::optional<Diagnostic> Device::popErrorScope() const {
    if (!object_) return std::nullopt;
    const std::lock_guard lock(object_->scopeMutex);
    if (object_->scopes.empty()) return std::nullopt;
    auto error = std::move(object_->scopes.back());
    object_->scopes.pop_back();
    return error;
}

}  // namespace pelage::rhi
