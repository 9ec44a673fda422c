// SPDX-License-Identifier: MIT
// The pages about files are those that the schemas give, and every member is explained.
#include "app_fixture.hpp"

#include <nlohmann/json.hpp>

namespace pelage::test {

namespace {

class Schema : public App {
protected:
    static std::string shipped(const std::string& file) { return read(std::string(PELAGE_SOURCE_DIR) + "/" + file); }

    void expectPage(const std::string& name, const std::string& page) const {
        const RunResult made = run({"schema", name, "--markdown"});
        EXPECT_EQ(made.exitCode, 0) << made.err;
        EXPECT_TRUE(made.out == shipped(page))
            << page << " is not what the schema gives: pelage schema " << name << " --markdown -o " << page;
    }

    /// Paths of members without a description, apart from those of conditions, which only narrow what is described.
    static void findUnexplained(const nlohmann::json& schema, const std::string& path, std::size_t& members,
                                std::string& unexplained) {
        if (schema.is_array()) {
            for (std::size_t i = 0; i < schema.size(); ++i)
                findUnexplained(schema[i], path + "/" + std::to_string(i), members, unexplained);
        }
        if (!schema.is_object()) return;
        const auto properties = schema.find("properties");
        if (properties != schema.end() && properties->is_object()) {
            for (const auto& [name, member] : properties->items()) {
                ++members;
                const std::string text = member.is_object() ? member.value("description", "") : "";
                if (text.size() < 4) unexplained += path + "/" + name + "\n";
            }
        }
        for (const auto& [key, value] : schema.items()) {
            if (key == "allOf" || key == "if" || key == "then") continue;
            // These hold schemas by names, which may be those of keywords.
            const bool named = (key == "properties" || key == "$defs") && value.is_object();
            if (!named) findUnexplained(value, path + "/" + key, members, unexplained);
            if (!named) continue;
            for (const auto& [name, one] : value.items()) findUnexplained(one, path + "/" + name, members, unexplained);
        }
    }
};

TEST_F(Schema, PageOfPassTreesIsWhatTheSchemaGives) {
    expectPage("passtree", "docs/passes.md");
}
TEST_F(Schema, PageOfMaterialsIsWhatTheSchemaGives) {
    expectPage("material", "docs/materials.md");
}

TEST_F(Schema, PageOfDiagnosticsIsWhatTheListGives) {
    EXPECT_TRUE(run({"schema", "diagnostics"}).out == shipped("docs/diagnostics.md"))
        << "pelage schema diagnostics -o docs/diagnostics.md";
}

TEST_F(Schema, EveryMemberIsExplained) {
    for (const char* file : {"passes/data/passtree.schema.json", "materials/data/materialtype.schema.json",
                             "materials/data/material.schema.json"}) {
        std::size_t members = 0;
        std::string unexplained;
        findUnexplained(nlohmann::json::parse(shipped(file)), "", members, unexplained);
        EXPECT_GT(members, 5U) << file;
        EXPECT_EQ(unexplained, "") << file;
    }
}

TEST_F(Schema, TheTextItselfIsPrinted) {
    EXPECT_EQ(run({"schema", "passtree"}).out, shipped("passes/data/passtree.schema.json"));
    expectRefusal({"schema", "passtre"}, "A121");
}

}  // namespace

}  // namespace pelage::test
