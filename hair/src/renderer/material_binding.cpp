// SPDX-License-Identifier: MIT
#include "material_binding.hpp"

#include <pelage/hair/renderer.hpp>

#include <algorithm>
#include <cstring>

namespace pelage::hair {
namespace {

Diagnostic blockFault(const std::string& shader, const std::string& text, const std::string& hint) {
    return {.code = "S030", .file = shader, .text = text, .hint = hint};
}

const materials::Value* findInput(const std::vector<materials::CompiledMaterial::InputValue>& inputs,
                                  const std::string& name) {
    const auto found =
        std::find_if(inputs.begin(), inputs.end(), [&](const auto& input) { return input.name == name; });
    return found == inputs.end() ? nullptr : &found->value;
}

// What "builtin.asset" means for a texture input: the asset's own map, or a constant when it brings none.
rhi::TextureView assetMap(const std::string& name, const GpuGeometry& geometry, std::string& standIn) {
    if (name == "colorMap" || name == "opacityMap") return geometry.colorMap;
    if (name == "strandIdMap") {
        standIn = "builtin.grey";
        return geometry.strandIdMap;
    }
    return {};
}

}  // namespace

Outcome<std::vector<std::byte>> fillBlock(const rhi::ReflectedBinding& block,
                                          const materials::CompiledMaterial& material, const std::string& shaderLabel) {
    std::vector<std::byte> bytes(block.blockSize);
    for (const rhi::BlockMember& member : block.members) {
        const materials::Value* value = findInput(material.inputs, member.name);
        if (value == nullptr) {
            return tl::unexpected(blockFault(
                shaderLabel, "the uniform block has '" + member.name + "', which no input of the material type fills",
                "declare the input in the material type, or delete the member"));
        }
        std::array<float, 4> number = value->number;
        const bool whole = value->type == materials::ValueType::Bool || value->type == materials::ValueType::Int ||
                           value->type == materials::ValueType::Uint || value->type == materials::ValueType::Enum;
        if (whole) number[0] = static_cast<float>(value->integer);
        const std::size_t size = std::size_t{member.components} * 4;
        if (member.columns != 1 || member.arrayLength != 1 || size > 16 || member.offset + size > bytes.size()) {
            return tl::unexpected(blockFault(shaderLabel,
                                             "member '" + member.name +
                                                 "' of the uniform block is no scalar or "
                                                 "vector of 4 bytes a component",
                                             "use float, int, uint, bool or vectors of them"));
        }
        if (member.scalar == rhi::ScalarType::Float) {
            std::memcpy(bytes.data() + member.offset, number.data(), size);
        } else {
            const auto integer =
                static_cast<std::int32_t>(whole ? value->integer : static_cast<std::int64_t>(number[0]));
            std::memcpy(bytes.data() + member.offset, &integer, 4);
        }
    }
    return bytes;
}

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

Outcome<rhi::BindGroup> MaterialBindings::bindGroup(const Key& key, const rhi::BindGroupLayout& layout,
                                                    const rhi::ShaderModule& shader,
                                                    const materials::CompiledMaterial& material,
                                                    const GpuGeometry& geometry, Uploads& uploads) {
    Entry& entry = entries_[key];
    std::vector<std::byte> bytes;
    std::vector<rhi::TextureView> views;
    std::vector<rhi::BindGroupEntry> entries;
    for (const rhi::BindGroupLayoutEntry& slot : layout.entries()) {
        switch (slot.type) {
            case rhi::BindingType::UniformBuffer: {
                const auto& bindings = shader.reflection().bindings;
                const auto block = std::find_if(bindings.begin(), bindings.end(), [&](const auto& b) {
                    return b.group == 2 && b.entry.binding == slot.binding;
                });
                if (block == bindings.end()) break;
                auto filled = fillBlock(*block, material, shader.label());
                if (!filled) return tl::unexpected(filled.error());
                bytes = std::move(*filled);
                if (!entry.block || entry.block.size() != bytes.size()) {
                    auto buffer =
                        device_.createBuffer({.label = shader.label() + " material",
                                              .size = bytes.size(),
                                              .usage = rhi::BufferUsage::Uniform | rhi::BufferUsage::CopyDst});
                    if (!buffer) return tl::unexpected(toDiagnostic(buffer.error()));
                    entry = {.block = *buffer};
                }
                entries.push_back({slot.binding, rhi::BufferBinding{entry.block, 0, bytes.size()}});
                break;
            }
            case rhi::BindingType::Sampler:
                entries.push_back({slot.binding, sampler_});
                break;
            default: {
                const materials::Value* value = findInput(material.textures, slot.name);
                if (value == nullptr) {
                    return tl::unexpected(blockFault(
                        shader.label(),
                        "the shader samples '" + slot.name + "', which no texture input of the material type fills",
                        "declare a texture2d input of this name"));
                }
                std::string reference = value->text.empty() ? "builtin.white" : value->text;
                rhi::TextureView view;
                if (reference == "builtin.asset") {
                    reference = "builtin.white";
                    view = assetMap(slot.name, geometry, reference);
                }
                if (!view) {
                    auto loaded = uploads.texture(reference, slot.name == "colorMap");
                    if (!loaded) return tl::unexpected(loaded.error());
                    view = *loaded;
                }
                views.push_back(view);
                entries.push_back({slot.binding, view});
            }
        }
    }
    if (entry.block && bytes != entry.bytes) {
        auto written = device_.queue().writeBuffer(entry.block, 0, bytes);
        if (!written) return tl::unexpected(toDiagnostic(written.error()));
        entry.bytes = std::move(bytes);
    }
    if (!entry.group || views != entry.views) {
        auto group =
            device_.createBindGroup({.label = shader.label() + " material", .layout = layout, .entries = entries});
        if (!group) return tl::unexpected(toDiagnostic(group.error()));
        entry.group = *group;
        entry.views = std::move(views);
    }
    return entry.group;
}

}  // namespace pelage::hair
