// SPDX-License-Identifier: MIT
// A compiled material joined to a shader: its uniform block filled by member names, its textures by names, its
// specialization constants by names. Names are resolved once for each object and layout. Nothing here knows one
// material type from another; what does not fit was refused by check.hpp.
#pragma once

#include "resources/uploads.hpp"

#include <pelage/materials/material.hpp>

#include <functional>

namespace pelage::hair {

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
        std::uint32_t shader = 0;  // index in the material
        auto operator<=>(const Key&) const = default;
    };
    struct Modules {
        rhi::ShaderModule vertex = {}, fragment = {}, compute = {};  // empty where there is none
    };
    /// `modules` is asked only when the key is new or has another material type than before.
    Result<rhi::BindGroup> bindGroup(const Key& key, const rhi::BindGroupLayout& layout,
                                     const std::shared_ptr<const materials::MaterialType>& type,
                                     const materials::CompiledMaterial& material, const GpuGeometry& geometry,
                                     Uploads& uploads, const std::function<Modules()>& modules);

private:
    struct Member {
        std::uint32_t offset = 0, size = 0, input = 0;  // bytes; index in CompiledMaterial::inputs
        bool isFloat = true;
    };
    struct TextureSlot {
        std::uint32_t binding = 0, texture = 0;  // index in CompiledMaterial::textures
        bool srgb = false;
        // What was found last, and by which name: nothing is looked up again while a material says the same.
        std::string reference = {};
        rhi::TextureView view = {};
    };
    struct Entry {
        std::shared_ptr<const materials::MaterialType> type = {};
        std::vector<Member> members = {};
        std::vector<TextureSlot> textures = {};
        std::vector<std::uint32_t> samplers = {};
        std::uint32_t blockBinding = 0;
        std::string label = {};
        rhi::Buffer block = {};
        rhi::BindGroup group = {};
        std::vector<std::byte> bytes = {};
        std::vector<rhi::TextureView> views = {};
    };
    Result<Entry> resolve(const rhi::BindGroupLayout& layout,
                          const std::shared_ptr<const materials::MaterialType>& type,
                          const materials::CompiledMaterial& material, const Modules& modules) const;
    void fillBlock(const Entry& entry, const materials::CompiledMaterial& material);
    Result<void> findViews(Entry& entry, const materials::CompiledMaterial& material, const GpuGeometry& geometry,
                           Uploads& uploads);

    rhi::Device device_;
    rhi::Sampler sampler_;
    std::map<Key, Entry> entries_;
    std::vector<std::byte> bytes_;         // of the block being filled
    std::vector<rhi::TextureView> views_;  // of the group being looked for
};

}  // namespace pelage::hair
