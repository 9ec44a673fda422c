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
    rhi::BindGroupLayout layout = {};    // held, so that its address stays its own
    std::vector<const void*> lent = {};  // imports it was made with
    rhi::BindGroup group = {};
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
    rhi::RenderPipeline pipeline = {};  // Fullscreen
    rhi::ComputePipeline compute = {};
    rhi::BindGroupLayout layout = {};  // of set 1; empty when the shader uses none
    PassQueries queries = {};
    double cpuMilliseconds = 0;
    std::uint32_t draws = 0;
    std::map<std::pair<const void*, std::uint32_t>, CachedGroup> groups = {};  // by layout and turn of the histories
    PassRecorder recorder = {};                                                // of a class
};

struct Graph::State {
    rhi::Device device = {};
    Plan plan = {};
    // What the plan was made from; the description is held, so that its address stays its own.
    std::shared_ptr<const PassTree::Description> tree = {};
    HostDescription host = {};
    std::shared_ptr<const Fixtures> fixtures = {};
    std::vector<rhi::Texture> textures = {};  // by resource; imports are set by record()
    std::vector<rhi::Buffer> buffers = {};    // by resource; imports are set by record()
    std::vector<History> histories = {};
    std::vector<PassState> passes = {};

    rhi::QuerySet timestamps = {}, statistics = {};
    rhi::Buffer timestampResults = {}, statisticsResults = {};
    std::uint32_t queryCount = 0;  // render passes and dispatches that are measured
    bool recorded = false;

    std::uint32_t layersOf(const PlanPass& pass) const;
};

/// The pairs of the plan's histories; those of `before` that are of the same shape are taken over.
Result<void> makeHistories(Graph::State& state, const Graph::State* before);
void takeTurns(Graph::State& state);
Result<void> beginHistories(Graph::State& state, rhi::CommandEncoder& encoder);
void endHistories(Graph::State& state);
/// Which of a pair is written now, for passes that use one; 0 for the others.
std::uint32_t turnOf(const Graph::State& state, const PlanPass& pass);

/// Paints the images that begin with this pass (graph_poison.cpp).
Result<void> poison(const Graph::State& state, std::uint32_t pass, rhi::CommandEncoder& encoder);

/// The image or buffer of a slot by its name.
rhi::Texture textureOf(const Graph::State& state, const PlanPass& pass, std::string_view slot);
rhi::Buffer bufferOf(const Graph::State& state, const PlanPass& pass, std::string_view slot);

/// Names a fault of a pass's shader: "P073", "P074", … in front of the sentence.
Diagnostic shaderError(std::string_view code, std::string text);

/// The group of set 1 for this layout: slots and samplers by the names of the shader's resources.
Result<rhi::BindGroup> bindGroupFor(Graph::State& state, std::size_t pass, const rhi::BindGroupLayout& layout);

/// Pipelines of fullscreen and compute passes and the recorders of classes; everything wrong at once.
void makePipelines(Graph::State& state, const ShaderSource& shaders, const PassClassRegistry& classes,
                   const PassTree::Description& tree, Reporter& reporter);

Result<void> makeQueries(Graph::State& state);
/// Copies the queries of a frame to where the host can read them.
void resolveQueries(const Graph::State& state, rhi::CommandEncoder& encoder);

bool isComparison(std::string_view sampler);

}  // namespace pelage::passes
