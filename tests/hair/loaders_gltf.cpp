// SPDX-License-Identifier: MIT
// Cards from glTF: directions, islands, and every fault that tinygltf lets pass.
#include "loaders_files.hpp"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

namespace pelage::hair::testing {
namespace {

Result<Mesh> readWith(const std::function<void(GlbFile&)>& change) {
    GlbFile file;
    change(file);
    return parseGltf(file.bytes(), "x.glb");
}

TEST(Gltf, StrandDirectionIsDownTheTexture) {
    const auto cards = parseGltf(GlbFile().bytes(), "x.glb");
    ASSERT_TRUE(cards) << cards.error().first().text;
    EXPECT_EQ(cards->indices.size(), 12U);
    EXPECT_EQ(cards->islandCount, 1U);
    EXPECT_EQ(cards->colorMap.width, 2U);
    expectSound(*cards);
    for (const Vertex& v : cards->vertices) {
        EXPECT_NEAR(v.tangent.y, -1.0F, 1e-5F);
        EXPECT_NEAR(v.along, -v.position.y / 0.1F, 1e-5F);
    }
}

TEST(Gltf, UpwardTextureIsTurnedRound) {
    GlbFile file;
    for (std::size_t i = 0; i < 6; ++i) poke(file.bin, 72 + 8 * i + 4, 1.0F - 0.5F * static_cast<float>(i / 2));
    const auto cards = parseGltf(file.bytes(), "x.glb");
    ASSERT_TRUE(cards);
    for (const Vertex& v : cards->vertices) {
        EXPECT_NEAR(v.tangent.y, -1.0F, 1e-5F);
        EXPECT_NEAR(v.along, -v.position.y / 0.1F, 1e-5F);
        EXPECT_NEAR(v.uv.y, v.along, 1e-5F);
    }
}

TEST(Gltf, NodeTransformsApplyAlsoNonUniformAndMirrored) {
    const auto cards = readWith([](GlbFile& f) {
        f.json["nodes"] = nlohmann::json::parse(
            R"([{"children": [1], "translation": [1, 2, 3]}, {"mesh": 0, "scale": [-2, 1, 4], "rotation": [0, 0, 0, 1]}])");
    });
    ASSERT_TRUE(cards) << cards.error().first().text;
    EXPECT_FLOAT_EQ(cards->vertices[1].position.x, 1.0F - 0.04F);
    EXPECT_FLOAT_EQ(cards->boundsMax.y, 2.0F);
    expectSound(*cards);
    // Mirroring turns triangles over; the normal computed from them must not.
    EXPECT_NEAR(cards->vertices[0].normal.z, 1.0F, 1e-5F);
}

TEST(Gltf, SeamsDoNotSplitIslandsAndSeparateCardsStaySeparate) {
    GlbFile file;
    file.json["meshes"][0]["primitives"].push_back(file.primitive());  // the same card again: equal edges, one island
    const auto same = parseGltf(file.bytes(), "x.glb");
    ASSERT_TRUE(same);
    EXPECT_EQ(same->islandCount, 1U);
    const auto apart = readWith([](GlbFile& f) {
        f.json["nodes"] = nlohmann::json::parse(R"([{"mesh": 0}, {"mesh": 0, "translation": [1, 0, 0]}])");
        f.json["scenes"][0]["nodes"] = {0, 1};
    });
    ASSERT_TRUE(apart);
    EXPECT_EQ(apart->islandCount, 2U);
    EXPECT_NE(apart->vertices.front().strandId, apart->vertices.back().strandId);
}

TEST(Gltf, StripsFansAndPlainVerticesAreTriangles) {
    const auto strip = readWith([](GlbFile& f) {
        f.primitive()["mode"] = 5;
        f.primitive().erase("indices");
    });
    ASSERT_TRUE(strip);
    EXPECT_EQ(strip->indices.size(), 12U);
    for (const Vertex& v : strip->vertices) EXPECT_NEAR(std::abs(v.normal.z), 1.0F, 1e-5F);
    const auto fan = readWith([](GlbFile& f) { f.primitive()["mode"] = 6; });
    ASSERT_TRUE(fan);
    const auto plain = readWith([](GlbFile& f) { f.primitive().erase("indices"); });
    ASSERT_TRUE(plain);
    EXPECT_EQ(plain->indices.size(), 6U);
}

TEST(Gltf, DegenerateTextureCoordinatesStillGiveUnitDirections) {
    GlbFile file;
    for (std::size_t i = 0; i < 12; ++i) poke(file.bin, 72 + 4 * i, 0.25F);
    const auto cards = parseGltf(file.bytes(), "x.glb");
    ASSERT_TRUE(cards);
    expectSound(*cards);
}

TEST(Gltf, ContainerFaults) {
    expectFault(parseGltf({}, "x"), "G001");
    expectFault(parseGltf(tfxFile(), "x"), "G001");
    const Bytes good = GlbFile().bytes();
    expectFault(parseGltf(std::span(good).first(19), "x"), "G002");
    expectFault(parseGltf(std::span(good).first(good.size() - 4), "x"), "G002");
    const auto with = [&](std::size_t offset, std::uint32_t value) {
        Bytes b = good;
        poke(b, offset, value);
        return parseGltf(b, "x");
    };
    expectFault(with(4, 1), "G001");
    expectFault(with(8, 0xFFFFFFFF), "G002");
    expectFault(with(12, 0xFFFFFFFF), "G002");
    expectFault(with(20, 0x41414141), "G004");
    const std::string deep =
        "{\"asset\":{\"version\":\"2.0\"},\"extras\":" + std::string(200000, '[') + std::string(200000, ']') + "}";
    expectFault(parseGltf(std::as_bytes(std::span(deep)), "x"), "G003");
}

TEST(Gltf, MissingPartsHaveTheirCodes) {
    expectFault(readWith([](GlbFile& f) { f.primitive()["attributes"].erase("POSITION"); }), "G006");
    expectFault(readWith([](GlbFile& f) { f.primitive()["attributes"].erase("TEXCOORD_0"); }), "G007");
    expectFault(readWith([](GlbFile& f) { f.json["nodes"][0].erase("mesh"); }), "G012");
    expectFault(readWith([](GlbFile& f) { f.json["buffers"][0]["uri"] = "away.bin"; }), "G005");
    expectFault(readWith([](GlbFile& f) { f.json["images"][0] = {{"uri", "away.png"}}; }), "G005");
    expectFault(readWith([](GlbFile& f) { f.json["textures"][0]["source"] = 9; }), "G016");
    expectFault(readWith([](GlbFile& f) { f.primitive()["material"] = 9; }), "G016");
}

TEST(Gltf, TextFilesFindTheirBuffersAndImagesBesideThem) {
    namespace fs = std::filesystem;
    const auto tick = std::chrono::steady_clock::now().time_since_epoch().count();
    const fs::path folder = fs::temp_directory_path() / ("pelage-gltf-" + std::to_string(tick));
    fs::create_directory(folder);
    const auto write = [&](const char* name, const void* data, std::size_t size) {
        std::ofstream stream(folder / name, std::ios::binary);
        stream.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
    };
    GlbFile file;
    file.json["buffers"][0]["uri"] = "card.bin";
    file.json["images"][0] = {{"uri", "card.bmp"}};
    const std::string text = file.json.dump();
    const Bytes image = bmpFile();
    write("card.gltf", text.data(), text.size());
    const std::string path = (folder / "card.gltf").string();
    expectFault(loadGltf(path), "G005");
    write("card.bin", file.bin.data(), file.bin.size());
    expectFault(loadGltf(path), "G005");
    write("card.bmp", image.data(), image.size());
    const auto cards = loadGltf(path);
    ASSERT_TRUE(cards) << cards.error().first().text;
    EXPECT_EQ(cards->colorMap.width, 2U);
    EXPECT_TRUE(loadAsset(path));
    write("card.bin", file.bin.data(), file.bin.size() - 1);
    EXPECT_FALSE(loadGltf(path));
    fs::remove_all(folder);
}

TEST(Gltf, AccessorsAreCheckedAgainstTheirBuffers) {
    const auto accessor = [](int index, const char* key, const nlohmann::json& value) {
        return readWith([&](GlbFile& f) { f.json["accessors"][index][key] = value; });
    };
    expectFault(accessor(0, "count", 7), "G008");
    expectFault(accessor(0, "count", 0), "G008");
    expectFault(accessor(0, "count", 0xFFFFFFFFFFFFULL), "G008");
    expectFault(accessor(0, "byteOffset", 4), "G008");
    expectFault(accessor(0, "byteOffset", 0xFFFFFFFFFFFFFFF0ULL), "G008");
    expectFault(accessor(0, "bufferView", 9), "G008");
    expectFault(accessor(1, "count", 5), "G008");
    expectFault(accessor(0, "componentType", 5125), "G009");
    expectFault(accessor(0, "type", "VEC2"), "G009");
    expectFault(accessor(2, "componentType", 5126), "G009");
    const auto view = [](int index, const char* key, const nlohmann::json& value) {
        return readWith([&](GlbFile& f) { f.json["bufferViews"][index][key] = value; });
    };
    expectFault(view(0, "byteOffset", 1000), "G008");
    expectFault(view(0, "byteLength", 0xFFFFFFFFFFFFULL), "G008");
    expectFault(view(0, "buffer", 3), "G008");
    expectFault(view(0, "byteStride", 8), "G008");
    expectFault(view(0, "byteStride", 16), "G008");
    expectFault(view(3, "byteLength", 100000), "G008");
    expectFault(readWith([](GlbFile& f) { f.primitive()["attributes"]["POSITION"] = 77; }), "G008");
    expectFault(
        readWith([](GlbFile& f) {
            f.json["accessors"][0]["sparse"] = nlohmann::json::parse(
                R"({"count": 1, "indices": {"bufferView": 2, "componentType": 5123}, "values": {"bufferView": 0}})");
        }),
        "G017");
}

TEST(Gltf, ContentFaults) {
    expectFault(readWith([](GlbFile& f) { poke(f.bin, 120, std::uint16_t{6}); }), "G010");
    expectFault(readWith([](GlbFile& f) { f.primitive()["mode"] = 1; }), "G011");
    expectFault(readWith([](GlbFile& f) { f.primitive()["mode"] = 0; }), "G011");
    expectFault(readWith([](GlbFile& f) { poke(f.bin, 0, std::numeric_limits<float>::quiet_NaN()); }), "G014");
    expectFault(readWith([](GlbFile& f) { f.json["nodes"][0]["children"] = {0}; }), "G015");
    expectFault(readWith([](GlbFile& f) { f.json["nodes"][0]["children"] = {5}; }), "G015");
    expectFault(readWith([](GlbFile& f) { f.json["nodes"][0]["mesh"] = 5; }), "G015");
    expectFault(readWith([](GlbFile& f) { f.json["nodes"][0]["matrix"] = {1, 2, 3}; }), "G015");
    expectFault(readWith([](GlbFile& f) { f.json["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }), "G017");
    expectFault(readWith([](GlbFile& f) { poke(f.bin, 144, 'X'); }), "I002");
}

TEST(Gltf, DamageNeverCrashes) {
    damage(GlbFile().bytes(), 4000, [](auto bytes) {
        if (const auto cards = parseGltf(bytes, "x")) expectSound(*cards);
    });
}

TEST(Image, DecodesAndRefusesWithCodes) {
    const auto image = decodeImage(bmpFile(), "x.bmp", true);
    ASSERT_TRUE(image);
    EXPECT_EQ(image->channels, 4U);
    EXPECT_EQ(image->texels.size(), 16U);
    EXPECT_TRUE(image->srgb);
    expectFault(decodeImage({}, "x", true), "I001");
    expectFault(decodeImage(Bytes(500, std::byte{7}), "x", true), "I002");
    Bytes wide = bmpFile();
    poke(wide, 18, std::uint32_t{20000});
    const auto tooWide = decodeImage(wide, "x", true);
    ASSERT_FALSE(tooWide);
    EXPECT_TRUE(tooWide.error().first().code == "I003" || tooWide.error().first().code == "I002")
        << tooWide.error().first().code;
    Bytes hollow = bmpFile();
    poke(hollow, 18, std::uint32_t{16384});
    poke(hollow, 22, std::uint32_t{16384});
    expectFault(decodeImage(hollow, "x", true), "I004");
    // A JPEG whose Huffman table has 258 codes, which stb_image would write past its 257 places.
    std::vector<std::byte> table{std::byte{0xFF}, std::byte{0xD8}, std::byte{0xFF}, std::byte{0xC4}, std::byte{0xFF}};
    table.resize(22);
    table[20] = std::byte{0xFF};
    table[21] = std::byte{0x03};
    expectFault(decodeImage(table, "x", true), "I005");
}

TEST(Image, DamageNeverCrashes) {
    damage(bmpFile(), 3000, [](auto bytes) {
        if (const auto image = decodeImage(bytes, "x", true)) {
            ASSERT_EQ(image->texels.size(), std::size_t{image->width} * image->height * image->channels);
        }
    });
}

class RealCards : public ::testing::TestWithParam<const char*> {};

TEST_P(RealCards, LoadWithDirectionsThatHang) {
    const char* folder = std::getenv("PELAGE_ASSETS");
    if (folder == nullptr) GTEST_SKIP() << "PELAGE_ASSETS does not name the folder of real assets";
    const std::string path = std::string(folder) + "/cards/" + GetParam() + ".glb";
    const auto cards = loadGltf(path);
    ASSERT_TRUE(cards) << cards.error().first().text;
    expectSound(*cards);
    EXPECT_GT(cards->islandCount, 10U);
    EXPECT_EQ(cards->colorMap.width, 512U);
    float down = 0;
    for (const Vertex& v : cards->vertices) down -= v.tangent.y;
    EXPECT_GT(down / static_cast<float>(cards->vertices.size()), 0.5F);
}

TEST_P(RealCards, DamageNeverCrashes) {
    const char* folder = std::getenv("PELAGE_ASSETS");
    if (folder == nullptr) GTEST_SKIP() << "PELAGE_ASSETS does not name the folder of real assets";
    const auto bytes = readFile(std::string(folder) + "/cards/" + GetParam() + ".glb");
    ASSERT_TRUE(bytes);
    // Changes where they hurt: the JSON at the front and the image at the back.
    std::minstd_rand random(7);
    for (int round = 0; round < 40; ++round) {
        Bytes b = *bytes;
        for (int flip = 0; flip < 3; ++flip) b[random() % 3000] = static_cast<std::byte>(random());
        b[b.size() - 1 - random() % 100000] = static_cast<std::byte>(random());
        if (const auto cards = parseGltf(b, "x")) expectSound(*cards);
    }
}

INSTANTIATE_TEST_SUITE_P(All, RealCards, ::testing::Values("bob01", "long01", "ponytail01"),
                         [](const auto& file) { return std::string(file.param); });

}  // namespace
}  // namespace pelage::hair::testing
