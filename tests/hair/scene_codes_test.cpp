// SPDX-License-Identifier: MIT
// What the renderer refuses, and what is done to an asset that states too little: one case for each code.
#include <pelage/hair/load.hpp>
#include <pelage/hair/scene_file.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace pelage::hair {
namespace {

std::string notesOf(const Strands& strands) {
    const std::string path =
        (std::filesystem::temp_directory_path() / ("pelage_scene_codes_" + std::to_string(::getpid()) + ".hair"))
            .string();
    const std::vector<std::byte> bytes = encodeHair(strands);
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    Library library(PELAGE_DATA_DIR);
    const auto scene = sceneFromAsset(path, "", 1.0F, library);
    std::filesystem::remove(path);
    if (!scene) return "refused: " + scene.error().text();
    std::string codes;
    for (const Diagnostic& note : scene->notes.items())
        codes += (codes.empty() ? "" : " ") + std::string(note.code.text());
    return codes;
}

TEST(SceneCodes, FewStrandsAndMissingWidthsAreSaid) {
    Strands strands;
    strands.first = {0};
    for (int s = 0; s < 40; ++s) {
        for (int i = 0; i < 3; ++i) strands.points.push_back({0.005F * float(s), 1.6F - 0.05F * float(i), 0});
        strands.first.push_back(static_cast<std::uint32_t>(strands.points.size()));
    }
    strands.updateBounds();
    EXPECT_EQ(notesOf(strands), "A103 A104");
    strands.width = 0.5F;
    EXPECT_EQ(notesOf(strands).substr(0, 4), "A102") << "no hair is half a metre wide";
}

TEST(SceneCodes, TypesAndRenderersThatAreNotThere) {
    Library library(PELAGE_DATA_DIR);
    const auto type = library.materialType("hiar");
    ASSERT_FALSE(type);
    EXPECT_EQ(type.error().first().code, Code("L001")) << type.error().text();
    EXPECT_NE(type.error().first().hint.find("hair"), std::string::npos);
    const auto renderer = Renderer::create({});
    ASSERT_FALSE(renderer);
    EXPECT_EQ(renderer.error().first().code, Code("N001")) << renderer.error().text();
}

}  // namespace
}  // namespace pelage::hair
