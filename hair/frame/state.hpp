// SPDX-License-Identifier: MIT
// What a Renderer keeps between frames. Its work is split by topic: prepare.cpp (graph, views, objects),
// object_pipelines.cpp (materials to pipelines), draw.cpp (bind groups, draws, dispatches), renderer.cpp (the frame and
// its readback).
#pragma once

#include "material/binding.hpp"
#include "pipelines.hpp"
#include "resources/uploads.hpp"
#include "views.hpp"
#include "visibility/cards/sorting.hpp"

#include <pelage/hair/renderer.hpp>

#include <array>
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

// The pipelines of one object, for the shaders of its material as they were when the pipelines were asked for: one for
// each pass that draws or dispatches one of the shaders. The object is drawn when all of its pipelines are ready.
struct ObjectPipelines {
    std::shared_ptr<const materials::MaterialType> type = {};
    bool strands = false, isEmpty = false;
    std::uint32_t subdivisions = 1;
    bool environmentOff = false;
    LightOptions lights = {};
    std::vector<materials::CompiledMaterial::Shader> shaders = {};
    std::uint64_t graph = 0;  // the build of the graph that `uses` is for
    struct Use {
        std::uint32_t pass = 0;    // in the plan
        std::uint32_t shader = 0;  // in `shaders`
        Pipelines::Handle pipeline = {};
    };
    std::vector<Use> uses = {};
    bool failureSaid = false;

    /// Material types name the vertex shader of meshes; strands have one of their own in its place.
    const std::string& vertexFile(const materials::ShaderUse& use) const;
    bool isReady() const;
    const Diagnostics* failure() const;
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
    rhi::Buffer sorted = {};                               // indices of a mesh, or pieces of one segment each
    std::uint32_t sortedCount = 0;                         // pieces
    std::optional<ObjectPipelines> shown = {}, next = {};  // `next` waits for its pipelines
    const GpuGeometry* geometry = nullptr;
    const materials::CompiledMaterial* material = nullptr;
};

struct ViewState {
    rhi::Buffer block = {};
    std::map<const void*, rhi::BindGroup> groups = {};
};

/// By set: frame, pass, material, object.
using ObjectGroups = std::array<rhi::BindGroup, 4>;
template <class Pipeline>
std::array<rhi::BindGroupLayout, 4> layoutsOf(const Pipeline& pipeline) {
    return {pipeline.bindGroupLayout(0), pipeline.bindGroupLayout(1), pipeline.bindGroupLayout(2),
            pipeline.bindGroupLayout(3)};
}

// All that the plan of a frame depends on, as it was when the plan was last looked for. Comparing allocates nothing.
struct GraphInputs {
    rhi::Extent3D extent = {};
    std::optional<passes::DepthConvention> hostDepth = {};
    LightOptions lights = {};  // with a layer for every light that casts a shadow
    std::map<std::string, passes::SettingValue> settings = {};
    std::map<std::string, passes::LentImport> images = {};
    std::vector<std::string> buffers = {};
    std::uint32_t shadowSize = 1, shadowLights = 0;  // what came of them

    GraphInputs(const Scene& scene, const FrameSettings& frame);
    bool are(const Scene& scene, const FrameSettings& frame) const;
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
    const Scene* recorded = nullptr;  // during Graph::record
    std::vector<ObjectState> objects;
    std::vector<ViewState> views;  // 0: main, then shadow layers
    rhi::Buffer displayBlock;
    passes::HostDescription host;  // of the built graph
    bool built = false;
    std::optional<GraphInputs> inputs = {};
    // Of the frame being recorded; kept, so that a steady frame allocates none of it anew.
    FrameViews viewBlocks = {};
    passes::FrameImports imports = {};
    std::uint64_t graphBuilds = 0;
    // Types that were checked against the tree and their shaders; held, so that no other type gets the address of one.
    std::vector<std::shared_ptr<const materials::MaterialType>> checkedTypes;
    FrameReport frame;
    // What the scene does not require is switched off for this frame whatever the material says.
    bool environmentOff = false;
    LightOptions lights = {};

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
    // object_pipelines.cpp
    Result<void> updatePipelines(ObjectState& object, const Object& from);
    Result<void> checkType(const std::shared_ptr<const materials::MaterialType>& type);
    bool isFor(const ObjectPipelines& set, const ObjectState& object,
               const materials::CompiledMaterial& material) const;
    Result<void> requestPipelines(ObjectPipelines& set, const std::string& label);
    std::vector<rhi::ConstantEntry> constantsOf(const ObjectPipelines& set,
                                                const materials::CompiledMaterial::Shader& shader,
                                                const passes::PlanPass& pass, std::uint32_t samples) const;
    Result<rhi::ComputePipelineDescriptor> describeCompute(const ObjectPipelines& set,
                                                           const materials::CompiledMaterial::Shader& shader,
                                                           const passes::PlanPass& pass);
    Result<rhi::RenderPipelineDescriptor> describePipeline(const ObjectPipelines& set,
                                                           const materials::CompiledMaterial::Shader& shader,
                                                           const passes::PlanPass& pass);
    // draw.cpp
    Result<rhi::BindGroup> materialGroup(std::size_t index, const ObjectPipelines& set, std::uint32_t shader,
                                         const rhi::BindGroupLayout& layout);
    Result<rhi::BindGroup> groupFor(std::map<const void*, rhi::BindGroup>& cache, const rhi::BindGroupLayout& layout,
                                    const rhi::Buffer& buffer, std::uint64_t size, const char* label);
    Result<rhi::BindGroup> objectGroup(ObjectState& object, const rhi::BindGroupLayout& layout,
                                       const rhi::Buffer& pieces);
    /// The groups of the sets that an object's shader uses in a pass; empty where its layout is.
    Result<ObjectGroups> groupsOf(std::size_t index, std::uint32_t shader, std::size_t view,
                                  const passes::PassContext& context,
                                  const std::array<rhi::BindGroupLayout, 4>& layouts);
    /// What records the raster passes: the objects of `recorded` whose materials have a shader for the pass's list.
    passes::PassClass drawListClass();
    /// What records the passes of a host's class that dispatches: the same objects, by their compute shaders.
    passes::PassClass dispatchClass(MaterialPass pass);
};

}  // namespace pelage::hair
