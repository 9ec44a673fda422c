// SPDX-License-Identifier: MIT
// A progress bar on a terminal; nothing but the plain lines elsewhere.
#pragma once

#include <cstddef>
#include <string>

namespace pelage::app {

class Progress {
public:
    explicit Progress(std::size_t total);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress();

    /// What is being worked on now.
    void show(const std::string& name);
    /// One is done: its line takes the place of the bar.
    void done(const std::string& line);
    /// One could not be done; its error has gone to stderr by the caller after clear().
    void skip();
    void clear();

private:
    std::size_t total_, finished_ = 0;
    bool terminal_;
};

}  // namespace pelage::app
