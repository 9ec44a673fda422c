// SPDX-License-Identifier: MIT
#include "app_fixture.hpp"

namespace pelage::test {

namespace {

class Help : public App {};

TEST_F(Help, OfTheProgramNamesEveryCommand) {
    const RunResult result = run({"--help"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.err, "");
    for (const char* command : {"render", "view", "info", "check", "graph", "schema", "gallery", "bench", "scatter", "accuracy"}) {
        EXPECT_NE(result.out.find(command), std::string::npos) << command;
    }
}

TEST_F(Help, OfEveryCommand) {
    for (const char* command : {"render", "view", "info", "check", "graph", "schema", "gallery", "bench", "scatter", "accuracy"}) {
        const RunResult result = run({command, "--help"});
        EXPECT_EQ(result.exitCode, 0) << command;
        EXPECT_EQ(result.err, "") << command;
        EXPECT_GT(result.out.size(), 50U) << command;
    }
}

TEST_F(Help, Version) {
    EXPECT_EQ(run({"--version"}).exitCode, 0);
}

}  // namespace

}  // namespace pelage::test
