// SPDX-License-Identifier: MIT
#include "data.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string_view>

namespace pelage::app {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view sceneEnding = ".scene.json";

fs::path sceneDirectory() {
    const fs::path beside = fs::path(dataDirectory()) / "scenes";
    std::error_code ignored;
    return fs::is_directory(beside, ignored) ? beside : fs::path(PELAGE_SCENE_DIR);
}

/// share/pelage beside the bin/ this program runs from; empty when there is none.
fs::path installedData() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    if (error) return {};
    const fs::path data = program.parent_path().parent_path() / "share" / "pelage";
    return fs::is_directory(data / "types", error) ? data : fs::path();
}

}  // namespace

std::string dataDirectory() {
    const char* chosen = std::getenv("PELAGE_DATA");
    if (chosen && *chosen) return chosen;
    const fs::path installed = installedData();
    return installed.empty() ? PELAGE_DATA_DIR : installed.string();
}

std::vector<std::string> sceneNames() {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator at(sceneDirectory(), error), end; !error && at != end; at.increment(error)) {
        const std::string name = at->path().filename().string();
        if (name.ends_with(sceneEnding)) names.push_back(name.substr(0, name.size() - sceneEnding.size()));
    }
    std::sort(names.begin(), names.end());
    return names;
}

std::string scenePath(const std::string& name) {
    if (name.find('/') != std::string::npos) return {};
    const fs::path path = sceneDirectory() / (name + std::string(sceneEnding));
    std::error_code ignored;
    return fs::is_regular_file(path, ignored) ? path.string() : std::string();
}

}  // namespace pelage::app
