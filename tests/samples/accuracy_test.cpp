// SPDX-License-Identifier: MIT
// `pelage accuracy`: the page is written, about every model, and moment_lut is as accurate as it is said to be.
#include "app_fixture.hpp"

#include <filesystem>
#include <sstream>

namespace pelage::test {

namespace {

class Accuracy : public App {};

TEST_F(Accuracy, QuickPageNamesEveryModelAndMissesNoGoal) {
    const RunResult result = run({"accuracy", "--quick", "--no-device", "-o", path("page")});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.err, "");
    const std::string page = read(path("page/accuracy.md"));
    EXPECT_EQ(page.find("# How accurate"), 0U);
    EXPECT_NE(page.find("Written by `pelage accuracy --quick` on no device"), std::string::npos);
    for (const char* id : {"kajiya_kay", "scheuermann", "marschner", "karis", "thesis", "gerard", "chiang", "pxr",
                           "moment_lut", "segment_cdf"}) {
        EXPECT_NE(page.find(std::string("| ") + id + " |"), std::string::npos) << id;
    }
    EXPECT_EQ(page.find("nan"), std::string::npos);
    EXPECT_EQ(page.find("inf |"), std::string::npos);
    std::istringstream lines(page);
    int passed = 0;
    for (std::string line; std::getline(lines, line);) {
        if (line.rfind("| moment_lut |", 0) != 0) continue;
        EXPECT_EQ(line.find("MISS"), std::string::npos) << line;
        if (line.find("| pass |") != std::string::npos) ++passed;
    }
    EXPECT_EQ(passed, 15 + 1 + 4 + 1) << "around the fibre, furnace, rounding, instructions";
    for (const char* plot : {"fitted", "sharp", "grazing", "published"}) {
        EXPECT_TRUE(std::filesystem::exists(path(std::string("page/images/scattering_") + plot + ".svg"))) << plot;
    }
}

TEST_F(Accuracy, DirectoryThatCannotBeMadeIsNamed) {
    const std::string file = write("file", "x");
    const RunResult result = run({"accuracy", "--quick", "--no-device", "-o", file + "/page"});
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_EQ(result.errorLines(), 1U);
    EXPECT_NE(result.err.find("A111"), std::string::npos) << result.err;
}

}  // namespace

}  // namespace pelage::test
