// SPDX-License-Identifier: MIT
// Readers of hair files. Each checks every byte that it uses, never throws and never crashes, whatever the file holds:
// a fault is one Diagnostic that names the file, what was found, what was expected and what to do.
#pragma once

#include <pelage/base/diagnostic.hpp>
#include <pelage/hair/geometry.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <variant>

namespace pelage::hair {

/// What a file holds.
using Asset = std::variant<Mesh, Strands>;

/// Cards from glTF 2.0 binary (.glb) or text (.gltf), all meshes of the default scene merged, node transforms applied.
/// Needs POSITION and TEXCOORD_0 (codes G001..). Strand direction: the v axis of the texture (+v, down the image, is
/// root to tip), from the triangles' UV gradients. `strandId` and `along` are found per island (connected triangles).
Result<Mesh> loadGltf(const std::string& path);
Result<Mesh> parseGltf(std::span<const std::byte> bytes, const std::string& name);

/// TressFX 4 grooms (.tfx): header of 160 bytes, then strands of float4 points. Codes T001...
Result<Strands> loadTfx(const std::string& path);
Result<Strands> parseTfx(std::span<const std::byte> bytes, const std::string& name);

/// Cem Yuksel's .hair files: 128-byte header, optional segments, points, thickness, transparency, colour. Codes H001...
Result<Strands> loadHair(const std::string& path);
Result<Strands> parseHair(std::span<const std::byte> bytes, const std::string& name);
/// The same format, written (points, segments and thickness).
std::vector<std::byte> encodeHair(const Strands& strands);

/// PNG, JPEG, TGA, BMP to 8 bits a channel (1, 2 or 4 channels). Codes I001...
Result<Image8> decodeImage(std::span<const std::byte> bytes, const std::string& name, bool srgb);

/// Reads any of the above by its ending. Strands whose units are plainly not metres are scaled, and widths that no hair
/// has are replaced (and `notes` says so); their center is the middle of the roots. Nothing else is changed: follow
/// strands, decimation and a covering width are asked for (generate.hpp).
struct LoadedAsset {
    Asset asset = {};
    Diagnostics notes = {};  // dropped strands, scaled units, guessed directions: warnings and notes, never errors
};
Result<LoadedAsset> loadAsset(const std::string& path);
/// The endings that loadAsset() knows, for people: ".glb, .gltf, .tfx or .hair".
std::string assetEndings();

/// What `pelage info` prints: format, counts, bounds, lengths, attributes present and missing. Several lines.
std::string describe(const LoadedAsset& asset, const std::string& path);

/// Whole file into memory (F001 cannot open, F002 larger than `limit`).
Result<std::vector<std::byte>> readFile(const std::string& path, std::size_t limit = std::size_t{1} << 31);

}  // namespace pelage::hair
