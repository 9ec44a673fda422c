// SPDX-License-Identifier: MIT
// Textures on the device against closed forms: how much of a card each blending mode covers for an opacity, and the
// colour of a texel.
#include "gpu.hpp"
#include "pictures.hpp"

#include <gtest/gtest.h>
#include <stb/stb_image_write.h>

#include <cmath>
#include <filesystem>

namespace pelage::test {
namespace {

using Values = std::vector<std::pair<std::string, std::string>>;

/// A PNG of one colour, in a folder that the test takes away.
class Texels : public ::testing::Test {
protected:
    ValidationGuard guard;
    std::filesystem::path folder;

    void SetUp() override {
        folder = std::filesystem::temp_directory_path() /
                 ("pelage_coverage_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
        std::filesystem::create_directories(folder);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::string png(int red, int green, int blue, int alpha) const {
        std::vector<std::uint8_t> texels;
        for (int i = 0; i < 16; ++i) {
            for (const int channel : {red, green, blue, alpha}) texels.push_back(static_cast<std::uint8_t>(channel));
        }
        const std::string name = std::to_string(red) + "_" + std::to_string(green) + "_" + std::to_string(blue) + "_" +
                                 std::to_string(alpha) + ".png";
        const std::string path = (folder / name).string();
        EXPECT_NE(stbi_write_png(path.c_str(), 4, 4, 4, texels.data(), 16), 0) << path;
        return path;
    }

    /// A card that fills the picture.
    static hair::Picture pictureOf(const materials::Material& material, const char* msaa = "4") {
        static hair::Renderer renderer = makeRenderer();
        hair::Scene scene;
        scene.objects.push_back({.name = "card", .geometry = card(), .material = material});
        scene.environment = hair::Environment::none();
        scene.lights = {{.direction = {0, 0, -1}, .castsShadow = false}};
        scene.camera = {.eye = {0, 0, 40}, .target = {0, 0, 0}, .verticalFov = 0.04F, .nearPlane = 10, .farPlane = 100};
        return render(renderer, scene, 64,
                      {{"msaa", {passes::SettingValue::Type::Enum, msaa[0] == '1' ? 0U : 1U, msaa}}});
    }
    double coverage(const char* mode, int alpha, const Values& more = {}, const char* msaa = "4") const {
        Values values = {{"blending.mode", mode}, {"surface.opacityMap", png(255, 255, 255, alpha)}};
        values.insert(values.end(), more.begin(), more.end());
        return coveredFraction(pictureOf(material("kajiya_brown", values), msaa));
    }
};

TEST_F(Texels, OpaqueCoversWhateverTheAlpha) {
    for (const int alpha : {0, 100, 255}) EXPECT_EQ(coverage("opaque", alpha), 1.0) << alpha;
}

// The whole card from the threshold on, nothing of it below: to half a step of 8 bits.
TEST_F(Texels, AlphaTestHasItsThresholdAsStated) {
    for (const char* mode : {"alphaTest", "alphaToCoverage"}) {
        for (const char* msaa : {"1", "4"}) {
            for (const int alpha : {26, 90, 128, 200}) {
                const double a = alpha / 255.0;
                const auto at = [&](double threshold) {
                    return coverage(mode, alpha, {{"blending.threshold", std::to_string(threshold)}}, msaa);
                };
                EXPECT_EQ(at(a - 0.5 / 255), 1.0) << mode << ", alpha " << alpha << "/255, msaa " << msaa;
                EXPECT_EQ(at(a + 0.5 / 255), 0.0) << mode << ", alpha " << alpha << "/255, msaa " << msaa;
            }
        }
    }
}

// Blended coverage is the alpha; hashed coverage is so in the mean of 64 x 64 pixels, whose deviation is below 0.008.
TEST_F(Texels, BlendAndHashCoverByTheirAlpha) {
    for (const int alpha : {0, 51, 102, 153, 204, 255}) {
        const double a = alpha / 255.0;
        EXPECT_NEAR(coverage("alphaBlend", alpha), a, 1e-3) << alpha;
        EXPECT_NEAR(coverage("hashedAlpha", alpha), a, 0.025) << alpha;
        EXPECT_NEAR(coverage("hashedAlpha", alpha, {}, "1"), a, 0.025) << alpha << ", one sample";
    }
}

// IEC 61966-2-1.
double decoded(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

// A colour map is decoded from sRGB, once: radiance is proportional to the scene-linear texel.
TEST_F(Texels, AColourMapIsDecodedFromSrgb) {
    for (const char* preset : {"kajiya_brown", "pbr_brown"}) {
        Values values = {{"blending.mode", "opaque"},      {"environment.enable", "false"},
                         {"globalScattering.mode", "off"}, {"surface.useStrandId", "false"},
                         {"surface.baseColor", "#ffffff"}, {"surface.useColorMap", "true"},
                         {"shadowing.mode", "off"}};
        if (preset == std::string("kajiya_brown")) {
            values.push_back({"specular.enable", "false"});
        } else {
            values.push_back({"reflection.specularScale", "0"});
        }
        const auto colored = [&](const std::string& map) {
            Values with = values;
            with.push_back({"surface.colorMap", map});
            const hair::Picture picture = pictureOf(material(preset, with));
            const std::size_t middle = (std::size_t{32} * 64 + 32) * 4;
            return glm::dvec3(picture.linear[middle], picture.linear[middle + 1], picture.linear[middle + 2]);
        };
        const glm::dvec3 white = colored(png(255, 255, 255, 255)), color = colored(png(200, 128, 40, 255));
        ASSERT_GT(white.x, 0) << preset;
        EXPECT_NEAR(color.x / white.x, decoded(200 / 255.0), 2e-3) << preset;
        EXPECT_NEAR(color.y / white.y, decoded(128 / 255.0), 2e-3) << preset;
        EXPECT_NEAR(color.z / white.z, decoded(40 / 255.0), 2e-3) << preset;
    }
}

}  // namespace
}  // namespace pelage::test
