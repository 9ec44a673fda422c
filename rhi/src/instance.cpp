// SPDX-License-Identifier: MIT
// The loader is opened at run time and never linked, so a program without Vulkan still starts.
#include "device_object.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstring>

namespace pelage::rhi {
namespace detail {

InstanceObject::~InstanceObject() {
    if (handle == VK_NULL_HANDLE || adopted) return;
    if (messenger != VK_NULL_HANDLE) vk.vkDestroyDebugUtilsMessengerEXT(handle, messenger, nullptr);
    vk.vkDestroyInstance(handle, nullptr);
    // The loader stays open: drivers leave threads and exit handlers behind that must not be unmapped.
}

void InstanceObject::message(LogLevel level, std::string id, std::string text) const {
    if (onMessage) onMessage(Message{level, std::move(id), std::move(text)});
}

namespace {

VKAPI_ATTR VkBool32 VKAPI_CALL onDebugMessage(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                              VkDebugUtilsMessageTypeFlagsEXT,
                                              const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    const auto& instance = *static_cast<const InstanceObject*>(user);
    const auto level =
        (severity & VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT) != 0 ? LogLevel::Error : LogLevel::Warning;
    instance.message(level, data->pMessageIdName != nullptr ? data->pMessageIdName : "vulkan",
                     data->pMessage != nullptr ? data->pMessage : "");
    return VK_FALSE;
}

bool hasExtension(const std::vector<VkExtensionProperties>& all, std::string_view word) {
    return std::any_of(all.begin(), all.end(), [&](const auto& e) { return word == e.extensionName; });
}

std::vector<VkExtensionProperties> extensions(const GlobalFunctions& vk, const char* layer) {
    std::uint32_t count = 0;
    vk.vkEnumerateInstanceExtensionProperties(layer, &count, nullptr);
    std::vector<VkExtensionProperties> all(count);
    vk.vkEnumerateInstanceExtensionProperties(layer, &count, all.data());
    all.resize(count);
    return all;
}

bool hasValidationLayer(const GlobalFunctions& vk, const char* layer) {
    std::uint32_t count = 0;
    vk.vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> all(count);
    vk.vkEnumerateInstanceLayerProperties(&count, all.data());
    return std::any_of(all.begin(), all.end(), [&](const auto& l) { return std::strcmp(l.layerName, layer) == 0; });
}

Result<PFN_vkGetInstanceProcAddr> openLoader() {
    void* library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) library = dlopen("libvulkan.so", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr)
        return fail(ErrorKind::Unsupported, ErrorCode::NoLoader,
                    "The Vulkan loader libvulkan.so.1 could not be opened; install \"libvulkan1\" and a driver, for "
                    "example \"mesa-vulkan-drivers\".");
    const auto entry = reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr"));
    if (entry == nullptr)
        return fail(ErrorKind::Unsupported, ErrorCode::NoLoader,
                    "The library libvulkan.so.1 has no vkGetInstanceProcAddr; it is not a Vulkan loader.");
    return entry;
}

}  // namespace

Result<std::shared_ptr<InstanceObject>> makeInstance(const InstanceDescriptor& descriptor,
                                                     PFN_vkGetInstanceProcAddr getProcAddr) {
    auto object = std::make_shared<InstanceObject>();
    object->label = descriptor.label;
    object->onMessage = descriptor.onMessage;
    object->getProcAddr = getProcAddr;
    auto& global = object->global;
#define PELAGE_VK_GLOBAL(name) global.name = reinterpret_cast<PFN_##name>(object->getProcAddr(nullptr, #name));
#include "functions.def"

    constexpr const char* layer = "VK_LAYER_KHRONOS_validation";
    if (descriptor.validation && !hasValidationLayer(global, layer))
        return fail(ErrorKind::Unsupported, ErrorCode::MissingLayer,
                    cat("Validation was asked for and the layer ", layer,
                        " is not installed; install \"vulkan-validationlayers\"."));
    const auto available = extensions(global, nullptr);
    std::vector<const char*> enabled;
    object->debugUtils = hasExtension(available, VK_EXT_DEBUG_UTILS_EXTENSION_NAME) || descriptor.validation;
    if (object->debugUtils) enabled.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    for (const auto& extension : descriptor.surfaceExtensions) {
        if (!hasExtension(available, extension))
            return fail(ErrorKind::Unsupported, ErrorCode::MissingFeature,
                        cat("[Instance \"", descriptor.label, "\"] needs the extension ", extension,
                            ", which the Vulkan loader does not offer."));
        enabled.push_back(extension.c_str());
        object->surfaces = object->surfaces || extension == VK_KHR_SURFACE_EXTENSION_NAME;
    }

    VkDebugUtilsMessengerCreateInfoEXT messenger = {VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    messenger.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType =
        VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    messenger.pfnUserCallback = onDebugMessage;
    messenger.pUserData = object.get();

    const VkValidationFeatureEnableEXT synchronization = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features = {VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &synchronization;
    features.pNext = &messenger;
    if (descriptor.validation && hasExtension(extensions(global, layer), VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME))
        enabled.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);

    VkApplicationInfo application = {VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.pApplicationName = descriptor.label.c_str();
    application.pEngineName = "pelage";
    application.apiVersion = VK_API_VERSION_1_3;
    VkInstanceCreateInfo info = {VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pApplicationInfo = &application;
    if (descriptor.validation) info.pNext = &features;
    info.enabledLayerCount = descriptor.validation ? 1 : 0;
    info.ppEnabledLayerNames = &layer;
    info.enabledExtensionCount = static_cast<std::uint32_t>(enabled.size());
    info.ppEnabledExtensionNames = enabled.data();
    if (const auto r = global.vkCreateInstance(&info, nullptr, &object->handle); r != VK_SUCCESS)
        return forward(vulkanError(r, "vkCreateInstance", cat("[Instance \"", descriptor.label, "\"]")));

    if (auto loaded = loadInstance(*object); !loaded) return forward(loaded.error());
    const auto& vk = object->vk;
    if (object->debugUtils && descriptor.validation && vk.vkCreateDebugUtilsMessengerEXT != nullptr)
        vk.vkCreateDebugUtilsMessengerEXT(object->handle, &messenger, nullptr, &object->messenger);
    return object;
}

Result<void> loadInstance(InstanceObject& instance) {
    auto& vk = instance.vk;
    std::string missing;
#define PELAGE_VK_INSTANCE(name)                                                          \
    vk.name = reinterpret_cast<PFN_##name>(instance.getProcAddr(instance.handle, #name)); \
    if (vk.name == nullptr) missing += " " #name;
#define PELAGE_VK_INSTANCE_OPTIONAL(name) \
    vk.name = reinterpret_cast<PFN_##name>(instance.getProcAddr(instance.handle, #name));
#include "functions.def"
    if (!missing.empty())
        return fail(ErrorKind::Unsupported, ErrorCode::NoLoader, cat("The Vulkan loader lacks", missing, "."));
    return {};
}

}  // namespace detail

Result<Instance> Instance::create(const InstanceDescriptor& descriptor) {
    const auto entry = detail::openLoader();
    if (!entry) return detail::forward(entry.error());
    return vulkan::createInstance(descriptor, *entry);
}

Result<Instance> vulkan::createInstance(const InstanceDescriptor& descriptor,
                                        PFN_vkGetInstanceProcAddr getInstanceProcAddr) {
    if (getInstanceProcAddr == nullptr)
        return detail::invalid(ErrorCode::InvalidHandle, "An empty handle was given for vkGetInstanceProcAddr.");
    return detail::makeInstance(descriptor, getInstanceProcAddr).map([](auto object) {
        return Instance(std::move(object));
    });
}

std::vector<Adapter> Instance::enumerateAdapters() const {
    if (!object_) return {};
    std::uint32_t count = 0;
    object_->vk.vkEnumeratePhysicalDevices(object_->handle, &count, nullptr);
    std::vector<VkPhysicalDevice> devices(count);
    object_->vk.vkEnumeratePhysicalDevices(object_->handle, &count, devices.data());
    devices.resize(count);
    std::vector<Adapter> adapters;
    for (auto* device : devices)
        if (auto adapter = detail::inspectAdapter(object_, device)) adapters.emplace_back(std::move(adapter));
    return adapters;
}

}  // namespace pelage::rhi
