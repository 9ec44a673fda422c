// SPDX-License-Identifier: MIT
#include "reflect.hpp"

#include <algorithm>
#include <spirv_cross/spirv_cross.hpp>

#include "text.hpp"

namespace pelage::rhi::detail {

namespace {

using spirv_cross::Compiler;
using spirv_cross::Resource;
using spirv_cross::SPIRType;

/// A module we cannot serve, thrown to the boundary below like SPIRV-Cross' own errors.
struct Refused {
    std::string message;
};

ScalarType scalarOf(const SPIRType& type) {
    switch (type.basetype) {
        case SPIRType::Boolean:
            return ScalarType::Bool;
        case SPIRType::SByte:
        case SPIRType::Short:
        case SPIRType::Int:
        case SPIRType::Int64:
            return ScalarType::Int;
        case SPIRType::UByte:
        case SPIRType::UShort:
        case SPIRType::UInt:
        case SPIRType::UInt64:
            return ScalarType::Uint;
        default:
            return ScalarType::Float;
    }
}

std::vector<BlockMember> membersOf(const Compiler& compiler, const SPIRType& block) {
    std::vector<BlockMember> members;
    for (std::uint32_t i = 0; i < block.member_types.size(); ++i) {
        const auto& type = compiler.get_type(block.member_types[i]);
        BlockMember m;
        m.name = compiler.get_member_name(block.self, i);
        m.offset = compiler.type_struct_member_offset(block, i);
        m.size = static_cast<std::uint32_t>(compiler.get_declared_struct_member_size(block, i));
        m.scalar = scalarOf(type);
        m.components = type.vecsize;
        m.columns = type.columns;
        for (std::size_t a = 0; a < type.array.size(); ++a)
            m.arrayLength *= type.array_size_literal[a] ? type.array[a] : 1;
        members.push_back(std::move(m));
    }
    return members;
}

std::uint32_t blockSize(const Compiler& compiler, const SPIRType& block) {
    // A run-time array at the end counts for nothing: a buffer without elements is not an error.
    return block.member_types.empty() ? 0 : static_cast<std::uint32_t>(compiler.get_declared_struct_size(block));
}

TextureViewDimension dimensionOf(const SPIRType& type, const std::string& variable) {
    if (type.image.dim == spv::Dim3D) return TextureViewDimension::E3D;
    if (type.image.dim == spv::DimCube && !type.image.arrayed) return TextureViewDimension::Cube;
    if (type.image.dim == spv::Dim2D)
        return type.image.arrayed ? TextureViewDimension::E2DArray : TextureViewDimension::E2D;
    throw Refused{cat("declares the texture \"", variable, "\" with a dimension other than 2D, 2D array, cube or 3D")};
}

class Reader {
public:
    Reader(const Compiler& compiler, ReflectedModule& out) : compiler_(compiler), out_(out) {}

    void read() {
        const auto all = compiler_.get_shader_resources();
        if (!all.sampled_images.empty())
            throw Refused{cat("declares the combined sampler \"", all.sampled_images[0].name,
                              "\"; a texture and a sampler are declared apart")};
        for (const auto& r : all.uniform_buffers) buffer(r, BindingType::UniformBuffer);
        for (const auto& r : all.storage_buffers) {
            const bool readOnly = compiler_.get_buffer_block_flags(r.id).get(spv::DecorationNonWritable);
            buffer(r, readOnly ? BindingType::ReadOnlyStorageBuffer : BindingType::StorageBuffer);
        }
        for (const auto& r : all.separate_images) image(r, false);
        for (const auto& r : all.storage_images) image(r, true);
        for (const auto& r : all.separate_samplers) add(r, BindingType::Sampler);
        std::sort(out_.reflection.bindings.begin(), out_.reflection.bindings.end(), [](const auto& a, const auto& b) {
            return std::pair(a.group, a.entry.binding) < std::pair(b.group, b.entry.binding);
        });
        for (const auto& r : all.push_constant_buffers) {
            const auto& type = compiler_.get_type(r.base_type_id);
            out_.reflection.pushConstants = membersOf(compiler_, type);
            out_.reflection.pushConstantsSize = blockSize(compiler_, type);
        }
        if (out_.reflection.stage == ShaderStage::Vertex) variables(all.stage_inputs, out_.reflection.inputs);
        if (out_.reflection.stage == ShaderStage::Fragment) variables(all.stage_outputs, out_.reflection.outputs);
        constants();
        for (const auto capability : compiler_.get_declared_capabilities())
            if (capability == spv::CapabilityInt64Atomics) out_.usesInt64Atomics = true;
    }

private:
    ReflectedBinding& add(const Resource& r, BindingType type) {
        if (!compiler_.get_type(r.type_id).array.empty())
            throw Refused{cat("declares \"", r.name, "\" as an array of bindings; use one binding or a 2D array")};
        ReflectedBinding b;
        b.group = compiler_.get_decoration(r.id, spv::DecorationDescriptorSet);
        b.entry.binding = compiler_.get_decoration(r.id, spv::DecorationBinding);
        // A block is known by its variable, or by its type when the variable has no name.
        b.entry.name = compiler_.get_name(r.id);
        if (b.entry.name.empty()) b.entry.name = compiler_.get_name(r.base_type_id);
        b.entry.type = type;
        out_.reflection.bindings.push_back(std::move(b));
        return out_.reflection.bindings.back();
    }
    void buffer(const Resource& r, BindingType type) {
        auto& b = add(r, type);
        const auto& block = compiler_.get_type(r.base_type_id);
        b.members = membersOf(compiler_, block);
        b.blockSize = blockSize(compiler_, block);
        b.entry.minBindingSize = b.blockSize;
        out_.writesStorage = out_.writesStorage || type == BindingType::StorageBuffer;
    }
    void image(const Resource& r, bool storage) {
        const auto& type = compiler_.get_type(r.type_id);
        if (type.image.dim == spv::DimBuffer || type.image.dim == spv::DimSubpassData)
            throw Refused{cat("declares \"", r.name, "\", a texel buffer or input attachment")};
        BindingType kind = type.image.ms      ? BindingType::MultisampledTexture
                           : type.image.depth ? BindingType::DepthTexture
                                              : BindingType::SampledTexture;
        if (storage) {
            const bool readOnly = compiler_.has_decoration(r.id, spv::DecorationNonWritable);
            kind = readOnly ? BindingType::ReadOnlyStorageTexture : BindingType::StorageTexture;
            out_.writesStorage = out_.writesStorage || !readOnly;
        }
        add(r, kind).entry.viewDimension = dimensionOf(type, r.name);
    }
    void variables(const spirv_cross::SmallVector<Resource>& from, std::vector<ReflectedVariable>& to) const {
        constexpr VertexFormat table[3][4] = {
            {VertexFormat::Float32, VertexFormat::Float32x2, VertexFormat::Float32x3, VertexFormat::Float32x4},
            {VertexFormat::Uint32, VertexFormat::Uint32x2, VertexFormat::Uint32x3, VertexFormat::Uint32x4},
            {VertexFormat::Sint32, VertexFormat::Sint32x2, VertexFormat::Sint32x3, VertexFormat::Sint32x4}};
        for (const auto& r : from) {
            const auto& type = compiler_.get_type(r.type_id);
            const auto scalar = scalarOf(type);
            const std::size_t row = scalar == ScalarType::Float ? 0 : scalar == ScalarType::Uint ? 1 : 2;
            const std::uint32_t first = compiler_.get_decoration(r.id, spv::DecorationLocation);
            std::uint32_t slots = type.columns;
            for (const auto length : type.array) slots *= length;
            for (std::uint32_t i = 0; i < slots; ++i)
                to.push_back({r.name, first + i, table[row][std::clamp(type.vecsize, 1U, 4U) - 1]});
        }
        std::sort(to.begin(), to.end(), [](const auto& a, const auto& b) { return a.location < b.location; });
    }
    void constants() {
        for (const auto& c : compiler_.get_specialization_constants()) {
            const auto& constant = compiler_.get_constant(c.id);
            const auto& type = compiler_.get_type(constant.constant_type);
            SpecConstant s;
            s.name = compiler_.get_name(c.id);
            s.id = c.constant_id;
            switch (type.basetype) {
                case SPIRType::Boolean:
                    s.type = SpecConstant::Type::Bool;
                    s.defaultValue = constant.scalar() != 0 ? 1 : 0;
                    break;
                case SPIRType::Int:
                    s.type = SpecConstant::Type::Int;
                    s.defaultValue = constant.scalar_i32();
                    break;
                case SPIRType::UInt:
                    s.type = SpecConstant::Type::Uint;
                    s.defaultValue = constant.scalar();
                    break;
                case SPIRType::Float:
                    s.type = SpecConstant::Type::Float;
                    s.defaultValue = static_cast<double>(constant.scalar_f32());
                    break;
                default:
                    throw Refused{cat("declares the specialization constant \"", s.name,
                                      "\"; it must be a bool, int, uint or float")};
            }
            out_.reflection.specConstants.push_back(std::move(s));
        }
    }
    const Compiler& compiler_;
    ReflectedModule& out_;
};

ShaderStage stageOf(spv::ExecutionModel model) {
    switch (model) {
        case spv::ExecutionModelVertex:
            return ShaderStage::Vertex;
        case spv::ExecutionModelFragment:
            return ShaderStage::Fragment;
        case spv::ExecutionModelGLCompute:
            return ShaderStage::Compute;
        default:
            throw Refused{"has an entry point that is no vertex, fragment or compute shader"};
    }
}

/// SPIRV-Cross trusts word counts; a walk over them first keeps it from reading past a truncated module.
bool wellFormed(const std::vector<std::uint32_t>& code) {
    if (code.size() < 5 || code[0] != spv::MagicNumber) return false;
    std::size_t at = 5;
    while (at < code.size()) {
        const std::uint32_t words = code[at] >> 16;
        if (words == 0 || words > code.size() - at) return false;
        at += words;
    }
    return true;
}

}  // namespace

Result<ReflectedModule> reflect(const std::vector<std::uint32_t>& code, const std::string& object) {
    if (!wellFormed(code))
        return invalid(ErrorCode::ShaderInvalid, cat(object, " is not SPIR-V: ", code.size(),
                                                     " words that do not start with the header 0x07230203 "
                                                     "or are cut short."));
    try {
        const Compiler compiler(code);
        const auto entries = compiler.get_entry_points_and_stages();
        const auto main = std::find_if(entries.begin(), entries.end(), [](const auto& e) { return e.name == "main"; });
        if (main == entries.end()) throw Refused{"has no entry point \"main\""};
        ReflectedModule module;
        module.reflection.stage = stageOf(main->execution_model);
        if (module.reflection.stage == ShaderStage::Compute)
            for (std::uint32_t i = 0; i < 3; ++i)
                module.reflection.workgroupSize[i] =
                    std::max(compiler.get_execution_mode_argument(spv::ExecutionModeLocalSize, i), 1U);
        Reader(compiler, module).read();
        return module;
    } catch (const Refused& refused) {
        return invalid(ErrorCode::ShaderInvalid, cat(object, ' ', refused.message, '.'));
    } catch (const std::exception& error) {
        return invalid(ErrorCode::ShaderInvalid, cat(object, " is not valid SPIR-V: ", error.what(), '.'));
    }
}

}  // namespace pelage::rhi::detail
