// SPDX-License-Identifier: MIT
// Runs a plan on a device: owns the transient attachments and the pipelines of fullscreen and compute passes, binds
// slots to shader resources by name, and calls the classes that the host registered for all other passes.
#pragma once

#include <pelage/passes/pass_class.hpp>

#include <string>

namespace pelage::passes {

/// What a pass draws into; a host can make its pipelines for it before the first frame.
Targets targetsOf(const Plan& plan, const PlanPass& pass);

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
        /// That trees may name. A tree with draw lists needs one called `drawListClass`.
        PassClassRegistry classes = {};
        /// For finding faults: paints each image of the heap that can be a target before it begins in a frame (not a
        /// number, or magenta), so that what a pass leaves unwritten shows. Costs a render pass for each layer.
        bool poison = false;
    };
    Graph() = default;
    explicit Graph(Descriptor descriptor);

    /// Compiles the tree for the host and makes what it needs. On an error the last good plan stays in force. When
    /// nothing has changed since the last build that worked (the same tree, settings, imports, extent and depth
    /// convention), the plan stays and the call costs less than 5 us: a host may call it each frame. That a callback in
    /// `host` would answer differently now is not noticed: call invalidate() then. What an attachment with a history
    /// remembers survives a new plan in which the attachment has the same shape.
    Result<void> build(const PassTree& tree, const HostDescription& host);
    /// The next build() plans anew although nothing it can see has changed: shaders were compiled again, say.
    void invalidate() { stale_ = true; }
    const Plan& plan() const;
    bool valid() const { return state_ != nullptr; }
    /// How many plans were made by builds that worked.
    std::uint64_t plansMade() const { return plansMade_; }

    /// Records every pass of the plan. An import that is not as the plan expects (absent P080; format, size, layers or
    /// samples P081) is an error before anything is recorded: build again with what is lent now.
    Result<void> record(rhi::CommandEncoder& encoder, const FrameImports& imports = {});
    /// The texture behind an export; valid after record(), with its contents until the next one. An export of a buffer
    /// is in exportedBuffer().
    rhi::Texture exported(const std::string& name) const;
    rhi::Buffer exportedBuffer(const std::string& name) const;
    /// Per pass, of the last recorded frame; call after its submission is done.
    std::vector<PassReport> reports() const;
    /// From the first begin to the last end timestamp of that frame.
    double frameMilliseconds() const;

private:
    std::shared_ptr<GraphState> state_;
    Descriptor descriptor_;
    std::uint64_t plansMade_ = 0;
    bool stale_ = false;
};

}  // namespace pelage::passes
