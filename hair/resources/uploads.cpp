// SPDX-License-Identifier: MIT
#include "uploads.hpp"

#include "mipmaps.hpp"

#include <pelage/hair/load.hpp>
#include <pelage/hair/moment_table.hpp>
#include <pelage/hair/renderer.hpp>

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cstring>

namespace pelage::hair {
namespace {

const void* keyOf(const Geometry& geometry) {
    return std::visit([](const auto& held) -> const void* { return held.get(); }, geometry);
}

}  // namespace

Result<const GpuGeometry*> Uploads::geometry(const Geometry& source) {
    if (const auto found = geometry_.find(keyOf(source)); found != geometry_.end()) return &found->second;
    GpuGeometry result = {.source = source};
    const Strands* strands = strandsOf(source);
    if (isEmpty(source)) {
        if (strands != nullptr) result.strands.emplace();
    } else if (strands != nullptr) {
        auto uploaded = uploadStrands(device_, *strands);
        if (!uploaded) return tl::unexpected(uploaded.error());
        result.strands = std::move(*uploaded);
    } else if (auto uploaded = uploadMesh(*meshOf(source), result); !uploaded) {
        return tl::unexpected(uploaded.error());
    }
    return &geometry_.emplace(keyOf(source), std::move(result)).first->second;
}

Result<void> Uploads::uploadMesh(const Mesh& mesh, GpuGeometry& to) {
    auto vertices = uploadBuffer(device_, mesh.name + " vertices", rhi::BufferUsage::Vertex,
                                 std::as_bytes(std::span(mesh.vertices)));
    if (!vertices) return tl::unexpected(vertices.error());
    auto indices =
        uploadBuffer(device_, mesh.name + " indices", rhi::BufferUsage::Index, std::as_bytes(std::span(mesh.indices)));
    if (!indices) return tl::unexpected(indices.error());
    to.vertices = *vertices;
    to.indices = *indices;
    to.indexCount = static_cast<std::uint32_t>(mesh.indices.size());
    if (!mesh.colorMap.empty()) {
        auto view = upload(mesh.colorMap, mesh.name + " colour map");
        if (!view) return tl::unexpected(view.error());
        to.colorMap = *view;
    }
    if (!mesh.strandIdMap.empty()) {
        auto view = upload(mesh.strandIdMap, mesh.name + " strand-ID map");
        if (!view) return tl::unexpected(view.error());
        to.strandIdMap = *view;
    }
    return {};
}

Result<rhi::TextureView> Uploads::texture(const std::string& reference, bool srgb) {
    const std::string key = reference + (srgb ? "|srgb" : "|linear");
    if (const auto found = textures_.find(key); found != textures_.end()) return found->second;
    if (reference.starts_with("moments:")) {
        auto view = uploadMoments(reference);
        if (!view) return view;
        // A slider that moves asks for a table at every step: the oldest go. Bind groups keep what they still use.
        momentTables_.push_back(key);
        if (momentTables_.size() > 16) {
            textures_.erase(momentTables_.front());
            momentTables_.pop_front();
        }
        textures_.emplace(key, *view);
        return view;
    }
    Image8 image = {1, 1, 4, srgb, {255, 255, 255, 255}};
    if (reference == "builtin.black") {
        image.texels = {0, 0, 0, 255};
    } else if (reference == "builtin.grey") {
        image.texels = {128, 128, 128, 255};
    } else if (reference != "builtin.white") {
        auto bytes = readFile(reference);
        if (!bytes) return tl::unexpected(bytes.error());
        auto decoded = decodeImage(*bytes, reference, srgb);
        if (!decoded) return tl::unexpected(decoded.error());
        image = std::move(*decoded);
    }
    auto view = upload(image, reference);
    if (view) textures_.emplace(key, *view);
    return view;
}

Result<rhi::TextureView> Uploads::uploadMoments(const std::string& name) {
    // A model without tables binds one black texel.
    std::optional<MomentTable> table = momentTableOf(name);
    const std::uint32_t width = table ? table->width() : 1, height = table ? table->height() : 1;
    const std::vector<std::uint16_t> texels =
        table ? table->halves() : std::vector<std::uint16_t>(std::size_t{MomentTable::layers} * 4);
    auto texture = device_.createTexture({.label = name,
                                          .size = {width, height, MomentTable::layers},
                                          .format = rhi::TextureFormat::RGBA16Float,
                                          .usage = rhi::TextureUsage::TextureBinding | rhi::TextureUsage::CopyDst});
    if (!texture) return tl::unexpected(texture.error());
    auto written = device_.queue().writeTexture({.texture = *texture}, std::as_bytes(std::span(texels)),
                                                {.bytesPerRow = width * 8, .rowsPerImage = height},
                                                {width, height, MomentTable::layers});
    if (!written) return tl::unexpected(written.error());
    auto view = texture->createView({.dimension = rhi::TextureViewDimension::E2DArray});
    if (!view) return tl::unexpected(view.error());
    return *view;
}

Result<rhi::TextureView> Uploads::upload(const Image8& image, const std::string& label) {
    const std::vector<Image8> levels = mipChain(image);
    const bool one = levels.front().channels == 1;
    auto texture = device_.createTexture({.label = label,
                                          .size = {image.width, image.height, 1},
                                          .mipLevelCount = static_cast<std::uint32_t>(levels.size()),
                                          .format = one          ? rhi::TextureFormat::R8Unorm
                                                    : image.srgb ? rhi::TextureFormat::RGBA8UnormSrgb
                                                                 : rhi::TextureFormat::RGBA8Unorm,
                                          .usage = rhi::TextureUsage::TextureBinding | rhi::TextureUsage::CopyDst});
    if (!texture) return tl::unexpected(texture.error());
    for (std::uint32_t level = 0; level < levels.size(); ++level) {
        const Image8& mip = levels[level];
        auto written = device_.queue().writeTexture(
            {.texture = *texture, .mipLevel = level}, std::as_bytes(std::span(mip.texels)),
            {.bytesPerRow = mip.width * mip.channels, .rowsPerImage = mip.height}, {mip.width, mip.height, 1});
        if (!written) return tl::unexpected(written.error());
    }
    auto view = texture->createView();
    if (!view) return tl::unexpected(view.error());
    return *view;
}

Result<rhi::Texture> Uploads::irradiance(const Environment& environment) {
    if (irradiance_ && environment.radiance == irradianceOf_.radiance &&
        environment.intensity == irradianceOf_.intensity) {
        return irradiance_;
    }
    constexpr std::uint32_t size = 16;
    if (!irradiance_) {
        auto texture = device_.createTexture({.label = "irradiance",
                                              .size = {size, size, 6},
                                              .format = rhi::TextureFormat::RGBA16Float,
                                              .usage = rhi::TextureUsage::TextureBinding | rhi::TextureUsage::CopyDst,
                                              .cubeCompatible = true});
        if (!texture) return tl::unexpected(texture.error());
        irradiance_ = *texture;
    }
    // Faces +X -X +Y -Y +Z -Z; directions by the Vulkan specification's table of cube map faces.
    std::vector<std::uint16_t> texels(std::size_t{size} * size * 6 * 4);
    for (std::uint32_t face = 0; face < 6; ++face) {
        for (std::uint32_t y = 0; y < size; ++y) {
            for (std::uint32_t x = 0; x < size; ++x) {
                const float s = 2.0F * (static_cast<float>(x) + 0.5F) / size - 1.0F;
                const float t = 2.0F * (static_cast<float>(y) + 0.5F) / size - 1.0F;
                const glm::vec3 directions[6] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t},
                                                 {s, -1, -t}, {s, -t, 1},  {-s, -t, -1}};
                const glm::vec3 value =
                    glm::min(environment.irradiance(glm::normalize(directions[face])), glm::vec3(6e4F));
                std::uint16_t* out = &texels[((std::size_t{face} * size + y) * size + x) * 4];
                for (int c = 0; c < 3; ++c) out[c] = glm::packHalf1x16(value[c]);
                out[3] = glm::packHalf1x16(1.0F);
            }
        }
    }
    auto written = device_.queue().writeTexture({.texture = irradiance_}, std::as_bytes(std::span(texels)),
                                                {.bytesPerRow = size * 8, .rowsPerImage = size}, {size, size, 6});
    if (!written) return tl::unexpected(written.error());
    irradianceOf_ = environment;
    return irradiance_;
}

void Uploads::collect() {
    std::erase_if(geometry_, [](const auto& entry) {
        return std::visit([](const auto& held) { return held.use_count() <= 1; }, entry.second.source);
    });
}

}  // namespace pelage::hair
