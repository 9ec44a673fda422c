// SPDX-License-Identifier: MIT
// A material type, its shader and its functor, all of this program's own, drawn with the library's renderer.
#include <pelage/hair/functors.hpp>
#include <pelage/hair/generate.hpp>
#include <pelage/hair/library.hpp>
#include <pelage/hair/renderer.hpp>

#include <stb/stb_image_write.h>

#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>

// What pelage_shaders() made of iridescent.frag.
namespace sample {
std::span<const std::uint32_t> embeddedShader(std::string_view name);
}

namespace {

using namespace pelage;
using materials::Port;
using materials::Value;
using materials::ValueType;

// From the film an artist describes to the phases the shader needs.
materials::FunctorType thinFilm() {
    materials::FunctorType type;
    type.name = "ThinFilm";
    type.description = "Phase difference across a film for red, green and blue; off when its strength is zero.";
    type.in = {{"strength"}, {"thickness"}, {"index"}};
    type.out = {
        {"phase", Port::Kind::Value, ValueType::Float3}, {"strength"}, {"on", Port::Kind::Value, ValueType::Bool}};
    type.run = [](std::span<const Value> in, materials::FunctorOutputs& out) {
        const float strength = in[0].number[0], path = 2.0F * in[1].number[0] * in[2].number[0];  // nm
        const auto phase = [&](float wavelength) { return 2.0F * std::numbers::pi_v<float> * path / wavelength; };
        out.set(0, Value::float3(phase(611), phase(549), phase(465)));
        out.set(1, Value::scalar(strength));
        out.set(2, Value::boolean(strength > 0));
    };
    return type;
}

struct Arguments {
    std::string output = "custom_material.png", thickness = {};
    std::uint32_t size = 640;
    bool validation = false;
};

Result<void> run(const Arguments& arguments) {
    const auto failed = [](Diagnostics faults) { return tl::unexpected<Diagnostics>(std::move(faults)); };

    // The functor by its name, then the type and material that name it.
    materials::FunctorRegistry functors = hair::functorRegistry();
    functors.add(thinFilm());
    hair::Library library(PELAGE_DATA_DIR, functors);
    auto material = library.material(SAMPLE_DIR "/petrol.material.json");
    if (!material) return tl::unexpected(material.error());
    if (!arguments.thickness.empty()) {
        const Diagnostics found = material->material.setFromText("film.thickness", arguments.thickness);
        if (found.hasErrors()) return failed(found);
    }
    auto skin = library.material("skin");
    auto tree = library.passTree("hair_frame");
    if (!skin || !tree) return tl::unexpected(skin ? tree.error() : skin.error());

    hair::Strands groom = hair::makeGroom({.style = hair::Style::Wavy, .strands = 12000, .width = 350e-6F});
    hair::Scene scene;
    scene.objects.push_back(
        {.name = "head", .geometry = std::make_shared<hair::Mesh>(hair::makeHead()), .material = skin->material});
    scene.objects.push_back({.name = "hair",
                             .geometry = std::make_shared<hair::Strands>(std::move(groom)),
                             .material = material->material});
    glm::vec3 low, high;
    hair::bounds(scene, true, low, high);
    scene.lights = hair::portraitLights(low, high);
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
    // The shader by the name that the material type gives it.
    auto renderer = hair::Renderer::create({.device = *device, .tree = *tree, .shaders = sample::embeddedShader});
    if (!renderer) return failed(renderer.error());
    auto picture = renderer->render(scene, {.width = arguments.size, .height = arguments.size});
    if (!picture) return failed(picture.error());
    std::fputs(picture->report.notes.text().c_str(), stderr);

    const int size = static_cast<int>(arguments.size);
    if (!stbi_write_png(arguments.output.c_str(), size, size, 4, picture->display.data(), 4 * size))
        return failed(Diagnostic{.code = "A020", .file = arguments.output, .text = "the picture cannot be written"});
    if (complaints > 0) return failed(Diagnostic{.code = "A031", .text = "the validation layer found errors"});
    return {};
}

}  // namespace

// custom_material [--validation] [OUT.png [PIXELS [FILM_THICKNESS_NM]]]
int main(int argc, char** argv) {
    Arguments arguments;
    std::vector<std::string> words(argv + 1, argv + argc);
    if (!words.empty() && words[0] == "--validation") {
        arguments.validation = true;
        words.erase(words.begin());
    }
    if (!words.empty()) arguments.output = words[0];
    if (words.size() > 1) arguments.size = static_cast<std::uint32_t>(std::strtoul(words[1].c_str(), nullptr, 10));
    if (words.size() > 2) arguments.thickness = words[2];
    const auto done = run(arguments);
    if (!done) std::fputs(done.error().text().c_str(), stderr);
    return done ? 0 : 2;
}
