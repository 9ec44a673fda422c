// SPDX-License-Identifier: MIT
// Geometry and textures on the device, made once and kept.
#pragma once

#include "strands.hpp"

#include <pelage/hair/geometry.hpp>
#include <pelage/hair/scene.hpp>
#include <pelage/rhi/rhi.hpp>

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace pelage::hair {

struct GpuGeometry {
    Geometry source = {};
    rhi::TextureView colorMap = {}, strandIdMap = {};  // empty when the asset has none
    rhi::Buffer vertices = {}, indices = {};           // of a mesh
    std::uint32_t indexCount = 0;
    std::optional<GpuStrands> strands = {};

    bool empty() const { return strands ? strands->pieceCount == 0 : indexCount == 0; }
};

class Uploads {
public:
    explicit Uploads(rhi::Device device) : device_(std::move(device)) {}

    Result<const GpuGeometry*> geometry(const Geometry& source);
    /// "builtin.white", "builtin.grey", "builtin.black", a moment table by name, or the path of an image.
    Result<rhi::TextureView> texture(const std::string& reference, bool srgb);
    /// A 16 x 16 cube of irradiance, RGBA16Float; rewritten only when the environment changed.
    Result<rhi::Texture> irradiance(const Environment& environment);
    /// Forgets geometry that no scene holds any more.
    void collect();

private:
    Result<rhi::TextureView> uploadMoments(const std::string& name);
    Result<rhi::TextureView> upload(const Image8& image, const std::string& label);

    rhi::Device device_;
    Result<void> uploadMesh(const Mesh& mesh, GpuGeometry& to);

    std::map<const void*, GpuGeometry> geometry_;  // by the mesh or the strands
    std::map<std::string, rhi::TextureView> textures_;
    std::deque<std::string> momentTables_;  // keys of textures_, oldest first
    rhi::Texture irradiance_;
    Environment irradianceOf_ = {};
};

}  // namespace pelage::hair
