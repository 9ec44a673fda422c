// SPDX-License-Identifier: MIT
// Renders a Scene with a pass tree on an rhi::Device. Uploads are cached by geometry; pipelines by what they are made
// of.
#pragma once

#include <pelage/hair/material_pass.hpp>
#include <pelage/hair/scene.hpp>
#include <pelage/passes/graph.hpp>
#include <pelage/rhi/rhi.hpp>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pelage::hair {

/// A host's camera, instead of the scene's. Right-handed view space that looks along -z; clip depth 0..1.
struct HostView {
    glm::mat4 view = glm::mat4(1.0F), projection = glm::mat4(1.0F);
    passes::DepthConvention depth = passes::DepthConvention::Reversed;
    /// True: clip-space +Y is down, as in Vulkan with a viewport of positive height.
    bool clipYDown = true;
};

struct FrameSettings {
    std::uint32_t width = 640, height = 640;
    std::map<std::string, passes::SettingValue> settings = {};  // of the pass tree, those that differ
    std::uint32_t frameIndex = 0;                               // seeds hashed alpha
    std::optional<HostView> view = {};
    /// What the host lends to the tree's imports of these names; hair_host takes "SceneColor" and "SceneDepth". They
    /// may be other textures each frame; another size or format compiles the tree again.
    std::map<std::string, rhi::Texture> imports = {};
    /// The same for the tree's imports that are buffers.
    std::map<std::string, rhi::Buffer> buffers = {};
};

struct AttachmentReport {
    std::string name = {}, format = {};
    rhi::Extent3D extent = {};
    std::uint32_t samples = 1;
    std::uint64_t bytes = 0;
};

/// When pipelines are made. Synchronous: before the frame that needs them is recorded, so that every picture is whole.
/// Background: on one thread of the renderer's own; until all pipelines of a changed material are there, the object is
/// drawn in the same passes and with the same pipelines as before (its numbers are new at once), and at first not at
/// all. A pipeline that cannot be made is an error of the frame, or, where something is shown already, a note of it;
/// the device's error callback hears of it on the thread that tried.
enum class PipelineMode : std::uint8_t { Synchronous, Background };

struct FrameReport {
    std::vector<passes::PassReport> passes = {};
    double gpuMilliseconds = 0;
    std::vector<AttachmentReport> attachments = {};
    std::vector<std::string> culled = {};
    std::uint32_t draws = 0, barriers = 0;
    std::uint64_t triangles = 0, segments = 0;  // submitted, all passes
    std::uint32_t pipelinesPending = 0;         // of materials, still being made
    std::uint32_t pipelinesMade = 0;            // of materials, since the renderer was made
    /// What is worth knowing of material types, said in the frame that uses one first (M017, M050, M052), and pipelines
    /// that could not be made in the background.
    Diagnostics notes = {};
};

/// A finished frame on the CPU, rows from the top.
struct Picture {
    std::uint32_t width = 0, height = 0;
    std::vector<float> linear = {};          // RGBA, scene-linear, premultiplied, alpha = coverage
    std::vector<std::uint8_t> display = {};  // RGBA8, sRGB-encoded, over the background
    FrameReport report = {};
};

/// SPIR-V by the name a material type or pass tree gives a shader; empty when there is none. The words must stay where
/// they are while the renderer lives. The `embeddedShader` that pelage_shaders() generates is one.
using ShaderCode = std::function<std::span<const std::uint32_t>(std::string_view file)>;

/// The strands of an object on the device, as the last frame drew them: for passes of a host's own. All are storage
/// buffers; per-point arrays but `points` begin at first[s] for strand s.
struct StrandBuffers {
    rhi::Buffer points = {}, previousPoints = {};    // float3 at a stride of 12 bytes; the same buffer for what rests
    rhi::Buffer starts = {};                         // u32: in both, strand s begins at point starts[s * startStride]
    std::uint32_t startStride = 1;                   // elements
    rhi::Buffer first = {};                          // u32, strandCount + 1
    rhi::Buffer widths = {};                         // float, m, of point p at [p * widthStride]
    rhi::Buffer colors = {};                         // float3 at a stride of 12 bytes, of point p at [p * colorStride]
    rhi::Buffer ids = {};                            // float, one a strand
    std::uint32_t widthStride = 1, colorStride = 1;  // elements; 0: one for all
    std::uint32_t strandCount = 0;
};

class Renderer {
public:
    struct Descriptor {
        rhi::Device device = {};
        std::shared_ptr<const passes::PassTree> tree = {};
        bool measure = true;
        PipelineMode pipelines = PipelineMode::Synchronous;
        /// Shaders of the host's own; asked before the built-in ones, which may so be replaced. hair/shaders/*.glsl has
        /// the declarations of the sets that the renderer binds.
        ShaderCode shaders = {};
        /// Pass classes of the host's own, for trees that name them. One called passes::drawListClass draws the lists
        /// instead of the renderer.
        passes::PassClassRegistry classes = {};
        /// Pass classes that dispatch the materials' compute shaders.
        std::vector<MaterialPass> materialPasses = {};
        /// Called with a pipeline's label before it is made, on the thread that makes it: for progress and for tests.
        std::function<void(const std::string& label)> beforePipeline = {};
    };
    static Result<Renderer> create(Descriptor descriptor);

    /// Swaps the pass tree; on an error the old one stays.
    Result<void> setTree(std::shared_ptr<const passes::PassTree> tree);

    /// Records the frame; the display picture is then in displayTexture(), the linear one in colorTexture().
    /// `scene` is not const: materials are compiled when their values changed.
    Result<void> encode(Scene& scene, const FrameSettings& settings, rhi::CommandEncoder& encoder);
    rhi::Texture displayTexture() const;  // empty when the tree exports no "LdrColor"
    rhi::Texture colorTexture() const;    // "HdrColor"
    /// Any export of the tree by its name, as Graph::exported(): empty when there is none of that kind.
    rhi::Texture exported(const std::string& name) const;
    rhi::Buffer exportedBuffer(const std::string& name) const;

    /// encode(), submit, wait and read back.
    Result<Picture> render(Scene& scene, const FrameSettings& settings);
    /// Until no pipeline is pending; the next frame draws with all of them. At once in synchronous mode.
    void waitForPipelines();
    /// Of the last frame, once its work is done.
    FrameReport report() const;
    const passes::Plan& plan() const;
    /// Of an object of the last encoded scene, by its index; null when it is not one of strands.
    const StrandBuffers* strandBuffers(std::size_t object) const;
    /// SPIR-V of an embedded shader and the constants a material gives it: for instruction counts.
    static std::span<const std::uint32_t> shaderCode(const std::string& file);
    static std::vector<std::string> shaderNames();

    struct State;

private:
    std::shared_ptr<State> state_;
};

}  // namespace pelage::hair
