// SPDX-License-Identifier: MIT
// What a built graph owns. A state is made whole or not at all; Graph::build swaps it in when it is.
#pragma once

#include "description.hpp"

#include <pelage/passes/graph.hpp>

#include <array>

namespace pelage::passes {

/// Samplers by their names in shaders and the 1 x 1 images behind const.*.
struct Fixtures {
    std::map<std::string, rhi::Sampler> samplers = {};
    std::map<std::string, rhi::Texture> constants = {};
    DepthConvention depth = DepthConvention::Reversed;
};
Result<std::shared_ptr<const Fixtures>> makeFixtures(const rhi::Device& device, DepthConvention depth);

/// Queries of one pass: a pair of timestamps and one statistics query for each render pass it is recorded as.
struct PassQueries {
    std::uint32_t first = 0, count = 0;
};

struct CachedGroup {
    rhi::BindGroupLayout layout = {};
    std::uint32_t turn = 0;              // of the histories
    std::vector<const void*> lent = {};  // imports it was made with; the group holds them
    rhi::BindGroup group = {};
};

/// Views of the images that take turns in one place: those of a history's pair, or of a host with several frames in
/// flight. The last four are kept.
class KeptViews {
public:
    Result<rhi::TextureView> of(const rhi::Texture& texture, const rhi::TextureViewDescriptor& wanted);

private:
    struct Kept {
        rhi::Texture texture = {};
        rhi::TextureView view = {};
    };
    std::array<Kept, 4> kept_ = {};
    std::size_t next_ = 0;
};

/// One render pass: what it is begun with, and the views of its targets, in the order of PassState::targetSlots.
struct LayerTargets {
    rhi::RenderPassDescriptor descriptor = {};
    std::vector<KeptViews> views = {};
};

/// An import of the plan, by the name that the host knows.
struct LentResource {
    std::uint32_t resource = ~0U;
    std::string name = {};
};

/// A pair that takes turns: `textures` or `buffers` of this frame at `turn`, of the last at the other. Indices are into
/// Plan::resources.
struct History {
    std::uint32_t last = ~0U, current = ~0U;
    std::uint32_t turn = 0;
    bool begun = false;  // the last frame's has been cleared or written
    std::array<rhi::Texture, 2> textures = {};
    std::array<rhi::Buffer, 2> buffers = {};
};

struct PassState {
    Targets targets = {};
    PassQueries queries = {};
    rhi::Extent3D extent = {};  // of the targets; of the frame when there are none
    std::vector<LayerTargets> layers = {};
    rhi::ComputePassDescriptor computePass = {};
    std::vector<std::uint32_t> targetSlots = {}, lentSlots = {};  // those that are targets; those that bind an import
    std::uint32_t history = ~0U;                                  // in GraphState::histories: whose turn counts
    double cpuMilliseconds = 0;
    std::uint32_t draws = 0;
    std::vector<CachedGroup> groups = {};
    PassRecorder recorder = {};  // of its class or its kind
};

struct GraphState {
    rhi::Device device = {};
    Plan plan = {};
    // What the plan was made from; the description is held, so that its address stays its own.
    std::shared_ptr<const PassTree::Description> tree = {};
    HostDescription host = {};
    std::shared_ptr<const Fixtures> fixtures = {};
    std::vector<rhi::Texture> textures = {};  // by resource; imports are set by record()
    std::vector<rhi::Buffer> buffers = {};    // by resource; imports are set by record()
    std::vector<LentResource> lent = {};
    std::vector<History> histories = {};
    std::vector<PassState> passes = {};

    rhi::QuerySet timestamps = {}, statistics = {};
    rhi::Buffer timestampResults = {}, statisticsResults = {};
    std::uint32_t queryCount = 0;  // render passes and dispatches that are measured
    bool recorded = false;

    std::uint32_t layersOf(const PlanPass& pass) const;
};

/// The pairs of the plan's histories; those of `before` that are of the same shape are taken over.
Result<void> makeHistories(GraphState& state, const GraphState* before);
void takeTurns(GraphState& state);
Result<void> beginHistories(GraphState& state, rhi::CommandEncoder& encoder);
void endHistories(GraphState& state);

/// Paints the images that begin with this pass (graph_poison.cpp).
Result<void> poison(const GraphState& state, std::uint32_t pass, rhi::CommandEncoder& encoder);

/// The image or buffer of a slot by its name.
rhi::Texture textureOf(const GraphState& state, const PlanPass& pass, std::string_view slot);
rhi::Buffer bufferOf(const GraphState& state, const PlanPass& pass, std::string_view slot);

/// Describes the render and compute passes of the plan (graph_targets.cpp). After makeHistories() and makeQueries().
void describePasses(GraphState& state);
/// Puts the views of this frame into the description of a render pass.
Result<void> putViews(GraphState& state, std::size_t pass, std::uint32_t layer);
std::optional<rhi::TimestampWrites> timestampsOf(const GraphState& state, std::uint32_t query);

/// The value of a specialization constant: what the pass says; else what the linked image says of itself,
/// u_source_samples or u_source_present (pass_class.cpp).
std::optional<double> constantOf(const Plan& plan, const PlanPass& pass, const std::string& name);

/// A fault of a pass's shader.
tl::unexpected<Diagnostics> shaderFault(Code code, std::string text, std::string hint = {});

/// The group of set 1 for this layout: slots and samplers by the names of the shader's resources.
Result<rhi::BindGroup> bindGroupFor(GraphState& state, std::size_t pass, const rhi::BindGroupLayout& layout);

/// Pipelines of fullscreen and compute passes and the recorders of classes; everything wrong at once.
void makePipelines(GraphState& state, const ShaderSource& shaders, const PassClassRegistry& classes,
                   const PassTree::Description& tree, Reporter& reporter);

Result<void> makeQueries(GraphState& state);
/// Copies the queries of a frame to where the host can read them.
void resolveQueries(const GraphState& state, rhi::CommandEncoder& encoder);

bool isComparison(std::string_view sampler);

}  // namespace pelage::passes
