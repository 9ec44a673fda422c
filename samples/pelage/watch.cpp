// SPDX-License-Identifier: MIT
#include "watch.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string_view>

namespace pelage::app {

namespace fs = std::filesystem;

void Watch::set(const std::vector<std::string>& files, bool neighbours) {
    files_ = files;
    neighbours_ = neighbours;
    std::map<std::string, Known> next;
    for (const std::string& file : present()) {
        const auto before = known_.find(file);
        next[file] = before != known_.end() ? before->second : Known{contentOf(file)};
    }
    known_ = std::move(next);
}

bool Watch::changed() {
    bool any = false;
    for (const std::string& file : present()) {
        Known& known = known_[file];  // a neighbour that was not there is known as gone
        const std::uint64_t now = contentOf(file);
        if (now == known.content) {
            known.missedOnce = false;
        } else if (now == gone && !known.missedOnce) {
            known.missedOnce = true;
        } else {
            known = {now};
            any = true;
        }
    }
    return any;
}

std::uint64_t Watch::contentOf(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return gone;
    const std::string bytes(std::istreambuf_iterator<char>(stream), {});
    if (bytes.empty()) return gone;
    return std::max<std::uint64_t>(std::hash<std::string_view>{}(bytes), 1);
}

std::vector<std::string> Watch::present() const {
    std::vector<std::string> files = files_;
    if (!neighbours_) return files;
    for (const std::string& file : files_) {
        const fs::path folder = fs::path(file).parent_path();
        std::error_code failed;
        for (fs::directory_iterator at(folder.empty() ? "." : folder, failed), end; !failed && at != end;
             at.increment(failed)) {
            if (at->path().extension() == ".json") files.push_back((folder / at->path().filename()).string());
        }
    }
    std::sort(files.begin(), files.end());
    files.erase(std::unique(files.begin(), files.end()), files.end());
    return files;
}

}  // namespace pelage::app
