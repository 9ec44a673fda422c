// SPDX-License-Identifier: MIT
// Instance, adapter and device behind their handles, and what a device does for all its children: errors,
// destruction after the last use, descriptor pools, caches, the queue.
#pragma once

#include <deque>
#include <functional>
#include <map>

#include "block_pool.hpp"
#include "objects.hpp"
#include "toggles.hpp"

#include <pelage/rhi/vulkan.hpp>

namespace pelage::rhi::detail {

struct InstanceObject {
    ~InstanceObject();
    void message(LogLevel level, std::string id, std::string text) const;
    std::string label;
    MessageCallback onMessage;
    GlobalFunctions global;
    InstanceFunctions vk;
    PFN_vkGetInstanceProcAddr getProcAddr = nullptr;
    VkInstance handle = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
    bool debugUtils = false, surfaces = false;
    bool adopted = false;  // a host's: not destroyed
};

struct AdapterObject {
    std::shared_ptr<InstanceObject> instance;
    VkPhysicalDevice handle = VK_NULL_HANDLE;
    AdapterInfo info;
    VkDriverId driverId = {};
    std::uint32_t driverVersion = 0;
    std::array<std::uint8_t, VK_UUID_SIZE> cacheIdentity = {};
    std::uint32_t queueFamily = 0;
    VkPhysicalDeviceMemoryProperties memory = {};
    bool lineRasterization = false, swapchain = false;
};
/// Null when the physical device is below what Pelage always needs.
std::shared_ptr<AdapterObject> inspectAdapter(std::shared_ptr<InstanceObject> instance, VkPhysicalDevice device);

struct CommandSlot {  // a pool and its one command buffer, recycled
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    std::uint64_t value = 0;
};
struct StagingChunk {
    VkBuffer buffer = VK_NULL_HANDLE;
    Allocation allocation;
    std::uint64_t used = 0, value = 0;
};
struct Recording;
struct RecordingPool;

struct QueueState {
    std::mutex mutex;
    VkQueue handle = VK_NULL_HANDLE;
    VkSemaphore timeline = VK_NULL_HANDLE;
    std::uint64_t submitted = 0;  // the last value given out, to a submission or a host's ticket
    BarrierLog barriers;
    BarrierBatch batch{&barriers};  // for the replay
    std::uint64_t signalled = 0;    // the last value that a submission of our own will signal
    vulkan::QueueLock hostLock;     // held around every call on the queue, inside `mutex`
    std::vector<CommandSlot> running, idle;
    std::vector<StagingChunk> staging;
    std::unique_ptr<Recording> uploads;           // writes that the next submission carries
    std::vector<VkSemaphoreSubmitInfo> acquired;  // binary semaphores that the next submission waits for
};

struct DeviceObject : std::enable_shared_from_this<DeviceObject> {
    ~DeviceObject();

    /// Gives the error to the innermost scope or the callback, and back to the caller.
    void report(const Diagnostics& errors);
    template <class T>
    Result<T> reported(Result<T> result) {
        if (!result) report(result.error());
        return result;
    }
    /// Runs `destroy` once the timeline has reached `value`; at once when it has.
    void bury(std::uint64_t value, std::function<void(DeviceObject&)> destroy);
    void collect();
    /// Waits for everything on the queue; its host's lock is held.
    void drain() const;
    std::uint64_t completed();
    /// A submission (or ticket) of this value exists from now on; completed() will not pass it before it is done.
    void began(std::uint64_t value, bool ticket);
    void finishTicket(std::uint64_t value);
    void loseDevice(const Diagnostic& error);
    void nameObject(VkObjectType type, std::uint64_t object, const std::string& text) const;
    template <class T>
    void nameObject(VkObjectType type, T object, const std::string& text) const {
        nameObject(type, reinterpret_cast<std::uint64_t>(object), text);
    }
    Result<std::pair<VkDescriptorSet, VkDescriptorPool>> allocateSet(VkDescriptorSetLayout layout,
                                                                     const std::string& object);
    void freeSet(VkDescriptorSet set, VkDescriptorPool pool);
    /// Recordings are used again, so that a frame like the last one allocates nothing for them.
    void takeRecording(Recording& into);
    void giveBack(Recording& recording);

    std::shared_ptr<AdapterObject> adapter;
    DeviceFunctions functions;
    VkDevice handle = VK_NULL_HANDLE;
    bool adopted = false;  // a host's: not destroyed
    bool hostPipelineCache = false;
    const VkAllocationCallbacks* allocator = nullptr;
    std::string label;
    AdapterInfo info;
    Toggles toggles;
    bool depthClamp = false, rectangularLines = false;
    std::function<void(const Diagnostic&)> onUncapturedError, onDeviceLost;
    std::function<void()> onRelease;
    std::atomic<bool> lost{false};
    std::atomic<std::uint64_t> nextId{1};
    std::atomic<std::uint32_t> liveBuffers{0}, liveTextures{0}, livePipelines{0};
    MemoryAllocator memory;
    QueueState queue;
    VkPipelineCache pipelineCache = VK_NULL_HANDLE;
    BlobCache blobs;
    std::atomic<std::uint32_t> pipelinesMade{0}, pipelinesCached{0}, pipelinesSinceStore{0};

    std::mutex scopeMutex;
    std::vector<std::optional<Diagnostic>> scopes;

    std::mutex graveMutex;
    struct Grave {
        std::uint64_t value;
        std::function<void(DeviceObject&)> destroy;
    };
    std::deque<Grave> graves;
    std::atomic<std::uint64_t> knownCompleted{0};

    std::mutex timelineMutex;
    std::vector<std::uint64_t> openTickets, openSubmissions;  // not known to be done, ascending
    std::uint64_t lastBegun = 0;

    std::unique_ptr<RecordingPool> recordings;
    std::shared_ptr<BlockPool> blocks = std::make_shared<BlockPool>();

    std::mutex poolMutex;
    std::vector<VkDescriptorPool> pools;

    std::mutex cacheMutex;
    std::map<std::string, std::weak_ptr<BindGroupLayoutObject>> layoutCache;
    std::map<std::string, std::weak_ptr<PipelineLayoutObject>> pipelineLayoutCache;
    std::map<std::string, std::weak_ptr<PipelineObject>> pipelineCacheByKey;
};

/// Loads the functions of device.handle and makes what every device has. What is there already is kept.
Result<void> openDevice(DeviceObject& device, const BlobCache& pipelines);
Result<std::shared_ptr<InstanceObject>> makeInstance(const InstanceDescriptor& descriptor,
                                                     PFN_vkGetInstanceProcAddr getProcAddr);
/// Loads the functions of instance.handle.
Result<void> loadInstance(InstanceObject& instance);

/// The host's queue lock while it lives.
class HostLock {
public:
    explicit HostLock(const QueueState& queue) : lock_(queue.hostLock) {
        if (lock_.lock) lock_.lock();
    }
    HostLock(const HostLock&) = delete;
    HostLock& operator=(const HostLock&) = delete;
    ~HostLock() {
        if (lock_.unlock) lock_.unlock();
    }

private:
    const vulkan::QueueLock& lock_;
};

/// Sends the uploads and the recordings as one command buffer; the queue's mutex is held by the caller.
struct SubmitExtras {
    VkSemaphore signal = VK_NULL_HANDLE;  // binary, for presentation
    TextureObject* present = nullptr;     // brought into the layout for presentation at the end
};
struct CommandBufferObject;
class Replay;
Result<void> checkBuffers(DeviceObject& device, std::span<const CommandBuffer> commandBuffers);
/// Writes the pending uploads and the recordings; markSent() afterwards, when the commands are on their way.
void replayAll(DeviceObject& device, Replay& replay, std::span<const CommandBuffer> commandBuffers);
void markSent(DeviceObject& device, std::uint64_t value, std::span<const CommandBuffer> commandBuffers);
Diagnostic lostError(const DeviceObject& device);
Result<Submission> submitLocked(DeviceObject& device, std::span<const CommandBuffer> commandBuffers,
                                const SubmitExtras& extras);

Result<std::shared_ptr<BindGroupLayoutObject>> makeBindGroupLayout(const std::shared_ptr<DeviceObject>& device,
                                                                   const BindGroupLayoutDescriptor& descriptor);
Result<std::shared_ptr<PipelineLayoutObject>> makePipelineLayout(
    const std::shared_ptr<DeviceObject>& device, const std::string& label,
    std::vector<std::shared_ptr<BindGroupLayoutObject>> sets, std::uint32_t pushConstantsSize);

}  // namespace pelage::rhi::detail
