// SPDX-License-Identifier: MIT
// PNG, JPEG, TGA and BMP through stb_image, compiled privately here so that no other copy in the process is disturbed.
#include "reading.hpp"

#include <pelage/hair/load.hpp>

#include <limits>
#include <memory>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_TGA
#define STBI_ONLY_BMP
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_NO_HDR
#define STBI_MAX_DIMENSIONS 16384
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wextra"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace pelage::hair {

using reading::fault;

namespace {

// False when a Huffman table of a JPEG promises more than 256 codes: Debian's stb_image would write past its table.
// Walks the markers as stb_image does (fill bytes and junk between segments, zeros behind the end), scan data included:
// inside it FF is followed by 00 or a restart marker.
bool jpegTablesFit(std::span<const std::byte> bytes) {
    const auto at = [&](std::size_t i) { return i < bytes.size() ? std::to_integer<unsigned>(bytes[i]) : 0U; };
    std::size_t begin = 0;
    while (at(begin) == 0xFF) ++begin;
    if (begin == 0 || at(begin) != 0xD8) return true;  // no JPEG
    for (std::size_t i = begin + 1; i < bytes.size();) {
        if (at(i) != 0xFF) {
            ++i;
            continue;
        }
        while (at(i) == 0xFF) ++i;
        const unsigned marker = at(i++);
        if (marker == 0xD9) return true;
        if (marker < 0xC0 || (marker >= 0xD0 && marker <= 0xD8)) continue;  // no segment
        const std::size_t length = at(i) * 256 + at(i + 1);
        if (marker == 0xC4) {
            std::size_t table = i + 2;
            for (std::size_t left = length < 2 ? 0 : length - 2; left > 0;) {
                std::size_t codes = 0;
                for (std::size_t k = 1; k <= 16; ++k) codes += at(table + k);
                if (codes > 256) return false;
                table += 17 + codes;
                left = left > 17 + codes ? left - 17 - codes : 0;
            }
        }
        i += length < 2 ? 2 : length;
    }
    return true;
}

}  // namespace

Result<Image8> decodeImage(std::span<const std::byte> bytes, const std::string& name, bool srgb) {
    if (bytes.empty()) {
        return fault("I001", name, "the image has no bytes", "export the texture again");
    }
    const auto unreadable = [&] {
        const char* why = stbi_failure_reason();
        return fault("I002", name,
                     "the image (" + std::to_string(bytes.size()) +
                         " bytes) cannot be decoded: " + (why != nullptr ? why : "unknown reason"),
                     "expected PNG, JPEG, TGA or BMP; export the texture again");
    };
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        return fault("I003", name, "the image file is larger than 2 GiB", "use a smaller texture");
    }
    if (!jpegTablesFit(bytes)) {
        return fault("I005", name, "a Huffman table of the JPEG has more than 256 codes",
                     "the texture is damaged: export it again");
    }
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    int width = 0, height = 0, found = 0;
    if (stbi_info_from_memory(data, size, &width, &height, &found) == 0) return unreadable();
    const auto side = static_cast<int>(reading::kMaxImageSide);
    const std::string extent = std::to_string(width) + " x " + std::to_string(height);
    if (width < 1 || height < 1 || width > side || height > side) {
        return fault("I003", name,
                     "the image is " + extent + " texels, expected 1 to " + std::to_string(side) + " on each side",
                     "use a smaller texture");
    }
    // The densest of these formats (1-bit PNG) packs some 8,000 texels a byte. More than that is a damaged header, and
    // decoding it would ask for a gigabyte to hold nothing.
    const auto texels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    if (texels / 16384 > bytes.size()) {
        return fault("I004", name,
                     "the image header promises " + extent + " texels, which cannot be in " +
                         std::to_string(bytes.size()) + " bytes",
                     "the texture is cut off or damaged: export it again");
    }
    const int channels = found == 3 ? 4 : found;
    const std::unique_ptr<stbi_uc, void (*)(void*)> decoded(
        stbi_load_from_memory(data, size, &width, &height, &found, channels), stbi_image_free);
    if (!decoded) return unreadable();

    Image8 image;
    image.width = static_cast<std::uint32_t>(width);
    image.height = static_cast<std::uint32_t>(height);
    image.channels = static_cast<std::uint32_t>(channels);
    image.srgb = srgb;
    const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * image.channels;
    image.texels.assign(decoded.get(), decoded.get() + count);
    return image;
}

}  // namespace pelage::hair
