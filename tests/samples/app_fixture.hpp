// SPDX-License-Identifier: MIT
// Runs the app in a directory of its own that is gone afterwards.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace pelage::test {

struct RunResult {
    int exitCode = -1;  // -1: killed by a signal
    std::string out = {}, err = {};
    std::size_t errorLines() const;
};

class App : public ::testing::Test {
protected:
    void SetUp() override;
    void TearDown() override;

    /// Arguments are passed as they are (no shell words inside are interpreted).
    RunResult run(const std::vector<std::string>& arguments) const;
    std::string path(const std::string& name) const { return (directory_ / name).string(); }
    std::string write(const std::string& name, const std::string& bytes) const;
    static std::string read(const std::string& path);

    /// Exit code 2, one line "pelage: error …" that contains `part`, and neither `output` nor anything beside it.
    void expectRefusal(std::vector<std::string> arguments, const std::string& part) const;

private:
    std::filesystem::path directory_;
};

}  // namespace pelage::test
