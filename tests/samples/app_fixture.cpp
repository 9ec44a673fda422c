// SPDX-License-Identifier: MIT
#include "app_fixture.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace pelage::test {

namespace fs = std::filesystem;

namespace {

std::string quoted(const std::string& word) {
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

}  // namespace

std::size_t RunResult::errorLines() const {
    return static_cast<std::size_t>(std::count(err.begin(), err.end(), '\n'));
}

void App::SetUp() {
    std::string pattern = (fs::temp_directory_path() / "pelage-test-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    directory_ = pattern;
}

void App::TearDown() {
    std::error_code ignored;
    if (!directory_.empty()) fs::remove_all(directory_, ignored);
}

std::string App::write(const std::string& name, const std::string& bytes) const {
    std::ofstream file(path(name), std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path(name);
}

std::string App::read(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

RunResult App::run(const std::vector<std::string>& arguments) const {
    std::string command = "cd " + quoted(directory_.string()) + " && " + quoted(PELAGE_APP);
    for (const std::string& argument : arguments) command += " " + quoted(argument);
    command += " >" + quoted(path("stdout")) + " 2>" + quoted(path("stderr")) + " </dev/null";
    const int status = std::system(command.c_str());
    RunResult result;
    // The shell reports a signal of its child as 128 and the signal's number.
    if (WIFEXITED(status) && WEXITSTATUS(status) < 128) result.exitCode = WEXITSTATUS(status);
    result.out = read(path("stdout"));
    result.err = read(path("stderr"));
    return result;
}

void App::expectRefusal(std::vector<std::string> arguments, const std::string& part) const {
    const auto count = [&] { return std::distance(fs::directory_iterator(directory_), fs::directory_iterator()); };
    write("stdout", "");
    write("stderr", "");
    const auto before = count();
    const RunResult result = run(arguments);
    EXPECT_EQ(result.exitCode, 2) << result.err;
    EXPECT_EQ(result.errorLines(), 1U) << result.err;
    EXPECT_EQ(result.err.rfind("pelage: error ", 0), 0U) << result.err;
    EXPECT_NE(result.err.find(part), std::string::npos) << "expected \"" << part << "\" in: " << result.err;
    EXPECT_EQ(count(), before) << "a file was left behind";
}

}  // namespace pelage::test
