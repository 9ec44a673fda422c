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
        for (const auto& entry : fs::directory_iterator(fs::path(PELAGE_SOURCE_DIR) / directory)) {
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
    expectClean(shipped("hair/data/types", ".materialtype.json"));
}
TEST_F(Check, ShippedMaterialsAreClean) {
    expectClean(shipped("hair/data/presets", ".material.json"));
}
TEST_F(Check, ShippedPassTreesAreClean) {
    expectClean(shipped("hair/data/frames", ".pass.json"));
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

// The shipped type with one draw list renamed; a tree among the files that has it makes it right.
TEST_F(Check, ADrawListThatNoTreeHasIsNamed) {
    std::string type = read(std::string(PELAGE_SOURCE_DIR) + "/hair/data/types/hair.materialtype.json");
    type.replace(type.find("\"drawList\": \"shadow\""), 20, "\"drawList\": \"shadows\"");
    const std::string file = write("mine.materialtype.json", type);
    const RunResult warned = run({"check", file});
    EXPECT_EQ(warned.exitCode, 0) << "a warning";
    EXPECT_NE(warned.err.find("warning M017: shader 'shadow': the pass tree has no draw list 'shadows'"),
              std::string::npos)
        << warned.err;
    EXPECT_NE(warned.err.find("did you mean 'shadow'?"), std::string::npos) << warned.err;
    std::string tree = read(std::string(PELAGE_SOURCE_DIR) + "/hair/data/frames/hair_frame.pass.json");
    tree.replace(tree.find("\"shadow\", \"depth\""), 8, "\"shadows\"");
    tree.replace(tree.find("\"drawList\": \"shadow\""), 20, "\"drawList\": \"shadows\"");
    const RunResult clean = run({"check", file, write("mine.pass.json", tree)});
    EXPECT_EQ(clean.exitCode, 0);
    EXPECT_EQ(clean.err, "");
    const std::string material = write("mine.material.json",
                                       R"({ "format": "pelage.material/1", "type": "mine.materialtype.json",
                                            "typeVersion": 4, "values": {} })");
    EXPECT_EQ(run({"check", material}).errorLines(), 1U);
    write("a.hair", hairFile(8, 4));
    const std::string scene = write("mine.scene.json", R"({ "format": "pelage.scene/1", "objects": [
        { "name": "hair", "asset": "a.hair", "material": "mine.material.json" } ] })");
    const RunResult drawn = run({"check", scene});
    EXPECT_EQ(drawn.exitCode, 0);
    EXPECT_NE(drawn.err.find("mine.materialtype.json"), std::string::npos) << drawn.err;
    EXPECT_NE(drawn.err.find("M017"), std::string::npos) << drawn.err;
}

TEST_F(Check, MigrateRewritesOlderMaterialsAndLeavesOthersAlone) {
    const std::string old = write("old.material.json",
                                  "{ \"format\": \"pelage.material/1\", \"type\": \"hair.materialtype.json\",\n"
                                  "  \"typeVersion\": 1, // then\n"
                                  "  \"values\": { \"scattering.roughness\": 0.3 } }\n");
    const RunResult first = run({"migrate", old});
    EXPECT_EQ(first.exitCode, 0) << first.err;
    EXPECT_EQ(first.errorLines(), 1U) << "V007: " << first.err;
    EXPECT_EQ(read(old),
              "{\n    \"format\": \"pelage.material/1\",\n    \"type\": \"hair.materialtype.json\",\n"
              "    \"typeVersion\": 4,\n    \"values\": {\n        \"scattering.longitudinalRoughness\": 0.3,\n"
              "        \"shadowing.mode\": \"pcf\",\n        \"scattering.model\": \"thesis\"\n    }\n}\n");
    const std::string after = read(old);
    const RunResult second = run({"migrate", old});
    EXPECT_EQ(second.exitCode, 0);
    EXPECT_NE(second.out.find("version 4 already"), std::string::npos) << second.out;
    EXPECT_EQ(read(old), after);
    const std::string bad = write("bad.material.json", "{}");
    EXPECT_EQ(run({"migrate", bad, old}).exitCode, 2);
    EXPECT_EQ(read(bad), "{}");
    EXPECT_EQ(run({"check", old}).err, "");
}

// A preset may be the parent of a material that lies anywhere.
TEST_F(Check, ParentsAreFoundBesideTheFileAndAmongThePresets) {
    const auto material = [](const std::string& parent) {
        return "{ \"format\": \"pelage.material/1\", \"type\": \"hair.materialtype.json\", \"typeVersion\": 4,\n"
               "\"parent\": \"" +
               parent + "\", \"values\": {} }";
    };
    EXPECT_EQ(run({"check", write("child.material.json", material("brown.material.json"))}).err, "");
    const RunResult gone = run({"check", write("orphan.material.json", material("browne.material.json"))});
    EXPECT_EQ(gone.exitCode, 2);
    EXPECT_NE(gone.err.find("orphan.material.json:2:11: error V012"), std::string::npos) << gone.err;
    write("browne.material.json", material("child.material.json"));
    EXPECT_EQ(run({"check", path("orphan.material.json")}).err, "");
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
    const std::string good = std::string(PELAGE_SOURCE_DIR) + "/hair/data/frames/hair_frame.pass.json";
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
