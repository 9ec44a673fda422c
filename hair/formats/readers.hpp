// SPDX-License-Identifier: MIT
// The readers with their notes; the public functions that return a bare value leave the notes out.
#pragma once

#include <pelage/hair/load.hpp>

namespace pelage::hair::reading {

Result<Groom> readTfx(std::span<const std::byte> bytes, const std::string& name, Diagnostics& notes);
Result<Groom> readHair(std::span<const std::byte> bytes, const std::string& name, Diagnostics& notes);
/// `folder`: where buffers and images named by URIs lie; empty: the file must be complete in itself.
Result<Geometry> readGltf(std::span<const std::byte> bytes, const std::string& name, const std::string& folder,
                           Diagnostics& notes);
/// The folder part of a path; "." for a bare file name.
std::string folderOf(const std::string& path);

}  // namespace pelage::hair::reading
