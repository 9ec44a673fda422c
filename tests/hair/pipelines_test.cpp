// SPDX-License-Identifier: MIT
// Which pipelines are made, when, on which thread, and what is drawn meanwhile.
#include "frame/pipelines.hpp"
#include "gpu.hpp"
#include "pictures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <condition_variable>
#include <fstream>
#include <iterator>
#include <mutex>
#include <set>
#include <thread>

namespace pelage::test {
namespace {

rhi::RenderPipelineDescriptor someDescriptor() {
    rhi::RenderPipelineDescriptor out{.label = "any"};
    out.vertex.constants = {{"isStrand", 1}, {"sampleCount", 4}};
    out.vertexBuffers = {{.arrayStride = 24,
                          .attributes = {{rhi::VertexFormat::Float32x3, 0, 0}, {rhi::VertexFormat::Float32x3, 12, 1}}}};
    out.primitive = {.topology = rhi::PrimitiveTopology::LineList, .cullMode = rhi::CullMode::Back};
    out.depthStencil = {.format = rhi::TextureFormat::Depth32Float,
                        .depthWriteEnabled = true,
                        .depthCompare = rhi::CompareFunction::GreaterEqual};
    out.multisample = {.count = 4};
    out.fragment = rhi::ProgrammableStage{.constants = {{"lobeR", 1}}};
    out.targets = {{.format = rhi::TextureFormat::RGBA16Float, .blend = rhi::BlendState{}}};
    return out;
}

TEST(SamePipeline, EverythingButTheLabelTellsThemApart) {
    rhi::RenderPipelineDescriptor same = someDescriptor();
    same.label = "another";
    EXPECT_TRUE(hair::samePipeline(same, someDescriptor()));

    using Change = void (*)(rhi::RenderPipelineDescriptor&);
    const Change changes[] = {
        [](auto& d) { d.vertex.constants[0].value = 0; },
        [](auto& d) { d.vertex.constants[0].name = "isCard"; },
        [](auto& d) { d.vertex.constants.pop_back(); },
        [](auto& d) { d.fragment->constants[0].value = 2; },
        [](auto& d) { std::swap(d.vertex.constants, d.fragment->constants); },
        [](auto& d) { d.fragment.reset(); },
        [](auto& d) { d.vertexBuffers.clear(); },
        [](auto& d) { d.vertexBuffers[0].arrayStride = 28; },
        [](auto& d) { d.vertexBuffers[0].stepMode = rhi::VertexStepMode::Instance; },
        [](auto& d) { d.vertexBuffers[0].attributes[1].offset = 16; },
        [](auto& d) { d.vertexBuffers[0].attributes[1].shaderLocation = 2; },
        [](auto& d) { d.vertexBuffers[0].attributes[1].format = rhi::VertexFormat::Float32x2; },
        [](auto& d) { d.primitive.topology = rhi::PrimitiveTopology::TriangleList; },
        [](auto& d) { d.primitive.cullMode = rhi::CullMode::None; },
        [](auto& d) { d.primitive.frontFace = rhi::FrontFace::CW; },
        [](auto& d) { d.primitive.unclippedDepth = true; },
        [](auto& d) { d.depthStencil.reset(); },
        [](auto& d) { d.depthStencil->format = rhi::TextureFormat::Undefined; },
        [](auto& d) { d.depthStencil->depthWriteEnabled = false; },
        [](auto& d) { d.depthStencil->depthCompare = rhi::CompareFunction::Equal; },
        [](auto& d) { d.depthStencil->depthBias = 1; },
        [](auto& d) { d.depthStencil->depthBiasSlopeScale = 1; },
        [](auto& d) { d.multisample.count = 1; },
        [](auto& d) { d.multisample.mask = 1; },
        [](auto& d) { d.multisample.alphaToCoverageEnabled = true; },
        [](auto& d) { d.targets.clear(); },
        [](auto& d) { d.targets[0].format = rhi::TextureFormat::RGBA8Unorm; },
        [](auto& d) { d.targets[0].blend.reset(); },
        [](auto& d) { d.targets[0].blend->alpha.dstFactor = rhi::BlendFactor::One; },
        [](auto& d) { d.targets[0].writeMask = rhi::ColorWriteMask::Red; },
        [](auto& d) { d.targets.push_back(d.targets[0]); },
    };
    for (std::size_t i = 0; i < std::size(changes); ++i) {
        rhi::RenderPipelineDescriptor changed = someDescriptor();
        changes[i](changed);
        EXPECT_FALSE(hair::samePipeline(changed, someDescriptor())) << "change " << i;
        EXPECT_FALSE(hair::samePipeline(someDescriptor(), changed)) << "change " << i;
        EXPECT_TRUE(hair::samePipeline(changed, changed)) << "change " << i;
    }
}

TEST(SamePipeline, AnotherModuleIsAnotherPipeline) {
    const auto shader = [](const char* name) {
        const auto code = hair::Renderer::shaderCode(name);
        return value(Gpu::get().device.createShaderModule({.label = name, .code = {code.begin(), code.end()}}));
    };
    const rhi::ShaderModule one = shader("resolve.frag"), other = shader("copy.frag"), rows = shader("rows.comp");
    rhi::RenderPipelineDescriptor a = someDescriptor(), b = someDescriptor();
    a.fragment->module = b.fragment->module = one;
    EXPECT_TRUE(hair::samePipeline(a, b));
    b.fragment->module = other;
    EXPECT_FALSE(hair::samePipeline(a, b));
    b = a;
    b.vertex.module = other;
    EXPECT_FALSE(hair::samePipeline(a, b));
    const rhi::ComputePipelineDescriptor none, compute{.label = "rows", .compute = {.module = rows}};
    EXPECT_TRUE(hair::samePipeline(none, {.label = "any"}));
    EXPECT_FALSE(hair::samePipeline(none, compute));
    EXPECT_FALSE(hair::samePipeline(compute, {.compute = {.module = rows, .constants = {{"model", 1}}}}));
}

// A gate at which threads wait before a pipeline is made; it remembers which labels came.
class Gate {
public:
    void pass(const std::string& label) {
        std::unique_lock lock(mutex_);
        labels_.push_back(label);
        threads_.insert(std::this_thread::get_id());
        changed_.notify_all();
        if (!open_ && std::this_thread::get_id() == drawing_) {
            ADD_FAILURE() << "a pipeline is made on the thread that draws";
            return;
        }
        changed_.wait(lock, [&] { return open_; });
    }
    void set(bool open) {
        const std::lock_guard lock(mutex_);
        open_ = open;
        changed_.notify_all();
    }
    std::set<std::thread::id> threads() {
        const std::lock_guard lock(mutex_);
        return threads_;
    }
    std::vector<std::string> labels() {
        const std::lock_guard lock(mutex_);
        return labels_;
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    bool open_ = true;
    const std::thread::id drawing_ = std::this_thread::get_id();
    std::vector<std::string> labels_;
    std::set<std::thread::id> threads_;
};

class Pipelines : public ::testing::Test {
protected:
    hair::Renderer renderer(hair::PipelineMode mode) {
        auto tree = dataLibrary().passTree("hair_frame");
        auto made = hair::Renderer::create({.device = Gpu::get().device,
                                            .tree = *tree,
                                            .pipelines = mode,
                                            .beforePipeline = [this](const std::string& label) { gate.pass(label); }});
        EXPECT_TRUE(made);
        return *made;
    }
    static void set(hair::Scene& scene, const char* property, const char* value) {
        for (hair::Object& object : scene.objects) {
            if (hair::isHair(object.geometry)) {
                EXPECT_TRUE(object.material.setFromText(property, value).empty()) << property;
            }
        }
    }

    Gate gate;  // outlives the renderer's thread: declared in the test before it
    ValidationGuard guard;
};

TEST_F(Pipelines, OnlyCombinationsInUseAreMadeAndEachOnce) {
    hair::Scene scene = portrait(strands(), material("brown"));
    hair::Renderer drawing = renderer(hair::PipelineMode::Synchronous);
    const auto made = [&](std::uint32_t size) {
        const std::size_t before = gate.labels().size();
        const hair::Picture picture = render(drawing, scene, size);
        EXPECT_EQ(picture.report.pipelinesMade, gate.labels().size());
        EXPECT_EQ(picture.report.pipelinesPending, 0U);
        return gate.labels().size() - before;
    };
    EXPECT_EQ(made(64), 6U) << "hair and skin, each in the shadow, depth and forward passes";
    EXPECT_EQ(made(64), 0U);
    EXPECT_EQ(made(80), 0U) << "another size, the same formats";
    set(scene, "scattering.longitudinalRoughness", "0.123");
    EXPECT_EQ(made(64), 0U) << "a number is no pipeline";
    set(scene, "scattering.enableTT", "false");
    EXPECT_EQ(made(64), 1U) << "an option that only the forward shader reads";
    set(scene, "scattering.enableTT", "true");
    EXPECT_EQ(made(64), 0U) << "known from before";
    scene.objects.push_back(scene.objects.back());
    EXPECT_EQ(made(64), 0U) << "a second object of the same kind";
    const auto labels = gate.labels();
    EXPECT_EQ(
        std::count_if(labels.begin(), labels.end(), [](const std::string& each) { return each.ends_with(" forward"); }),
        3)
        << "of the skin, and of the hair with TT and without";
    EXPECT_EQ(gate.threads(), std::set<std::thread::id>{std::this_thread::get_id()});
}

TEST_F(Pipelines, AnotherRendererMakesTheSameInTheSameOrder) {
    hair::Scene scene = portrait(strands(), material("brown"));
    hair::Renderer first = renderer(hair::PipelineMode::Synchronous);
    render(first, scene, 32);
    const auto before = gate.labels();
    hair::Renderer second = renderer(hair::PipelineMode::Synchronous);
    render(second, scene, 32);
    const auto all = gate.labels();
    ASSERT_EQ(all.size(), 2 * before.size());
    EXPECT_TRUE(std::equal(before.begin(), before.end(), all.begin() + static_cast<std::ptrdiff_t>(before.size())));
}

// A draw list takes constants of the file: what the pass says goes before what the material says.
TEST_F(Pipelines, ConstantsOfAPassGoBeforeTheMaterials) {
    std::ifstream in(std::string(PELAGE_DATA_DIR) + "/frames/hair_frame.pass.json", std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::string list = "\"drawList\": \"forward\"";
    ASSERT_NE(text.find(list), std::string::npos);
    text.insert(text.find(list), R"("constants": { "shadowMode": 0 }, )");
    const auto tree = passes::PassTree::parse(text, "unshadowed.pass.json");
    ASSERT_TRUE(tree) << tree.error().text();
    hair::Scene scene = portrait(strands(), material("brown"));
    auto unshadowed = hair::Renderer::create({.device = Gpu::get().device, .tree = *tree});
    ASSERT_TRUE(unshadowed);
    hair::Renderer usual = renderer(hair::PipelineMode::Synchronous);
    const hair::Picture byPass = render(*unshadowed, scene, 64);
    EXPECT_NE(byPass.display, render(usual, scene, 64).display);
    for (hair::Object& object : scene.objects)
        EXPECT_TRUE(object.material.setFromText("shadowing.mode", "off").empty());
    EXPECT_EQ(byPass.display, render(usual, scene, 64).display);
}

// The gate is shut while frames are recorded: were one of them to wait for a pipeline, this would never end.
TEST_F(Pipelines, AChangedMaterialNeverWaitsInTheBackground) {
    hair::Scene scene = portrait(strands(), material("brown"));
    set(scene, "shadowing.mode", "hard");  // between this and pcf no number changes, only the option
    hair::Renderer whole = renderer(hair::PipelineMode::Synchronous);
    const hair::Picture before = render(whole, scene, 64);
    set(scene, "shadowing.mode", "pcf");
    const hair::Picture after = render(whole, scene, 64);
    ASSERT_NE(before.display, after.display);
    set(scene, "shadowing.mode", "hard");
    const std::size_t synchronous = gate.labels().size();

    hair::Renderer drawing = renderer(hair::PipelineMode::Background);
    gate.set(false);
    const hair::Picture nothing = render(drawing, scene, 64);
    EXPECT_EQ(nothing.report.pipelinesPending, 6U);
    EXPECT_EQ(nothing.report.pipelinesMade, 0U);
    EXPECT_EQ(coveredFraction(nothing), 0.0);
    gate.set(true);
    drawing.waitForPipelines();
    const hair::Picture first = render(drawing, scene, 64);
    EXPECT_EQ(first.report.pipelinesPending, 0U);
    EXPECT_EQ(first.report.pipelinesMade, 6U);
    EXPECT_EQ(first.display, before.display);

    gate.set(false);
    set(scene, "shadowing.mode", "pcf");
    for (int i = 0; i < 3; ++i) {
        const hair::Picture meanwhile = render(drawing, scene, 64);
        EXPECT_EQ(meanwhile.report.pipelinesPending, 1U);
        EXPECT_EQ(meanwhile.display, before.display) << "as it was";
    }
    gate.set(true);
    drawing.waitForPipelines();
    EXPECT_EQ(render(drawing, scene, 64).display, after.display);

    gate.set(false);
    set(scene, "shadowing.mode", "hard");
    EXPECT_EQ(render(drawing, scene, 64).display, before.display) << "known from before: at once";
    gate.set(true);
    const auto threads = gate.threads();
    EXPECT_EQ(threads.size(), 2U) << "this one for the synchronous renderer, one for the other";
    EXPECT_EQ(gate.labels().size(), synchronous + 7);
}

// Blending moves the object to other passes: it must not vanish between them.
TEST_F(Pipelines, AnObjectIsNeverDrawnByHalf) {
    hair::Scene scene = portrait(cards(), material("brown"));
    hair::Renderer drawing = renderer(hair::PipelineMode::Background);
    render(drawing, scene, 64);
    drawing.waitForPipelines();
    const hair::Picture before = render(drawing, scene, 64);
    gate.set(false);
    set(scene, "blending.mode", "alphaBlend");
    const hair::Picture meanwhile = render(drawing, scene, 64);
    EXPECT_GT(meanwhile.report.pipelinesPending, 0U);
    EXPECT_NEAR(coveredFraction(meanwhile), coveredFraction(before), 0.02);
    gate.set(true);
    drawing.waitForPipelines();
    hair::Renderer whole = renderer(hair::PipelineMode::Synchronous);
    EXPECT_EQ(render(drawing, scene, 64).display, render(whole, scene, 64).display);
}

// What was asked for and is no longer wanted is not waited for, and a resize keeps what is ready.
TEST_F(Pipelines, LaterChangesAndResizesKeepWhatIsReady) {
    hair::Scene scene = portrait(strands(), material("brown"));
    hair::Renderer drawing = renderer(hair::PipelineMode::Background);
    render(drawing, scene, 64);
    drawing.waitForPipelines();
    const hair::Picture before = render(drawing, scene, 64);
    gate.set(false);
    set(scene, "shadowing.mode", "off");
    render(drawing, scene, 64);
    set(scene, "shadowing.mode", "exponential");
    EXPECT_EQ(render(drawing, scene, 64).display, before.display);
    EXPECT_GT(coveredFraction(render(drawing, scene, 96)), 0.1) << "resized while a pipeline is pending";
    gate.set(true);
    drawing.waitForPipelines();
    EXPECT_EQ(render(drawing, scene, 64).display, before.display);
}

TEST_F(Pipelines, ARendererMayGoWhilePipelinesArePending) {
    hair::Scene scene = portrait(strands(), material("brown"));
    {
        hair::Renderer drawing = renderer(hair::PipelineMode::Background);
        render(drawing, scene, 32);
    }
    EXPECT_LE(gate.labels().size(), 6U);
}

}  // namespace
}  // namespace pelage::test
