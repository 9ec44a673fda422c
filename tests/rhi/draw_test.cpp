// SPDX-License-Identifier: MIT
#include "common.hpp"

#include <numeric>

namespace pelage::test {
namespace {

using Draw = RhiTest;

TEST_F(Draw, ClearWritesTheColour) {
    const auto t = target(5, 3);
    auto encoder = device.createCommandEncoder("clear");
    encoder.beginRenderPass(clearPass(view(t), {0.2, 0.4, 0.6, 1})).end();
    run(encoder);
    for (const auto& texel : read<Texel>(t)) EXPECT_EQ(texel, (Texel{51, 102, 153, 255}));
}

TEST_F(Draw, TriangleCoversExactlyTheLowerLeftHalfWithYUp) {
    const auto texels = drawTo(target(8, 8), pipeline("triangle.vert", "color.frag"), {}, {0, 0, 1, 1});
    for (std::size_t y = 0; y < 8; ++y)
        for (std::size_t x = 0; x < 8; ++x) {
            // Row 0 is the top. The hypotenuse runs through texel centres there, which belong to one side by rule.
            if (x == y) continue;
            EXPECT_EQ(texels[y * 8 + x], x < y ? (Texel{255, 0, 0, 255}) : (Texel{0, 0, 255, 255})) << x << ',' << y;
        }
}

TEST_F(Draw, CounterClockwiseOnScreenIsFront) {
    auto d = pipelineDescriptor("full.vert", "color.frag");
    d.primitive.cullMode = CullMode::Back;
    EXPECT_EQ(drawTo(target(4, 4), value(device.createRenderPipeline(d)))[0], (Texel{255, 0, 0, 255}));
    d.primitive.cullMode = CullMode::Front;
    EXPECT_EQ(drawTo(target(4, 4), value(device.createRenderPipeline(d)))[0], (Texel{0, 0, 0, 0}));
    d.primitive.frontFace = FrontFace::CW;
    EXPECT_EQ(drawTo(target(4, 4), value(device.createRenderPipeline(d)))[0], (Texel{255, 0, 0, 255}));
}

TEST_F(Draw, ConstantsByNameChangeTheOutput) {
    auto d = pipelineDescriptor("full.vert", "color.frag");
    d.fragment->constants = {{"RED", 0.2}, {"GREEN", 1}, {"BLUE", 33}, {"ALPHA", 77}};
    EXPECT_EQ(drawTo(target(2, 2), value(device.createRenderPipeline(d)))[3], (Texel{51, 255, 33, 77}));
}

TEST_F(Draw, PushConstantsReachTheShaderAndPartsAreKept) {
    const auto t = target(4, 2);
    const auto p = pipeline("full.vert", "push.frag");
    auto encoder = device.createCommandEncoder("push");
    auto pass = encoder.beginRenderPass(clearPass(view(t)));
    const float a[4] = {0.2F, 0, 0, 1}, b[4] = {0, 0.4F, 0, 0}, c[4] = {0, 0, 0.6F, 0};
    pass.setPipeline(p);
    pass.setPushConstants(0, std::as_bytes(std::span(a)));
    pass.setPushConstants(16, std::as_bytes(std::span(b)));
    pass.setScissorRect(0, 0, 2, 2);
    pass.draw(3);
    pass.setPushConstants(16, std::as_bytes(std::span(c)));
    pass.setScissorRect(2, 0, 2, 2);
    pass.draw(3);
    pass.end();
    run(encoder);
    const auto texels = read<Texel>(t);
    EXPECT_EQ(texels[0], (Texel{51, 102, 0, 255}));
    EXPECT_EQ(texels[3], (Texel{51, 0, 153, 255}));
}

TEST_F(Draw, ReversedDepthKeepsTheNearer) {
    const auto t = target(4, 4);
    const auto z = target(4, 4, TextureFormat::Depth32Float);
    const auto make = [&](double depth, double red) {
        auto d = pipelineDescriptor("full.vert", "color.frag");
        d.vertex.constants = {{"DEPTH", depth}};
        d.fragment->constants = {{"RED", red}};
        d.depthStencil = DepthStencilState{TextureFormat::Depth32Float, true, CompareFunction::Greater};
        return value(device.createRenderPipeline(d));
    };
    const auto close = make(0.75, 1), far = make(0.25, 0.2);
    auto encoder = device.createCommandEncoder("depth");
    auto descriptor = clearPass(view(t));
    descriptor.depthStencilAttachment = RenderPassDepthStencilAttachment{.view = view(z), .depthClearValue = 0};
    auto pass = encoder.beginRenderPass(descriptor);
    pass.setPipeline(close);
    pass.draw(3);
    pass.setPipeline(far);
    pass.draw(3);
    pass.end();
    run(encoder);
    EXPECT_EQ(read<Texel>(t)[5], (Texel{255, 0, 0, 255}));
    EXPECT_FLOAT_EQ(read<float>(z)[5], 0.75F);
}

TEST_F(Draw, VertexIndexAndUniformBuffersFeedAMesh) {
    struct Vertex {
        float x, y;
        std::uint8_t color[4];
    };
    const std::vector<Vertex> vertices = {
        {-1, -1, {255, 0, 0, 255}}, {1, -1, {255, 0, 0, 255}}, {1, 1, {255, 0, 0, 255}}, {-1, 1, {255, 0, 0, 255}}};
    const std::vector<std::uint16_t> indices = {0, 1, 2, 0, 2, 3};
    const std::vector<float> frame = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0.4F, 1, 1, 1};
    const auto vb = bufferOf("vertices", vertices, BufferUsage::Vertex);
    const auto ib = bufferOf("indices", indices, BufferUsage::Index);
    const auto ub = bufferOf("frame", frame, BufferUsage::Uniform);
    auto d = pipelineDescriptor("mesh.vert", "mesh.frag");
    d.vertexBuffers = {{.arrayStride = sizeof(Vertex),
                        .attributes = {{VertexFormat::Float32x2, 0, 0},
                                       {VertexFormat::Unorm8x4, 8, 1},
                                       {VertexFormat::Float32, 0, 7}}}};  // location 7 is not in the shader: dropped
    const auto p = value(device.createRenderPipeline(d));
    const auto g = group(p.bindGroupLayout(0), {{0, BufferBinding{ub}}});
    const auto t = target(4, 4);
    auto encoder = device.createCommandEncoder("mesh");
    auto pass = encoder.beginRenderPass(clearPass(view(t)));
    pass.setPipeline(p);
    pass.setBindGroup(0, g);
    pass.setVertexBuffer(0, vb);
    pass.setIndexBuffer(ib, IndexFormat::Uint16);
    pass.drawIndexed(6);
    pass.end();
    const auto commands = run(encoder);
    for (const auto& texel : read<Texel>(t)) EXPECT_EQ(texel, (Texel{102, 0, 0, 255}));
    EXPECT_EQ(commands.counters().draws, 1U);
    EXPECT_EQ(commands.counters().renderPasses, 1U);
}

TEST_F(Draw, BlendingAddsWithFactors) {
    auto d = pipelineDescriptor("full.vert", "color.frag");
    d.fragment->constants = {{"RED", 1}, {"ALPHA", 51}};
    d.targets[0].blend = BlendState{{BlendOperation::Add, BlendFactor::SrcAlpha, BlendFactor::OneMinusSrcAlpha},
                                    {BlendOperation::Add, BlendFactor::One, BlendFactor::One}};
    EXPECT_EQ(drawTo(target(2, 2), value(device.createRenderPipeline(d)), {}, {0, 1, 0, 0.2})[0],
              (Texel{51, 204, 0, 102}));
}

TEST_F(Draw, TwoTargetsOfDifferentKinds) {
    const auto a = target(4, 1), b = target(4, 1, TextureFormat::R32Uint);
    auto d = pipelineDescriptor("full.vert", "two.frag");
    d.targets.push_back({.format = TextureFormat::R32Uint});
    const auto p = value(device.createRenderPipeline(d));
    auto encoder = device.createCommandEncoder("two");
    auto pass = encoder.beginRenderPass(
        {.label = "two", .colorAttachments = {{.view = view(a)}, {.view = view(b), .clearValue = {9, 0, 0, 0}}}});
    pass.setPipeline(p);
    pass.setScissorRect(0, 0, 3, 1);
    pass.draw(3);
    pass.end();
    run(encoder);
    EXPECT_EQ(read<std::uint32_t>(b), (std::vector<std::uint32_t>{7, 8, 9, 9}));
    EXPECT_EQ(read<Texel>(a)[0], (Texel{0, 255, 0, 255}));
}

TEST_F(Draw, MultisampleResolveAverages) {
    const auto many = target(8, 8, TextureFormat::RGBA8Unorm, 4, TextureUsage::TextureBinding), one = target(8, 8);
    auto d = pipelineDescriptor("triangle.vert", "color.frag");
    d.multisample.count = 4;
    const auto p = value(device.createRenderPipeline(d));
    auto encoder = device.createCommandEncoder("resolve");
    auto pass = encoder.beginRenderPass(
        {.label = "msaa",
         .colorAttachments = {{.view = view(many), .resolveTarget = view(one), .clearValue = {0, 0, 0, 1}}}});
    pass.setPipeline(p);
    pass.draw(3);
    pass.end();
    run(encoder);
    const auto texels = read<Texel>(one);
    EXPECT_EQ(texels[7 * 8][0], 255);  // lower left: inside
    EXPECT_EQ(texels[7][0], 0);        // upper right: outside
    EXPECT_GT(texels[3 * 8 + 3][0], 0);
    EXPECT_LT(texels[3 * 8 + 3][0], 255);  // on the edge: some samples
    // The same average, taken by a shader from the samples.
    const auto q = pipeline("full.vert", "multisample.frag");
    EXPECT_EQ(drawTo(target(8, 8), q, group(q.bindGroupLayout(0), {{0, view(many)}})), texels);
}

TEST_F(Draw, AlphaToCoverageTakesHalfTheSamples) {
    const auto many = target(8, 8, TextureFormat::RGBA8Unorm, 4), one = target(8, 8);
    auto d = pipelineDescriptor("full.vert", "alpha.frag");
    d.multisample = {.count = 4, .alphaToCoverageEnabled = true};
    const auto p = value(device.createRenderPipeline(d));
    auto encoder = device.createCommandEncoder("coverage");
    auto pass = encoder.beginRenderPass(
        {.label = "a2c", .colorAttachments = {{.view = view(many), .resolveTarget = view(one)}}});
    pass.setPipeline(p);
    pass.draw(3);
    pass.end();
    run(encoder);
    const auto texels = read<Texel>(one);
    const int sum = std::accumulate(texels.begin(), texels.end(), 0, [](int s, const Texel& t) { return s + t[0]; });
    EXPECT_NEAR(sum / 64.0, 128, 64);  // the driver chooses the pattern: within one sample of four
}

TEST_F(Draw, WideLineHasItsAreaUnderMultisampling) {
    if (!device.has(Feature::WideLines)) GTEST_SKIP() << "no wide lines";
    const auto many = target(16, 16, TextureFormat::RGBA8Unorm, 4), one = target(16, 16);
    auto d = pipelineDescriptor("line.vert", "white.frag");
    d.primitive.topology = PrimitiveTopology::LineList;
    d.multisample.count = 4;
    const auto p = value(device.createRenderPipeline(d));
    auto encoder = device.createCommandEncoder("line");
    auto pass = encoder.beginRenderPass(
        {.label = "line", .colorAttachments = {{.view = view(many), .resolveTarget = view(one)}}});
    pass.setPipeline(p);
    pass.setLineWidth(3);
    pass.draw(2);
    pass.end();
    run(encoder);
    const auto texels = read<Texel>(one);
    const double area =
        std::accumulate(texels.begin(), texels.end(), 0.0, [](double s, const Texel& t) { return s + t[0] / 255.0; });
    EXPECT_NEAR(area, 8 * 3, 1);  // half the width of the target, three pixels high
}

TEST_F(Draw, EqualDescriptorsGiveTheSamePipelineAndLayouts) {
    auto d = pipelineDescriptor("full.vert", "sample.frag");
    const auto a = value(device.createRenderPipeline(d));
    d.label = "another name";
    const auto b = value(device.createRenderPipeline(d));
    EXPECT_EQ(a, b);
    d.multisample.mask = 1;
    const auto c = value(device.createRenderPipeline(d));
    EXPECT_NE(a, c);
    EXPECT_EQ(a.bindGroupLayout(0), c.bindGroupLayout(0));
    // The same declarations in another fragment shader, and none of the vertex shader's.
    EXPECT_EQ(a.bindGroupLayout(0).find("image")->binding, 0U);
    EXPECT_FALSE(a.bindGroupLayout(1));
}

TEST_F(Draw, ReadOnlyDepthIsTestedAndSampledInOnePass) {
    const auto z = target(4, 4, TextureFormat::Depth32Float, 1, TextureUsage::TextureBinding), t = target(4, 4);
    auto d = pipelineDescriptor("full.vert", "shadow.frag");
    d.vertex.constants = {{"DEPTH", 0.75}};
    d.depthStencil = DepthStencilState{TextureFormat::Depth32Float, false, CompareFunction::Greater};
    const auto p = value(device.createRenderPipeline(d));
    const auto s = value(device.createSampler({.label = "compare", .compare = CompareFunction::Less}));
    const auto g = group(p.bindGroupLayout(0), {{0, view(z)}, {1, s}});
    auto encoder = device.createCommandEncoder("read-only depth");
    encoder
        .beginRenderPass(
            {.label = "clear depth",
             .depthStencilAttachment = RenderPassDepthStencilAttachment{.view = view(z), .depthClearValue = 0.6F}})
        .end();
    auto descriptor = clearPass(view(t));
    descriptor.depthStencilAttachment = RenderPassDepthStencilAttachment{.view = view(z), .depthReadOnly = true};
    auto pass = encoder.beginRenderPass(descriptor);
    pass.setPipeline(p);
    pass.setBindGroup(0, g);
    pass.draw(3);
    pass.end();
    run(encoder);
    EXPECT_EQ(read<Texel>(t)[5], (Texel{255, 255, 255, 255}));  // 0.75 > 0.6 passes; 0.5 < 0.6 is lit
}

}  // namespace
}  // namespace pelage::test
