// SPDX-License-Identifier: MIT
// The program with a material type, a shader and a functor of its own: its file is opened and looked at.
#include "app_fixture.hpp"

#include <pelage/hair/load.hpp>

#include <cmath>

namespace pelage::test {
namespace {

class CustomMaterial : public App {
protected:
    hair::Image8 picture(const std::string& name, const std::string& thickness) const {
        const RunResult result = run({"--validation", name, "96", thickness});
        EXPECT_EQ(result.exitCode, 0) << result.err;
        EXPECT_EQ(result.err, "");
        const std::string file = read(path(name));
        auto image = hair::decodeImage(std::as_bytes(std::span(file.data(), file.size())), name, true);
        EXPECT_TRUE(image) << (image ? "" : image.error().text());
        return image ? *image : hair::Image8{};
    }
};

// Mean difference of two pictures over all channels, in 1/255.
double difference(const hair::Image8& a, const hair::Image8& b) {
    if (a.texels.size() != b.texels.size() || a.texels.empty()) return 255;
    double sum = 0;
    for (std::size_t i = 0; i < a.texels.size(); ++i) sum += std::abs(double{1.0 * a.texels[i]} - b.texels[i]);
    return sum / static_cast<double>(a.texels.size());
}

TEST_F(CustomMaterial, IsInThePictureAndItsFunctorTurnsItsColours) {
    const hair::Image8 thin = picture("thin.png", "200"), thick = picture("thick.png", "450");
    ASSERT_EQ(thin.width, 96U);
    ASSERT_EQ(thin.height, 96U);
    ASSERT_EQ(thin.channels, 4U);
    // The tips are petrol: there are pixels where blue and green are well above red.
    std::size_t petrol = 0;
    for (std::size_t i = 0; i < thin.texels.size(); i += 4) {
        const int r = thin.texels[i], g = thin.texels[i + 1], b = thin.texels[i + 2];
        if (g > r + 25 && b > r + 25) ++petrol;
    }
    EXPECT_GT(petrol, 96U * 96U / 40);
    EXPECT_GT(difference(thin, thick), 1.0);
    EXPECT_LT(difference(thin, picture("again.png", "200")), 0.5);
}

TEST_F(CustomMaterial, ABadValueIsOneLine) {
    const RunResult result = run({"a.png", "32", "thick"});
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_EQ(result.errorLines(), 1U);
    EXPECT_NE(result.err.find("V003"), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(path("a.png")));
}

}  // namespace
}  // namespace pelage::test
