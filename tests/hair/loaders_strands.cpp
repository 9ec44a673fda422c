// SPDX-License-Identifier: MIT
// .tfx and .hair: what is read, and what is said about every kind of damage.
#include "loaders_files.hpp"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

namespace pelage::hair::testing {
namespace {

/// Writes `bytes` under a name of its own and removes it afterwards.
class TemporaryFile {
public:
    TemporaryFile(const Bytes& bytes, const std::string& ending) {
        static int count = 0;
        const auto tick = std::chrono::steady_clock::now().time_since_epoch().count();
        path_ = (std::filesystem::temp_directory_path() /
                 ("pelage-" + std::to_string(tick) + "-" + std::to_string(++count) + ending))
                    .string();
        std::ofstream stream(path_, std::ios::binary);
        stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }
    ~TemporaryFile() { std::filesystem::remove(path_); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    const std::string& path() const { return path_; }

private:
    std::string path_;
};

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t kFirstPoint = 160;  // bytes

TEST(Tfx, ReadsStrandsAndPoints) {
    const auto groom = parseTfx(tfxFile(4, 5), "x.tfx");
    ASSERT_TRUE(groom);
    EXPECT_EQ(groom->strandCount(), 4U);
    EXPECT_EQ(groom->points.size(), 20U);
    EXPECT_FLOAT_EQ(groom->points[19].y, 0.92F);
    expectSound(*groom);
}

TEST(Tfx, EveryFaultHasItsCode) {
    expectFault(parseTfx({}, "x"), "T001");
    expectFault(parseTfx(Bytes(159), "x"), "T001");
    const auto with = [](std::size_t offset, auto value) {
        Bytes b = tfxFile();
        poke(b, offset, value);
        return parseTfx(b, "x");
    };
    expectFault(with(0, 3.0F), "T002");
    expectFault(with(0, kNan), "T002");
    expectFault(with(4, std::uint32_t{0}), "T003");
    expectFault(with(8, std::uint32_t{1}), "T003");
    expectFault(with(8, std::uint32_t{0}), "T003");
    expectFault(with(4, std::uint32_t{5}), "T004");
    expectFault(with(4, std::uint32_t{0xFFFFFFFF}), "T004");
    expectFault(with(12, std::uint32_t{0xFFFFFFF0}), "T004");
    expectFault(with(12, std::uint32_t{159}), "T005");
    Bytes cut = tfxFile();
    cut.pop_back();
    expectFault(parseTfx(cut, "x"), "T004");
    Bytes overflow = tfxFile();  // 2^31 strands of 2^31 points: 2^66 bytes
    poke(overflow, 4, std::uint32_t{1U << 31});
    poke(overflow, 8, std::uint32_t{1U << 31});
    expectFault(parseTfx(overflow, "x"), "T004");
}

TEST(Tfx, StrandsWithBadPointsAreDroppedAndCounted) {
    Bytes b = tfxFile(4, 5);
    poke(b, kFirstPoint, kNan);
    poke(b, kFirstPoint + 2 * 5 * 16 + 4, std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < 5; ++i) poke(b, kFirstPoint + (3 * 5 + i) * 16 + 4, 1.0F);  // no length
    const TemporaryFile file(b, ".tfx");
    const auto asset = loadAsset(file.path());
    ASSERT_TRUE(asset);
    EXPECT_EQ(std::get<Strands>(asset->asset).strandCount(), 1U);
    const std::string notes = asset->notes.text();
    EXPECT_NE(notes.find("T101"), std::string::npos);
    EXPECT_NE(notes.find("2 of 4 strands"), std::string::npos) << notes;
    EXPECT_NE(notes.find("T103"), std::string::npos);
    EXPECT_FALSE(asset->notes.hasErrors());
}

TEST(Tfx, OnlyBadStrandsAreAnError) {
    Bytes b = tfxFile(2, 3);
    for (std::size_t at = kFirstPoint; at < b.size(); at += 48) poke(b, at, kNan);
    expectFault(parseTfx(b, "x"), "T006");
}

TEST(Tfx, RepeatedPointsAreMerged) {
    Bytes b = tfxFile(1, 5);
    poke(b, kFirstPoint + 16 * 2 + 4, 0.98F);  // point 2 on point 1
    const auto groom = parseTfx(b, "x");
    ASSERT_TRUE(groom);
    EXPECT_EQ(groom->points.size(), 4U);
    expectSound(*groom);
}

TEST(Tfx, DamageNeverCrashes) {
    damage(tfxFile(), 4000, [](auto bytes) {
        if (const auto groom = parseTfx(bytes, "x")) expectSound(*groom);
    });
}

TEST(HairFile, RoundTripIsExact) {
    const Strands groom = sampleGroom();
    const auto read = parseHair(encodeHair(groom), "x.hair");
    ASSERT_TRUE(read);
    EXPECT_EQ(read->points, groom.points);
    EXPECT_EQ(read->first, groom.first);
    EXPECT_EQ(read->widths, groom.widths);
    EXPECT_EQ(read->width, groom.width);
}

TEST(HairFile, DefaultSegmentsServeWhereThereAreNone) {
    Bytes b;
    for (const char c : {'H', 'A', 'I', 'R'}) append(b, c);
    for (const std::uint32_t x : {2U, 6U, 2U, 2U}) append(b, x);
    b.resize(128);
    for (int i = 0; i < 18; ++i) append(b, 0.1F * static_cast<float>(i));
    const auto groom = parseHair(b, "x");
    ASSERT_TRUE(groom);
    EXPECT_EQ(groom->strandCount(), 2U);
    EXPECT_EQ(groom->first[1], 3U);
}

TEST(HairFile, EveryFaultHasItsCode) {
    expectFault(parseHair({}, "x"), "H001");
    expectFault(parseHair(Bytes(127), "x"), "H001");
    const Bytes good = encodeHair(sampleGroom());
    const auto with = [&](std::size_t offset, auto value) {
        Bytes b = good;
        poke(b, offset, value);
        return parseHair(b, "x");
    };
    expectFault(with(0, 'h'), "H002");
    expectFault(with(12, std::uint32_t{5}), "H003");
    expectFault(with(4, std::uint32_t{0}), "H003");
    expectFault(with(8, std::uint32_t{0}), "H003");
    expectFault(with(8, std::uint32_t{0xFFFFFFFF}), "H004");
    expectFault(with(4, std::uint32_t{0xFFFFFFFF}), "H004");
    expectFault(with(12, std::uint32_t{31}), "H004");
    expectFault(with(128, std::uint16_t{7}), "H005");
    Bytes cut = good;
    cut.resize(cut.size() - 1);
    expectFault(parseHair(cut, "x"), "H004");
}

TEST(HairFile, StrandsOfOnePointAreDroppedAndCounted) {
    Strands groom = sampleGroom();
    groom.points.push_back({5, 5, 5});
    groom.widths.push_back(1e-4F);
    groom.first.push_back(static_cast<std::uint32_t>(groom.points.size()));
    const TemporaryFile file(encodeHair(groom), ".hair");
    const auto asset = loadAsset(file.path());
    ASSERT_TRUE(asset);
    EXPECT_EQ(std::get<Strands>(asset->asset).strandCount(), 5U);
    EXPECT_NE(asset->notes.text().find("H102"), std::string::npos);
    Strands single;
    single.points = {{0, 0, 0}};
    single.first = {0, 1};
    expectFault(parseHair(encodeHair(single), "x"), "H006");
}

TEST(HairFile, DamageNeverCrashes) {
    damage(encodeHair(sampleGroom()), 4000, [](auto bytes) {
        if (const auto groom = parseHair(bytes, "x")) expectSound(*groom);
    });
}

TEST(Assets, CentimetresBecomeMetresAndAreNoted) {
    Strands groom = sampleGroom();
    for (glm::vec3& p : groom.points) p *= 300.0F;
    const TemporaryFile file(encodeHair(groom), ".hair");
    const auto asset = loadAsset(file.path());
    ASSERT_TRUE(asset);
    EXPECT_NEAR(std::get<Strands>(asset->asset).points[0].y, 3.0F, 1e-4F);
    EXPECT_NE(asset->notes.text().find("A101"), std::string::npos);
    EXPECT_NE(asset->notes.text().find("0.01"), std::string::npos);
    EXPECT_NE(describe(*asset, file.path()).find("strands   5"), std::string::npos);
}

TEST(Assets, FilesThatCannotBeReadHaveTheirCodes) {
    expectFault(loadAsset("no/such/file.glb"), "F001");
    expectFault(loadAsset(std::filesystem::temp_directory_path().string() + "/."), "A001");
    expectFault(loadAsset("hair.obj"), "A001");
    for (const char* ending : {".glb", ".gltf", ".tfx", ".hair"}) {
        const TemporaryFile empty({}, ending);
        expectFault(loadAsset(empty.path()), "F003");
    }
    const TemporaryFile large(Bytes(100), ".tfx");
    expectFault(readFile(large.path(), 99), "F002");
    expectFault(readFile(std::filesystem::temp_directory_path().string()), "F001");
}

TEST(Assets, RealGroomIsRead) {
    const char* folder = std::getenv("PELAGE_ASSETS");
    if (folder == nullptr) GTEST_SKIP() << "PELAGE_ASSETS does not name the folder of real assets";
    const std::string path = std::string(folder) + "/strands/ratboy/Ratboy_mohawk.tfx";
    const auto asset = loadAsset(path);
    ASSERT_TRUE(asset) << asset.error().first().text;
    const Strands& groom = std::get<Strands>(asset->asset);
    EXPECT_EQ(groom.strandCount(), 2228U);
    expectSound(groom);
}

}  // namespace
}  // namespace pelage::hair::testing
