// SPDX-License-Identifier: MIT
// The host's frames, and its second thread.
#include "engine.hpp"

#include "scene.hpp"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/packing.hpp>

#include <chrono>
#include <cstring>

namespace host {

namespace {

const glm::vec3 toLight = glm::normalize(glm::vec3(0.5F, 0.9F, 0.7F));

glm::mat4 projectionFor(float aspect, bool reversed) {
    // Swapping near and far reverses the depth; Vulkan's clip space has +Y down.
    auto m = reversed ? glm::perspective(0.5F, aspect, 20.0F, 0.05F) : glm::perspective(0.5F, aspect, 0.05F, 20.0F);
    m[1][1] = -m[1][1];
    return m;
}

VkImageMemoryBarrier2 transition(VkImage image, VkImageAspectFlags aspect, VkImageLayout from, VkImageLayout to) {
    VkImageMemoryBarrier2 barrier = {VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {aspect, 0, 1, 0, 1};
    return barrier;
}

void barrierOf(VkCommandBuffer commands, const std::vector<VkImageMemoryBarrier2>& images) {
    VkDependencyInfo info = {VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.imageMemoryBarrierCount = static_cast<std::uint32_t>(images.size());
    info.pImageMemoryBarriers = images.data();
    vkCmdPipelineBarrier2(commands, &info);
}

}  // namespace

void Engine::recordScene(const Slot& slot, const Frame& frame, float time) {
    auto* const commands = slot.commands;
    barrierOf(commands, {transition(color_.image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
                                    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL),
                         transition(depth_.image, VK_IMAGE_ASPECT_DEPTH_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
                                    VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL)});
    VkRenderingAttachmentInfo color = {VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    color.imageView = color_.view;
    color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    color.clearValue.color = {{0.25F, 0.3F, 0.36F, 1}};
    VkRenderingAttachmentInfo depth = color;
    depth.imageView = depth_.view;
    depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    depth.clearValue.depthStencil.depth = options_.reversedDepth ? 0.0F : 1.0F;
    VkRenderingInfo info = {VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = context_.extent;
    info.layerCount = info.colorAttachmentCount = 1;
    info.pColorAttachments = &color;
    info.pDepthAttachment = &depth;
    vkCmdBeginRendering(commands, &info);
    const VkViewport viewport = {0, 0, static_cast<float>(options_.width), static_cast<float>(options_.height), 0, 1};
    const VkRect2D scissor = {{0, 0}, context_.extent};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &scissor);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
    const VkDeviceSize offset = 0;
    vkCmdBindVertexBuffers(commands, 0, 1, &mesh_.buffer, &offset);
    const auto draw = [&](const glm::mat4& model, const glm::vec3& tint, bool ball) {
        const glm::mat3 normals = glm::transpose(glm::inverse(glm::mat3(model)));
        Push push = {frame.projection * frame.view * model, {}, glm::vec4(toLight, 0)};
        for (int i = 0; i < 3; ++i) push.columns[i] = glm::vec4(normals[i], tint[i]);
        vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof push, &push);
        vkCmdDraw(commands, ball ? sphereVertices_ : boxVertices_, 1, ball ? 0 : sphereVertices_, 0);
    };
    const auto move = [](const glm::vec3& to) { return glm::translate(glm::mat4(1.0F), to); };
    draw(glm::scale(move({0, 1.6F, 0}), glm::vec3(0.07F, 0.108F, 0.085F)), {0.55F, 0.36F, 0.28F}, true);
    draw(glm::scale(move({0, 1.25F, -0.35F}), glm::vec3(0.6F, 0.6F, 0.02F)), {0.5F, 0.5F, 0.5F}, false);
    draw(glm::scale(move({0, 1.28F, 0}), glm::vec3(0.6F, 0.02F, 0.5F)), {0.5F, 0.48F, 0.45F}, false);
    // Goes around the head: before the hair in one half of its turn and behind it in the other.
    const glm::vec3 place = {0.2F * std::sin(time), 1.6F, 0.2F * std::cos(time)};
    auto model = glm::rotate(move(place), 2 * time, glm::vec3(0.3F, 1, 0.2F));
    draw(glm::scale(model, glm::vec3(0.03F)), {0.15F, 0.4F, 0.6F}, false);
    vkCmdEndRendering(commands);
}

void Engine::recordReadback(VkCommandBuffer commands) {
    barrierOf(commands, {transition(color_.image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                    VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL)});
    VkBufferImageCopy region = {};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = {options_.width, options_.height, 1};
    vkCmdCopyImageToBuffer(commands, color_.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, readback_.buffer, 1, &region);
    VkMemoryBarrier2 barrier = {VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT | VK_PIPELINE_STAGE_2_COPY_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;
    VkDependencyInfo info = {VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.memoryBarrierCount = 1;
    info.pMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &info);
}

void Engine::submit(const Slot& slot) {
    VkCommandBufferSubmitInfo commands = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
    commands.commandBuffer = slot.commands;
    VkSubmitInfo2 info = {VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
    info.commandBufferInfoCount = 1;
    info.pCommandBufferInfos = &commands;
    const std::lock_guard lock(queueMutex_);
    check(vkQueueSubmit2(context_.queue, 1, &info, slot.fence), "vkQueueSubmit2");
}

void Engine::waitFor(Slot& slot, std::uint32_t index) {
    if (!slot.drawn) return;
    check(vkWaitForFences(context_.device, 1, &slot.fence, VK_TRUE, ~0ULL), "vkWaitForFences");
    check(vkResetFences(context_.device, 1, &slot.fence), "vkResetFences");
    slot.drawn = false;
    if (guest_.done) guest_.done(index);
}

void Engine::stream(const std::atomic<bool>& stop) {
    // Stands for an engine's texture streaming: small submissions at any time, on the only queue there is.
    Slot slot = makeSlot();
    while (!stop) {
        check(vkResetCommandPool(context_.device, slot.pool, 0), "vkResetCommandPool");
        VkCommandBufferBeginInfo begin = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        check(vkBeginCommandBuffer(slot.commands, &begin), "vkBeginCommandBuffer");
        vkCmdFillBuffer(slot.commands, streamBuffer_.buffer, 0, VK_WHOLE_SIZE, static_cast<std::uint32_t>(streamed_));
        check(vkEndCommandBuffer(slot.commands), "vkEndCommandBuffer");
        submit(slot);
        check(vkWaitForFences(context_.device, 1, &slot.fence, VK_TRUE, ~0ULL), "vkWaitForFences");
        check(vkResetFences(context_.device, 1, &slot.fence), "vkResetFences");
        ++streamed_;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    vkDestroyFence(context_.device, slot.fence, nullptr);
    vkDestroyCommandPool(context_.device, slot.pool, nullptr);
}

std::vector<std::uint8_t> Engine::run() {
    std::atomic<bool> stop{false};
    std::thread streaming([&] { stream(stop); });
    for (std::uint32_t i = 0; i < options_.frames; ++i) {
        const std::uint32_t index = i % framesInFlight;
        Slot& slot = slots_[index];
        waitFor(slot, index);
        check(vkResetCommandPool(context_.device, slot.pool, 0), "vkResetCommandPool");
        VkCommandBufferBeginInfo begin = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        check(vkBeginCommandBuffer(slot.commands, &begin), "vkBeginCommandBuffer");
        Frame frame;
        frame.commands = slot.commands;
        frame.slot = index;
        frame.toLight = toLight;
        frame.view = glm::lookAt(glm::vec3(0.25F, 1.72F, 1.15F), glm::vec3(0, 1.55F, 0), glm::vec3(0, 1, 0));
        frame.projection = projectionFor(static_cast<float>(options_.width) / static_cast<float>(options_.height),
                                         options_.reversedDepth);
        recordScene(slot, frame, options_.turn + 0.25F * static_cast<float>(i));
        if (guest_.draw) guest_.draw(frame);
        recordReadback(slot.commands);
        check(vkEndCommandBuffer(slot.commands), "vkEndCommandBuffer");
        submit(slot);
        slot.drawn = true;
    }
    for (std::uint32_t i = 0; i < framesInFlight; ++i) waitFor(slots_[i], i);
    stop = true;
    streaming.join();
    std::vector<std::uint8_t> picture(std::size_t{4} * options_.width * options_.height);
    const auto* half = static_cast<const std::uint16_t*>(readback_.mapped);
    for (std::size_t i = 0; i < picture.size(); ++i) {
        const float x = i % 4 == 3 ? 1.0F : glm::clamp(glm::unpackHalf1x16(half[i]), 0.0F, 1.0F);
        const float encoded = x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1 / 2.4F) - 0.055F;
        picture[i] = static_cast<std::uint8_t>(encoded * 255.0F + 0.5F);
    }
    return picture;
}

}  // namespace host
