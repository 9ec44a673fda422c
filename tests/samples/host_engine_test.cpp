// SPDX-License-Identifier: MIT
// The host engine: a renderer that is not ours, with hair in it. It runs under the validation layer with
// synchronization validation, while its second thread submits to the same queue; one message and it exits with 1.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wextra"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
constexpr int size = 240;

struct Picture {
    std::vector<std::uint8_t> rgb;
    int at(int x, int y, int channel) const { return rgb[static_cast<std::size_t>((y * size + x) * 3 + channel)]; }
};

class HostEngine : public ::testing::Test {
protected:
    static Picture draw(const std::string& arguments) {
        const auto path = fs::temp_directory_path() / ("pelage_host_" + std::to_string(::getpid()) + ".png");
        const std::string command = std::string(HOST_ENGINE) + " --validate --size " + std::to_string(size) + " -o " +
                                    path.string() + " " + arguments;
        EXPECT_EQ(std::system(command.c_str()), 0) << command;
        int width = 0, height = 0, channels = 0;
        Picture picture;
        if (auto* pixels = stbi_load(path.c_str(), &width, &height, &channels, 3); pixels != nullptr) {
            EXPECT_EQ(width, size);
            picture.rgb.assign(pixels, pixels + std::size_t{3} * size * size);
            stbi_image_free(pixels);
        }
        fs::remove(path);
        return picture;
    }
    /// Pixels where two pictures differ by more than `tolerance` in a channel, in a rectangle.
    static int differ(const Picture& a, const Picture& b, int tolerance, int x0 = 0, int y0 = 0, int x1 = size,
                      int y1 = size) {
        int count = 0;
        for (int y = y0; y < y1; ++y)
            for (int x = x0; x < x1; ++x) {
                bool other = false;
                for (int c = 0; c < 3; ++c) other = other || std::abs(a.at(x, y, c) - b.at(x, y, c)) > tolerance;
                count += other ? 1 : 0;
            }
        return count;
    }
};

TEST_F(HostEngine, BothDepthConventionsGiveOnePicture) {
    const auto reversed = draw("--frames 2"), conventional = draw("--frames 2 --conventional-depth");
    ASSERT_FALSE(reversed.rgb.empty());
    ASSERT_FALSE(conventional.rgb.empty());
    EXPECT_LT(differ(reversed, conventional, 8), size * size / 1000) << "a strand at a depth edge may fall either way";
}

TEST_F(HostEngine, HairIsHiddenByTheSceneAndShadowsIt) {
    // Where the box stands before the hair.
    const auto with = draw("--frames 2 --turn 5.85"), without = draw("--frames 2 --turn 5.85 --no-hair");
    ASSERT_FALSE(with.rgb.empty());
    ASSERT_FALSE(without.rgb.empty());
    EXPECT_GT(differ(with, without, 24), size * size / 20) << "there is hair";
    // The box is blue where nothing else is; every blue pixel of the picture without hair is still there with it.
    int blue = 0, kept = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const auto isBlue = [&](const Picture& p) { return p.at(x, y, 2) > p.at(x, y, 0) + 60; };
            if (!isBlue(without)) continue;
            ++blue;
            kept += isBlue(with) ? 1 : 0;
        }
    EXPECT_GT(blue, 300);
    EXPECT_GT(kept, blue * 98 / 100) << "the box hides the hair behind it";
    // The floor below has no hair before it, and is darker where the hair's shadow falls.
    int darker = 0;
    for (int y = size * 80 / 100; y < size * 92 / 100; ++y)
        for (int x = size * 17 / 100; x < size * 62 / 100; ++x)
            darker += with.at(x, y, 1) < without.at(x, y, 1) - 15 ? 1 : 0;
    EXPECT_GT(darker, 150);
}

TEST(HostEngineSource, AddsHairInAtMostSixtyLines) {
    std::ifstream file(HOST_ENGINE_SOURCE "/hair.cpp");
    ASSERT_TRUE(file);
    int lines = 0;
    bool inside = false;
    for (std::string line; std::getline(file, line);) {
        if (line.find("class Hair {") != std::string::npos) inside = true;
        if (line.find("To here.") != std::string::npos) break;
        if (inside && line.find_first_not_of(" \t") != std::string::npos) ++lines;
    }
    EXPECT_GT(lines, 20) << "the markers moved";
    EXPECT_LE(lines, 60);
}

TEST(HostEngineSource, TheEngineKnowsNothingOfPelage) {
    for (const auto& entry : fs::directory_iterator(HOST_ENGINE_SOURCE)) {
        const auto name = entry.path().filename().string();
        if (name == "hair.cpp" || entry.path().extension() == ".txt" || entry.path().extension() == ".md") continue;
        if (!entry.is_regular_file()) continue;
        std::ifstream file(entry.path());
        for (std::string line; std::getline(file, line);)
            EXPECT_EQ(line.find("#include <pelage"), std::string::npos) << name << ": " << line;
    }
}

}  // namespace
