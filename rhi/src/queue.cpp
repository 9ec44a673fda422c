// SPDX-License-Identifier: MIT
// One submission is one Vulkan command buffer: first the staged writes, then what the encoders recorded.
#include "device_object.hpp"
#include "recording.hpp"

namespace pelage::rhi {
namespace detail {

Diagnostic lostError(const DeviceObject& device) {
    return {.code = ErrorCode::DeviceLost,
            .text = cat("[Device \"", device.label, "\"] was lost."),
            .kind = ErrorKind::DeviceLost};
}

namespace {

Result<CommandSlot> takeSlot(DeviceObject& device) {
    auto& q = device.queue;
    const auto& f = device.functions;
    const std::uint64_t done = device.completed();
    for (std::size_t i = 0; i < q.running.size();) {
        if (q.running[i].value > done) {
            ++i;
            continue;
        }
        f.vkResetCommandPool(device.handle, q.running[i].pool, 0);
        q.idle.push_back(q.running[i]);
        q.running[i] = q.running.back();
        q.running.pop_back();
    }
    if (!q.idle.empty()) {
        const auto slot = q.idle.back();
        q.idle.pop_back();
        return slot;
    }
    CommandSlot slot;
    VkCommandPoolCreateInfo pool = {VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool.queueFamilyIndex = device.adapter->queueFamily;
    if (const auto r = f.vkCreateCommandPool(device.handle, &pool, device.allocator, &slot.pool); r != VK_SUCCESS)
        return forward(vulkanError(r, "vkCreateCommandPool", "the queue"));
    VkCommandBufferAllocateInfo info = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    info.commandPool = slot.pool;
    info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    info.commandBufferCount = 1;
    if (const auto r = f.vkAllocateCommandBuffers(device.handle, &info, &slot.commands); r != VK_SUCCESS) {
        f.vkDestroyCommandPool(device.handle, slot.pool, device.allocator);
        return forward(vulkanError(r, "vkAllocateCommandBuffers", "the queue"));
    }
    return slot;
}

}  // namespace

Result<void> checkBuffers(DeviceObject& device, std::span<const CommandBuffer> commandBuffers) {
    for (std::size_t i = 0; i < commandBuffers.size(); ++i) {
        const auto& c = commandBuffers[i];
        if (!c) return needHandle(c, cat("command buffer ", i, " of a submission"));
        if (auto ok = needSameDevice(*c.get(), device); !ok) return ok;
        bool twice = c.get()->submitted;
        for (std::size_t j = 0; j < i; ++j) twice = twice || commandBuffers[j] == c;
        if (twice)
            return invalid(ErrorCode::AlreadySubmitted,
                           cat(c.get()->describe(), " was submitted before; a command buffer is used once."));
    }
    return {};
}

void replayAll(DeviceObject& device, Replay& replay, std::span<const CommandBuffer> commandBuffers) {
    auto& q = device.queue;
    for (const auto& [object, owner] : q.uploads->weak)
        if (auto held = owner.lock()) q.uploads->references.push_back(std::move(held));
    q.uploads->dropDead();
    if (!q.uploads->packets.empty()) {
        q.uploads->label = "uploads";
        replay.run(*q.uploads, nullptr);
    }
    for (const auto& c : commandBuffers) replay.run(c.get()->recording, &c.get()->counters);
}

void markSent(DeviceObject& device, std::uint64_t value, std::span<const CommandBuffer> commandBuffers) {
    auto& q = device.queue;
    q.submitted = value;
    for (const auto& object : q.uploads->references) object->markUsed(value);
    for (auto& chunk : q.staging)
        if (chunk.value == 0 && chunk.used > 0) chunk.value = value;
    q.uploads->clear();
    for (const auto& c : commandBuffers) {
        c.get()->submitted = true;
        for (const auto& object : c.get()->recording.references) object->markUsed(value);
        device.giveBack(c.get()->recording);  // used once: its objects are free to go when the device is done
    }
}

Result<Submission> submitLocked(DeviceObject& device, std::span<const CommandBuffer> commandBuffers,
                                const SubmitExtras& extras) {
    auto& q = device.queue;
    const auto& f = device.functions;
    if (device.lost) return forward(lostError(device));
    if (auto ok = checkBuffers(device, commandBuffers); !ok) return forward(ok.error());
    auto slot = takeSlot(device);
    if (!slot) return forward(slot.error());
    const std::uint64_t value = q.submitted + 1;
    VkCommandBufferBeginInfo begin = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    if (const auto r = f.vkBeginCommandBuffer(slot->commands, &begin); r != VK_SUCCESS) {
        q.idle.push_back(*slot);
        return forward(vulkanError(r, "vkBeginCommandBuffer", "the queue"));
    }
    Replay replay(device, slot->commands);
    replayAll(device, replay, commandBuffers);
    replay.finish(extras.present);
    // The states of what was used have moved on; a submission that does not happen leaves them untrue for good.
    const auto refused = [&](VkResult r, const char* call) {
        f.vkResetCommandPool(device.handle, slot->pool, 0);
        q.idle.push_back(*slot);
        q.uploads->references.clear();  // they hold what holds the device
        auto error = vulkanError(r, call, "the queue");
        device.loseDevice(error);
        return forward(std::move(error));
    };
    if (const auto r = f.vkEndCommandBuffer(slot->commands); r != VK_SUCCESS) return refused(r, "vkEndCommandBuffer");
    VkCommandBufferSubmitInfo commands = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
    commands.commandBuffer = slot->commands;
    VkSemaphoreSubmitInfo signals[2] = {{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO},
                                        {VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO}};
    signals[0].semaphore = q.timeline;
    signals[0].value = value;
    signals[0].stageMask = signals[1].stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    signals[1].semaphore = extras.signal;
    VkSubmitInfo2 info = {VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
    info.waitSemaphoreInfoCount = static_cast<std::uint32_t>(q.acquired.size());
    info.pWaitSemaphoreInfos = q.acquired.data();
    info.commandBufferInfoCount = 1;
    info.pCommandBufferInfos = &commands;
    info.signalSemaphoreInfoCount = extras.signal != VK_NULL_HANDLE ? 2 : 1;
    info.pSignalSemaphoreInfos = signals;
    VkResult sent = VK_SUCCESS;
    {
        const HostLock lock(q);
        sent = f.vkQueueSubmit2(q.handle, 1, &info, VK_NULL_HANDLE);
    }
    if (sent != VK_SUCCESS) return refused(sent, "vkQueueSubmit2");
    device.began(value, false);
    q.signalled = value;
    q.acquired.clear();
    slot->value = value;
    q.running.push_back(*slot);
    if (extras.present != nullptr) extras.present->markUsed(value);
    markSent(device, value, commandBuffers);
    return Submission{value};
}

}  // namespace detail

Result<Submission> Queue::submit(std::span<const CommandBuffer> commandBuffers) {
    if (!device_) return detail::invalid(ErrorCode::InvalidHandle, "submit() was called on an empty queue.");
    Result<Submission> result;
    {
        const std::lock_guard lock(device_->queue.mutex);
        result = detail::submitLocked(*device_, commandBuffers, {});
    }
    device_->collect();
    return device_->reported(std::move(result));
}

bool Queue::isDone(Submission submission) const {
    if (!device_ || device_->completed() >= submission.value) return true;
    // A host's frame that is still open holds completed() back, but not this submission.
    std::uint64_t signalled = 0;
    return device_->functions.vkGetSemaphoreCounterValue(device_->handle, device_->queue.timeline, &signalled) ==
               VK_SUCCESS &&
           signalled >= submission.value;
}

Result<bool> Queue::wait(Submission submission, std::uint64_t timeoutNs) const {
    if (!device_) return detail::invalid(ErrorCode::InvalidHandle, "wait() was called on an empty queue.");
    std::uint64_t last = 0;
    {
        const std::lock_guard lock(device_->queue.mutex);
        last = device_->queue.signalled;
    }
    if (submission.value > last)
        return device_->reported<bool>(
            detail::invalid(ErrorCode::OutOfRange, detail::cat("wait() was called for submission ", submission.value,
                                                               "; the last one of this queue is ", last, '.')));
    VkSemaphoreWaitInfo info = {VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO};
    info.semaphoreCount = 1;
    info.pSemaphores = &device_->queue.timeline;
    info.pValues = &submission.value;
    const auto r = device_->functions.vkWaitSemaphores(device_->handle, &info, timeoutNs);
    if (r == VK_TIMEOUT) return false;
    if (r != VK_SUCCESS)
        return device_->reported<bool>(detail::forward(detail::vulkanError(r, "vkWaitSemaphores", "the queue")));
    device_->completed();
    return true;
}

Result<void> Device::waitIdle() const {
    if (!object_) return detail::invalid(ErrorCode::InvalidHandle, "waitIdle() was called on an empty device.");
    Result<Submission> last;
    {
        const std::lock_guard lock(object_->queue.mutex);
        last->value = object_->queue.signalled;
        // Writes are work, too.
        if (!object_->queue.uploads->packets.empty()) last = detail::submitLocked(*object_, {}, {});
    }
    if (!last) return object_->reported<void>(detail::forward(last.error()));
    if (auto done = queue().wait(*last); !done) return detail::forward(done.error());
    object_->collect();
    return {};
}

}  // namespace pelage::rhi
