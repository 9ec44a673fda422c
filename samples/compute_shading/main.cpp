// SPDX-License-Identifier: MIT
// Shades the points of a strand in a compute pass and prints them beside the same on the CPU, as CSV.
#include "shade_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace {

using namespace pelage;

Result<void> run(bool validation) {
    const auto failed = [](Diagnostics faults) { return tl::unexpected<Diagnostics>(std::move(faults)); };
    hair::Library library(PELAGE_DATA_DIR);
    auto material = sample::shadingMaterial(library);
    auto tree = library.passTree(SAMPLE_DIR "/shading.pass.json");
    if (!material || !tree) return tl::unexpected(material ? tree.error() : material.error());
    hair::Scene scene = sample::shadingScene(*material);
    const std::vector<glm::vec4> points = sample::strand(64);

    int complaints = 0;  // of the validation layer
    auto instance = rhi::Instance::create({.validation = validation, .onMessage = [&](const rhi::Message& m) {
                                               if (m.level != rhi::LogLevel::Error) return;
                                               ++complaints;
                                               std::fprintf(stderr, "%s\n", m.text.c_str());
                                           }});
    if (!instance) return failed(instance.error());
    auto adapter = instance->requestAdapter();
    if (!adapter) return failed(adapter.error());
    auto device = adapter->requestDevice();
    if (!device) return failed(device.error());
    auto shaded = sample::shadeOnDevice(*device, *tree, scene, points);
    if (!shaded) return failed(shaded.error());

    const std::vector<glm::dvec3> truth = sample::shadeOnCpu(scene, points);
    double largest = 0, error = 0;
    for (const glm::dvec3& one : truth) largest = std::max({largest, one.r, one.g, one.b});
    std::printf("point,r,g,b,r_cpu,g_cpu,b_cpu\n");
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 made(glm::vec3((*shaded)[i]));
        const glm::dvec3 off = glm::abs(made - truth[i]);
        error = std::max({error, off.r, off.g, off.b});
        std::printf("%zu,%.7g,%.7g,%.7g,%.7g,%.7g,%.7g\n", i, made.r, made.g, made.b, truth[i].r, truth[i].g,
                    truth[i].b);
    }
    std::fprintf(stderr, "largest difference %.2e of the largest radiance\n", error / largest);
    if (complaints > 0) return failed(Diagnostic{.code = "A031", .text = "the validation layer found errors"});
    return {};
}

}  // namespace

// compute_shading [--validation]
int main(int argc, char** argv) {
    const auto done = run(argc > 1 && std::string_view(argv[1]) == "--validation");
    if (!done) std::fputs(done.error().text().c_str(), stderr);
    return done ? 0 : 2;
}
