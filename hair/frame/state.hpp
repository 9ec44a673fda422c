// SPDX-License-Identifier: MIT
// What a Renderer keeps between frames. Its work is split by topic: renderer_prepare.cpp (graph, views, objects),
// renderer_looks.cpp (materials to pipelines), renderer_draw.cpp (bind groups, draws), renderer.cpp (the frame and its
// readback).
#pragma once

#include "material/binding.hpp"
#include "pipelines.hpp"
#include "resources/uploads.hpp"
#include "views.hpp"
#include "visibility/cards/sorting.hpp"

#include <pelage/hair/renderer.hpp>

#include <optional>

namespace pelage::hair {

/// The first that is an error; warnings may stand before it.
inline Diagnostic firstError(const Diagnostics& found) {
    for (const Diagnostic& each : found.items()) {
        if (each.severity == Severity::Error) return each;
    }
    return found.empty() ? Diagnostic() : found.items().front();
}

struct ObjectBlock {
    glm::mat4 model = glm::mat4(1.0F), normalMatrix = glm::mat4(1.0F);
    glm::vec4 center = {};  // hair/shaders/object.glsl
    glm::uvec4 strides = {};
};

// An object as far as pipelines go: the shaders of its material as they were, and a pipeline for each pass that draws
// one of them. It is drawn when all of them are ready, never by half.
struct Look {
    std::shared_ptr<const materials::MaterialType> type = {};
    bool strands = false, isEmpty = false;
    std::uint32_t subdivisions = 1;
    bool shadowsOff = false, environmentOff = false;
    std::vector<materials::CompiledMaterial::Shader> shaders = {};
    std::uint64_t graph = 0;  // the build of the graph that `draws` is for
    struct Draw {
        std::string pass = {};
        std::uint32_t shader = 0;
        Pipelines::Handle pipeline = {};
    };
    std::vector<Draw> draws = {};
    bool failureSaid = false;

    /// Material types name the vertex shader of meshes; strands have one of their own in its place.
    const std::string& vertexFile(const materials::ShaderUse& use) const;
    bool isReady() const;
    const Diagnostic* failure() const;
};

// What an object keeps from frame to frame; found by its index in the scene.
struct ObjectState {
    rhi::Buffer block = {};
    // By layout and, for strands, the buffers that change: points take turns, pieces are as cut or as sorted.
    struct Group {
        const void* layout = nullptr;
        rhi::Buffer points = {}, starts = {}, pieces = {};
        rhi::BindGroup group = {};
    };
    std::vector<Group> groups = {};
    MovingPoints moving = {};
    rhi::Buffer sorted = {};                    // indices of a mesh, or pieces of one segment each
    std::uint32_t sortedCount = 0;              // pieces
    std::optional<Look> shown = {}, next = {};  // `next` waits for its pipelines
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
    ShaderCode hostShaders;
    BackToFront order;
    std::map<std::string, rhi::ShaderModule> modules;
    PipelineMode mode = PipelineMode::Synchronous;
    Pipelines pipelines;
    std::vector<ObjectState> objects;
    std::vector<ViewState> views;  // 0: main, then shadow layers
    rhi::Buffer displayBlock;
    passes::HostDescription host;  // of the built graph
    bool built = false;
    std::uint64_t graphBuilds = 0;
    // Types that were checked against the tree and their shaders; held, so that none of another type has its address.
    std::vector<std::shared_ptr<const materials::MaterialType>> checkedTypes;
    FrameReport frame;
    // What the scene does not require is switched off for this frame whatever the material says.
    bool shadowsOff = false, environmentOff = false;

    State(const Descriptor& descriptor, rhi::Sampler sampler)
        : device(descriptor.device),
          uploads(device),
          bindings(device, sampler),
          hostShaders(descriptor.shaders),
          mode(descriptor.pipelines),
          pipelines(device, mode, descriptor.beforePipeline) {}

    Result<rhi::ShaderModule> module(const std::string& file);
    Result<void> buildGraph(const Scene& scene, const FrameSettings& settings, std::uint32_t& shadowSize,
                             std::uint32_t& shadowLights);
    Result<void> prepareObjects(Scene& scene, const FrameViews& frameViews, rhi::CommandEncoder& encoder);
    Result<void> sortObject(const Object& from, ObjectState& state, const glm::vec3& forward);
    Result<void> writeView(std::size_t index, const FrameBlock& block);
    // renderer_looks.cpp
    Result<void> updateLook(ObjectState& object, const Object& from);
    Result<void> checkType(const std::shared_ptr<const materials::MaterialType>& type);
    bool looksLike(const Look& look, const ObjectState& object, const materials::CompiledMaterial& material) const;
    Result<void> requestPipelines(Look& look, const std::string& label);
    Result<rhi::RenderPipelineDescriptor> describePipeline(const Look& look,
                                                                const materials::CompiledMaterial::Shader& shader,
                                                                const passes::Targets& targets);
    // renderer_draw.cpp
    Result<rhi::BindGroup> materialGroup(std::size_t index, const Look& look, std::uint32_t shader,
                                          const rhi::BindGroupLayout& layout);
    Result<rhi::BindGroup> groupFor(std::map<const void*, rhi::BindGroup>& cache,
                                         const rhi::BindGroupLayout& layout, const rhi::Buffer& buffer,
                                         std::uint64_t size, const char* label);
    Result<rhi::BindGroup> objectGroup(ObjectState& object, const rhi::BindGroupLayout& layout,
                                            const rhi::Buffer& pieces);
    Result<void> draw(Scene& scene, passes::RasterContext& context);
};

}  // namespace pelage::hair
