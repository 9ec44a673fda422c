// SPDX-License-Identifier: MIT
// A Vulkan 1.3 driver that does no work: it makes handles, remembers which are alive, keeps what a command buffer was
// told, and signals at once. With it the whole library, and the whole renderer above it, run without a device; every
// call that can fail can be made to fail; and a HazardOracle sees every access and every barrier in the order of the
// queue.
#pragma once

#include "hazard_oracle.hpp"

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

namespace pelage::test {

class NullDriver {
public:
    NullDriver();
    NullDriver(const NullDriver&) = delete;
    NullDriver& operator=(const NullDriver&) = delete;
    ~NullDriver();

    /// For rhi::vulkan::createInstance. vkCreateInstance reaches the driver that was made last and is still there.
    static PFN_vkGetInstanceProcAddr entry();

    // --- What a test asks for.
    /// The n-th call that can fail (1 is the next) fails with `result`; 0: none does.
    void failCall(std::uint64_t n, VkResult result);
    /// Every call that can fail, by name, since the start.
    const std::vector<std::string>& calls() const { return calls_; }
    std::optional<std::string> failed() const { return failed_; }
    VkDriverId driverId = VK_DRIVER_ID_MESA_RADV;
    std::uint32_t driverVersion = VK_MAKE_API_VERSION(0, 1, 0, 0);
    bool keepCommands =
        true;  // false: neither commands nor the names of calls are kept, and nothing is allocated for them
    /// Sees the commands of each submission, in order. `dropBarrier`: the barrier call (counted from 0, since `oracle`
    /// was set) that the oracle does not see.
    HazardOracle* oracle = nullptr;
    std::optional<std::uint64_t> dropBarrier;
    std::uint64_t barrierCalls = 0;
    std::uint64_t submissions = 0, memoryAllocations = 0, pipelinesCreated = 0;
    std::uint64_t pipelinesCompiled = 0;  // those that were in no pipeline cache
    /// Objects that were made and not destroyed, "VkBuffer 12": empty at the end of a device.
    std::vector<std::string> alive() const;
    /// Calls that no correct program makes: an object destroyed twice, or used after it.
    const std::vector<std::string>& misuse() const { return misuse_; }

    struct Commands;
    struct Functions;

private:
    friend struct Functions;
    struct Buffer {
        std::uint64_t size = 0, memory = 0;
    };
    struct Image {
        VkImageCreateInfo info = {};
    };
    struct View {
        std::uint64_t image = 0;
        VkImageSubresourceRange range = {};
    };
    struct Memory {
        std::uint32_t type = 0;
        std::uint64_t size = 0;
        std::unique_ptr<std::byte[]> bytes;
    };
    /// What a shader does with one binding.
    struct ShaderUse {
        VkPipelineStageFlags2 stages = 0;
        bool reads = false, writes = false;
    };
    using ShaderUses = std::map<std::pair<std::uint32_t, std::uint32_t>, ShaderUse>;
    struct Descriptor {
        VkDescriptorType type = {};
        std::uint64_t object = 0;  // a buffer or a view
        std::uint64_t offset = 0, range = 0;
        VkImageLayout layout = {};
    };
    struct Set {
        std::uint64_t layout = 0;
        std::map<std::uint32_t, Descriptor> descriptors;
    };
    std::uint64_t make(const char* type);
    void destroy(const char* type, std::uint64_t handle);
    VkResult mayFail(const char* call);

    mutable std::recursive_mutex mutex_;
    std::uint64_t next_ = 1, failAt_ = 0;
    VkResult failResult_ = VK_SUCCESS;
    std::vector<std::string> calls_, misuse_;
    std::optional<std::string> failed_;
    std::unordered_map<std::uint64_t, const char*> alive_;
    std::unordered_map<std::uint64_t, Buffer> buffers_;
    std::unordered_map<std::uint64_t, Image> images_;
    std::unordered_map<std::uint64_t, View> views_;
    std::unordered_map<std::uint64_t, Memory> memories_;
    std::unordered_map<std::uint64_t, ShaderUses> modules_, pipelines_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> vertexBindings_;  // of pipelines
    std::unordered_map<std::uint64_t, std::map<std::uint32_t, VkDescriptorType>> setLayouts_;
    std::unordered_map<std::uint64_t, Set> sets_;
    std::unordered_map<std::uint64_t, std::set<std::uint64_t>> poolSets_;
    std::unordered_map<std::uint64_t, std::uint64_t> moduleHashes_;
    std::unordered_map<std::uint64_t, std::set<std::uint64_t>> caches_;  // hashes of pipelines
    std::unordered_map<std::uint64_t, std::uint64_t> semaphores_;        // timeline values
    std::unordered_map<std::uint64_t, std::vector<std::shared_ptr<Commands>>> pools_;
};

}  // namespace pelage::test
