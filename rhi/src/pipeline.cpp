// SPDX-License-Identifier: MIT
#include "pipeline.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>

namespace pelage::rhi {
namespace detail {

PipelineObject::~PipelineObject() {
    if (handle == VK_NULL_HANDLE) return;
    --device->livePipelines;
    {
        const std::lock_guard lock(device->cacheMutex);
        const auto known = device->pipelineCacheByKey.find(key);
        if (known != device->pipelineCacheByKey.end() && known->second.expired())
            device->pipelineCacheByKey.erase(known);
    }
    device->bury(lastUse, [pipeline = handle](DeviceObject& d) {
        d.functions.vkDestroyPipeline(d.handle, pipeline, d.allocator);
    });
}

VkPipelineShaderStageCreateInfo Stage::create() const {
    VkPipelineShaderStageCreateInfo create = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    create.stage = static_cast<VkShaderStageFlagBits>(toVk(stage));
    create.module = module->handle;
    create.pName = "main";
    create.pSpecializationInfo = map.empty() ? nullptr : &info;
    return create;
}

namespace {

/// The bits of a constant, or nothing when the value is not one of its type.
std::optional<std::uint32_t> bitsOf(SpecConstant::Type type, double value) {
    const bool whole = std::isfinite(value) && value == std::floor(value);
    switch (type) {
        case SpecConstant::Type::Bool:
            return value != 0 ? VK_TRUE : VK_FALSE;
        case SpecConstant::Type::Int:
            if (!whole || value < std::numeric_limits<std::int32_t>::min() ||
                value > std::numeric_limits<std::int32_t>::max())
                return std::nullopt;
            return static_cast<std::uint32_t>(static_cast<std::int32_t>(value));
        case SpecConstant::Type::Uint:
            if (!whole || value < 0 || value > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
            return static_cast<std::uint32_t>(value);
        case SpecConstant::Type::Float:
            break;
    }
    return std::bit_cast<std::uint32_t>(static_cast<float>(value));
}

std::string_view typeName(SpecConstant::Type type) {
    constexpr std::string_view names[] = {"bool", "int", "uint", "float"};
    return names[static_cast<std::size_t>(type)];
}

}  // namespace

Result<Stage> makeStage(const DeviceObject& device, const ProgrammableStage& programmable, ShaderStage expected,
                        const std::string& object) {
    if (auto ok = needHandle(programmable.module, cat("the ", name(expected), " module of ", object)); !ok)
        return forward(ok.error());
    const auto& module = *programmable.module.get();
    if (auto ok = needSameDevice(module, device); !ok) return forward(ok.error());
    if (module.reflection.stage != expected)
        return invalid(ErrorCode::ShaderInvalid, cat(module.describe(), " is a ", name(module.reflection.stage),
                                                     " shader; ", object, " needs a ", name(expected), " shader."));
    Stage stage;
    stage.module = &module;
    stage.stage = expected;
    const auto& known = module.reflection.specConstants;
    for (const auto& constant : programmable.constants) {
        const auto found =
            std::find_if(known.begin(), known.end(), [&](const SpecConstant& c) { return c.name == constant.name; });
        if (found == known.end()) {
            std::string names;
            for (const auto& c : known) names += cat(names.empty() ? "" : ", ", c.name);
            return invalid(ErrorCode::ConstantUnknown,
                           cat(object, " sets the constant \"", constant.name, "\", which ", module.describe(),
                               " does not have; it has ", names.empty() ? "none" : names, '.'));
        }
        const auto bits = bitsOf(found->type, constant.value);
        if (!bits)
            return invalid(ErrorCode::OutOfRange,
                           cat(object, " sets the constant \"", constant.name, "\" of ", module.describe(), " to ",
                               constant.value, ", which is no ", typeName(found->type), '.'));
        stage.map.push_back({found->id, static_cast<std::uint32_t>(stage.data.size() * 4), 4});
        stage.data.push_back(*bits);
    }
    stage.info.mapEntryCount = static_cast<std::uint32_t>(stage.map.size());
    stage.info.pMapEntries = stage.map.data();  // moving a vector keeps its storage
    stage.info.dataSize = stage.data.size() * 4;
    stage.info.pData = stage.data.data();
    return stage;
}

std::string keyOf(const Stage& stage) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> constants;
    for (std::size_t i = 0; i < stage.map.size(); ++i) constants.emplace_back(stage.map[i].constantID, stage.data[i]);
    std::sort(constants.begin(), constants.end());
    std::string key = cat("m", stage.module->id);
    for (const auto& [id, bits] : constants) key += cat(',', id, '=', bits);
    return key + ';';
}

namespace {

/// One declaration for all stages, or an error that names both.
Result<void> merge(BindGroupLayoutEntry& into, const BindGroupLayoutEntry& from, std::uint32_t group,
                   const std::string& object) {
    const bool storage = isBuffer(into.type) && isBuffer(from.type) && into.type != BindingType::UniformBuffer &&
                         from.type != BindingType::UniformBuffer;
    const bool images = toVk(into.type, false) == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE &&
                        toVk(from.type, false) == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    if ((canonical(into.type) != canonical(from.type) && !storage && !images) ||
        into.viewDimension != from.viewDimension)
        return invalid(
            ErrorCode::LayoutMismatch,
            cat(object, " declares group ", group, " binding ", into.binding, " as the ", name(into.type), " \"",
                into.name, "\" in one stage and as the ", name(from.type), " \"", from.name, "\" in the other."));
    if (canonical(into.type) != canonical(from.type))  // one stage writes: the binding is writable
        into.type = storage ? BindingType::StorageBuffer : BindingType::StorageTexture;
    into.minBindingSize = std::max(into.minBindingSize, from.minBindingSize);
    return {};
}

Result<void> checkAgainst(const PipelineLayoutObject& layout, const Stage& stage, const std::string& object) {
    const auto& reflection = stage.module->reflection;
    for (const auto& b : reflection.bindings) {
        const auto what = cat(stage.module->describe(), " declares group ", b.group, " binding ", b.entry.binding,
                              " \"", b.entry.name, "\" (", name(b.entry.type), ')');
        const BindGroupLayoutEntry* e = b.group < layout.sets.size() && layout.sets[b.group]
                                            ? layout.sets[b.group]->find(b.entry.binding)
                                            : nullptr;
        if (e == nullptr)
            return invalid(ErrorCode::LayoutMismatch,
                           cat(what, ", which ", layout.describe(), " of ", object, " does not have."));
        const bool same =
            canonical(e->type) == canonical(b.entry.type) ||
            (e->type == BindingType::StorageBuffer && b.entry.type == BindingType::ReadOnlyStorageBuffer) ||
            (e->type == BindingType::StorageTexture && b.entry.type == BindingType::ReadOnlyStorageTexture);
        if (!same || (!isBuffer(e->type) && !isSampler(e->type) && e->viewDimension != b.entry.viewDimension))
            return invalid(ErrorCode::LayoutMismatch,
                           cat(what, "; ", layout.describe(), " of ", object, " says it is a ", name(e->viewDimension),
                               ' ', name(e->type), '.'));
        if (!contains(e->visibility, stage.stage))
            return invalid(ErrorCode::LayoutMismatch, cat(what, "; in ", layout.describe(), " of ", object,
                                                          " it is not visible to the ", name(stage.stage), " stage."));
    }
    if (reflection.pushConstantsSize > layout.pushConstantsSize)
        return invalid(
            ErrorCode::PushConstantRange,
            cat(stage.module->describe(), " reads ", reflection.pushConstantsSize, " bytes of push constants; ",
                layout.describe(), " of ", object, " has ", layout.pushConstantsSize, '.'));
    return {};
}

}  // namespace

Result<std::shared_ptr<PipelineLayoutObject>> layoutFor(const std::shared_ptr<DeviceObject>& device,
                                                        const PipelineLayout& given, std::span<const Stage> stages,
                                                        const std::string& label, const std::string& object) {
    if (given) {
        if (auto ok = needSameDevice(*given.get(), *device); !ok) return forward(ok.error());
        for (const auto& stage : stages)
            if (auto ok = checkAgainst(*given.get(), stage, object); !ok) return forward(ok.error());
        return given.shared();
    }
    std::map<std::uint32_t, std::map<std::uint32_t, BindGroupLayoutEntry>> groups;
    std::uint32_t push = 0;
    for (const auto& stage : stages) {
        push = std::max(push, stage.module->reflection.pushConstantsSize);
        for (const auto& b : stage.module->reflection.bindings) {
            const auto [entry, fresh] = groups[b.group].try_emplace(b.entry.binding, b.entry);
            if (fresh) continue;
            if (auto ok = merge(entry->second, b.entry, b.group, object); !ok) return forward(ok.error());
        }
    }
    if (!groups.empty() && groups.rbegin()->first >= device->info.limits.maxBindGroups)
        return invalid(ErrorCode::OutOfRange,
                       cat(object, " uses group ", groups.rbegin()->first, "; the device allows ",
                           device->info.limits.maxBindGroups, " groups."));
    std::vector<std::shared_ptr<BindGroupLayoutObject>> sets(groups.empty() ? 0 : groups.rbegin()->first + 1);
    for (const auto& [group, entries] : groups) {
        BindGroupLayoutDescriptor descriptor{.label = cat(label, " group ", group)};
        for (const auto& [binding, entry] : entries) descriptor.entries.push_back(entry);
        auto layout = makeBindGroupLayout(device, descriptor);
        if (!layout) return forward(layout.error());
        sets[group] = *layout;
    }
    return makePipelineLayout(device, label, std::move(sets), push);
}

std::shared_ptr<PipelineObject> findPipeline(DeviceObject& device, const std::string& key) {
    const std::lock_guard lock(device.cacheMutex);
    const auto known = device.pipelineCacheByKey.find(key);
    return known == device.pipelineCacheByKey.end() ? nullptr : known->second.lock();
}

std::shared_ptr<PipelineObject> enterPipeline(DeviceObject& device, std::shared_ptr<PipelineObject> made) {
    std::shared_ptr<PipelineObject> first;
    {
        const std::lock_guard lock(device.cacheMutex);
        auto& cached = device.pipelineCacheByKey[made->key];
        first = cached.lock();
        if (!first) cached = made;
    }
    return first ? first : made;
}

}  // namespace detail
}  // namespace pelage::rhi
