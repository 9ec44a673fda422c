// SPDX-License-Identifier: MIT
#include "app_files.hpp"
#include "app_fixture.hpp"

namespace pelage::test {

namespace {

namespace fs = std::filesystem;

class Check : public App {
protected:
    static std::vector<std::string> shipped(const char* directory, const std::string& ending) {
        std::vector<std::string> files;
        for (const auto& entry : fs::directory_iterator(fs::path(PELAGE_DATA_DIR) / directory)) {
            if (entry.path().string().ends_with(ending)) files.push_back(entry.path().string());
        }
        return files;
    }
    void expectClean(const std::vector<std::string>& files) const {
        ASSERT_FALSE(files.empty());
        std::vector<std::string> arguments{"check"};
        arguments.insert(arguments.end(), files.begin(), files.end());
        const RunResult result = run(arguments);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        EXPECT_EQ(result.err, "");
    }
};

TEST_F(Check, ShippedMaterialTypesAreClean) {
    expectClean(shipped("materials/types", ".materialtype.json"));
}
TEST_F(Check, ShippedMaterialsAreClean) {
    expectClean(shipped("materials/presets", ".material.json"));
}
TEST_F(Check, ShippedPassTreesAreClean) {
    expectClean(shipped("passes/templates", ".pass.json"));
}
TEST_F(Check, ShippedScenesAreClean) {
    expectClean(shipped("samples/scenes", ".scene.json"));
}

TEST_F(Check, EveryFaultIsOneLine) {
    const std::string file = write("bad.scene.json",
                                   "{ \"format\": \"pelage.scene/1\",\n"
                                   "  \"objects\": [{ \"name\": 3, \"material\": \"brown\" }],\n"
                                   "  \"exposre\": 1,\n"
                                   "  \"background\": [0, 0] }\n");
    const RunResult result = run({"check", file});
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_EQ(result.errorLines(), 3U) << result.err;
    EXPECT_NE(result.err.find("bad.scene.json:3:3"), std::string::npos) << result.err;
}

TEST_F(Check, ExitCodes) {
    EXPECT_EQ(run({"check", path("gone.pass.json")}).exitCode, 2);
    EXPECT_EQ(run({"check", write("what.json", "{}")}).exitCode, 2);
    EXPECT_EQ(run({"check", write("bad.pass.json", "{}")}).exitCode, 2);
    EXPECT_EQ(run({"check", write("bad.material.json", "{}")}).exitCode, 2);
    EXPECT_EQ(run({"check", write("bad.materialtype.json", "{}")}).exitCode, 2);
}

TEST_F(Check, InfoDescribesHair) {
    const RunResult strands = run({"info", write("a.hair", hairFile(8, 4))});
    EXPECT_EQ(strands.exitCode, 0) << strands.err;
    EXPECT_NE(strands.out.find("8"), std::string::npos) << strands.out;
    const RunResult cards = run({"info", write("a.glb", glbFile())});
    EXPECT_EQ(cards.exitCode, 0) << cards.err;
}

}  // namespace

}  // namespace pelage::test
