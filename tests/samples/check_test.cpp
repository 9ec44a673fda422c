// SPDX-License-Identifier: MIT
#include "app_files.hpp"
#include "app_fixture.hpp"

#include <nlohmann/json.hpp>

#include <sstream>

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

// Each line is JSON by itself, with the place, and where the first of two names stood.
TEST_F(Check, JsonIsOneObjectForEachFault) {
    const std::string file = write("twice.scene.json",
                                   "{ \"format\": \"pelage.scene/1\",\n"
                                   "  \"objects\": [],\n"
                                   "  \"exposure\": 1, \"exposure\": 2 }\n");
    const std::string good = std::string(PELAGE_DATA_DIR) + "/passes/templates/hair_frame.pass.json";
    const RunResult result = run({"check", "--json", good, file, path("gone.pass.json")});
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_EQ(result.err, "");
    std::vector<nlohmann::json> found;
    std::istringstream lines(result.out);
    for (std::string line; std::getline(lines, line);) found.push_back(nlohmann::json::parse(line));
    ASSERT_EQ(found.size(), 2U) << result.out;
    EXPECT_EQ(found[0]["file"], file);
    EXPECT_EQ(found[0]["code"], "J004");
    EXPECT_EQ(found[0]["line"], 3);
    EXPECT_EQ(found[0]["column"], 18);
    EXPECT_EQ(found[0]["severity"], "error");
    ASSERT_EQ(found[0]["related"].size(), 1U);
    EXPECT_EQ(found[0]["related"][0], nlohmann::json({{"file", file}, {"line", 3}, {"column", 3}}));
    EXPECT_EQ(found[1]["code"], "F001");
    EXPECT_EQ(found[1]["line"], 0);
    EXPECT_EQ(run({"check", "--json", good}).exitCode, 0);
    EXPECT_EQ(run({"check", "--json", good}).out, "");
}

TEST_F(Check, JsonSaysTheSameAsTheLines) {
    const std::string file = write("bad.pass.json", R"({ "format": "pelage.passtree/1", "nam": 3, "passes": 1 })");
    const RunResult plain = run({"check", file}), json = run({"check", "--json", file});
    EXPECT_EQ(plain.exitCode, json.exitCode);
    std::istringstream lines(plain.err), objects(json.out);
    for (std::string line, object; std::getline(lines, line);) {
        ASSERT_TRUE(std::getline(objects, object)) << line;
        const nlohmann::json read = nlohmann::json::parse(object);
        const std::string text = read["text"];
        EXPECT_NE(line.find(text), std::string::npos) << line;
    }
    EXPECT_TRUE(objects.peek() == std::char_traits<char>::eof());
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
