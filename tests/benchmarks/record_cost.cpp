// SPDX-License-Identifier: MIT
// What recording costs beside hand-written Vulkan that does the same work: many commands in one process, pools
// recycled, the order of the two sides alternated. Nothing is submitted. Only ratios mean something on a shared
// machine.
//   pelage_record_cost [--commands N] [--rounds N] [--case draw|bind|dispatch] [--only raw|rhi]
// `--only` is for counting instructions: valgrind --tool=callgrind pelage_record_cost --only raw --case bind --rounds 3
#include <pelage/rhi/rhi.hpp>
#include <pelage/rhi/vulkan.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>

#include "objects.hpp"  // the raw side binds the same pipelines and sets

namespace pelage::test {

std::span<const std::uint32_t> embeddedShader(std::string_view name);

namespace {

using namespace rhi;
namespace vk = rhi::vulkan;

template <class T>
auto need(Result<T> result) {
    if (!result) {
        std::fprintf(stderr, "record_cost: error: %s\n", result.error().text().c_str());
        std::exit(2);
    }
    if constexpr (!std::is_void_v<T>) return std::move(*result);
}

#define PELAGE_RAW_FUNCTIONS(F)                                                                                 \
    F(vkCreateCommandPool)                                                                                      \
    F(vkDestroyCommandPool)                                                                                     \
    F(vkResetCommandPool) F(vkAllocateCommandBuffers) F(vkBeginCommandBuffer) F(vkEndCommandBuffer)             \
        F(vkCmdPipelineBarrier2) F(vkCmdBeginRendering) F(vkCmdEndRendering) F(vkCmdBindPipeline)               \
            F(vkCmdBindDescriptorSets) F(vkCmdSetViewport) F(vkCmdSetScissor) F(vkCmdSetLineWidth) F(vkCmdDraw) \
                F(vkCmdDispatch)

/// The functions that the raw side calls, and its command buffer.
struct Raw {
    explicit Raw(const Device& device, const Instance& instance) : handle(vk::device(device)) {
        const auto entry = vk::getInstanceProcAddr(instance);
        const auto get =
            reinterpret_cast<PFN_vkGetDeviceProcAddr>(entry(vk::instance(instance), "vkGetDeviceProcAddr"));
#define PELAGE_RAW(name) name = reinterpret_cast<PFN_##name>(get(handle, #name));
        PELAGE_RAW_FUNCTIONS(PELAGE_RAW)
#undef PELAGE_RAW
        VkCommandPoolCreateInfo pools = {VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
        vkCreateCommandPool(handle, &pools, nullptr, &pool);
        VkCommandBufferAllocateInfo info = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        info.commandPool = pool;
        info.commandBufferCount = 1;
        vkAllocateCommandBuffers(handle, &info, &commands);
    }
    Raw(const Raw&) = delete;
    Raw& operator=(const Raw&) = delete;
    ~Raw() {
        vkDestroyCommandPool(handle, pool, nullptr);
    }
    void begin() const {
        vkResetCommandPool(handle, pool, 0);
        VkCommandBufferBeginInfo info = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        vkBeginCommandBuffer(commands, &info);
    }
    VkDevice handle;
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
#define PELAGE_RAW(name) PFN_##name name = nullptr;
    PELAGE_RAW_FUNCTIONS(PELAGE_RAW)
#undef PELAGE_RAW
};

struct Bench {
    Instance instance = need(Instance::create());
    Adapter adapter = need(instance.requestAdapter());
    Device device = need(adapter.requestDevice());
    Raw raw{device, instance};
    int commands = 10000;
    Texture target;
    TextureView view;
    RenderPipeline draw;
    ComputePipeline add;
    BindGroup drawGroups[2], computeGroups[2];

    ShaderModule shader(std::string_view name) const {
        const auto code = embeddedShader(name);
        return need(device.createShaderModule({.label = std::string(name), .code = {code.begin(), code.end()}}));
    }
    Bench() {
        target = need(
            device.createTexture({.label = "target", .size = {64, 64, 1}, .usage = TextureUsage::RenderAttachment}));
        view = need(target.createView());
        draw = need(device.createRenderPipeline({.label = "draw",
                                                 .vertex = {.module = shader("full.vert")},
                                                 .fragment = ProgrammableStage{.module = shader("buffer.frag")},
                                                 .targets = {{.format = TextureFormat::RGBA8Unorm}}}));
        add = need(device.createComputePipeline({.label = "add", .compute = {.module = shader("add.comp")}}));
        for (int i = 0; i < 2; ++i) {
            const auto buffer =
                need(device.createBuffer({.label = "values", .size = 256, .usage = BufferUsage::Storage}));
            drawGroups[i] = need(device.createBindGroup(
                {.label = "draw", .layout = draw.bindGroupLayout(0), .entries = {{0, BufferBinding{buffer}}}}));
            const auto shared = i == 0 ? buffer : lastBuffer;
            computeGroups[i] = need(device.createBindGroup(
                {.label = "add", .layout = add.bindGroupLayout(0), .entries = {{0, BufferBinding{shared}}}}));
            lastBuffer = shared;
        }
    }
    Buffer lastBuffer;

    void finish(CommandEncoder& encoder) {
        const auto recorded = need(encoder.finish());
        raw.begin();
        const auto ticket = need(vk::encodeInto(device, raw.commands, {&recorded, 1}));
        raw.vkEndCommandBuffer(raw.commands);
        vk::finished(device, ticket);
    }
    void drawsRhi(bool alternate) {
        auto encoder = device.createCommandEncoder("draws");
        auto pass = encoder.beginRenderPass({.label = "draws", .colorAttachments = {{.view = view}}});
        pass.setPipeline(draw);
        pass.setBindGroup(0, drawGroups[0]);
        for (int i = 0; i < commands; ++i) {
            if (alternate) pass.setBindGroup(0, drawGroups[i & 1]);
            pass.draw(3);
        }
        pass.end();
        finish(encoder);
    }
    void drawsRaw(bool alternate) {
        raw.begin();
        VkImageMemoryBarrier2 image = {VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
        image.dstStageMask = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
        image.dstAccessMask = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
        image.newLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        image.image = target.get()->handle;
        image.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        VkDependencyInfo dependency = {VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
        dependency.imageMemoryBarrierCount = 1;
        dependency.pImageMemoryBarriers = &image;
        raw.vkCmdPipelineBarrier2(raw.commands, &dependency);
        VkRenderingAttachmentInfo color = {VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
        color.imageView = view.get()->handle;
        color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        VkRenderingInfo info = {VK_STRUCTURE_TYPE_RENDERING_INFO};
        info.renderArea.extent = {64, 64};
        info.layerCount = info.colorAttachmentCount = 1;
        info.pColorAttachments = &color;
        raw.vkCmdBeginRendering(raw.commands, &info);
        const VkViewport viewport = {0, 64, 64, -64, 0, 1};
        raw.vkCmdSetViewport(raw.commands, 0, 1, &viewport);
        raw.vkCmdSetScissor(raw.commands, 0, 1, &info.renderArea);
        raw.vkCmdSetLineWidth(raw.commands, 1);
        raw.vkCmdBindPipeline(raw.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, draw.get()->handle);
        const auto bind = [&](int i) {
            raw.vkCmdBindDescriptorSets(raw.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, draw.get()->layout->handle, 0, 1,
                                        &drawGroups[i].get()->set, 0, nullptr);
        };
        bind(0);
        for (int i = 0; i < commands; ++i) {
            if (alternate) bind(i & 1);
            raw.vkCmdDraw(raw.commands, 3, 1, 0, 0);
        }
        raw.vkCmdEndRendering(raw.commands);
        raw.vkEndCommandBuffer(raw.commands);
    }
    void dispatchesRhi() {
        auto encoder = device.createCommandEncoder("dispatches");
        auto pass = encoder.beginComputePass({.label = "dispatches"});
        pass.setPipeline(add);
        for (int i = 0; i < commands; ++i) {
            pass.setBindGroup(0, computeGroups[i & 1]);  // both write one buffer: a barrier before each
            pass.dispatchWorkgroups(1);
        }
        pass.end();
        finish(encoder);
    }
    void dispatchesRaw() {
        raw.begin();
        VkMemoryBarrier2 memory = {VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
        memory.srcStageMask = memory.dstStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
        memory.srcAccessMask = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
        memory.dstAccessMask = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
        VkDependencyInfo dependency = {VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
        dependency.memoryBarrierCount = 1;
        dependency.pMemoryBarriers = &memory;
        raw.vkCmdBindPipeline(raw.commands, VK_PIPELINE_BIND_POINT_COMPUTE, add.get()->handle);
        for (int i = 0; i < commands; ++i) {
            if (i > 0) raw.vkCmdPipelineBarrier2(raw.commands, &dependency);
            raw.vkCmdBindDescriptorSets(raw.commands, VK_PIPELINE_BIND_POINT_COMPUTE, add.get()->layout->handle, 0, 1,
                                        &computeGroups[i & 1].get()->set, 0, nullptr);
            raw.vkCmdDispatch(raw.commands, 1, 1, 1);
        }
        raw.vkEndCommandBuffer(raw.commands);
    }
};

double nanoseconds(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
}
double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

int run(int count, char** words) {
    Bench bench;
    int rounds = 9;
    std::string onlyCase, only;
    for (int i = 1; i + 1 < count; i += 2) {
        const std::string word = words[i], next = words[i + 1];
        if (word == "--commands") bench.commands = std::max(1, std::atoi(next.c_str()));
        if (word == "--rounds") rounds = std::max(1, std::atoi(next.c_str()));
        if (word == "--case") onlyCase = next;
        if (word == "--only") only = next;
    }
    struct Case {
        const char* name;
        const char* what;
        std::function<void()> raw, ours;
    };
    const Case cases[] = {
        {"draw", "draw, nothing changed", [&] { bench.drawsRaw(false); }, [&] { bench.drawsRhi(false); }},
        {"bind", "draw with a bind-group change", [&] { bench.drawsRaw(true); }, [&] { bench.drawsRhi(true); }},
        {"dispatch", "dispatch with bind-group change and barrier", [&] { bench.dispatchesRaw(); },
         [&] { bench.dispatchesRhi(); }}};
    std::printf("%s, %d commands, median of %d\n", bench.adapter.info().driver.c_str(), bench.commands, rounds);
    for (const auto& one : cases) {
        if (!onlyCase.empty() && onlyCase != one.name) continue;
        if (!only.empty()) {
            for (int i = 0; i < rounds; ++i) only == "raw" ? one.raw() : one.ours();
            continue;
        }
        std::vector<double> raw, ours, ratio;
        for (int i = 0; i < rounds + 2; ++i) {  // the first two fault pages in
            double a = 0, b = 0;
            if (i % 2 == 0) a = nanoseconds(one.raw);
            b = nanoseconds(one.ours);
            if (i % 2 != 0) a = nanoseconds(one.raw);
            if (i < 2) continue;
            raw.push_back(a / bench.commands);
            ours.push_back(b / bench.commands);
            ratio.push_back(b / a);
        }
        std::printf("%-45s raw %6.0f ns  rhi %6.0f ns  ratio %.2f\n", one.what, median(raw), median(ours),
                    median(ratio));
    }
    return 0;
}

}  // namespace
}  // namespace pelage::test

int main(int count, char** words) {
    return pelage::test::run(count, words);
}
