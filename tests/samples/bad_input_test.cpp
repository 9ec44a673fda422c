// SPDX-License-Identifier: MIT
// Whatever is wrong with an input, the answer is one line on stderr, exit code 2 and no file.
#include "app_files.hpp"
#include "app_fixture.hpp"

namespace pelage::test {

namespace {

class BadInput : public App {
protected:
    void refuses(const std::string& file, const std::string& part) const {
        expectRefusal({"render", file, "-o", path("out.png"), "--size", "32x32"}, part);
    }
    std::string scene(const std::string& members) const {
        return write("bad.scene.json", "{ \"format\": \"pelage.scene/1\",\n" + members + "}\n");
    }
    static constexpr const char* groom =
        R"("objects": [{ "name": "h", "generate": { "kind": "groom", "strands": 10 }, "material": "brown" }])";
};

TEST_F(BadInput, MissingFile) {
    refuses(path("nothing.glb"), "nothing.glb");
    refuses(path("nothing.hair"), "nothing.hair");
    refuses(path("nothing.tfx"), "nothing.tfx");
    refuses(path("nothing.scene.json"), "nothing.scene.json");
    refuses("nothing_of_that_name", "nothing_of_that_name");
}

TEST_F(BadInput, EndingOfNoReader) {
    refuses(write("model.obj", "v 0 0 0\n"), "model.obj");
}

TEST_F(BadInput, CutOffFiles) {
    const std::string hair = hairFile(8, 4), tfx = tfxFile(8, 4), glb = glbFile();
    for (const double part : {0.0, 0.01, 0.3, 0.9}) {
        const auto cut = [&](const std::string& whole) {
            return whole.substr(0, static_cast<std::size_t>(static_cast<double>(whole.size()) * part));
        };
        refuses(write("cut.hair", cut(hair)), "cut.hair");
        refuses(write("cut.tfx", cut(tfx)), "cut.tfx");
        refuses(write("cut.glb", cut(glb)), "cut.glb");
    }
}

TEST_F(BadInput, GltfWithoutPositions) {
    refuses(write("bare.glb", glbFile({.positions = false})), "POSITION");
}
TEST_F(BadInput, GltfWithoutUvs) {
    refuses(write("bare.glb", glbFile({.uvs = false})), "TEXCOORD_0");
}
TEST_F(BadInput, GltfWithATextureThatDoesNotDecode) {
    refuses(write("bad.glb", glbFile({.image = "this is no picture"})), "bad.glb");
}

TEST_F(BadInput, HeadersThatPromiseMore) {
    refuses(write("big.hair", hairFile(4, 4, 4'000'000)), "big.hair");
    refuses(write("huge.hair", hairFile(4, 4, 0xffffffffU)), "huge.hair");
    refuses(write("big.tfx", tfxFile(4, 4, 4'000'000)), "big.tfx");
    refuses(write("huge.tfx", tfxFile(4, 4, 0xffffffffU)), "huge.tfx");
}

TEST_F(BadInput, PointsThatAreNoNumbers) {
    refuses(write("nan.hair", hairFile(4, 4, 0, true)), "nan.hair");
    refuses(write("nan.tfx", tfxFile(4, 4, 0, true)), "nan.tfx");
    refuses(write("nan.glb", glbFile({.notANumber = true})), "nan.glb");
}

TEST_F(BadInput, StrandsOfNoneOrOnePoint) {
    refuses(write("none.hair", hairFile(4, 0)), "none.hair");
    refuses(write("one.hair", hairFile(4, 1)), "one.hair");
    refuses(write("none.tfx", tfxFile(4, 0)), "none.tfx");
    refuses(write("one.tfx", tfxFile(4, 1)), "one.tfx");
    refuses(write("empty.hair", hairFile(0, 4)), "empty.hair");
}

TEST_F(BadInput, SceneWithATypo) {
    refuses(scene("\"objectz\": []"), "objectz");
    refuses(scene(std::string(groom) + ",\n\"exposure\": \"bright\""), "exposure");
    refuses(write("bad.scene.json", "{ \"format\": \"pelage.scene/1\", "), "bad.scene.json:1");
}

TEST_F(BadInput, SceneNamesPlaceAndNearestName) {
    refuses(scene(std::string(groom) + ",\n\"bakground\": [0, 0, 0]"), "bad.scene.json:3:1");
    refuses(scene(std::string(groom) + ",\n\"bakground\": [0, 0, 0]"), "background");
}

TEST_F(BadInput, SceneWithoutSource) {
    refuses(scene(R"("objects": [{ "name": "h", "material": "brown" }])"), "neither");
    refuses(scene(R"("objects": [{ "name": "h", "asset": "gone.hair" }])"), "gone.hair");
}

TEST_F(BadInput, UnknownMaterialAndProperty) {
    const std::string file = write("good.hair", hairFile(8, 4));
    expectRefusal({"render", file, "-o", path("out.png"), "--material", "brwon"}, "brown");
    expectRefusal({"render", file, "-o", path("out.png"), "--set", "scattering.nothing=1"}, "scattering.nothing");
    expectRefusal({"render", file, "-o", path("out.png"), "--set", "blending.mode=sideways"}, "sideways");
    expectRefusal({"render", file, "-o", path("out.png"), "--set", "no equals sign"}, "NAME=VALUE");
}

TEST_F(BadInput, UnknownSettingAndPass) {
    const std::string file = write("good.hair", hairFile(8, 4));
    expectRefusal({"render", file, "-o", path("out.png"), "--setting", "msa=4"}, "msaa");
    expectRefusal({"render", file, "-o", path("out.png"), "--setting", "msaa=3"}, "msaa");
    expectRefusal({"render", file, "-o", path("out.png"), "--frame", "no_such_tree"}, "no_such_tree");
    std::string tree = read(std::string(PELAGE_SOURCE_DIR) + "/hair/data/frames/hair_frame.pass.json");
    const std::size_t at = tree.find("\"Resolve.color\"");
    ASSERT_NE(at, std::string::npos);
    tree.replace(at, 15, "\"Resolvee.color\"");
    expectRefusal({"render", file, "-o", path("out.png"), "--frame", write("bad.pass.json", tree)}, "Resolve");
}

TEST_F(BadInput, UnknownDevice) {
    const std::string file = write("good.hair", hairFile(8, 4));
    expectRefusal({"render", file, "-o", path("out.png"), "--device", "no such device"}, "no such device");
}

TEST_F(BadInput, OutputThatCannotBe) {
    const std::string file = write("good.hair", hairFile(8, 4));
    expectRefusal({"render", file, "-o", path("picture.jpg")}, "picture.jpg");
    expectRefusal({"render", file, "-o", path("no/such/directory/out.png")}, "directory");
}

TEST_F(BadInput, Options) {
    const std::string file = write("good.hair", hairFile(8, 4));
    for (const char* size : {"0x0", "12", "axb", "-3x4", "999999x4", "12x"}) {
        expectRefusal({"render", file, "-o", path("out.png"), "--size", size}, "--size");
    }
    for (const char* camera : {"1,2,3", "0,0,0;0,0,0", "a;b", "0,0,1;0,0,0;nan", "0,0,1;0,0,0;500"}) {
        expectRefusal({"render", file, "-o", path("out.png"), "--camera", camera}, "--camera");
    }
    expectRefusal({"render", file, "-o", path("out.png"), "--background", "#12345g"}, "--background");
    expectRefusal({"render", file, "-o", path("out.png"), "--environment", "sunny"}, "--environment");
    expectRefusal({"render", file, "-o", path("out.png"), "--environment", write("bad.hdr", "no")}, "bad.hdr");
    expectRefusal({"render", file, "-o", path("out.png"), "--environment", write("bad.exr", "no")}, "bad.exr");
}

TEST_F(BadInput, CommandLine) {
    expectRefusal({"render"}, "input");
    expectRefusal({"rendr", "x"}, "pelage --help");
    expectRefusal({"info", path("nothing.glb")}, "nothing.glb");
    expectRefusal({"gallery", "-o", path("out"), "--only", "no_such_scene"}, "no_such_scene");
}

}  // namespace

}  // namespace pelage::test
