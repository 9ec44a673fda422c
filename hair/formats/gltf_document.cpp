// SPDX-License-Identifier: MIT
#include "gltf_document.hpp"

#include "reading.hpp"

#include <pelage/hair/load.hpp>

#include <algorithm>
#include <filesystem>
#include <limits>

namespace pelage::hair::gltf {
namespace {

using reading::fault;

constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinChunk = 0x004E4942;
constexpr int kMaxDepth = 128;  // nested brackets; tinygltf recurses over extras and extensions

/// What the callbacks of tinygltf may touch.
struct Folder {
    std::string path;     // empty: no outside files
    std::string missing;  // the first file that was asked for and could not be had
};

bool isInside(const Folder& folder, const std::string& path) {
    // tinygltf also looks in the current folder; a model must not pick up files that merely lie there.
    const std::string prefix = folder.path.ends_with('/') ? folder.path : folder.path + "/";
    return !folder.path.empty() && path.starts_with(prefix);
}

bool fileExists(const std::string& path, void* user) {
    auto& folder = *static_cast<Folder*>(user);
    std::error_code error;
    const bool found = isInside(folder, path) && std::filesystem::is_regular_file(path, error);
    if (!found && folder.missing.empty()) folder.missing = path;
    return found;
}

std::string samePath(const std::string& path, void*) {
    return path;
}

bool readWhole(std::vector<unsigned char>* out, std::string* error, const std::string& path, void* user) {
    auto& folder = *static_cast<Folder*>(user);
    if (!isInside(folder, path)) return false;
    const Result<std::vector<std::byte>> bytes = readFile(path);
    if (!bytes) {
        if (error != nullptr) *error = bytes.error().first().text;
        if (folder.missing.empty()) folder.missing = path;
        return false;
    }
    const auto* first = reinterpret_cast<const unsigned char*>(bytes->data());
    out->assign(first, first + bytes->size());
    return true;
}

bool writeNothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
}

/// Keeps the encoded bytes; decoding happens later and only for images that are used. For an image in a buffer view
/// the pointer must not be read: tinygltf has not checked that view.
bool keepEncoded(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes,
                 int size, void*) {
    if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
    return true;
}

/// The deepest nesting of brackets outside strings.
int depthOf(std::string_view json) {
    int depth = 0, deepest = 0;
    bool inString = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (inString) {
            if (c == '\\') ++i;
            if (c == '"') inString = false;
        } else if (c == '"') {
            inString = true;
        } else if (c == '{' || c == '[') {
            deepest = std::max(deepest, ++depth);
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
    return deepest;
}

Result<std::string_view> jsonOfBinary(std::span<const std::byte> bytes, const std::string& name) {
    const std::string size = std::to_string(bytes.size());
    if (bytes.size() < 20) {
        return fault("G002", name, "the file has " + size + " bytes, expected at least 20 of a .glb",
                     "the file is cut off: copy or export it again");
    }
    const auto version = reading::valueAt<std::uint32_t>(bytes, 4);
    const auto length = reading::valueAt<std::uint32_t>(bytes, 8);
    const auto jsonLength = reading::valueAt<std::uint32_t>(bytes, 12);
    if (version != 2) {
        return fault("G001", name, "the .glb header says version " + std::to_string(version) + ", expected 2",
                     "export it as glTF 2.0");
    }
    if (length > bytes.size()) {
        return tl::unexpected(
            fault("G002", name, "the header promises " + std::to_string(length) + " bytes, but the file has " + size,
                  "the file is cut off: copy or export it again"));
    }
    if (reading::valueAt<std::uint32_t>(bytes, 16) != kJsonChunk || !reading::fits(20, jsonLength, 1, length)) {
        return fault("G002", name,
                     "the first chunk promises " + std::to_string(jsonLength) +
                         " bytes of JSON, expected a JSON chunk that ends within " + std::to_string(length) + " bytes",
                     "the file is damaged: export it again");
    }
    const std::size_t next = std::size_t{20} + jsonLength;
    if (reading::fits(next, 8, 1, length)) {
        const auto binLength = reading::valueAt<std::uint32_t>(bytes, next);
        const bool isBin = reading::valueAt<std::uint32_t>(bytes, next + 4) == kBinChunk;
        if (isBin && !reading::fits(next + 8, binLength, 1, length)) {
            return fault("G002", name,
                         "the binary chunk promises " + std::to_string(binLength) + " bytes, but only " +
                             std::to_string(length - next - 8) + " follow",
                         "the file is cut off or damaged: export it again");
        }
    }
    return std::string_view(reinterpret_cast<const char*>(bytes.data()) + 20, jsonLength);
}

/// Extensions that change how positions or texture coordinates are stored; without them nothing can be read.
Result<tinygltf::Model> checkExtensions(tinygltf::Model model, const std::string& name) {
    for (const std::string& extension : model.extensionsRequired) {
        const bool harmless = extension.starts_with("KHR_materials_") || extension == "KHR_lights_punctual" ||
                              extension == "KHR_mesh_quantization" || extension == "KHR_xmp_json_ld";
        if (harmless) continue;
        return fault("G017", name, "the file requires the extension \"" + extension + "\"",
                     "export it uncompressed and without that extension");
    }
    return model;
}

}  // namespace

Result<tinygltf::Model> readDocument(std::span<const std::byte> bytes, const std::string& name,
                                     const std::string& folder) {
    const bool binary = bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
    std::string_view json(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (bytes.empty()) return fault("G001", name, "there are no bytes", "name a .glb or .gltf file");
    if (binary) {
        const Result<std::string_view> chunk = jsonOfBinary(bytes, name);
        if (!chunk) return tl::unexpected(chunk.error());
        json = *chunk;
    } else {
        const std::size_t start = json.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
        if (start == std::string_view::npos || json[start] != '{') {
            return fault("G001", name,
                         "the file starts with \"" + reading::oneLine(json.substr(0, 4)) +
                             "\", expected \"glTF\" (binary) or \"{\" (text)",
                         "this is no glTF file");
        }
    }
    if (bytes.size() > std::numeric_limits<std::uint32_t>::max()) {
        return fault("G002", name, "the file is larger than 4 GiB", "split the asset");
    }
    if (const int depth = depthOf(json); depth > kMaxDepth) {
        return fault(
            "G003", name,
            "the JSON is nested " + std::to_string(depth) + " deep, expected at most " + std::to_string(kMaxDepth),
            "remove deeply nested extras");
    }

    Folder outside{folder, ""};
    tinygltf::TinyGLTF reader;
    reader.SetImageLoader(keepEncoded, nullptr);
    reader.SetFsCallbacks({fileExists, samePath, readWhole, writeNothing, &outside});
    tinygltf::Model model;
    std::string error, warning;
    bool good = false;
    try {
        const auto size = static_cast<unsigned int>(bytes.size());
        if (binary) {
            const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
            good = reader.LoadBinaryFromMemory(&model, &error, &warning, data, size, folder);
        } else {
            good = reader.LoadASCIIFromString(&model, &error, &warning, json.data(), size, folder);
        }
    } catch (const std::exception& e) {
        good = false;
        error = e.what();
    }
    if (!good && !outside.missing.empty()) {
        const std::string where =
            folder.empty() ? "this reader was given bytes without a folder" : "looked for " + outside.missing;
        return fault("G005", name, "a buffer file that the glTF names cannot be read; " + where,
                     "keep the .bin beside the .gltf, or export one .glb");
    }
    if (!good) {
        return fault("G004", name, "the glTF document is not valid: " + error,
                     "check it with the Khronos glTF validator, or export it again");
    }
    return checkExtensions(std::move(model), name);
}

Result<std::span<const std::byte>> viewBytes(const tinygltf::Model& model, int view, const std::string& name) {
    const auto wrong = [&](const std::string& text) {
        return fault("G008", name, "buffer view " + std::to_string(view) + " " + text,
                     "the file is damaged: export it again");
    };
    if (view < 0 || static_cast<std::size_t>(view) >= model.bufferViews.size()) {
        return wrong("does not exist; the file has " + std::to_string(model.bufferViews.size()));
    }
    const tinygltf::BufferView& v = model.bufferViews[static_cast<std::size_t>(view)];
    if (v.buffer < 0 || static_cast<std::size_t>(v.buffer) >= model.buffers.size()) {
        return wrong("names buffer " + std::to_string(v.buffer) + "; the file has " +
                     std::to_string(model.buffers.size()));
    }
    const std::vector<unsigned char>& data = model.buffers[static_cast<std::size_t>(v.buffer)].data;
    if (!reading::fits(v.byteOffset, v.byteLength, 1, data.size())) {
        return wrong("spans " + std::to_string(v.byteLength) + " bytes from byte " + std::to_string(v.byteOffset) +
                     ", but its buffer has " + std::to_string(data.size()));
    }
    return std::as_bytes(std::span(data)).subspan(v.byteOffset, v.byteLength);
}

}  // namespace pelage::hair::gltf
