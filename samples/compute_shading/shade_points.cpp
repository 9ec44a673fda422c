// SPDX-License-Identifier: MIT
#include "shade_points.hpp"

#include <pelage/hair/functors.hpp>
#include <pelage/hair/generate.hpp>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <numbers>

namespace sample {

using namespace pelage;

// What pelage_shaders() made of points.comp.
std::span<const std::uint32_t> embeddedShader(std::string_view name);

namespace {

// "class": "ShadePoints" in a tree. The renderer sets the pipeline and the four bind groups; one thread for each point
// is all that is left to say.
hair::MaterialPass shadePoints() {
    return {.info = {.name = "ShadePoints"}, .dispatch = [](const hair::MaterialDispatch& shader) -> Result<void> {
                const std::uint64_t points = shader.pass.buffer("points").size() / sizeof(glm::vec4);
                shader.encoder.dispatchWorkgroups(static_cast<std::uint32_t>((points + 63) / 64));
                shader.pass.draws += 1;
                return {};
            }};
}

}  // namespace

Result<materials::Material> shadingMaterial(hair::Library& library) {
    const std::string file = library.dataDirectory() + "/types/hair.materialtype.json";
    std::ifstream in(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::string_view shaders = "\"shaders\": {";
    const std::size_t at = text.find(shaders);
    if (at != std::string::npos)
        text.insert(at + shaders.size(),
                    R"("points": { "drawList": "shade", "compute": "points.comp", "options": "*" },)");
    auto type = materials::MaterialType::parse(text, file, hair::functorRegistry());
    if (!type) return tl::unexpected(std::move(type.error()));
    materials::Material material(*type);
    Diagnostics faults;
    for (const auto& [property, value] : {std::pair{"surface.baseColor", "1,1,1"},
                                          {"surface.useStrandId", "false"},
                                          {"absorption.mode", "sigma"},
                                          {"absorption.sigma", "0.2,0.4,0.9"},
                                          {"scattering.longitudinalRoughness", "0.3"},
                                          {"scattering.azimuthalRoughness", "0.25"}}) {
        faults.append(material.setFromText(property, value));
    }
    if (faults.hasErrors()) return tl::unexpected(std::move(faults));
    return material;
}

std::vector<glm::vec4> strand(std::size_t count) {
    std::vector<glm::vec4> points;
    for (std::size_t i = 0; i < count; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(count), angle = 9.0F * t;
        points.emplace_back(0.02F * std::cos(angle), -0.2F * t, 0.02F * std::sin(angle), 1.0F);
    }
    return points;
}

hair::Scene shadingScene(materials::Material material) {
    hair::Scene scene;
    // The pass reads points of its own; what the object is drawn with does not matter to it.
    hair::Strands groom = hair::makeGroom({.style = hair::Style::Straight, .strands = 1, .pointsPerStrand = 4});
    scene.objects.push_back({.name = "strand",
                             .geometry = std::make_shared<const hair::Strands>(std::move(groom)),
                             .material = std::move(material),
                             .transform = glm::rotate(glm::translate(glm::mat4(1.0F), {0.1F, 0.2F, -0.1F}), 0.4F,
                                                      glm::vec3(0.6F, 0, 0.8F))});
    scene.lights = {{.direction = {-0.6F, -0.48F, -0.64F}, .color = {1, 0.9F, 0.8F}, .intensity = 2},
                    {.kind = hair::Light::Kind::Point, .position = {0.5F, 0.8F, 0.7F}, .intensity = 1.5F}};
    scene.camera = {.eye = {0.3F, 0.1F, 1.2F}, .target = {0.1F, 0.1F, 0}};
    return scene;
}

Result<std::vector<glm::vec4>> shadeOnDevice(const rhi::Device& device, std::shared_ptr<const passes::PassTree> tree,
                                             hair::Scene& scene, std::span<const glm::vec4> points) {
    const auto failed = [](Diagnostics faults) { return tl::unexpected<Diagnostics>(std::move(faults)); };
    auto renderer = hair::Renderer::create(
        {.device = device, .tree = std::move(tree), .shaders = embeddedShader, .materialPasses = {shadePoints()}});
    if (!renderer) return tl::unexpected(renderer.error());
    const std::uint64_t bytes = points.size_bytes();
    auto lent = device.createBuffer(
        {.label = "points", .size = bytes, .usage = rhi::BufferUsage::Storage | rhi::BufferUsage::CopyDst});
    auto back = device.createBuffer(
        {.label = "readback", .size = bytes, .usage = rhi::BufferUsage::MapRead | rhi::BufferUsage::CopyDst});
    if (!lent || !back) return failed(lent ? back.error() : lent.error());
    if (auto written = device.queue().writeBuffer(*lent, 0, std::as_bytes(points)); !written)
        return failed(written.error());

    hair::FrameSettings settings{.buffers = {{"Points", *lent}}};
    settings.settings["points"] = {.type = passes::SettingValue::Type::Uint,
                                   .number = static_cast<std::uint32_t>(points.size())};
    rhi::CommandEncoder encoder = device.createCommandEncoder("shade points");
    if (auto encoded = renderer->encode(scene, settings, encoder); !encoded) return tl::unexpected(encoded.error());
    encoder.copyBufferToBuffer(renderer->exportedBuffer("Radiance"), 0, *back, 0, bytes);
    auto commands = encoder.finish();
    if (!commands) return failed(commands.error());
    auto sent = device.queue().submit(*commands);
    if (!sent) return failed(sent.error());
    if (auto waited = device.queue().wait(*sent); !waited) return failed(waited.error());
    std::vector<glm::vec4> radiance(points.size());
    std::memcpy(radiance.data(), back->mapped().data(), bytes);
    return radiance;
}

std::vector<glm::dvec3> shadeOnCpu(const hair::Scene& scene, std::span<const glm::vec4> points) {
    const hair::Object& object = scene.objects.front();
    const materials::Material& material = object.material;
    const auto number = [&](const char* id) { return static_cast<double>(material.get(id)->number[0]); };
    hair::FiberProperties fiber;
    fiber.eta = number("scattering.ior");
    fiber.betaM = number("scattering.longitudinalRoughness");
    fiber.betaN = number("scattering.azimuthalRoughness");
    fiber.alpha = number("scattering.cuticleTilt") * std::numbers::pi / 180.0;
    for (std::size_t c = 0; c < 3; ++c) {
        fiber.sigmaA[c] = static_cast<double>(material.get("absorption.sigma")->number[c]);
        fiber.color[c] = std::exp(-4.0 * fiber.sigmaA[c]);  // of models without absorption
    }
    const auto model = static_cast<hair::ScatteringModel>(material.get("scattering.model")->integer);
    const hair::ModelInfo& info = hair::scatteringModels()[static_cast<std::size_t>(model)];
    hair::MomentTable table(fiber.eta, fiber.betaN);

    const glm::dmat4 transform(object.transform);
    const auto world = [&](std::size_t i) { return glm::dvec3(transform * glm::dvec4(glm::dvec3(points[i]), 1.0)); };
    std::vector<glm::dvec3> radiance;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 at = world(i);
        const glm::dvec3 u = glm::normalize(world(std::min(i + 1, points.size() - 1)) - world(i == 0 ? 0 : i - 1));
        const glm::dvec3 wo = glm::normalize(glm::dvec3(scene.camera.eye) - at);
        glm::dvec3 sum(0.0);
        for (const hair::Light& light : scene.lights) {
            glm::dvec3 wi = -glm::normalize(glm::dvec3(light.direction));
            glm::dvec3 arriving = glm::dvec3(light.color) * static_cast<double>(light.intensity);
            if (light.kind == hair::Light::Kind::Point) {
                const glm::dvec3 to = glm::dvec3(light.position) - at;
                wi = glm::normalize(to);
                arriving /= glm::dot(to, to);
            }
            const glm::dvec3 acrossI = glm::cross(u, wi), acrossO = glm::cross(u, wo);
            hair::FiberDirections directions{
                .sinThetaI = glm::dot(u, wi),
                .cosThetaI = glm::length(acrossI),
                .sinThetaO = glm::dot(u, wo),
                .cosThetaO = glm::length(acrossO),
                .phi = std::atan2(glm::dot(u, glm::cross(acrossO, acrossI)), glm::dot(acrossO, acrossI))};
            // The shader gives an offset to this model only: that of a ray through the axis.
            if (model == hair::ScatteringModel::Chiang) directions.h = 0.0;
            const auto lobes =
                hair::scatterDouble(model, false, fiber, directions, info.usesTable ? &table : nullptr).lobe;
            for (const auto& lobe : lobes) sum += glm::dvec3(lobe[0], lobe[1], lobe[2]) * arriving;
        }
        radiance.push_back(sum);
    }
    return radiance;
}

}  // namespace sample
