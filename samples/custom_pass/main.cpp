// SPDX-License-Identifier: MIT
// A pass class of this program's own, named by its own pass tree, drawn with its own shader in the library's frame.
#include <pelage/hair/generate.hpp>
#include <pelage/hair/library.hpp>
#include <pelage/hair/renderer.hpp>
#include <pelage/hair/settings.hpp>

#include <stb/stb_image_write.h>

#include <cstdio>
#include <cstdlib>
#include <string>

// What pelage_shaders() made of outline.frag.
namespace sample {
std::span<const std::uint32_t> embeddedShader(std::string_view name);
}

namespace {

using namespace pelage;

// "class": "Outline" in a tree. It writes one color slot and reads what its shader names u_color and u_depth.
passes::PassClass outline() {
    passes::PassClass made;
    made.info = {.name = "Outline",
                 .kind = passes::PassKind::Raster,
                 .parameters = {{.name = "width", .description = "Pixels", .min = 1, .max = 8, .defaultNumber = 2},
                                {.name = "strength", .description = "0: no ink", .defaultNumber = 1},
                                {.name = "contrast",
                                 .description = "How much nearer an edge is, as a part of the distance",
                                 .min = 0.001,
                                 .defaultNumber = 0.03}}};
    made.create = [](const passes::PassSetup& setup) -> Result<passes::PassRecorder> {
        auto vertex = setup.shaders("fullscreen.vert"), fragment = setup.shaders("outline.frag");
        if (!vertex || !fragment) return tl::unexpected(vertex ? fragment.error() : vertex.error());
        rhi::RenderPipelineDescriptor descriptor{.label = "outline", .vertex = {.module = *vertex}};
        descriptor.fragment = rhi::ProgrammableStage{.module = *fragment};
        for (const char* name : {"width", "strength", "contrast"})
            descriptor.fragment->constants.push_back({name, setup.parameters.number(name)});
        descriptor.targets.push_back({.format = setup.targets.colors.at(0)});
        auto pipeline = setup.device.createRenderPipeline(descriptor);
        if (!pipeline) return tl::unexpected(pipeline.error());
        return passes::PassRecorder([pipeline = *pipeline](passes::PassContext& context) -> Result<void> {
            auto group = context.bindGroup(pipeline.bindGroupLayout(1));
            if (!group) return tl::unexpected(group.error());
            context.raster->setPipeline(pipeline);
            context.raster->setBindGroup(1, *group);
            context.raster->draw(3);
            context.draws += 1;
            return {};
        });
    };
    return made;
}

struct Arguments {
    std::string output = "custom_pass.png", tree = SAMPLE_DIR "/outline.pass.json";
    hair::FrameSettings frame = {};
    std::vector<std::string> settings = {};  // name=value
    bool validation = false;
};

Result<void> run(Arguments arguments) {
    const auto failed = [](Diagnostics faults) { return tl::unexpected<Diagnostics>(std::move(faults)); };
    hair::Library library(PELAGE_DATA_DIR);
    auto tree = library.passTree(arguments.tree);
    auto skin = library.material("skin"), blond = library.material("blond");
    if (!tree) return tl::unexpected(tree.error());
    if (!skin || !blond) return tl::unexpected(skin ? blond.error() : skin.error());
    for (const std::string& text : arguments.settings) {
        const std::size_t equals = std::min(text.find('='), text.size() - 1);
        const std::string name = text.substr(0, equals);
        auto value = hair::parseSetting(**tree, name, text.substr(equals + 1));
        if (!value) return failed(value.error());
        arguments.frame.settings[name] = *value;
    }

    hair::Scene scene;
    hair::Strands groom = hair::makeGroom({.style = hair::Style::Curly, .strands = 3000, .width = 600e-6F});
    scene.objects.push_back(
        {.name = "head", .geometry = std::make_shared<hair::Mesh>(hair::makeHead()), .material = skin->material});
    scene.objects.push_back(
        {.name = "hair", .geometry = std::make_shared<hair::Strands>(std::move(groom)), .material = blond->material});
    glm::vec3 low, high;
    hair::bounds(scene, true, low, high);
    scene.lights = hair::portraitLights(low, high);
    scene.background = {0.9F, 0.85F, 0.75F};
    scene.camera = hair::frameBox(low, high, {-0.8F, 0.2F, 1.0F}, 1.0F);

    int complaints = 0;  // of the validation layer
    auto instance = rhi::Instance::create({.validation = arguments.validation, .onMessage = [&](const rhi::Message& m) {
                                               if (m.level != rhi::LogLevel::Error) return;
                                               ++complaints;
                                               std::fprintf(stderr, "%s\n", m.text.c_str());
                                           }});
    if (!instance) return failed(instance.error());
    auto adapter = instance->requestAdapter();
    if (!adapter) return failed(adapter.error());
    auto device = adapter->requestDevice();
    if (!device) return failed(device.error());
    passes::PassClassRegistry classes;
    classes.add(outline());
    auto renderer = hair::Renderer::create(
        {.device = *device, .tree = *tree, .shaders = sample::embeddedShader, .classes = std::move(classes)});
    if (!renderer) return failed(renderer.error());
    auto picture = renderer->render(scene, arguments.frame);
    if (!picture) return failed(picture.error());

    const int size = static_cast<int>(arguments.frame.width);
    if (!stbi_write_png(arguments.output.c_str(), size, size, 4, picture->display.data(), 4 * size))
        return failed(Diagnostic{.code = "A020", .file = arguments.output, .text = "the picture cannot be written"});
    if (complaints > 0) return failed(Diagnostic{.code = "A031", .text = "the validation layer found errors"});
    return {};
}

}  // namespace

// custom_pass [--validation] [OUT.png [PIXELS [TREE.pass.json [NAME=VALUE ...]]]]
int main(int argc, char** argv) {
    Arguments arguments;
    std::vector<std::string> words(argv + 1, argv + argc);
    if (!words.empty() && words[0] == "--validation") {
        arguments.validation = true;
        words.erase(words.begin());
    }
    if (!words.empty()) arguments.output = words[0];
    if (words.size() > 1) {
        arguments.frame.width = static_cast<std::uint32_t>(std::strtoul(words[1].c_str(), nullptr, 10));
        arguments.frame.height = arguments.frame.width;
    }
    if (words.size() > 2) arguments.tree = words[2];
    if (words.size() > 3) arguments.settings.assign(words.begin() + 3, words.end());
    const auto done = run(std::move(arguments));
    if (!done) std::fputs(done.error().text().c_str(), stderr);
    return done ? 0 : 2;
}
