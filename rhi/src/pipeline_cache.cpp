// SPDX-License-Identifier: MIT
// The stored form: "PLGPIPE1", the size and a checksum of what follows, and the driver's own bytes. Everything else is
// in the key, so that another driver, or another version of it, finds nothing.
#include "pipeline_cache.hpp"

#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iomanip>

#include "device_object.hpp"

namespace pelage::rhi {
namespace detail {
namespace {

struct Header {
    char magic[8] = {'P', 'L', 'G', 'P', 'I', 'P', 'E', '1'};
    std::uint64_t size = 0, checksum = 0;
};

std::uint64_t fnv1a(std::span<const std::byte> bytes) {
    std::uint64_t h = 0xcbf29ce484222325ULL;
    for (const std::byte b : bytes) h = (h ^ std::to_integer<std::uint64_t>(b)) * 0x100000001b3ULL;
    return h;
}

/// Vendor, device, driver version and the driver's own identity of its caches. Mesa 22.3's lavapipe gives every version
/// one identity, so the version is part of the key as well.
std::string keyOf(const AdapterObject& adapter) {
    std::ostringstream key;
    key << "pelage-pipelines-" << std::hex << adapter.info.vendorId << '-' << adapter.info.deviceId << '-'
        << adapter.driverVersion << '-' << std::setfill('0');
    for (const std::uint8_t byte : adapter.cacheIdentity) key << std::setw(2) << static_cast<unsigned>(byte);
    return key.str();
}

/// The driver's bytes, or a word on why there are none.
tl::expected<std::vector<std::byte>, const char*> unwrap(const std::vector<std::byte>& stored) {
    const auto bad = [](const char* why) { return tl::unexpected<const char*>(why); };
    Header header, expected;
    if (stored.size() < sizeof header) return bad("it is shorter than its header");
    std::memcpy(&header, stored.data(), sizeof header);
    if (std::memcmp(header.magic, expected.magic, sizeof header.magic) != 0) return bad("it is not a pipeline cache");
    const auto payload = std::span(stored).subspan(sizeof header);
    if (header.size != payload.size() || header.checksum != fnv1a(payload)) return bad("it is damaged");
    return std::vector<std::byte>(payload.begin(), payload.end());
}

}  // namespace

Result<void> openPipelineCache(DeviceObject& device, const BlobCache& blobs) {
    if (device.pipelineCache != VK_NULL_HANDLE) return {};  // a host's
    device.blobs = blobs;
    std::vector<std::byte> initial;
    if (blobs.load) {
        const auto stored = blobs.load(keyOf(*device.adapter));
        if (!stored.empty()) {
            auto payload = unwrap(stored);
            if (payload)
                initial = std::move(*payload);
            else
                device.adapter->instance->message(
                    LogLevel::Info, "pipelines",
                    cat("the stored pipelines are not used and will be replaced: ", payload.error(), '.'));
        }
    }
    VkPipelineCacheCreateInfo info = {VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    info.initialDataSize = initial.size();
    info.pInitialData = initial.data();
    const auto& vk = device.functions;
    if (const auto r = vk.vkCreatePipelineCache(device.handle, &info, device.allocator, &device.pipelineCache);
        r != VK_SUCCESS)
        return forward(vulkanError(r, "vkCreatePipelineCache", cat("[Device \"", device.label, "\"]")));
    return {};
}

void CreationFeedback::count(DeviceObject& device) const {
    constexpr VkPipelineCreationFeedbackFlags hit =
        VK_PIPELINE_CREATION_FEEDBACK_VALID_BIT | VK_PIPELINE_CREATION_FEEDBACK_APPLICATION_PIPELINE_CACHE_HIT_BIT;
    ++device.pipelinesMade;
    if ((feedback_.flags & hit) == hit)
        ++device.pipelinesCached;
    else
        ++device.pipelinesSinceStore;
}

void storePipelineCache(DeviceObject& device) {
    if (!device.blobs.store || device.pipelineCache == VK_NULL_HANDLE || device.pipelinesSinceStore.exchange(0) == 0)
        return;
    const auto& vk = device.functions;
    std::size_t size = 0;
    if (vk.vkGetPipelineCacheData(device.handle, device.pipelineCache, &size, nullptr) != VK_SUCCESS || size == 0)
        return;
    std::vector<std::byte> bytes(sizeof(Header) + size);
    if (vk.vkGetPipelineCacheData(device.handle, device.pipelineCache, &size, bytes.data() + sizeof(Header)) !=
        VK_SUCCESS)
        return;
    bytes.resize(sizeof(Header) + size);
    Header header;
    header.size = size;
    header.checksum = fnv1a(std::span(bytes).subspan(sizeof header));
    std::memcpy(bytes.data(), &header, sizeof header);
    device.blobs.store(keyOf(*device.adapter), bytes);
}

}  // namespace detail

void Device::storePipelines() const {
    if (object_) detail::storePipelineCache(*object_);
}

BlobCache fileCache(const std::string& directory) {
    namespace fs = std::filesystem;
    BlobCache cache;
    cache.load = [directory](const std::string& key) {
        std::ifstream file(fs::path(directory) / key, std::ios::binary);
        std::vector<std::byte> bytes;
        for (char c = 0; file.get(c);) bytes.push_back(static_cast<std::byte>(c));
        return bytes;
    };
    cache.store = [directory](const std::string& key, std::span<const std::byte> bytes) {
        // Under another name first: a program that ends half way leaves the old file whole.
        std::error_code ignored;
        fs::create_directories(directory, ignored);
        // The address tells two devices of one process apart, the process number two processes.
        std::ostringstream own;
        own << '.' << ::getpid() << '.' << bytes.data();
        const fs::path path = fs::path(directory) / key, part = path.string() + own.str();
        std::ofstream file(part, std::ios::binary | std::ios::trunc);
        file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        file.close();
        if (file)
            fs::rename(part, path, ignored);
        else
            fs::remove(part, ignored);
    };
    return cache;
}

}  // namespace pelage::rhi
