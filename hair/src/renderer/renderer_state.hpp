// SPDX-License-Identifier: MIT
// What a Renderer keeps between frames. Its work is split by topic: renderer_prepare.cpp (graph, views, objects),
// renderer_draw.cpp (pipelines, bind groups, draws), renderer.cpp (the frame and its readback).
#pragma once

#include "material_binding.hpp"
#include "uploads.hpp"
#include "views.hpp"

#include <pelage/hair/renderer.hpp>

namespace pelage::hair {

struct ObjectBlock {
    glm::mat4 model = glm::mat4(1.0F), normalMatrix = glm::mat4(1.0F);
    glm::vec4 lineWidth = {};
};

// What an object keeps from frame to frame; found by its index in the scene.
struct ObjectState {
    rhi::Buffer block = {};
    std::map<const void*, rhi::BindGroup> groups = {};  // by layout
    rhi::Buffer sortedIndices = {};
    std::map<std::string, rhi::RenderPipeline> pipelines = {};
    float lineWidthMain = 1, lineWidthShadow = 1;
    const GpuGeometry* geometry = nullptr;
    const materials::CompiledMaterial* material = nullptr;
};

struct ViewState {
    rhi::Buffer block = {};
    std::map<const void*, rhi::BindGroup> groups = {};
};

struct Renderer::State {
    rhi::Device device;
    std::shared_ptr<const passes::PassTree> tree;
    passes::Graph graph;
    Uploads uploads;
    MaterialBindings bindings;
    std::map<std::string, rhi::ShaderModule> modules;
    std::vector<ObjectState> objects;
    std::vector<ViewState> views;  // 0: main, then shadow layers
    rhi::Buffer displayBlock;
    passes::HostDescription host;  // of the built graph
    bool built = false;
    FrameReport frame;
    // What the scene does not require is switched off for this frame whatever the material says.
    bool shadowsOff = false, environmentOff = false;

    explicit State(rhi::Device d, rhi::Sampler sampler) : device(d), uploads(d), bindings(d, sampler) {}

    rhi::Result<rhi::ShaderModule> module(const std::string& file);
    Outcome<void> buildGraph(const Scene& scene, const FrameSettings& settings, std::uint32_t& shadowSize,
                             std::uint32_t& shadowLights);
    Outcome<void> prepareObjects(Scene& scene, const FrameViews& frameViews);
    Outcome<void> writeView(std::size_t index, const FrameBlock& block);
    rhi::Result<rhi::RenderPipeline> pipeline(ObjectState& object, const materials::CompiledMaterial::Shader& shader,
                                              const passes::Targets& targets);
    rhi::Result<rhi::BindGroup> groupFor(std::map<const void*, rhi::BindGroup>& cache,
                                         const rhi::BindGroupLayout& layout, const rhi::Buffer& buffer,
                                         std::uint64_t size, const char* label);
    rhi::Result<void> draw(Scene& scene, passes::RasterContext& context);
};

}  // namespace pelage::hair
