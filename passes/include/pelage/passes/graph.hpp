// SPDX-License-Identifier: MIT
// Runs a plan on a device: owns the transient attachments and the pipelines of fullscreen and compute passes, binds
// slots to shader resources by name, and calls the host for the draws of raster passes.
#pragma once

#include <pelage/passes/tree.hpp>
#include <pelage/rhi/rhi.hpp>

#include <functional>
#include <string>

namespace pelage::passes {

/// The shader module of a file named in a tree ("resolve.frag"), or an error.
using ShaderSource = std::function<rhi::Result<rhi::ShaderModule>(const std::string& file)>;

struct Targets {
    std::vector<rhi::TextureFormat> colors = {};
    rhi::TextureFormat depth = rhi::TextureFormat::Undefined;
    std::uint32_t samples = 1;
    bool depthReadOnly = false;
    bool operator==(const Targets&) const = default;
};

/// What a pass draws into; a host can make its pipelines for it before the first frame.
Targets targetsOf(const Plan& plan, const PlanPass& pass);

/// Given to the host when a raster pass wants its draws.
struct RasterContext {
    const PlanPass& pass;
    std::uint32_t viewIndex = 0;  // layer, for passes with forEachView
    rhi::Extent3D extent = {};
    const Targets& targets;
    rhi::RenderPassEncoder& encoder;
    /// The bind group of set 1 for a pipeline's layout of that set: slots matched by shader resource name, samplers by
    /// their names ("s_linear", "s_nearest", "s_shadow", "s_linearRepeat"). Cached. An error names what no slot
    /// provides.
    std::function<rhi::Result<rhi::BindGroup>(const rhi::BindGroupLayout&)> bindGroup;
    std::uint32_t draws = 0;  // the host adds what it draws; for PassReport
};
using DrawCallback = std::function<rhi::Result<void>(RasterContext&)>;

struct FrameImports {
    std::map<std::string, rhi::Texture> textures = {};
    std::map<std::string, rhi::Buffer> buffers = {};
};

struct PassReport {
    std::string name = {};
    double gpuMilliseconds = 0;                 // 0 without Feature::Timestamps
    double cpuMilliseconds = 0;                 // recording
    std::uint64_t fragments = 0, vertices = 0;  // 0 without Feature::PipelineStatistics
    std::uint32_t draws = 0;
};

class Graph {
public:
    struct Descriptor {
        rhi::Device device = {};
        ShaderSource shaders = {};
        bool measure = true;  // timestamps and statistics per pass
    };
    Graph() = default;
    explicit Graph(Descriptor descriptor);

    /// Compiles the tree for the host and makes what it needs. On an error the last good plan stays in force.
    Checked<void> build(const PassTree& tree, const HostDescription& host);
    const Plan& plan() const;
    bool valid() const { return state_ != nullptr; }

    /// Records every pass of the plan. `draws` is called once per raster pass (and layer).
    rhi::Result<void> record(rhi::CommandEncoder& encoder, const FrameImports& imports, const DrawCallback& draws);
    /// The texture behind an export; valid after record().
    rhi::Texture exported(const std::string& name) const;
    /// Per pass, of the last recorded frame; call after its submission is done.
    std::vector<PassReport> reports() const;
    /// From the first begin to the last end timestamp of that frame.
    double frameMilliseconds() const;

    struct State;

private:
    std::shared_ptr<State> state_;
    Descriptor descriptor_;
};

}  // namespace pelage::passes
