// SPDX-License-Identifier: MIT
// One input for each code of scene files, of shipped data by name and of the app that needs no device.
#include "app_fixture.hpp"

namespace pelage::test {

namespace {

class Codes : public App {
protected:
    std::string sceneOf(const std::string& members) const {
        return write("bad.scene.json",
                     R"({ "format": "pelage.scene/1", "objects": [{ "name": "h", "generate": { "kind": "groom",)"
                     R"( "strands": 10 }, "material": "brown" }])" +
                         (members.empty() ? "" : ", " + members) + " }");
    }
    void renderRefuses(const std::string& input, const std::string& code,
                       const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments = {"render", input, "-o", path("out.png"), "--size", "32x32"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        expectRefusal(arguments, "error " + code + ":");
    }
};

TEST_F(Codes, OfSceneFiles) {
    const auto light = [&](const std::string& members) { return sceneOf(R"("lights": [{ )" + members + " }]"); };
    renderRefuses(light(R"("kind": "directional", "direction": [0, 0, 0])"), "S003");
    renderRefuses(light(R"("kind": "point")"), "S004");
    renderRefuses(light(R"("kind": "directional", "direction": [0, -1, 0], "position": [0, 1, 0])"), "S005");
    renderRefuses(light(R"("kind": "directionl", "direction": [0, -1, 0])"), "S008");
    renderRefuses(sceneOf(R"("camera": { "eye": [0, 1, 2], "target": [0, 1, 2] })"), "S006");
    renderRefuses(sceneOf(R"("camera": { "eye": [0, 1, 2], "target": [0, 1, 0], "near": 2, "far": 1 })"), "S007");
}

TEST_F(Codes, OfShippedDataByName) {
    const std::string wrong =
        write("wrong.scene.json", R"({ "format": "pelage.scene/1", "objects": [{ "name": "h", "generate": )"
                                  R"({ "kind": "groom", "strands": 10 }, "material": "brwon" }] })");
    renderRefuses(wrong, "L002");
    renderRefuses(sceneOf(""), "L003", {"--frame", "hair_farme"});
    const std::string typeless =
        write("typeless.material.json", R"({ "format": "pelage.material/1", "type": "nothing.materialtype.json",)"
                                        R"( "typeVersion": 1, "values": {} })");
    const RunResult checked = run({"check", typeless});
    EXPECT_EQ(checked.exitCode, 2);
    EXPECT_NE((checked.out + checked.err).find("L001"), std::string::npos) << checked.out << checked.err;
}

TEST_F(Codes, OfTheCommandLine) {
    renderRefuses(sceneOf(""), "A001", {"--background", "red"});
    renderRefuses("nothing_of_that_name", "A002");
    renderRefuses(sceneOf(""), "A010", {"--environment", write("bad.hdr", "no picture")});
    renderRefuses(sceneOf(""), "A011", {"--environment", "stduio"});
    renderRefuses(sceneOf(""), "A030", {"--device", "no such device"});
    expectRefusal({"render", sceneOf(""), "-o", path("out.jpg"), "--size", "32x32"}, "A021");
    expectRefusal({"gallery", "--only", "no_such_scene", "-o", path("out")}, "A041");
    expectRefusal({"gallery", "--only", "wavy_brown", "-o", write("file", "") + "/out"}, "A042");
    const RunResult checked = run({"check", write("what.txt", "hello")});
    EXPECT_EQ(checked.exitCode, 2);
    EXPECT_NE((checked.out + checked.err).find("A050"), std::string::npos) << checked.out << checked.err;
    expectRefusal({"bench", "--models", "karls"}, "A063");
    expectRefusal({"scatter", "--model", "karls", write("rows.csv", "")}, "A097");
    renderRefuses(sceneOf(""), "S011", {"--setting", "msaa=3"});
    const RunResult published = run({"scatter", "--model", "segment_cdf", "--published", write("none.csv", "")});
    EXPECT_NE(published.err.find("A098"), std::string::npos) << published.err;
}

}  // namespace

}  // namespace pelage::test
