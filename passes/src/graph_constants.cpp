// SPDX-License-Identifier: MIT
// The fixtures of a graph: samplers and the 1 x 1 stand-ins.
#include "graph_state.hpp"

#include <cstring>

namespace pelage::passes {
namespace {

struct SamplerRow {
    const char* name;
    rhi::FilterMode filter;
    rhi::AddressMode address;
};

Result<rhi::Texture> makeConstant(const rhi::Device& device, const std::string& name, std::array<std::uint8_t, 4> texel,
                                  rhi::TextureFormat format, std::uint32_t layers, rhi::TextureDimension dimension) {
    auto usage = rhi::TextureUsage::TextureBinding | rhi::TextureUsage::CopyDst;
    // The layout in which depth is sampled is one of attachments.
    if (rhi::isDepth(format)) usage = usage | rhi::TextureUsage::RenderAttachment;
    auto texture = device.createTexture({.label = name,
                                         .size = {1, 1, layers},
                                         .dimension = dimension,
                                         .format = format,
                                         .usage = usage,
                                         .cubeCompatible = layers == 6});
    if (!texture) return texture;
    std::vector<std::uint8_t> bytes;
    for (std::uint32_t layer = 0; layer < layers; ++layer) bytes.insert(bytes.end(), texel.begin(), texel.end());
    const auto written = device.queue().writeTexture({.texture = *texture}, std::as_bytes(std::span(bytes)),
                                                     {.bytesPerRow = 4, .rowsPerImage = 1}, {1, 1, layers});
    if (!written) return tl::unexpected(written.error());
    return texture;
}

}  // namespace

bool isComparison(std::string_view sampler) {
    return sampler == "s_shadow";
}

Result<std::shared_ptr<const Fixtures>> makeFixtures(const rhi::Device& device, DepthConvention depth) {
    auto fixtures = std::make_shared<Fixtures>();
    fixtures->depth = depth;
    using rhi::AddressMode;
    using rhi::FilterMode;
    for (const SamplerRow& row : {SamplerRow{"s_linear", FilterMode::Linear, AddressMode::ClampToEdge},
                                  SamplerRow{"s_nearest", FilterMode::Nearest, AddressMode::ClampToEdge},
                                  SamplerRow{"s_linearRepeat", FilterMode::Linear, AddressMode::Repeat},
                                  SamplerRow{"s_shadow", FilterMode::Linear, AddressMode::ClampToEdge}}) {
        rhi::SamplerDescriptor descriptor{.label = row.name,
                                          .addressModeU = row.address,
                                          .addressModeV = row.address,
                                          .addressModeW = row.address,
                                          .magFilter = row.filter,
                                          .minFilter = row.filter,
                                          .mipmapFilter = row.filter};
        // Lit when the receiver is as near as the nearest caster, or nearer.
        const bool reversed = depth == DepthConvention::Reversed;
        if (isComparison(row.name)) {
            descriptor.compare = reversed ? rhi::CompareFunction::GreaterEqual : rhi::CompareFunction::LessEqual;
            descriptor.mipmapFilter = FilterMode::Nearest;
        }
        auto sampler = device.createSampler(descriptor);
        if (!sampler) return tl::unexpected(std::move(sampler.error()));
        fixtures->samplers[row.name] = std::move(*sampler);
    }

    const float far = depth == DepthConvention::Reversed ? 0.0F : 1.0F;
    std::array<std::uint8_t, 4> farBytes{};
    std::memcpy(farBytes.data(), &far, sizeof(far));
    struct Row {
        const char* name;
        std::array<std::uint8_t, 4> texel;
        rhi::TextureFormat format;
        std::uint32_t layers;
        rhi::TextureDimension dimension = rhi::TextureDimension::E2D;
    };
    for (const Row& row :
         {Row{"const.white", {255, 255, 255, 255}, rhi::TextureFormat::RGBA8Unorm, 1},
          Row{"const.black", {0, 0, 0, 255}, rhi::TextureFormat::RGBA8Unorm, 1},
          Row{"const.transparent", {0, 0, 0, 0}, rhi::TextureFormat::RGBA8Unorm, 1},
          Row{"const.transparent3D", {0, 0, 0, 0}, rhi::TextureFormat::RGBA8Unorm, 1, rhi::TextureDimension::E3D},
          Row{"const.blackCube", {0, 0, 0, 255}, rhi::TextureFormat::RGBA8Unorm, 6},
          Row{"const.depthFar", farBytes, rhi::TextureFormat::Depth32Float, 1}}) {
        auto texture = makeConstant(device, row.name, row.texel, row.format, row.layers, row.dimension);
        if (!texture) return tl::unexpected(std::move(texture.error()));
        fixtures->constants[row.name] = std::move(*texture);
    }
    // The same image; how it is seen follows from the shader.
    fixtures->constants["const.depthFarArray"] = fixtures->constants["const.depthFar"];
    return fixtures;
}

}  // namespace pelage::passes
