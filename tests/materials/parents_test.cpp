// SPDX-License-Identifier: MIT
// Materials that stand on others, as files in a directory of their own.
#include "support.hpp"

#include <filesystem>

using namespace pelage;
using namespace pelage::materials;
using namespace pelage::materials::test;

namespace {

namespace fs = std::filesystem;

class Parents : public ::testing::Test {
protected:
    void SetUp() override {
        const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
        directory_ = fs::temp_directory_path() / (std::string("pelage_parents_") + test->name());
        fs::remove_all(directory_);
        fs::create_directories(directory_ / "deep");
    }
    void TearDown() override { fs::remove_all(directory_); }

    std::string path(const std::string& name) const { return (directory_ / name).string(); }

    // A material of one value and, perhaps, a parent; "parent" is on line 3, "values" on line 5.
    void write(const std::string& name, const std::string& parent, const std::string& values,
               const std::string& type = "hair", int version = 3) const {
        std::ofstream(path(name)) << "{ \"format\": \"pelage.material/1\",\n  \"type\": \"" << type
                                  << ".materialtype.json\",\n  "
                                  << (parent.empty() ? "" : "\"parent\": \"" + parent + "\",")
                                  << "\n  \"typeVersion\": " << version << ",\n  \"values\": {" << values << "} }\n";
    }

    std::vector<std::string> linesOf(const Result<Material::Parsed>& parsed) const {
        std::vector<std::string> out;
        if (parsed) return out;
        for (Diagnostic each : parsed.error().items()) {
            // Without the directory, which differs from machine to machine.
            const auto strip = [&](std::string& text) {
                const std::string prefix = directory_.string() + "/";
                for (auto at = text.find(prefix); at != std::string::npos; at = text.find(prefix))
                    text.erase(at, prefix.size());
            };
            strip(each.file);
            strip(each.text);
            out.push_back(each.file + ":" + std::to_string(each.line) + ":" + std::to_string(each.column) + " " +
                          each.code + " " + each.text);
        }
        return out;
    }

private:
    fs::path directory_;
};

TEST_F(Parents, TheNearestValueWins) {
    write("grand.material.json", "", R"("scattering.ior": 1.7, "scattering.weightR": 0.2, "scattering.weightTT": 0.3)");
    write("deep/parent.material.json", "../grand.material.json",
          R"("scattering.weightR": 0.4, "scattering.weightTT": 0.5)");
    write("child.material.json", "deep/parent.material.json", R"("scattering.weightTT": 0.6)");
    const auto child = Material::load(path("child.material.json"), shippedSource());
    ASSERT_TRUE(child) << child.error().text();
    EXPECT_EQ(child->material.get("scattering.ior")->number[0], 1.7F);
    EXPECT_EQ(child->material.get("scattering.weightR")->number[0], 0.4F);
    EXPECT_EQ(child->material.get("scattering.weightTT")->number[0], 0.6F);
    const Value* untouched = child->material.get("scattering.weightTRT");
    EXPECT_EQ(*untouched, child->material.type().find("scattering.weightTRT")->defaultValue);
}

TEST_F(Parents, AChainMayBeLongAndItsFilesAreKnown) {
    write("m0.material.json", "", R"("scattering.ior": 1.9)");
    constexpr int depth = 200;
    for (int i = 1; i <= depth; ++i)
        write("m" + std::to_string(i) + ".material.json", "m" + std::to_string(i - 1) + ".material.json", "");
    const auto last = Material::load(path("m200.material.json"), shippedSource());
    ASSERT_TRUE(last) << last.error().text();
    EXPECT_EQ(last->material.get("scattering.ior")->number[0], 1.9F);
    ASSERT_EQ(last->material.files().size(), depth + 1U);
    EXPECT_EQ(last->material.files().front(), path("m200.material.json"));
    EXPECT_EQ(last->material.files().back(), path("m0.material.json"));
    EXPECT_TRUE(Material(shipped("hair")).files().empty());
}

TEST_F(Parents, AnOlderChildReliesOnItsParentAndNotOnVersions) {
    write("base.material.json", "", R"("shadowing.mode": "hard")");
    write("old.material.json", "base.material.json", "", "hair", 1);
    write("root.material.json", "", "", "hair", 1);
    write("young.material.json", "root.material.json", "");
    const auto old = Material::load(path("old.material.json"), shippedSource());
    ASSERT_TRUE(old) << old.error().text();
    EXPECT_EQ(old->material.get("shadowing.mode")->text, "hard");
    const auto young = Material::load(path("young.material.json"), shippedSource());
    ASSERT_TRUE(young) << young.error().text();
    EXPECT_EQ(young->material.get("shadowing.mode")->text, "pcf") << "setValue of version 2 holds for the root";
}

TEST_F(Parents, ACircleIsNamedAtEachOfItsPlaces) {
    write("a.material.json", "b.material.json", "");
    write("b.material.json", "./c.material.json", "");
    write("c.material.json", "deep/../b.material.json", "");
    const auto lines = linesOf(Material::load(path("a.material.json"), shippedSource()));
    ASSERT_EQ(lines.size(), 2U) << lines.front();
    EXPECT_EQ(
        lines[0],
        "b.material.json:3:13 V012 parents form a circle: b.material.json -> ./c.material.json -> b.material.json");
    EXPECT_EQ(lines[1].substr(0, 29), "./c.material.json:3:13 V012 p");
    write("self.material.json", "self.material.json", "");
    EXPECT_EQ(linesOf(Material::load(path("self.material.json"), shippedSource())).size(), 1U);
}

TEST_F(Parents, AParentOfAnotherTypeIsNamedAtBothPlaces) {
    write("pbr.material.json", "", "", "standard_pbr", 1);
    write("child.material.json", "pbr.material.json", "");
    const auto lines = linesOf(Material::load(path("child.material.json"), shippedSource()));
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_EQ(
        lines[0],
        "child.material.json:3:13 V012 parent 'pbr.material.json' is of type 'standard_pbr.materialtype.json', this "
        "material of 'hair.materialtype.json'");
    EXPECT_EQ(lines[1].substr(0, 28), "pbr.material.json:2:11 V012 ");
}

TEST_F(Parents, TwoNamesOfOneTypeAreOneType) {
    write("base.material.json", "", R"("scattering.ior": 1.9)", "./hair");
    write("child.material.json", "base.material.json", "");
    const auto child = Material::load(path("child.material.json"), shippedSource());
    EXPECT_TRUE(child) << child.error().text();
}

TEST_F(Parents, AMissingOrFaultyParentIsNamed) {
    write("child.material.json", "gone.material.json", "");
    auto lines = linesOf(Material::load(path("child.material.json"), shippedSource()));
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_EQ(lines[0], "child.material.json:3:13 V012 cannot use parent 'gone.material.json'");
    EXPECT_EQ(lines[1].substr(0, 28), "gone.material.json:0:0 F001 ");

    std::ofstream(path("faulty.material.json")) << "{ \"format\": \"pelage.material/1\", \"typ\": 1 }";
    write("child.material.json", "faulty.material.json", "");
    lines = linesOf(Material::load(path("child.material.json"), shippedSource()));
    ASSERT_GE(lines.size(), 2U);
    EXPECT_NE(
        std::find(lines.begin(), lines.end(), "child.material.json:3:13 V012 cannot use parent 'faulty.material.json'"),
        lines.end());

    write("wrong.material.json", "", R"("scattering.iro": 1.9)");
    write("child.material.json", "wrong.material.json", "");
    lines = linesOf(Material::load(path("child.material.json"), shippedSource()));
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0].substr(0, 30), "wrong.material.json:5:14 V002 ") << lines[0];
}

TEST_F(Parents, AProgramMaySayWhereParentsAre) {
    write("deep/base.material.json", "", R"("scattering.ior": 1.9)");
    write("child.material.json", "anything", "");
    std::string from;
    const auto child = Material::load(path("child.material.json"), shippedSource(),
                                      [&](const std::string& name, const std::string& file) {
                                          from = name + " " + file;
                                          return path("deep/base.material.json");
                                      });
    ASSERT_TRUE(child) << child.error().text();
    EXPECT_EQ(from, "anything " + path("child.material.json"));
    EXPECT_EQ(child->material.get("scattering.ior")->number[0], 1.9F);
}

}  // namespace
