// SPDX-License-Identifier: MIT
#include "environment_file.hpp"

#include <pelage/hair/load.hpp>

#include <ImfRgbaFile.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <vector>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_HDR
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 32768
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wextra"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace pelage::app {

namespace {

Diagnostic unreadable(const std::string& path, const std::string& why) {
    return failure("A010", path + ": the environment cannot be read: " + why +
                               "; expected an equirectangular Radiance .hdr or OpenEXR .exr picture");
}

/// One infinite or negative texel would spoil all nine coefficients.
void tame(std::vector<float>& rgb) {
    for (float& value : rgb) value = std::isfinite(value) ? std::clamp(value, 0.0F, 65504.0F) : 0.0F;
}

Result<hair::Environment> fromHdr(const std::string& path) {
    const auto bytes = hair::readFile(path, std::size_t{1} << 29);
    if (!bytes) return tl::unexpected(bytes.error());
    if (bytes->size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        return tl::unexpected(unreadable(path, "the file is larger than 2 GiB"));
    }
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<float, decltype(&stbi_image_free)> texels(
        stbi_loadf_from_memory(reinterpret_cast<const stbi_uc*>(bytes->data()), static_cast<int>(bytes->size()), &width,
                               &height, &channels, 3),
        &stbi_image_free);
    if (!texels) return tl::unexpected(unreadable(path, stbi_failure_reason()));
    std::vector<float> rgb(texels.get(),
                           texels.get() + static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
    tame(rgb);
    return hair::Environment::fromEquirect(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), rgb);
}

Result<hair::Environment> fromExr(const std::string& path) {
    try {
        Imf::RgbaInputFile file(path.c_str());
        const auto window = file.dataWindow();
        const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
        const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
        if (width <= 0 || height <= 0 || width > 32768 || height > 32768) {
            return tl::unexpected(unreadable(path, "its size is outside 1 to 32768"));
        }
        std::vector<Imf::Rgba> row(static_cast<std::size_t>(width));
        std::vector<float> rgb;
        rgb.reserve(row.size() * static_cast<std::size_t>(height) * 3);
        for (int y = window.min.y; y <= window.max.y; ++y) {
            // OpenEXR addresses a pixel as base + x + y * stride: one row at a time needs no arithmetic on outside
            // memory.
            file.setFrameBuffer(row.data() - window.min.x, 1, 0);
            file.readPixels(y);
            for (const Imf::Rgba& texel : row) rgb.insert(rgb.end(), {float(texel.r), float(texel.g), float(texel.b)});
        }
        tame(rgb);
        return hair::Environment::fromEquirect(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height),
                                               rgb);
    } catch (const std::exception& error) {
        return tl::unexpected(unreadable(path, error.what()));
    }
}

}  // namespace

Result<hair::Environment> chooseEnvironment(const std::string& text) {
    if (text == "none") return hair::Environment::none();
    if (text == "studio") return hair::Environment::studio();
    if (text.ends_with(".hdr")) return fromHdr(text);
    if (text.ends_with(".exr")) return fromExr(text);
    return tl::unexpected(failure(
        "A011", "--environment is \"" + text + "\", expected none, studio, or a path that ends in .hdr or .exr"));
}

}  // namespace pelage::app
