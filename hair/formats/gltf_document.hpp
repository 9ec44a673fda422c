// SPDX-License-Identifier: MIT
// glTF through tinygltf, fenced in: what tinygltf does not check is checked here, before or after it runs.
#pragma once

#include <pelage/base/diagnostic.hpp>
#include <pelage/hair/geometry.hpp>

#include <span>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wextra"
#include <tiny_gltf.h>
#pragma GCC diagnostic pop

namespace pelage::hair::gltf {

/// The document, images still encoded (Image::image holds the file's bytes of an image named by a URI).
Result<tinygltf::Model> readDocument(std::span<const std::byte> bytes, const std::string& name,
                                     const std::string& folder);

/// The bytes of a buffer view, checked against its buffer (G008).
Result<std::span<const std::byte>> viewBytes(const tinygltf::Model& model, int view, const std::string& name);

/// Elements of an accessor, checked against its view and buffer: reading element i < count is always safe.
class Elements {
public:
    std::size_t count() const { return count_; }
    int components() const { return components_; }
    /// Component c of element i as a number; normalised integers as 0..1 or -1..1.
    float number(std::size_t i, int c) const;
    /// Component 0 of element i as an unsigned integer.
    std::uint32_t index(std::size_t i) const;

private:
    friend Result<Elements> elements(const tinygltf::Model&, int, std::string_view, const std::string&);
    std::span<const std::byte> bytes_ = {};
    std::size_t count_ = 0, stride_ = 0;
    int components_ = 0, type_ = 0;
    bool normalized_ = false;
};

/// Accessor `index`, which serves as `semantic` (POSITION, indices, ...): component type and width must suit it.
Result<Elements> elements(const tinygltf::Model& model, int index, std::string_view semantic, const std::string& name);

}  // namespace pelage::hair::gltf
