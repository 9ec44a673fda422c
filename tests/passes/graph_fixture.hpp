// SPDX-License-Identifier: MIT
// What tests of a graph on a device share: small shaders, a triangle to draw, a frame to run.
#pragma once

#include <pelage/passes/graph.hpp>

#include <array>
#include <gpu.hpp>

namespace pelage::passes::test {
std::span<const std::uint32_t> embeddedShader(std::string_view name);

using Pixel = std::array<std::uint8_t, 4>;

inline std::string edited(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

class GraphTest : public pelage::test::GpuTest {
protected:
    Result<rhi::ShaderModule> shader(const std::string& file) {
        const auto code = embeddedShader(file);
        if (code.empty()) return tl::unexpected(Diagnostic{.text = "no shader '" + file + "'"});
        return gpu.device.createShaderModule({.label = file, .code = {code.begin(), code.end()}});
    }
    /// What records the passes with a draw list.
    std::function<Result<void>(PassContext&)> draws = [this](PassContext& context) { return drawTriangle(context); };
    static Result<void> drawNothing(PassContext&) { return {}; }
    PassClass drawList() {
        return {.info = {.name = std::string(drawListClass)}, .create = [this](const PassSetup&) {
                    return Result<PassRecorder>([this](PassContext& context) { return draws(context); });
                }};
    }
    Graph graph(bool poison = false) {
        PassClassRegistry classes;
        classes.add(drawList());
        return Graph({.device = gpu.device,
                      .shaders = [this](const std::string& file) { return shader(file); },
                      .classes = std::move(classes),
                      .poison = poison});
    }
    static Result<void> build(Graph& graph, const std::string& text, const HostDescription& host) {
        const auto tree = PassTree::parse(text, "test.pass.json");
        if (!tree) return tl::unexpected(tree.error());
        return graph.build(**tree, host);
    }
    static void mustBuild(Graph& graph, const std::string& text, const HostDescription& host) {
        const auto built = build(graph, text, host);
        ASSERT_TRUE(built) << built.error().text();
    }

    // Draws the triangle with a pipeline made for the targets of the pass.
    Result<void> drawTriangle(PassContext& context) {
        rhi::RenderPipelineDescriptor descriptor{.label = "triangle",
                                                 .vertex = {.module = value(shader("triangle.vert"))}};
        descriptor.multisample.count = context.targets.samples;
        if (!context.targets.colors.empty()) descriptor.fragment = {.module = value(shader("triangle.frag"))};
        for (const rhi::TextureFormat format : context.targets.colors) descriptor.targets.push_back({.format = format});
        if (context.targets.depth != rhi::TextureFormat::Undefined) {
            descriptor.depthStencil = {.format = context.targets.depth,
                                       .depthWriteEnabled = !context.targets.depthReadOnly,
                                       .depthCompare = rhi::CompareFunction::Always};
        }
        auto pipeline = gpu.device.createRenderPipeline(descriptor);
        if (!pipeline) return tl::unexpected(std::move(pipeline.error()));
        context.raster->setPipeline(*pipeline);
        context.raster->draw(3);
        context.draws += 1;
        return {};
    }
    void frame(Graph& graph, const FrameImports& imports = {}) {
        auto encoder = gpu.device.createCommandEncoder("frame");
        pelage::test::succeed(graph.record(encoder, imports));
        run(encoder);
    }
    template <class T>
    static T value(Result<T> result) {
        return pelage::test::value(std::move(result));
    }
};

}  // namespace pelage::passes::test
