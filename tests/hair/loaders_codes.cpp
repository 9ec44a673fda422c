// SPDX-License-Identifier: MIT
// What readers say of files that they mend or that lack something: one file for each code.
#include "loaders_files.hpp"

#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace pelage::hair::testing {
namespace {

/// The codes of the notes on a file, each once, in their order.
std::string notesOf(const Bytes& bytes, const std::string& ending) {
    const auto path = std::filesystem::temp_directory_path() / ("pelage_codes_" + std::to_string(::getpid()) + ending);
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    const auto asset = loadAsset(path.string());
    std::filesystem::remove(path);
    if (!asset) return "refused: " + asset.error().text();
    std::string codes;
    for (const Diagnostic& note : asset->notes.items()) {
        const std::string code(note.code.text());
        if (codes.find(code) == std::string::npos) codes += (codes.empty() ? "" : " ") + code;
    }
    return codes;
}

/// sampleGroom() with one more strand of these points and widths.
Bytes hairWith(const std::vector<glm::vec3>& points, float width = 90e-6F) {
    Strands groom = sampleGroom();
    for (const glm::vec3& p : points) {
        groom.points.push_back(p);
        groom.widths.push_back(width);
    }
    groom.first.push_back(static_cast<std::uint32_t>(groom.points.size()));
    return encodeHair(groom);
}

const float nan = std::nanf("");

TEST(LoaderCodes, OfStrandsThatAreDroppedOrMended) {
    EXPECT_EQ(notesOf(hairWith({{0, 1, 0}, {0, 0.9F, 0}}), ".hair"), "");
    EXPECT_EQ(notesOf(hairWith({{0, 1, 0}, {nan, 0.9F, 0}}), ".hair"), "H101");
    EXPECT_EQ(notesOf(hairWith({{0, 1, 0}}), ".hair"), "H102");
    EXPECT_EQ(notesOf(hairWith({{0, 1, 0}, {0, 1, 0}}), ".hair"), "H103");
    EXPECT_EQ(notesOf(hairWith({{0, 1, 0}, {0, 0.9F, 0}, {0, 0.9F, 0}}), ".hair"), "H104");
    EXPECT_EQ(notesOf(hairWith({{0, 1, 0}, {0, 0.9F, 0}}, -1.0F), ".hair"), "H105");
}

TEST(LoaderCodes, OfTressFxStrands) {
    const auto with = [](std::size_t point, const glm::vec3& p) {
        Bytes bytes = tfxFile();
        poke(bytes, 160 + 16 * point, p);
        return notesOf(bytes, ".tfx");
    };
    EXPECT_EQ(notesOf(tfxFile(), ".tfx"), "");
    EXPECT_EQ(with(2, {nan, 0, 0}), "T101");
    EXPECT_EQ(with(1, {0, 1, 0}), "T104") << "the first point again";
    Bytes flat = tfxFile();
    for (std::size_t i = 0; i < 5; ++i) poke(flat, 160 + 16 * i, glm::vec3(0, 1, 0));
    EXPECT_EQ(notesOf(flat, ".tfx"), "T103");
}

TEST(LoaderCodes, OfCards) {
    EXPECT_EQ(notesOf(GlbFile().bytes(), ".glb"), "G102") << "this card has no normals";
    GlbFile bare;
    bare.json.erase("materials");
    bare.primitive().erase("material");
    EXPECT_EQ(notesOf(bare.bytes(), ".glb"), "G102 G104");

    GlbFile second;
    second.json["materials"].push_back(second.json["materials"][0]);
    nlohmann::json other = second.primitive();
    other["material"] = 1;
    second.json["meshes"][0]["primitives"].push_back(other);
    EXPECT_EQ(notesOf(second.bytes(), ".glb"), "G102 G105");

    GlbFile flat;  // one texture coordinate for all
    for (std::size_t i = 0; i < 6; ++i) {
        poke(flat.bin, 72 + 8 * i, 0.5F);
        poke(flat.bin, 76 + 8 * i, 0.5F);
    }
    EXPECT_EQ(notesOf(flat.bytes(), ".glb"), "G102 G103");

    GlbFile upward;  // v grows towards the root
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t side = 0; side < 2; ++side)
            poke(upward.bin, 76 + 8 * (2 * row + side), 1.0F - 0.5F * static_cast<float>(row));
    }
    EXPECT_EQ(notesOf(upward.bytes(), ".glb"), "G102 G101");
}

}  // namespace
}  // namespace pelage::hair::testing
