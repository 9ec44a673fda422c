// SPDX-License-Identifier: MIT
// Accessors of glTF. tinygltf stores what the file says and checks none of it against the bytes that are there.
#include "gltf_document.hpp"
#include "reading.hpp"

#include <algorithm>

namespace pelage::hair::gltf {
namespace {

using reading::fault;

const char* typeName(int componentType) {
    switch (componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return "BYTE";
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return "UNSIGNED_BYTE";
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return "SHORT";
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return "UNSIGNED_SHORT";
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return "UNSIGNED_INT";
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return "FLOAT";
        default:
            return "an unknown type";
    }
}

std::size_t sizeOf(int componentType) {
    switch (componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            return 0;
    }
}

int componentsOf(int type) {
    switch (type) {
        case TINYGLTF_TYPE_SCALAR:
            return 1;
        case TINYGLTF_TYPE_VEC2:
            return 2;
        case TINYGLTF_TYPE_VEC3:
            return 3;
        case TINYGLTF_TYPE_VEC4:
            return 4;
        default:
            return 0;
    }
}

/// What the glTF 2.0 specification, with KHR_mesh_quantization, allows for a semantic.
struct Expected {
    int components;
    const char* text;
    bool (*suits)(int componentType);
};

Expected expectedOf(std::string_view semantic) {
    if (semantic == "indices") {
        return {1, "SCALAR of UNSIGNED_BYTE, UNSIGNED_SHORT or UNSIGNED_INT", [](int t) {
                    return t == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || t == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                           t == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
                }};
    }
    const auto quantized = [](int t) { return sizeOf(t) != 0 && t != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT; };
    if (semantic == "TEXCOORD_0") return {2, "VEC2 of FLOAT or 8- or 16-bit integers", quantized};
    if (semantic == "TANGENT") return {4, "VEC4 of FLOAT or 8- or 16-bit integers", quantized};
    return {3, "VEC3 of FLOAT or 8- or 16-bit integers", quantized};
}

}  // namespace

float Elements::number(std::size_t i, int c) const {
    const std::size_t at = i * stride_ + static_cast<std::size_t>(c) * sizeOf(type_);
    const auto scaled = [&](float value, float largest) {
        return normalized_ ? std::max(value / largest, -1.0F) : value;
    };
    switch (type_) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return scaled(reading::valueAt<std::int8_t>(bytes_, at), 127.0F);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return scaled(reading::valueAt<std::uint8_t>(bytes_, at), 255.0F);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return scaled(reading::valueAt<std::int16_t>(bytes_, at), 32767.0F);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return scaled(reading::valueAt<std::uint16_t>(bytes_, at), 65535.0F);
        default:
            return reading::valueAt<float>(bytes_, at);
    }
}

std::uint32_t Elements::index(std::size_t i) const {
    const std::size_t at = i * stride_;
    switch (type_) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return reading::valueAt<std::uint8_t>(bytes_, at);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return reading::valueAt<std::uint16_t>(bytes_, at);
        default:
            return reading::valueAt<std::uint32_t>(bytes_, at);
    }
}

Result<Elements> elements(const tinygltf::Model& model, int index, std::string_view semantic, const std::string& name) {
    const std::string self = "accessor " + std::to_string(index) + " (" + std::string(semantic) + ") ";
    const char* const damaged = "the file is damaged: export it again";
    const auto outside = [&](const std::string& text) { return fault("G008", name, self + text, damaged); };
    if (index < 0 || static_cast<std::size_t>(index) >= model.accessors.size()) {
        return outside("does not exist; the file has " + std::to_string(model.accessors.size()));
    }
    const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
    const Expected expected = expectedOf(semantic);
    const int components = componentsOf(accessor.type);
    if (components != expected.components || !expected.suits(accessor.componentType)) {
        return fault("G009", name,
                     self + "has " + std::to_string(components) + " components of " + typeName(accessor.componentType) +
                         ", expected " + expected.text,
                     "export the mesh again");
    }
    if (accessor.sparse.isSparse || accessor.bufferView < 0) {
        return tl::unexpected(
            fault("G017", name, self + "is sparse or has no buffer view", "export the mesh without sparse accessors"));
    }
    const auto view = viewBytes(model, accessor.bufferView, name);
    if (!view) return tl::unexpected(view.error());
    const std::size_t size = static_cast<std::size_t>(components) * sizeOf(accessor.componentType);
    const std::size_t given = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
    const std::size_t stride = given == 0 ? size : given;
    if (stride < size || stride > 252) {
        return outside("steps by " + std::to_string(stride) + " bytes, expected " + std::to_string(size) + " to 252");
    }
    if (accessor.count == 0) return outside("has no elements");
    // The last element may be shorter than the stride.
    const bool inside = reading::fits(accessor.byteOffset, 1, size, view->size()) &&
                        reading::fits(accessor.byteOffset + size, accessor.count - 1, stride, view->size());
    if (!inside) {
        return outside("needs " + std::to_string(accessor.count) + " elements of " + std::to_string(size) + " bytes, " +
                       std::to_string(stride) + " apart, from byte " + std::to_string(accessor.byteOffset) +
                       ", but its buffer view has " + std::to_string(view->size()) + " bytes");
    }
    Elements out;
    out.bytes_ = view->subspan(accessor.byteOffset);
    out.count_ = accessor.count;
    out.stride_ = stride;
    out.components_ = components;
    out.type_ = accessor.componentType;
    out.normalized_ = accessor.normalized;
    return out;
}

}  // namespace pelage::hair::gltf
