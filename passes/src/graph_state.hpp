// SPDX-License-Identifier: MIT
// What a built graph owns. A state is made whole or not at all; Graph::build swaps it in when it is.
#pragma once

#include "description.hpp"

#include <pelage/passes/graph.hpp>

namespace pelage::passes {

/// Samplers by their names in shaders and the 1 x 1 images behind const.*.
struct Fixtures {
    std::map<std::string, rhi::Sampler> samplers = {};
    std::map<std::string, rhi::Texture> constants = {};
    DepthConvention depth = DepthConvention::Reversed;
};
rhi::Result<std::shared_ptr<const Fixtures>> makeFixtures(const rhi::Device& device, DepthConvention depth);

/// Queries of one pass: a pair of timestamps and one statistics query for each render pass it is recorded as.
struct PassQueries {
    std::uint32_t first = 0, count = 0;
};

struct CachedGroup {
    rhi::BindGroupLayout layout = {};    // held, so that its address stays its own
    std::vector<const void*> lent = {};  // imports it was made with
    rhi::BindGroup group = {};
};

struct PassState {
    Targets targets = {};
    rhi::RenderPipeline pipeline = {};  // Fullscreen
    rhi::ComputePipeline compute = {};
    rhi::BindGroupLayout layout = {};  // of set 1; empty when the shader uses none
    PassQueries queries = {};
    double cpuMilliseconds = 0;
    std::uint32_t draws = 0;
    std::map<const void*, CachedGroup> groups = {};  // by layout
};

struct Graph::State {
    rhi::Device device = {};
    Plan plan = {};
    std::shared_ptr<const Fixtures> fixtures = {};
    std::vector<rhi::Texture> textures = {};  // by resource; imports are set by record()
    std::vector<rhi::Buffer> buffers = {};    // by resource; imports only
    std::vector<PassState> passes = {};

    rhi::QuerySet timestamps = {}, statistics = {};
    rhi::Buffer timestampResults = {}, statisticsResults = {};
    std::uint32_t queryCount = 0;  // render passes and dispatches that are measured
    bool recorded = false;

    std::uint32_t layersOf(const PlanPass& pass) const;
};

/// Names a fault of a pass's shader: "S010", "S011", … in front of the sentence.
rhi::Error shaderError(std::string_view code, std::string text);

/// The group of set 1 for this layout: slots and samplers by the names of the shader's resources.
rhi::Result<rhi::BindGroup> bindGroupFor(Graph::State& state, std::size_t pass, const rhi::BindGroupLayout& layout);

/// Pipelines of fullscreen and compute passes; everything wrong at once.
void makePipelines(Graph::State& state, const ShaderSource& shaders, const PassTree::Description& tree,
                   Reporter& reporter);

rhi::Result<void> makeQueries(Graph::State& state);
/// Copies the queries of a frame to where the host can read them.
void resolveQueries(const Graph::State& state, rhi::CommandEncoder& encoder);

bool isComparison(std::string_view sampler);

}  // namespace pelage::passes
