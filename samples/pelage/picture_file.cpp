// SPDX-License-Identifier: MIT
#include "picture_file.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <limits>
#include <vector>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wextra"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace pelage::app {

namespace fs = std::filesystem;

namespace {

/// Half has no room above 65504; a light seen directly may be brighter.
float toHalfRange(float value) {
    constexpr float largest = 65504.0F;
    return value > largest ? largest : value < -largest ? -largest : value;
}

Failure notWritten(const std::string& path, const std::string& why) {
    return Failure("A020: " + path + ": the picture cannot be written: " + why);
}

void writePng(const std::string& path, const hair::Picture& picture) {
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    const auto append = [](void* context, void* bytes, int size) {
        static_cast<std::ofstream*>(context)->write(static_cast<const char*>(bytes), size);
    };
    const int width = static_cast<int>(picture.width), height = static_cast<int>(picture.height);
    const int encoded = stbi_write_png_to_func(append, &file, width, height, 4, picture.display.data(), width * 4);
    file.close();
    if (encoded == 0 || !file) throw std::runtime_error("the disk is full or the directory is read-only");
}

void writeExr(const std::string& path, const hair::Picture& picture) {
    const std::size_t count = std::size_t{picture.width} * picture.height;
    std::vector<Imath::half> planes[4];
    Imf::Header header(static_cast<int>(picture.width), static_cast<int>(picture.height));
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::addComments(header, "Pelage: scene-linear Rec.709, premultiplied alpha");
    Imf::FrameBuffer frame;
    const char* names[4] = {"R", "G", "B", "A"};
    for (std::size_t channel = 0; channel < 4; ++channel) {
        planes[channel].resize(count);
        for (std::size_t i = 0; i < count; ++i) planes[channel][i] = toHalfRange(picture.linear[i * 4 + channel]);
        header.channels().insert(names[channel], Imf::Channel(Imf::HALF));
        frame.insert(names[channel], Imf::Slice(Imf::HALF, reinterpret_cast<char*>(planes[channel].data()),
                                                sizeof(Imath::half), sizeof(Imath::half) * picture.width));
    }
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(static_cast<int>(picture.height));
}

}  // namespace

Result<void> checkPicturePath(const std::string& path) {
    if (!path.ends_with(".png") && !path.ends_with(".exr")) {
        return tl::unexpected(Failure("A021: the output \"" + path + "\" ends in neither .png nor .exr"));
    }
    const fs::path directory = fs::path(path).parent_path();
    std::error_code ignored;
    if (!directory.empty() && !fs::is_directory(directory, ignored)) {
        return tl::unexpected(notWritten(path, "there is no directory " + directory.string() + "; make it first"));
    }
    return {};
}

Result<void> writePicture(const std::string& path, const hair::Picture& picture) {
    const std::size_t texels = std::size_t{picture.width} * picture.height * 4;
    const bool png = path.ends_with(".png");
    if (png ? picture.display.size() != texels : picture.linear.size() != texels) {
        return tl::unexpected(
            notWritten(path, std::string("the pass tree exports no ") + (png ? "\"LdrColor\"" : "\"HdrColor\"")));
    }
    const std::string partial = path + ".part";
    std::error_code ignored;
    try {
        png ? writePng(partial, picture) : writeExr(partial, picture);
        fs::rename(partial, path);
    } catch (const std::exception& error) {
        fs::remove(partial, ignored);
        return tl::unexpected(notWritten(path, error.what()));
    }
    return {};
}

}  // namespace pelage::app
