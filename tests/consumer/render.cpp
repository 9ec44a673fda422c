// SPDX-License-Identifier: MIT
// The smallest host of pelage::hair: opens a device without a window, reads the installed pass tree and material, draws
// a few strands and looks at the picture. Ends with 0 only if there is brown hair in it.
#include <pelage/hair/generate.hpp>
#include <pelage/hair/library.hpp>
#include <pelage/hair/renderer.hpp>

#include <atomic>
#include <cstdio>
#include <memory>
#include <string>

using namespace pelage;

namespace {

int failed(const std::string& why) {
    std::fprintf(stderr, "consumer: %s\n", why.c_str());
    return 1;
}

/// Hair covers some of the picture, and where it is, it is lit, uneven, and more red than green than blue.
bool looksLikeBrownHair(const hair::Picture& picture) {
    double coverage = 0, red = 0, green = 0, blue = 0, squares = 0;
    for (std::size_t i = 0; i + 3 < picture.linear.size(); i += 4) {
        const double r = picture.linear[i], g = picture.linear[i + 1], b = picture.linear[i + 2];
        const double alpha = picture.linear[i + 3];
        if (alpha <= 0) continue;
        coverage += alpha;
        red += r;
        green += g;
        blue += b;
        squares += g * g / alpha;  // colours are premultiplied
    }
    const double pixels = double(picture.width) * picture.height;
    const double mean = green / coverage, variance = squares / coverage - mean * mean;
    std::printf("covered %.3f, colour %.4f %.4f %.4f, variance of green %.2g\n", coverage / pixels, red / coverage,
                mean, blue / coverage, variance);
    return coverage > 0.05 * pixels && coverage < 0.9 * pixels && red > 1.1 * green && green > 1.1 * blue &&
           blue > 0.001 * coverage && variance > 0.1 * mean * mean;
}

}  // namespace

int main() {
    std::atomic<int> complaints = 0;  // from whatever thread
    auto instance =
        rhi::Instance::create({.label = "consumer", .validation = true, .onMessage = [&](const rhi::Message& m) {
                                   if (m.level != rhi::LogLevel::Error) return;
                                   ++complaints;
                                   failed(m.id + ": " + m.text);
                               }});
    if (!instance) return failed(instance.error().text());
    auto adapter = instance->requestAdapter();
    if (!adapter) return failed(adapter.error().text());
    auto device = adapter->requestDevice();
    if (!device) return failed(device.error().text());

    hair::Library library(CONSUMER_DATA_DIR);
    auto tree = library.passTree("hair_frame");
    if (!tree) return failed(tree.error().text());
    auto material = library.material("brown");
    if (!material) return failed(material.error().text());
    auto renderer = hair::Renderer::create({.device = *device, .tree = *tree});
    if (!renderer) return failed(renderer.error().text());

    hair::Strands groom = hair::makeGroom({.strands = 400, .pointsPerStrand = 12, .width = 0.002F});
    hair::Scene scene;
    scene.objects.push_back({.name = "hair",
                             .geometry = std::make_shared<const hair::Strands>(std::move(groom)),
                             .material = material->material});
    glm::vec3 low, high;
    hair::bounds(scene, true, low, high);
    scene.lights = hair::portraitLights(low, high);
    scene.camera = hair::frameBox(low, high, {0.4F, 0.1F, 1.0F}, 1.0F);
    auto picture = renderer->render(scene, {.width = 64, .height = 64});
    if (!picture) return failed(picture.error().text());
    if (complaints > 0) return failed("the validation layer complained");
    return looksLikeBrownHair(*picture) ? 0 : failed("this is no picture of brown hair");
}
