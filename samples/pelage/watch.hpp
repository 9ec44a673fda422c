// SPDX-License-Identifier: MIT
// Notices files whose contents changed. Contents are compared, not times: two edits within one tick of the file
// system's clock are two edits, and a file that was only touched has not changed.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace pelage::app {

class Watch {
public:
    /// Watches these from now on; with `neighbours`, every *.json file beside them as well, those that do not exist yet
    /// included. What is known of a file that was watched before stays known, so that no edit falls between.
    void set(const std::vector<std::string>& files, bool neighbours = false);

    /// True once after any of the files changed. Editors replace files, and empty them before they write: a file that
    /// is gone or empty counts as changed when it is so twice in a row.
    bool changed();

private:
    static constexpr std::uint64_t gone = 0;
    static std::uint64_t contentOf(const std::string& file);
    std::vector<std::string> present() const;

    struct Known {
        std::uint64_t content = gone;
        bool missedOnce = false;
    };
    std::vector<std::string> files_ = {};
    bool neighbours_ = false;
    std::map<std::string, Known> known_ = {};
};

}  // namespace pelage::app
