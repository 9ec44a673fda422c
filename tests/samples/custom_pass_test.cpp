// SPDX-License-Identifier: MIT
// The program with a pass class and a pass tree of its own: its picture is opened and looked at.
#include "app_fixture.hpp"

#include <pelage/hair/load.hpp>

namespace pelage::test {
namespace {

class CustomPass : public App {
protected:
    static std::string tree() { return std::string(PELAGE_SOURCE_DIR) + "/samples/custom_pass/outline.pass.json"; }

    hair::Image8 picture(const std::string& name, const std::string& setting) const {
        const RunResult result = run({"--validation", name, "96", tree(), setting});
        EXPECT_EQ(result.exitCode, 0) << result.err;
        EXPECT_EQ(result.err, "");
        const std::string file = read(path(name));
        auto image = hair::decodeImage(std::as_bytes(std::span(file.data(), file.size())), name, true);
        EXPECT_TRUE(image) << (image ? "" : image.error().text());
        EXPECT_EQ(image->width, 96U);
        EXPECT_EQ(image->channels, 4U);
        return image ? *image : hair::Image8{};
    }
    /// Pixels that were light and are nearly black.
    static std::size_t inked(const hair::Image8& before, const hair::Image8& after) {
        std::size_t count = 0;
        for (std::size_t i = 0; i + 3 < before.texels.size(); i += 4)
            count += before.texels[i] > 120 && after.texels[i] < 60 ? 1 : 0;
        return count;
    }
    static std::size_t changed(const hair::Image8& before, const hair::Image8& after) {
        std::size_t count = 0;
        for (std::size_t i = 0; i + 3 < before.texels.size(); i += 4)
            count += before.texels[i] != after.texels[i] ? 1 : 0;
        return count;
    }
};

TEST_F(CustomPass, InksContoursAndNothingElse) {
    const hair::Image8 plain = picture("plain.png", "ink=false"), thin = picture("thin.png", "inkWidth=1"),
                       bold = picture("bold.png", "inkWidth=3");
    EXPECT_GT(inked(plain, thin), 60U) << "the contour of a head is longer";
    EXPECT_GT(changed(plain, bold), changed(plain, thin)) << "wider, more";
    // Far from the hair nothing has changed.
    for (std::size_t x = 0; x < 96; ++x) EXPECT_EQ(plain.texels[4 * x], bold.texels[4 * x]) << x;
}

TEST_F(CustomPass, FaultsOfItsTreeAreOneLineEach) {
    std::string text = read(tree());
    const auto refused = [&](const std::string& from, const std::string& to, const std::string& why) {
        std::string edited = text;
        edited.replace(edited.find(from), from.size(), to);
        const RunResult result = run({"a.png", "32", write("mine.pass.json", edited)});
        EXPECT_EQ(result.exitCode, 2) << why;
        EXPECT_EQ(result.errorLines(), 1U) << result.err;
        EXPECT_NE(result.err.find(why), std::string::npos) << result.err;
    };
    refused("\"class\": \"Outline\"", "\"class\": \"Outlin\"", "P053");
    refused("\"strength\": 0.9", "\"strenght\": 0.9", "P054");
    refused("\"strength\": 0.9", "\"strength\": 9", "P055");
    EXPECT_FALSE(std::filesystem::exists(path("a.png")));
}

}  // namespace
}  // namespace pelage::test
