// SPDX-License-Identifier: MIT
// Pictures as files: PNG for people, OpenEXR (half, scene-linear, premultiplied) for programs.
#pragma once

#include "failure.hpp"

#include <pelage/hair/renderer.hpp>

#include <string>

namespace pelage::app {

/// Fails when the ending is neither .png nor .exr, or the directory does not exist: ask before rendering.
Result<void> checkPicturePath(const std::string& path);

/// Writes beside `path` and renames at the end, so that a picture is either whole or not there.
Result<void> writePicture(const std::string& path, const hair::Picture& picture);

}  // namespace pelage::app
