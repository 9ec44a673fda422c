// SPDX-License-Identifier: MIT
// Passes that the host records itself. A file names a class where another pass names a kind:
//
//     { "name": "Outline", "class": "Outline",
//       "slots": {
//         "depth": { "access": "read", "as": "sampled", "bind": "u_depth" },
//         "color": { "access": "readWrite", "as": "color" } },
//       "connect": { "depth": "Depth.depth", "color": "Resolve.color" },
//       "parameters": { "width": 2, "style": "soft" },
//       "constants": { "kernel": 3 } }
//
// and the host registers it in the registry that it gives to Graph::Descriptor::classes:
//
//     passes::PassClassRegistry classes;
//     classes.add({.info = {.name = "Outline",
//                           .kind = passes::PassKind::Raster,
//                           .parameters = {{.name = "width", .min = 1, .max = 8, .defaultNumber = 1},
//                                          {.name = "style", .type = passes::ParameterInfo::Type::Word,
//                                           .words = {"hard", "soft"}}}},
//                  .create = [](const passes::PassSetup& setup) -> Result<passes::PassRecorder> {
//                      auto pipeline = setup.device.createRenderPipeline(… setup.stage(module) … setup.targets …);
//                      if (!pipeline) return tl::unexpected(pipeline.error());
//                      return passes::PassRecorder([pipeline = *pipeline](passes::PassContext& context) {
//                          auto group = context.bindGroup(pipeline.bindGroupLayout(1));
//                          if (!group) return Result<void>(tl::unexpected(group.error()));
//                          context.raster->setPipeline(pipeline);
//                          context.raster->setBindGroup(1, *group);
//                          context.raster->draw(3);
//                          return Result<void>();
//                      });
//                  }});
//
// The graph does the rest: order, attachments, load and store, clears, barriers, labels, queries, memory. What a class
// touches must be a slot; a resource that it brings itself (a pipeline, a vertex buffer) it must keep alive itself.
// Faults of a file are found when it is compiled: an unknown class (P053, with the nearest name), a parameter that the
// class does not have or that it needs (P054), a value outside its range (P055), a slot that such a pass cannot have
// (P023). A constant that none of the class's shaders has is P077, with the nearest name. A fault of create() keeps its
// code, at the class's place; no recorder is P072. The last good plan stays.
#pragma once

#include <pelage/passes/tree.hpp>
#include <pelage/rhi/rhi.hpp>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace pelage::passes {

/// The shader module of a file named in a tree ("resolve.frag"), or an error.
using ShaderSource = std::function<Result<rhi::ShaderModule>(const std::string& file)>;

/// What a pass draws into.
struct Targets {
    std::vector<rhi::TextureFormat> colors = {};
    rhi::TextureFormat depth = rhi::TextureFormat::Undefined;
    std::uint32_t samples = 1;
    bool depthReadOnly = false;
    bool operator==(const Targets&) const = default;
};

/// The values of a pass's parameters. Asking for one that the class does not declare is a slip of the program and gives
/// 0, false or "".
class PassParameters {
public:
    explicit PassParameters(const std::vector<PlanParameter>& values) : values_(values) {}
    double number(std::string_view name) const;
    bool flag(std::string_view name) const { return number(name) != 0; }
    const std::string& word(std::string_view name) const;
    /// The index of a word among those its ParameterInfo lists.
    std::uint32_t index(std::string_view name) const { return static_cast<std::uint32_t>(number(name)); }

private:
    const std::vector<PlanParameter>& values_;
};

/// Given to create(); valid during the call.
struct PassSetup {
    const rhi::Device& device;
    const Plan& plan;
    const PlanPass& pass;
    const Targets& targets;  // of a Raster class; empty for the others
    PassParameters parameters;
    const ShaderSource& shaders;  // the graph's

    /// The stage of a pipeline of this pass: the module with those of its specialization constants that the file gives
    /// a value ("constants": {"samples": 4}), else what the images say of themselves (u_depth_samples and
    /// u_depth_present for the bind u_depth). A constant of the file that is in no stage asked for here is an error of
    /// the build (P077).
    rhi::ProgrammableStage stage(const rhi::ShaderModule& module) const;
    /// All constants of the file, for a class that makes its pipelines later: none of them is an error then.
    const std::map<std::string, double>& constants() const;

    struct Asked {
        bool all = false;                     // constants() was called
        std::vector<std::string> names = {};  // constants of the modules that stage() was given
    };
    Asked& asked;
};

struct GraphState;

/// Given to the recorder, for each frame (and for each layer of a pass with "forEachView"); valid during the call.
class PassContext {
public:
    PassContext(GraphState& state, std::size_t index);

    const PlanPass& pass;
    PassParameters parameters;
    const Targets& targets;
    rhi::Extent3D extent = {};    // of the targets; of the frame for Compute and Copy
    std::uint32_t viewIndex = 0;  // the layer that is drawn into
    // One of these is there, by the class's kind. Render and compute passes are begun and ended by the graph.
    rhi::RenderPassEncoder* raster = nullptr;
    rhi::ComputePassEncoder* compute = nullptr;
    rhi::CommandEncoder* copy = nullptr;
    std::uint32_t draws = 0;  // the recorder adds what it draws or dispatches; for PassReport

    /// The bind group of set 1 for a pipeline's layout of that set: slots by their "bind", samplers by their names
    /// (s_linear, s_nearest, s_linearRepeat, s_shadow). Cached. An error names what no slot provides.
    Result<rhi::BindGroup> bindGroup(const rhi::BindGroupLayout& layout) const;
    /// The image or buffer of a slot; an empty handle when the slot is not connected or is of the other kind.
    rhi::Texture texture(std::string_view slot) const;
    rhi::Buffer buffer(std::string_view slot) const;

private:
    GraphState& state_;
    std::size_t index_;
};

/// Records one pass. An error ends the frame: Graph::record gives it back.
using PassRecorder = std::function<Result<void>(PassContext&)>;

struct PassClass {
    PassClassInfo info = {};
    /// Called by Graph::build once for each pass of the class: the place to make pipelines. The recorder lives as long
    /// as the plan.
    std::function<Result<PassRecorder>(const PassSetup&)> create = {};
};

/// A value: copied into a graph, and no two graphs share one.
class PassClassRegistry {
public:
    /// False when there is a class of that name, its name is empty or it has no create(); the registry is as before.
    bool add(PassClass made);
    const PassClass* find(std::string_view name) const;
    const std::vector<PassClass>& classes() const { return classes_; }
    /// What HostDescription::classes wants, for compiling without a device.
    std::vector<PassClassInfo> infos() const;

private:
    std::vector<PassClass> classes_;
};

}  // namespace pelage::passes
