// SPDX-License-Identifier: MIT
// A compute pass shades with a fibre's material: the same headers, block and options as the forward shader.
#include "harness.hpp"

#include <pelage/hair/functors.hpp>
#include <pelage/materials/material.hpp>

#include <algorithm>
#include <cmath>

namespace pelage::test {

namespace shaders {
std::span<const std::uint32_t> embeddedShader(std::string_view name);
}

namespace {

using rhi::BufferUsage;

struct Query {
    std::array<float, 4> wi, wo;
};

class MaterialInCompute : public ScatteringHarness {
protected:
    // Radiances under the material, and the offset h of each query.
    std::vector<std::array<float, 4>> shade(const materials::CompiledMaterial& material,
                                            const std::vector<Query>& queries, hair::MomentTable* table) {
        const auto code = shaders::embeddedShader("material.comp");
        const auto module =
            value(gpu.device.createShaderModule({.label = "material", .code = {code.begin(), code.end()}}));
        std::vector<rhi::ConstantEntry> constants;
        for (const rhi::ConstantEntry& option : material.options) {
            const auto& declared = module.reflection().specConstants;
            if (std::any_of(declared.begin(), declared.end(), [&](const auto& c) { return c.name == option.name; })) {
                constants.push_back(option);
            }
        }
        const auto pipeline = value(gpu.device.createComputePipeline(
            {.label = "material", .compute = {.module = module, .constants = constants}}));
        const auto sampler = value(gpu.device.createSampler(
            {.label = "linear", .magFilter = rhi::FilterMode::Linear, .minFilter = rhi::FilterMode::Linear}));
        const auto unread = view(value(gpu.device.createTexture({.label = "unread",
                                                                 .size = {1, 1, 1},
                                                                 .format = rhi::TextureFormat::RGBA8Unorm,
                                                                 .usage = rhi::TextureUsage::TextureBinding})));
        std::vector<rhi::BindGroupEntry> entries;
        for (const rhi::ReflectedBinding& binding : module.reflection().bindings) {
            if (binding.group != 2) continue;
            if (binding.entry.type == rhi::BindingType::UniformBuffer) {
                entries.push_back({binding.entry.binding, rhi::BufferBinding{block(binding, material)}});
            } else if (binding.entry.type == rhi::BindingType::Sampler) {
                entries.push_back({binding.entry.binding, sampler});
            } else if (binding.entry.name == "momentTable") {
                entries.push_back({binding.entry.binding, upload(table)});
            } else {
                entries.push_back({binding.entry.binding, unread});  // maps of cards
            }
        }
        const auto output = bufferOf("radiances", std::vector<std::array<float, 4>>(queries.size()),
                                     BufferUsage::Storage | BufferUsage::CopySrc);
        const auto own = value(gpu.device.createBindGroup(
            {.label = "queries",
             .layout = pipeline.bindGroupLayout(0),
             .entries = {{0, rhi::BufferBinding{bufferOf("queries", queries, BufferUsage::Storage)}},
                         {1, rhi::BufferBinding{output}}}}));
        const auto shared = value(gpu.device.createBindGroup(
            {.label = "material", .layout = pipeline.bindGroupLayout(2), .entries = entries}));
        auto encoder = gpu.device.createCommandEncoder("material");
        auto pass = encoder.beginComputePass({.label = "material"});
        pass.setPipeline(pipeline);
        pass.setBindGroup(0, own);
        pass.setBindGroup(2, shared);
        pass.dispatchWorkgroups(static_cast<std::uint32_t>((queries.size() + 63) / 64));
        pass.end();
        run(encoder);
        return read<std::array<float, 4>>(output, queries.size());
    }

private:
    rhi::Buffer block(const rhi::ReflectedBinding& binding, const materials::CompiledMaterial& material) {
        std::vector<float> floats(binding.blockSize / sizeof(float));
        for (const rhi::BlockMember& member : binding.members) {
            const auto input = std::find_if(material.inputs.begin(), material.inputs.end(),
                                            [&](const auto& each) { return each.name == member.name; });
            if (input == material.inputs.end()) {
                ADD_FAILURE() << "the material has no input " << member.name;
                continue;
            }
            std::copy_n(input->value.number.begin(), member.components, floats.begin() + member.offset / sizeof(float));
        }
        return bufferOf("material", floats, BufferUsage::Uniform);
    }
};

TEST_F(MaterialInCompute, RadianceIsWhatTheModelSays) {
    const auto type = materials::MaterialType::load(std::string(PELAGE_MATERIALS) + "/types/hair.materialtype.json",
                                                    hair::functorRegistry());
    ASSERT_TRUE(type) << type.error().text();
    hair::FiberProperties fiber{.eta = 1.5, .betaM = 0.3, .betaN = 0.25, .sigmaA = {0.2, 0.4, 0.9}};
    hair::MomentTable table(fiber.eta, fiber.betaN);
    using enum hair::ScatteringModel;
    for (const hair::ScatteringModel model : {MomentLut, SegmentCdf, Karis, Chiang}) {
        const hair::ModelInfo& info = *hair::findScatteringModel(model);
        materials::Material material(*type);
        for (const auto& [id, text] : {std::pair<std::string_view, std::string_view>{"scattering.model", info.id},
                                       {"scattering.ior", "1.5"},
                                       {"scattering.longitudinalRoughness", "0.3"},
                                       {"scattering.azimuthalRoughness", "0.25"},
                                       {"scattering.cuticleTilt", "0"},
                                       {"absorption.mode", "sigma"},
                                       {"absorption.sigma", "0.2,0.4,0.9"}}) {
            const auto wrong = material.setFromText(id, text);
            ASSERT_TRUE(wrong.empty()) << wrong.text();
        }
        std::vector<Query> queries;
        std::vector<hair::FiberDirections> directions;
        for (const double thetaI : {-0.9, -0.2, 0.3}) {
            for (const double thetaO : {-0.4, 0.1, 0.8}) {
                for (const double phi : {0.0, 0.9, 2.2, 3.1}) {
                    const auto vector = [](double theta, double azimuth) {
                        return std::array<float, 4>{static_cast<float>(std::sin(theta)),
                                                    static_cast<float>(std::cos(theta) * std::cos(azimuth)),
                                                    static_cast<float>(std::cos(theta) * std::sin(azimuth)), 0};
                    };
                    queries.push_back({vector(thetaI, phi), vector(thetaO, 0)});
                    directions.push_back(
                        {std::sin(thetaI), std::cos(thetaI), std::sin(thetaO), std::cos(thetaO), phi, {}});
                }
            }
        }
        const auto found = shade(material.compile(), queries, &table);
        ASSERT_EQ(found.size(), queries.size());
        for (std::size_t i = 0; i < queries.size(); ++i) {
            if (info.nearField) directions[i].h = static_cast<double>(found[i][3]);
            EXPECT_EQ(found[i][3] != 0, info.nearField) << "an offset where the model has one";
            const hair::ScatteredLobes s = hair::scatterDouble(model, false, fiber, directions[i], &table);
            for (std::size_t c = 0; c < 3; ++c) {
                const double expected = s.lobe[0][c] + s.lobe[1][c] + s.lobe[2][c] + s.lobe[3][c];
                EXPECT_NEAR(static_cast<double>(found[i][c]), expected, 1e-3 * expected + 1e-6) << info.id << " " << i;
            }
        }
    }
}

}  // namespace
}  // namespace pelage::test
