// SPDX-License-Identifier: MIT
// A compiled material joined to a shader: its uniform block filled by member names, its textures and samplers by names,
// its specialization constants by names. Nothing here knows one material type from another.
#pragma once

#include "uploads.hpp"

#include <pelage/materials/material.hpp>

namespace pelage::hair {

/// The bytes of the uniform block of set 2, from the inputs of the material. An input whose member is missing is not an
/// error (another shader of the material may use it); a member that no input fills is.
Outcome<std::vector<std::byte>> fillBlock(const rhi::ReflectedBinding& block,
                                          const materials::CompiledMaterial& material, const std::string& shaderLabel);

/// Those of `constants` that the module declares.
std::vector<rhi::ConstantEntry> declaredConstants(const rhi::ShaderModule& module,
                                                  const std::vector<rhi::ConstantEntry>& constants);

/// Set 2 for one pipeline layout. `geometry` gives the maps behind "builtin.asset".
class MaterialBindings {
public:
    MaterialBindings(rhi::Device device, rhi::Sampler sampler) : device_(std::move(device)), sampler_(sampler) {}

    struct Key {
        std::size_t object = 0;  // index in the scene
        const void* layout = nullptr;
        std::string shader = {};
        auto operator<=>(const Key&) const = default;
    };
    Outcome<rhi::BindGroup> bindGroup(const Key& key, const rhi::BindGroupLayout& layout,
                                      const rhi::ShaderModule& shader, const materials::CompiledMaterial& material,
                                      const GpuGeometry& geometry, Uploads& uploads);
    void clear() { entries_.clear(); }

private:
    struct Entry {
        rhi::Buffer block = {};
        rhi::BindGroup group = {};
        std::vector<std::byte> bytes = {};
        std::vector<rhi::TextureView> views = {};
    };
    rhi::Device device_;
    rhi::Sampler sampler_;
    std::map<Key, Entry> entries_;
};

}  // namespace pelage::hair
