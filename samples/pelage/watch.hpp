// SPDX-License-Identifier: MIT
// Notices files that were written again.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace pelage::app {

class Watch {
public:
    void set(const std::vector<std::string>& files) {
        times_.clear();
        for (const std::string& file : files) times_[file] = timeOf(file);
    }

    /// True once after any of the files changed. A file that is gone for a moment (editors replace files) is no change.
    bool changed() {
        bool any = false;
        for (auto& [file, known] : times_) {
            const auto now = timeOf(file);
            if (now == Time::min() || now == known) continue;
            known = now;
            any = true;
        }
        return any;
    }

private:
    using Time = std::filesystem::file_time_type;

    static Time timeOf(const std::string& file) {
        std::error_code failed;
        const Time time = std::filesystem::last_write_time(file, failed);
        return failed ? Time::min() : time;
    }

    std::map<std::string, Time> times_ = {};
};

}  // namespace pelage::app
