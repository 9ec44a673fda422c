// SPDX-License-Identifier: MIT
// Hair files from outside, rendered with nothing but defaults.
#include "app_files.hpp"
#include "app_fixture.hpp"

namespace pelage::test {

namespace {

class Render : public App {
protected:
    void renders(const std::string& file, const std::vector<std::string>& extra = {}) const {
        std::vector<std::string> arguments{"render", file, "-o", path("a.png"), "-o", path("a.exr"), "--size", "64x48"};
        arguments.insert(arguments.end(), extra.begin(), extra.end());
        const RunResult result = run(arguments);
        ASSERT_EQ(result.exitCode, 0) << result.err;
        EXPECT_EQ(result.err.find("error"), std::string::npos) << result.err;
        const std::string png = read(path("a.png")), exr = read(path("a.exr"));
        EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
        EXPECT_EQ(exr.substr(0, 4), "\x76\x2f\x31\x01");
        // The IHDR chunk: width and height, big-endian.
        ASSERT_GT(png.size(), 24U);
        EXPECT_EQ(png[19], 64);
        EXPECT_EQ(png[23], 48);
        EXPECT_FALSE(std::filesystem::exists(path("a.png.part")));
    }
};

TEST_F(Render, StrandsWithDefaults) {
    renders(write("a.hair", hairFile(40, 6)), {"--validation"});
    renders(write("a.tfx", tfxFile(40, 6)));
}

TEST_F(Render, CardsWithDefaults) {
    renders(write("a.glb", glbFile()), {"--validation"});
}

TEST_F(Render, OptionsAreHeard) {
    renders(write("a.hair", hairFile(40, 6)),
            {"--material", "black", "--set", "scattering.enableR=false", "--set", "blending.mode=opaque", "--setting",
             "msaa=1", "--background", "#ff0000", "--environment", "none", "--exposure", "2", "--camera",
             "0,1.6,0.6;0,1.6,0;30"});
    EXPECT_NE(run({"render", path("a.hair"), "--report", "--size", "32x32"}).out.find("fragments"), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(path("a.png")));
}

TEST_F(Render, ScenesHaveRelativeAssets) {
    write("strands.hair", hairFile(40, 6));
    renders(write("mine.scene.json", R"({ "format": "pelage.scene/1",
        "objects": [{ "name": "hair", "asset": "strands.hair", "material": "brown",
                      "set": { "scattering.longitudinalRoughness": 0.3 },
                      "transform": { "translate": [0, 0.1, 0], "rotate": { "axis": [0, 1, 0], "angle_deg": 30 },
                                     "scale": 1.5 } }],
        "lights": [{ "kind": "point", "position": [0, 2, 1], "intensity": 4 }],
        "environment": { "kind": "uniform", "radiance": [0.2, 0.2, 0.3] },
        "frame": { "settings": { "msaa": "1" } } })"));
}

TEST_F(Render, GraphShowsWhatEachPassCost) {
    write("strands.hair", hairFile(40, 6));
    const std::string scene = write("mine.scene.json", R"({ "format": "pelage.scene/1",
        "objects": [{ "name": "hair", "asset": "strands.hair", "material": "brown" }],
        "lights": [{ "kind": "point", "position": [0, 2, 1], "intensity": 4 }] })");
    const RunResult result =
        run({"graph", "hair_frame", "--measure", scene, "--size", "64x48", "--validation", "-o", path("a.html")});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    const std::string page = read(path("a.html"));
    EXPECT_NE(page.find("Measured on "), std::string::npos);
    EXPECT_NE(page.find("64 x 48"), std::string::npos);
    EXPECT_NE(page.find("share of the GPU"), std::string::npos);
    EXPECT_NE(page.find(" barriers; a device does not count them for each pass"), std::string::npos);
}

TEST_F(Render, APictureThatCannotBeWrittenIsOneLine) {
    const std::string scene = write("p.scene.json", R"({ "format": "pelage.scene/1", "objects": [{ "name": "h",
        "generate": { "kind": "groom", "strands": 10 }, "material": "brown" }] })");
    const std::string blocked = write("file", "") + "/out.png";
    const RunResult result = run({"render", scene, "-o", blocked, "--size", "16x16"});
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_NE(result.err.find("error A020:"), std::string::npos) << result.err;
    EXPECT_EQ(result.errorLines(), 1U) << result.err;
}

TEST_F(Render, SameFileTwiceIsTheSamePicture) {
    const std::string file = write("a.hair", hairFile(40, 6));
    renders(file);
    const std::string first = read(path("a.png"));
    renders(file);
    EXPECT_EQ(read(path("a.png")), first);
}

}  // namespace

}  // namespace pelage::test
