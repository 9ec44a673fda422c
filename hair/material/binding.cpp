// SPDX-License-Identifier: MIT
#include "binding.hpp"

#include <pelage/hair/renderer.hpp>

#include <algorithm>
#include <cstring>
#include <optional>

namespace pelage::hair {
namespace {

template <class T>
std::optional<std::uint32_t> indexOf(const std::vector<T>& items, const std::string& name) {
    const auto found = std::find_if(items.begin(), items.end(), [&](const T& item) { return item.name == name; });
    if (found == items.end()) return {};
    return static_cast<std::uint32_t>(found - items.begin());
}

// What "builtin.asset" means for a texture input: the asset's own map, or a constant when it brings none.
rhi::TextureView assetMap(const std::string& name, const GpuGeometry& geometry, std::string_view& standIn) {
    if (name == "colorMap" || name == "opacityMap") return geometry.colorMap;
    if (name == "strandIdMap") {
        standIn = "builtin.grey";
        return geometry.strandIdMap;
    }
    return {};
}

const rhi::ReflectedBinding* bindingAt(const rhi::ShaderModule& module, std::uint32_t binding) {
    if (!module) return nullptr;
    for (const rhi::ReflectedBinding& each : module.reflection().bindings) {
        if (each.group == 2 && each.entry.binding == binding) return &each;
    }
    return nullptr;
}

}  // namespace

std::vector<rhi::ConstantEntry> declaredConstants(const rhi::ShaderModule& module,
                                                  const std::vector<rhi::ConstantEntry>& constants) {
    std::vector<rhi::ConstantEntry> result;
    for (const rhi::ConstantEntry& constant : constants) {
        const auto& known = module.reflection().specConstants;
        if (std::any_of(known.begin(), known.end(), [&](const auto& k) { return k.name == constant.name; })) {
            result.push_back(constant);
        }
    }
    return result;
}

Result<MaterialBindings::Entry> MaterialBindings::resolve(const rhi::BindGroupLayout& layout,
                                                          const std::shared_ptr<const materials::MaterialType>& type,
                                                          const materials::CompiledMaterial& material,
                                                          const Modules& modules) const {
    Entry entry{.type = type};
    for (const rhi::BindGroupLayoutEntry& slot : layout.entries()) {
        if (slot.type == rhi::BindingType::Sampler) {
            entry.samplers.push_back(slot.binding);
        } else if (slot.type == rhi::BindingType::UniformBuffer) {
            std::uint32_t size = 0;
            // Each stage declares the members it reads, at the same offsets.
            for (const rhi::ShaderModule& module : {modules.vertex, modules.fragment, modules.compute}) {
                const rhi::ReflectedBinding* block = bindingAt(module, slot.binding);
                if (!block) continue;
                entry.blockBinding = slot.binding;
                entry.label = module.label() + " material";
                size = std::max(size, block->blockSize);
                for (const rhi::BlockMember& member : block->members) {
                    const auto input = indexOf(material.inputs, member.name);
                    if (!input || member.offset + member.components * 4 > block->blockSize) continue;
                    entry.members.push_back(
                        {member.offset, member.components * 4, *input, member.scalar == rhi::ScalarType::Float});
                }
            }
            auto buffer = device_.createBuffer(
                {.label = entry.label, .size = size, .usage = rhi::BufferUsage::Uniform | rhi::BufferUsage::CopyDst});
            if (!buffer) return tl::unexpected(buffer.error());
            entry.block = *buffer;
        } else {
            // Not by the layout's name: layouts are shared, and the names in one may be those of another shader.
            const rhi::ReflectedBinding* declared = nullptr;
            for (const rhi::ShaderModule& module : {modules.fragment, modules.vertex, modules.compute}) {
                if (!declared) declared = bindingAt(module, slot.binding);
            }
            const auto texture = declared ? indexOf(material.textures, declared->entry.name) : std::nullopt;
            if (!texture) continue;
            const auto input = indexOf(type->inputs(), declared->entry.name);
            entry.textures.push_back({slot.binding, *texture, input && type->inputs()[*input].srgb});
        }
    }
    return entry;
}

void MaterialBindings::fillBlock(const Entry& entry, const materials::CompiledMaterial& material) {
    bytes_.assign(entry.block ? entry.block.size() : 0, std::byte{0});
    for (const Member& member : entry.members) {
        const materials::Value& value = material.inputs[member.input].value;
        if (member.isFloat) {
            std::memcpy(bytes_.data() + member.offset, value.number.data(), member.size);
        } else {
            const auto integer = static_cast<std::uint32_t>(value.integer);  // the same bits for an int
            std::memcpy(bytes_.data() + member.offset, &integer, 4);
        }
    }
}

Result<void> MaterialBindings::findViews(Entry& entry, const materials::CompiledMaterial& material,
                                         const GpuGeometry& geometry, Uploads& uploads) {
    views_.clear();
    for (TextureSlot& slot : entry.textures) {
        const auto& texture = material.textures[slot.texture];
        std::string_view reference = texture.value.text;
        if (reference.empty()) reference = "builtin.white";
        rhi::TextureView view;
        if (reference == "builtin.asset") {
            reference = "builtin.white";
            view = assetMap(texture.name, geometry, reference);
        }
        if (!view && (slot.reference != reference || !slot.view)) {
            auto loaded = uploads.texture(std::string(reference), slot.srgb);
            if (!loaded) return tl::unexpected(loaded.error());
            slot.reference = reference;
            slot.view = *loaded;
        }
        if (!view) view = slot.view;
        views_.push_back(std::move(view));
    }
    return {};
}

Result<rhi::BindGroup> MaterialBindings::bindGroup(const Key& key, const rhi::BindGroupLayout& layout,
                                                   const std::shared_ptr<const materials::MaterialType>& type,
                                                   const materials::CompiledMaterial& material,
                                                   const GpuGeometry& geometry, Uploads& uploads,
                                                   const std::function<Modules()>& modules) {
    Entry& entry = entries_[key];
    if (entry.type != type) {
        auto resolved = resolve(layout, type, material, modules());
        if (!resolved) return tl::unexpected(resolved.error());
        entry = std::move(*resolved);
    }
    fillBlock(entry, material);
    if (entry.block && bytes_ != entry.bytes) {
        auto written = device_.queue().writeBuffer(entry.block, 0, bytes_);
        if (!written) return tl::unexpected(written.error());
        entry.bytes = bytes_;
    }
    if (auto found = findViews(entry, material, geometry, uploads); !found) return tl::unexpected(found.error());
    if (entry.group && views_ == entry.views) return entry.group;
    std::vector<rhi::BindGroupEntry> bound;
    if (entry.block) bound.push_back({entry.blockBinding, rhi::BufferBinding{entry.block, 0, entry.block.size()}});
    for (const std::uint32_t binding : entry.samplers) bound.push_back({binding, sampler_});
    for (std::size_t i = 0; i < views_.size(); ++i) bound.push_back({entry.textures[i].binding, views_[i]});
    auto group = device_.createBindGroup({.label = entry.label, .layout = layout, .entries = bound});
    if (!group) return tl::unexpected(group.error());
    entry.group = *group;
    entry.views = views_;
    return entry.group;
}

}  // namespace pelage::hair
