// SPDX-License-Identifier: MIT
#include "gpu.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace pelage::app {

namespace {

/// PELAGE_CACHE, or the user's cache; without either, nothing is kept.
rhi::BlobCache pipelineCache() {
    const char* chosen = std::getenv("PELAGE_CACHE");
    if (chosen != nullptr) return *chosen != 0 ? rhi::fileCache(chosen) : rhi::BlobCache();
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != 0)
        return rhi::fileCache(std::string(cache) + "/pelage");
    const char* home = std::getenv("HOME");
    return home != nullptr && *home != 0 ? rhi::fileCache(std::string(home) + "/.cache/pelage") : rhi::BlobCache();
}

std::string adapterNames(const rhi::Instance& instance) {
    std::string names;
    for (const rhi::Adapter& adapter : instance.enumerateAdapters()) {
        names += (names.empty() ? "\"" : ", \"") + adapter.info().name + "\"";
    }
    return names;
}

}  // namespace

Result<Gpu> openInstance(const DeviceOptions& options, std::vector<std::string> surfaceExtensions) {
    Gpu gpu;
    auto instance = rhi::Instance::create({
        .label = "pelage",
        .validation = options.validation,
        .surfaceExtensions = std::move(surfaceExtensions),
        .onMessage =
            [errors = gpu.validationErrors](const rhi::Message& message) {
                if (message.level != rhi::LogLevel::Error) return;
                errors->fetch_add(1);
                warn(message.id + ": " + message.text);
            },
    });
    if (!instance) return tl::unexpected(instance.error());
    gpu.instance = *instance;
    return gpu;
}

Result<void> openDevice(Gpu& gpu, const DeviceOptions& options, const rhi::Surface& surface) {
    auto adapter = gpu.instance.requestAdapter({.nameContains = options.name, .compatibleSurface = surface});
    if (!adapter) {
        const std::string names = adapterNames(gpu.instance);
        if (options.name.empty() || names.empty()) {
            Diagnostic none = adapter.error().first();
            none.hint = "install a Vulkan 1.3 driver; mesa-vulkan-drivers has one that needs no GPU";
            return tl::unexpected(std::move(none));
        }
        return tl::unexpected(
            failure("A030", "no device has \"" + options.name + "\" in its name; there are " + names));
    }
    gpu.adapter = *adapter;
    auto device = gpu.adapter.requestDevice({.label = "pelage", .pipelines = pipelineCache()});
    if (!device) return tl::unexpected(device.error());
    gpu.device = *device;
    return {};
}

Result<Gpu> openGpu(const DeviceOptions& options) {
    auto gpu = openInstance(options);
    if (!gpu) return gpu;
    if (auto opened = openDevice(*gpu, options); !opened) return tl::unexpected(opened.error());
    return gpu;
}

Result<hair::Renderer> makeRenderer(const Gpu& gpu, const std::shared_ptr<const passes::PassTree>& tree, bool measure) {
    auto renderer = hair::Renderer::create({.device = gpu.device, .tree = tree, .measure = measure});
    if (!renderer) return tl::unexpected(renderer.error());
    return std::move(*renderer);
}

int finish(const Gpu& gpu) {
    const int errors = gpu.validationErrors->load();
    if (errors == 0) return exitOk;
    return report(failure("A031", "the validation layer reported " + std::to_string(errors) + " errors, listed above"));
}

}  // namespace pelage::app
