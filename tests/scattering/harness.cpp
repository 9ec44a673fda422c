// SPDX-License-Identifier: MIT
#include "harness.hpp"

#include <limits>

namespace pelage::test {

namespace shaders {
std::span<const std::uint32_t> embeddedShader(std::string_view name);
}

using rhi::BufferUsage;

hair::FiberProperties anyFiber(std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const auto corner = [&](double low, double high, double value) {
        const double where = unit(random);
        return where < 0.1 ? low : (where < 0.2 ? high : value);
    };
    hair::FiberProperties f;
    f.eta = corner(1.0001, 3.0, 1.0001 + 2.0 * unit(random) * unit(random));
    f.betaM = corner(0.0, 1.0, unit(random));
    f.betaN = corner(0.0, 1.0, unit(random));
    f.alpha = corner(-0.5, 0.5, 0.2 * (unit(random) - 0.5));
    for (double& s : f.sigmaA) s = corner(0.0, 1e4, std::exp(12.0 * unit(random) - 6.0));
    for (double& c : f.color) c = corner(0.0, 1.0, unit(random));
    f.glintGain = corner(0.0, 10.0, unit(random));
    f.glintWidth = corner(0.5, 90.0, 20.0 * unit(random));
    f.glintShift = corner(-30.0, 30.0, 0.0);
    return f;
}

rhi::TextureView ScatteringHarness::upload(hair::MomentTable* table) {
    const std::uint32_t width = table != nullptr ? table->width() : 1, height = table != nullptr ? table->height() : 1;
    const std::vector<std::uint16_t> texels = table != nullptr ? table->halves() : std::vector<std::uint16_t>(12);
    const auto texture =
        value(gpu.device.createTexture({.label = "moments",
                                        .size = {width, height, hair::MomentTable::layers},
                                        .format = rhi::TextureFormat::RGBA16Float,
                                        .usage = rhi::TextureUsage::TextureBinding | rhi::TextureUsage::CopyDst}));
    succeed(gpu.device.queue().writeTexture({.texture = texture}, std::as_bytes(std::span(texels)),
                                            {.bytesPerRow = width * 8, .rowsPerImage = height},
                                            {width, height, hair::MomentTable::layers}));
    return view(texture, {.dimension = rhi::TextureViewDimension::E2DArray});
}

rhi::ComputePipeline ScatteringHarness::pipelineOf(const char* shader, std::vector<rhi::ConstantEntry> constants) {
    const auto code = shaders::embeddedShader(shader);
    const auto module = value(gpu.device.createShaderModule({.label = shader, .code = {code.begin(), code.end()}}));
    return value(gpu.device.createComputePipeline(
        {.label = shader, .compute = {.module = module, .constants = std::move(constants)}}));
}

Found ScatteringHarness::stress(const StressRun& wanted, const std::vector<hair::PackedFiber>& materials,
                                hair::MomentTable* table) {
    const auto pipeline = pipelineOf("stress.comp", {{"scatteringModel", static_cast<double>(wanted.model)},
                                                     {"asPublished", wanted.published ? 1.0 : 0.0},
                                                     {"points", static_cast<double>(wanted.points)},
                                                     {"nonsense", wanted.nonsense ? 1.0 : 0.0},
                                                     {"nearField", wanted.nearField ? 1.0 : 0.0}});
    const auto input = bufferOf("materials", materials, BufferUsage::Storage);
    const auto output = bufferOf("found", std::vector<Found>(1), BufferUsage::Storage | BufferUsage::CopySrc);
    const auto sampler = value(gpu.device.createSampler(
        {.label = "linear", .magFilter = rhi::FilterMode::Linear, .minFilter = rhi::FilterMode::Linear}));
    const auto group = value(gpu.device.createBindGroup(
        {.label = "stress",
         .layout = pipeline.bindGroupLayout(0),
         .entries = {
             {0, rhi::BufferBinding{input}}, {1, rhi::BufferBinding{output}}, {2, upload(table)}, {3, sampler}}}));
    auto encoder = gpu.device.createCommandEncoder("stress");
    auto pass = encoder.beginComputePass({.label = "stress"});
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, group);
    pass.setPushConstants(0, std::as_bytes(std::span(&wanted.seed, 1)));
    pass.dispatchWorkgroups((wanted.invocations + 63) / 64);
    pass.end();
    run(encoder);
    return read<Found>(output, 1)[0];
}

std::vector<float> ScatteringHarness::furnace(hair::ScatteringModel model, bool published, bool nearField,
                                              const std::vector<hair::PackedFiber>& materials,
                                              const std::vector<FurnaceView>& views, hair::MomentTable* table) {
    const auto pipeline = pipelineOf("furnace.comp", {{"scatteringModel", static_cast<double>(model)},
                                                      {"asPublished", published ? 1.0 : 0.0},
                                                      {"steps", static_cast<double>(furnaceSteps)},
                                                      {"nearField", nearField ? 1.0 : 0.0}});
    const std::size_t count = views.size() * furnaceSteps;
    const auto output = bufferOf("energies", std::vector<float>(count), BufferUsage::Storage | BufferUsage::CopySrc);
    const auto sampler = value(gpu.device.createSampler(
        {.label = "linear", .magFilter = rhi::FilterMode::Linear, .minFilter = rhi::FilterMode::Linear}));
    const auto group = value(gpu.device.createBindGroup(
        {.label = "furnace",
         .layout = pipeline.bindGroupLayout(0),
         .entries = {{0, rhi::BufferBinding{bufferOf("materials", materials, BufferUsage::Storage)}},
                     {1, rhi::BufferBinding{bufferOf("views", views, BufferUsage::Storage)}},
                     {2, upload(table)},
                     {3, sampler},
                     {4, rhi::BufferBinding{output}}}}));
    auto encoder = gpu.device.createCommandEncoder("furnace");
    auto pass = encoder.beginComputePass({.label = "furnace"});
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, group);
    pass.dispatchWorkgroups(static_cast<std::uint32_t>((count + 31) / 32));
    pass.end();
    run(encoder);
    const std::vector<float> parts = read<float>(output, count);
    std::vector<float> energies(views.size());
    for (std::size_t i = 0; i < count; ++i) energies[i / furnaceSteps] += parts[i];
    return energies;
}

}  // namespace pelage::test
